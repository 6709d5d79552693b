"""How good is it? Sections, motions, added mass and wave forces beside published numbers and a three-dimensional code.

Four pictures: 2-D sections against multipole references and Vugts' measurements; the S-175 at zero speed against SCORES;
Journee's Wigley III against 3-D panels; the forms of the wave force on Series 60, with Capytaine where it is installed.
Prints the numbers quoted in docs/how_good_is_it.md.

Usage: python plot_how_good.py [picture.png]   (the other three are named after it: picture-sections.png, ..)
"""

import csv
import sys
import warnings
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt
from quartering.hull.lines.hull import scaled
from quartering.hull.lines.stations import hull_from_offsets
from quartering.hull.ship import Loading, Ship
from quartering.hydro.added_mass import hydrodynamics6
from quartering.hydro.source.capytaine_run import bem_forces
from quartering.loads.comparison import compare_forces
from quartering.view.plots.forces import LOOKS

TESTS = Path(__file__).parents[1] / "tests"
PANELS = find_spec("capytaine") is not None
BLUE, RED, GREEN, PINK, GREY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#6b6b6b"
MODES = ("sway", "roll", "yaw")


def read(path: str) -> list[dict[str, str]]:
    lines = (TESTS / path).read_text().splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def finish(figure: plt.Figure, title: str, picture: Path | None, name: str) -> None:
    figure.suptitle(title, x=0.01, ha="left", fontsize=11)
    for axes in figure.axes:
        axes.grid(color="#dddddd", lw=0.6)
        axes.spines[["top", "right"]].set_visible(False)
    if picture:
        figure.savefig(picture.with_stem(picture.stem + name), dpi=85)
        plt.close(figure)


# ------------------------------------------------------------------------------------------------------- sections


def rectangle(ratio: float) -> qt.Section:
    """Half contour of breadth 2, keel to waterline."""
    along, draught = np.linspace(0, 1, 41), 2 / ratio
    return qt.Section(y=np.append(along, np.ones(40)), z=draught * np.append(np.ones(41), 1 - along[1:]))


def curve(section: qt.Section, area: float, w: np.ndarray, key: str, method: str) -> np.ndarray:
    """A coefficient in the units of the reference tables; breadth 2."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", qt.RangeWarning)
        ds = qt.section_coefficients(section, w * np.sqrt(9.81), method=method, density=1.0)
    unit = area * {"22": 1.0, "33": 1.0, "24": 2.0, "44": 4.0}[key[1:]] * (np.sqrt(9.81) if key[0] == "b" else 1.0)
    return ds[key].to_numpy() / unit


def points(axes: plt.Axes, rows: list[dict[str, str]], name: str, key: str) -> None:
    chosen = [row for row in rows if row["section"] == name]
    x = [np.sqrt(float(row["frequency_squared"])) for row in chosen]
    axes.plot(x, [float(row[key]) for row in chosen], "o", color=GREY, mfc="none", ms=4, label="_")


def sections(picture: Path | None) -> None:
    """Added mass and damping of a half circle and two rectangles over frequency."""
    figure, panels = plt.subplots(2, 4, figsize=(13, 6), layout="constrained")
    w, angle = np.linspace(0.05, 2.0, 79), np.linspace(0, np.pi / 2, 101)
    measured = read("data/vugts_circle.csv")
    reference = read("data/sections_reference.csv") + read("data/rectangles_reference.csv")
    circle = qt.Section(y=np.sin(angle), z=np.cos(angle))
    names = {"a22": "sway added mass", "b22": "sway damping", "a33": "heave added mass", "b33": "heave damping"}
    for axes, (key, words) in zip(panels[0], names.items(), strict=True):
        for method, colour, dash in (("lewis", BLUE, "-"), ("close-fit", RED, "--")):
            axes.plot(w, curve(circle, np.pi / 2, w, key, method), color=colour, ls=dash, label=method)
        points(axes, reference, "circle", key)
        at = [row for row in measured if row["quantity"] == key]
        values = [float(row["frequency"]) for row in at], [float(row["measured"]) for row in at]
        axes.plot(*values, "k*", ms=9, label="Vugts 1970, measured")
        axes.set(title=f"half circle: {words}", ylim=(0, 2.2 if key == "a33" else None))
    names = {"a22": "sway added mass", "a24": "sway-roll added mass", "a44": "roll added mass", "b22": "sway damping"}
    for axes, (key, words) in zip(panels[1], names.items(), strict=True):
        for ratio, colour in ((2, GREEN), (8, PINK)):
            for method, dash in (("lewis", ":"), ("close-fit", "-")):
                values = curve(rectangle(ratio), 4 / ratio, w, key, method)
                axes.plot(w, values, color=colour, ls=dash, label=f"B/T = {ratio}, {method}")
            points(axes, reference, f"rectangle-{ratio}", key)
        axes.set(title=f"rectangles: {words}", xlabel="ω √(B/2g)")
    panels[0, 2].legend(fontsize=7.5)
    panels[1, 0].legend(fontsize=7.5)
    title = (
        "Sections: lines are ours, circles a multipole reference, stars measured; units ρA, ρAB, ρAB²; damping √(2g/B)"
    )
    finish(figure, title, picture, "-sections")


# ---------------------------------------------------------------------------------------------------------- S-175


def s175(picture: Path | None) -> None:
    """Sway, roll and yaw at zero speed beside SCORES."""
    rows = read("reference/s175_scores.csv")
    ship = qt.ship("s175").with_(ends="strips", gm=1.066, gyradius_roll=9.65, gyradius_yaw=70.0, roll_damping=0.0)
    figure, panels = plt.subplots(1, 3, figsize=(13, 4.2), layout="constrained")
    fine = np.unique(np.concatenate([np.linspace(0.2, 0.63, 80), np.linspace(0.305, 0.33, 51)]))
    for heading, colour in ((30.0, BLUE), (60.0, RED), (90.0, GREEN)):
        table = [row for row in rows if float(row["heading_deg"]) == heading]
        omega = np.array([float(row["omega"]) for row in table])
        every = np.unique(np.concatenate([omega, fine]))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", qt.RangeWarning)
            ds = qt.sweep(ship, 0.0, heading, (2 * np.pi * 9.81 / every**2)[::-1], [0.002])
        low = (omega < 0.4) & (np.abs(omega - 0.31738) > 0.012)
        said = []
        for axes, name, unit in zip(panels, MODES, ("m_per_m", "deg_per_m", "deg_per_m"), strict=True):
            ours = ds[name].to_numpy().ravel()[::-1] / 0.001
            theirs = np.array([float(row[f"{name}_{unit}"]) for row in table])
            axes.plot(every, ours, color=colour, lw=1.2, label=f"{heading:.0f}°")
            axes.plot(omega, theirs, "o", color=colour, mfc="none", ms=3.5)
            off = np.abs(np.interp(omega, every, ours) - theirs)[low].max() / theirs.max()
            said.append(f"{name} {100 * off:.1f} %")
        print(f"S-175 {heading:.0f} deg, below 0.4 rad/s, of the peak: " + ", ".join(said))
    panels[0].set_ylim(0, 1.2)
    panels[2].set_ylim(0, 0.5)
    for axes, name, unit in zip(panels, MODES, ("m/m", "deg/m", "deg/m"), strict=True):
        axes.set(
            title=f"{name} per metre of wave amplitude [{unit}]", xlabel="wave frequency [rad/s]", xlim=(0.2, 0.65)
        )
    panels[1].set_yscale("log")
    panels[1].axvline(0.31738, color=GREY, lw=0.8, ls=":")
    panels[0].legend(title="heading", fontsize=8)
    finish(
        figure,
        "S-175 at zero speed: lines are ours, circles SCORES II (a strip program of 1972); no added damping",
        picture,
        "-s175",
    )


# ----------------------------------------------------------------------------------------------------- Wigley III


def wigley_iii() -> Ship:
    x, t = np.linspace(-1.5, 1.5, 33), np.linspace(1.0, 0.0, 25)
    half = 0.15 * (1 - (x / 1.5) ** 2) * (1 + 0.2 * (x / 1.5) ** 2)
    contours = tuple((np.append(b * (1 - t**2), b), 0.1875 * np.append(1 - t, 1.3)) for b in half)
    hull = hull_from_offsets("Wigley III", length=3.0, beam=0.3, draught=0.1875, x=x, contours=contours)
    return Ship("Wigley III", hull, Loading(gm=0.05, kg=0.1875, gyradius_roll=0.1, gyradius_yaw=0.75, density=1000.0))


def wigley(picture: Path | None) -> None:
    """Ratios of added mass and damping to 3-D panels, and wave forces beside them."""
    ship, rows = wigley_iii(), read("hydro/wigley3_radiation_3d.csv")
    omega = np.unique([float(row["omega"]) for row in rows])
    scaled_omega = omega * np.sqrt(3.0 / 9.81)
    ds = hydrodynamics6(ship, omega, reference="waterline")
    figure, panels = plt.subplots(2, 2, figsize=(11, 7), layout="constrained")
    styles = {"sway": ("22", BLUE), "roll": ("44", RED), "yaw": ("66", GREEN), "heave": ("33", PINK)}
    for axes, quantity, name in zip(panels[0], "AB", ("added_mass", "damping"), strict=True):
        for mode, (digits, colour) in styles.items():
            chosen = [r for r in rows if (r["quantity"], r["force"], r["motion"]) == (quantity, mode, mode)]
            ratio = ds[name].sel(mode=mode, mode_of_motion=mode) / [float(r["value"]) for r in chosen]
            axes.plot(scaled_omega, ratio, "o-", ms=3, color=colour, label=f"{quantity}{digits}")
            print(f"Wigley III {quantity}{digits} strip over 3-D: " + " ".join(f"{v:.2f}" for v in ratio.to_numpy()))
        axes.axhline(1, color="k", lw=0.8)
        axes.set(title=f"{name.replace('_', ' ')}: strip over 3-D", xlabel="ω √(L/g)")
        axes.legend()
    panels[0, 1].set_yscale("log")
    lengths = np.geomspace(0.25, 6.3, 120) * 3.0
    forces = compare_forces(ship, lengths, [90.0, 150.0])
    table = read("loads/wigley3_forces_3d.csv")
    for axes, mode in zip(panels[1], ("sway", "roll"), strict=True):
        for heading, colour in ((90.0, BLUE), (150.0, RED)):
            axes.plot(
                lengths / 3,
                forces.amplitude.sel(form="stf", mode=mode, heading=heading),
                color=colour,
                label=f"{heading:.0f}°",
            )
            chosen = [r for r in table if r["mode"] == mode and float(r["heading"]) == heading]
            parts = [
                np.array([complex(float(r["real"]), float(r["imag"])) for r in chosen if r["force"] == f])
                for f in ("FK", "FD")
            ]
            axes.plot(2 * np.pi / scaled_omega**2, np.abs(parts[0] + parts[1]), "o", color=colour, mfc="none", ms=4)
        axes.set(
            title=f"{'sway force' if mode == 'sway' else 'roll moment'} per amplitude [{'N/m' if mode == 'sway' else 'N m/m'}]",
            xlabel="λ/L",
            xscale="log",
            ylim=(0, None),
        )
        axes.set_xticks([0.25, 0.5, 1, 2, 4], ["0.25", "0.5", "1", "2", "4"])
        axes.set_xticks([], minor=True)
        axes.legend(title="heading")
    finish(
        figure,
        "Journée's Wigley III at zero speed, about the waterplane centre: strip theory (lines) and 3-D panels (circles)",
        picture,
        "-wigley3",
    )


# ------------------------------------------------------------------------------------------------------ Series 60


def series60(picture: Path | None) -> None:
    """The forms of the wave force over heading and over wave length, and what the ends of the ship do."""
    ship = qt.ship("series60-cb60").with_(ends="strips")
    length = ship.hull.length
    headings, ratios = np.arange(0.0, 181.0, 15.0), np.array([0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 3.0])
    over_heading = compared(ship, [length], headings)
    over_length = compared(ship, ratios * length, np.array([90.0]))
    figure, panels = plt.subplots(2, 3, figsize=(13, 7.4), layout="constrained")
    for column, mode in enumerate(MODES):
        for form in over_heading.form.to_numpy():
            values = over_heading.amplitude.sel(form=form, mode=mode)[0] / 1e6
            panels[0, column].plot(headings, values, label=str(form), **LOOKS[str(form)])
            if column < 2:
                values = over_length.amplitude.sel(form=form, mode=mode)[:, 0] / 1e6
                panels[1, column].plot(ratios, values, **LOOKS[str(form)])
        unit = "MN/m" if mode == "sway" else "MN m/m"
        panels[0, column].set(
            title=f"{mode}, λ = L [{unit}]", xlabel="heading [deg]", xticks=range(0, 181, 30), ylim=(0, None)
        )
        if column < 2:
            panels[1, column].set(title=f"{mode}, beam sea [{unit}]", xlabel="λ/L", ylim=(0, None))
    panels[0, 0].legend(fontsize=7.5)
    print(over_heading.largest_difference[:, 0].to_pandas().round(3))
    if PANELS:
        ends(panels[1, 2], ship, ratios[[2, 3, 5, 6, 7]])
    else:
        panels[1, 2].set_title("needs Capytaine: pip install 'quartering[bem]'")
    finish(
        figure,
        "Series 60, CB 0.60, at zero speed, about G: forms of the wave force per metre of wave amplitude",
        picture,
        "",
    )


def compared(ship: Ship, lengths: list[float] | np.ndarray, headings: np.ndarray):
    panels = bem_forces(ship, lengths, headings) if PANELS else None
    return compare_forces(ship, lengths, headings, bem=panels)


def ends(axes: plt.Axes, ship: Ship, ratios: np.ndarray) -> None:
    """Strip over panels in beam seas: the ship, and the same sections twice and four times as far apart."""
    for factor, dash in ((1, "-"), (2, "--"), (4, ":")):
        longer = replace(ship, hull=scaled(ship.hull, factor, 1.0, 1.0))
        waves = ratios * ship.hull.length
        panels = bem_forces(longer, waves, [90.0], panels=(30 + 10 * factor, 12))
        force = compare_forces(longer, waves, [90.0], bem=panels).force.sel(heading=90.0)
        phasor = force.sel(part="cos") - 1j * force.sel(part="sin")
        lever = ship.loading.kg - ship.hull.draught
        sway, roll = (phasor.sel(mode=mode) for mode in ("sway", "roll"))
        for name, values, colour in (("sway", sway, BLUE), ("roll about WL", roll + lever * sway, RED)):
            ratio = np.abs(values.sel(form="stf") / values.sel(form="bem")).to_numpy()
            axes.plot(ratios, ratio, color=colour, ls=dash, label=f"{name}, {factor} x as long" if factor > 1 else name)
            print(f"Series 60 x {factor}: {name} strip over panels: " + " ".join(f"{v:.3f}" for v in ratio))
        if factor == 1:
            size = np.abs(phasor.sel(form="froude-krylov", mode="roll"))
            share = np.abs(roll.sel(form="stf") - roll.sel(form="bem")) / size
            print(
                "roll about G: difference over Froude-Krylov moment " + " ".join(f"{v:.2f}" for v in share.to_numpy())
            )
            print(
                "roll about G: strip over panels "
                + " ".join(f"{v:.2f}" for v in np.abs(roll.sel(form="stf") / roll.sel(form="bem")).to_numpy())
            )
    axes.axhline(1, color="k", lw=0.8)
    axes.set(title="beam sea: stf over bem, for longer ships", xlabel="λ/L", ylim=(0.95, 1.42))
    axes.legend(fontsize=7.5, ncols=2)


def main(picture: str = "") -> None:
    place = Path(picture) if picture else None
    for draw in (sections, s175, wigley, series60):
        draw(place)
    if place is None:
        plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
