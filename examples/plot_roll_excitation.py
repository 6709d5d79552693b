"""Why the roll moment of strip theory and of panels differ by a fifth, and why the ship rolls alike all the same.

Series 60 CB 0.60 and a Wigley hull in beam seas at zero speed, strips against Capytaine. The water escapes round the ends
of a real ship, where a section thinks it is infinitely long. The deep, narrow end sections carry most of the sway-roll added
mass, so the moment on a ship held fast suffers most. A ship that is free to sway meets the same added mass in its own
motion, and its roll excitation comes out within 3 %. With ends: three-dimensional the moment on the ship held fast does too,
within 5 %. Prints the numbers quoted in docs/how_good_is_it.md.

Needs Capytaine: pip install 'quartering[bem]'

Usage: python plot_roll_excitation.py [picture.png]
"""

import sys

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import quartering as qt
from quartering.hull.lines.mesh import hull_panels
from quartering.hydro.strip.moments import section_table
from quartering.loads.strips.stations import stations

BLUE, RED, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#6b6b6b"
RATIOS = np.array([0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0])
DAMPING = 0.05
"""Roll damping added on both sides, fraction of critical."""


def coupling_along(ship: qt.Ship, frequency: float, panels: tuple[int, int] = (60, 16)) -> dict[str, np.ndarray]:
    """Sway-roll added mass about the waterline, per metre of ship: by strips, and by panels integrated column by column.

    Returns x from G [m], width of each column of panels [m], `panels` and `strips` [kg m/m].
    """
    import capytaine  # here, so that the rest can be read without it

    capytaine.set_logging("ERROR")
    half = hull_panels(ship.hull, *panels)
    x_g = qt.hydrostatics(ship).lcb
    turned = (half.vertices - [x_g, 0.0, 0.0]) * [1.0, -1.0, -1.0]  # y to port, z up
    mesh = capytaine.ReflectionSymmetricMesh(capytaine.Mesh(vertices=turned, faces=half.quads), plane="xOz")
    dofs = capytaine.rigid_body_dofs(only=["Sway", "Roll"], rotation_center=(0.0, 0.0, 0.0))
    body = capytaine.FloatingBody(mesh=mesh, dofs=dofs)
    problem = capytaine.RadiationProblem(
        body=body, omega=frequency, radiating_dof="Sway", rho=ship.loading.density, g=9.81, water_depth=np.inf
    )
    result = capytaine.BEMSolver().solve(problem)
    whole = body.mesh.merged()
    centre, normal = whole.faces_centers, whole.faces_normals
    lever = centre[:, 1] * normal[:, 2] - centre[:, 2] * normal[:, 1]
    mass = (result.pressure * lever * whole.faces_areas).real / frequency**2  # minus, and minus again for z down
    ends = np.sort(whole.vertices[whole.faces][:, :, 0], axis=1)[:, [0, -1]]
    columns, where = np.unique(ends.round(6), axis=0, return_inverse=True)
    width = columns[:, 1] - columns[:, 0]
    x = columns.mean(axis=1)
    total = np.bincount(where.ravel(), mass, columns.shape[0])
    return {"x": x, "width": width, "panels": total / width, "strips": coupling_of_sections(ship, frequency, x)}


def coupling_of_sections(ship: qt.Ship, frequency: float, x: np.ndarray) -> np.ndarray:
    """Sway-roll added mass about the waterline of the sections at places x from G, per metre of ship [kg m/m]."""
    place, table = stations(ship), section_table(ship.hull, ship.loading.density)
    strips = [np.interp(frequency, table.frequency, table.a[:, i, 1]) for i in range(place.x.size)]
    return np.interp(x, place.x, strips)


def both(ship: qt.Ship, panels: xr.Dataset) -> dict[str, tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Force (n, 3) [N/m], added mass and damping (n, 3, 3) in beam seas at zero speed, by strips and by panels."""
    lengths = panels.wave_length.to_numpy()
    force = qt.compare_forces(ship, lengths, [90.0], bem=panels).force.sel(heading=90.0)
    phasor = force.sel(part="cos") - 1j * force.sel(part="sin")
    strips = qt.hydrodynamics(ship, frequency=np.sqrt(2 * np.pi * 9.81 / lengths), speed=0.0)
    found = (("strips", "stf", strips), ("panels", "bem", panels))
    return {
        name: (phasor.sel(form=form).to_numpy(), ds.added_mass.to_numpy(), ds.damping.to_numpy())
        for name, form, ds in found
    }


def impedance(ship: qt.Ship, omega: np.ndarray, added: np.ndarray, damping: np.ndarray) -> np.ndarray:
    """Mass, added mass and damping as one: -w^2 Z x + C x = F, (n, 3, 3)."""
    mass = ship.loading.density * qt.hydrostatics(ship).volume
    own = np.diag([mass, mass * ship.loading.gyradius_roll**2, mass * ship.loading.gyradius_yaw**2])
    return own + added - 1j * damping / omega[:, None, None]


def free_moment(
    ship: qt.Ship, omega: np.ndarray, force: np.ndarray, added: np.ndarray, damping: np.ndarray
) -> np.ndarray:
    """Moment that rolls a ship free to sway and yaw: these have no restoring and are eliminated exactly. (n,) [N m/m]"""
    z, free = impedance(ship, omega, added, damping), [0, 2]
    moved = np.linalg.solve(z[:, free][:, :, free], force[:, free, None])[..., 0]
    return force[:, 1] - (z[:, 1, free] * moved).sum(axis=1)


def roll(ship: qt.Ship, omega: np.ndarray, force: np.ndarray, added: np.ndarray, damping: np.ndarray) -> np.ndarray:
    """Roll amplitude per metre of wave amplitude, (n,) [rad/m]."""
    z = impedance(ship, omega, added, damping)
    stiffness = ship.loading.density * 9.81 * qt.hydrostatics(ship).volume * ship.loading.gm
    z[:, 1, 1] -= 1j * 2 * DAMPING * np.sqrt(stiffness * z[:, 1, 1].real) / omega
    system = -(omega[:, None, None] ** 2) * z + np.diag([0.0, stiffness, 0.0])
    return np.abs(np.linalg.solve(system, force[..., None])[:, 1, 0])


def measures(ship: qt.Ship, ratios: np.ndarray, panels: xr.Dataset) -> dict[str, np.ndarray]:
    """Strips over panels (of `bem_forces`) in beam seas: moments about three points, the lever they differ by, and roll."""
    omega = np.sqrt(2 * np.pi * 9.81 / (ratios * ship.hull.length))
    two = both(ship, panels)
    (ours, *own), (theirs, *three) = two["strips"], two["panels"]
    lever = ship.loading.kg - ship.hull.draught
    held = [force[:, 1] + lever * force[:, 0] for force in (ours, theirs)]
    return {
        "sway force": np.abs(ours[:, 0] / theirs[:, 0]),
        "about the waterline": np.abs(held[0] / held[1]),
        "about G": np.abs(ours[:, 1] / theirs[:, 1]),
        "free to sway and yaw": np.abs(free_moment(ship, omega, ours, *own) / free_moment(ship, omega, theirs, *three)),
        "lever over draught": np.abs(held[0] - held[1]) / np.abs(theirs[:, 0]) / ship.hull.draught,
        "roll": roll(ship, omega, ours, *own) / roll(ship, omega, theirs, *three),
        "roll, force by panels on strips": roll(ship, omega, theirs, *own) / roll(ship, omega, theirs, *three),
    }


def draw_along(axes: plt.Axes, ship: qt.Ship) -> None:
    """Sway-roll added mass per metre along the ship in waves of its length."""
    length, frequency = ship.hull.length, np.sqrt(2 * np.pi * 9.81 / ship.hull.length)
    found = coupling_along(ship, frequency)
    ends = coupling_of_sections(ship.with_(ends="three-dimensional"), frequency, found["x"])
    axes.plot(found["x"] / length, found["strips"] / 1e3, color=RED, label="strips")
    axes.plot(found["x"] / length, ends / 1e3, color=BLUE, label="strips, three-dimensional ends")
    axes.plot(found["x"] / length, found["panels"] / 1e3, "o", color="k", mfc="none", ms=4, label="panels")
    axes.set(
        title="Series 60, λ = L: sway-roll added mass\nabout the waterline (960 panels a side)",
        xlabel="x/L, bow to the right", ylabel="[t m/m]",
    )  # fmt: skip


def draw_ratios(moments: plt.Axes, motion: plt.Axes, words: str, dash: str, found: dict[str, np.ndarray]) -> None:
    """Moments and roll over those of panels, of one ship by strips; and the moment on a ship held fast about G."""
    points = (("about the waterline", RED, "s"), ("about G", GREY, "^"), ("free to sway and yaw", GREEN, "o"))
    for key, colour, mark in points:
        moments.plot(RATIOS, found[key], color=colour, ls=dash, marker=mark, ms=4, label=f"{words}, {key}")
    sources = (
        ("roll", RED, "s", "strips"),
        ("roll, force by panels on strips", GREY, "^", "force by panels on strips"),
    )
    for key, colour, mark, of in sources:
        motion.plot(RATIOS, found[key], color=colour, ls=dash, marker=mark, ms=4, label=f"{words}, {of}")


def draw_ends(moments: plt.Axes, motion: plt.Axes, words: str, dash: str, found: dict[str, np.ndarray]) -> None:
    """The same with three-dimensional ends: the moment about the waterline, and roll."""
    said = "three-dimensional ends"
    held = found["about the waterline"]
    moments.plot(RATIOS, held, color=BLUE, ls=dash, marker="D", ms=4, label=f"{words}, about the waterline, {said}")
    motion.plot(RATIOS, found["roll"], color=BLUE, ls=dash, marker="D", ms=4, label=f"{words}, strips, {said}")


def main(picture: str = "") -> None:
    figure, (along, moments, motion) = plt.subplots(1, 3, figsize=(13, 5.2), layout="constrained")
    draw_along(along, qt.ship("series60-cb60").with_(ends="strips"))
    for name, dash, words in (("series60-cb60", "-", "Series 60"), ("wigley", "--", "Wigley")):
        ship = qt.ship(name)
        panels = qt.bem_forces(ship, RATIOS * ship.hull.length, [90.0])
        for ends, draw in (("strips", draw_ratios), ("three-dimensional", draw_ends)):
            found = measures(ship.with_(ends=ends), RATIOS, panels)
            for key, values in found.items():
                print(f"{words}, ends {ends}, {key}, over panels: " + " ".join(f"{v:.3f}" for v in values))
            draw(moments, motion, words, dash, found)
    moments.set(title="roll moment in beam seas\nover that by panels", ylim=(0.3, 1.5))
    motion.set(title="roll in beam seas\nover roll by panels", ylim=(0.7, 1.5))
    for axes in (moments, motion):
        axes.axhline(1.0, color="k", lw=0.8)
        axes.set_xlabel("λ/L")
    for axes in figure.axes:
        axes.grid(color="#dddddd", lw=0.6)
        axes.spines[["top", "right"]].set_visible(False)
        axes.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.14), frameon=False)
    figure.suptitle(
        "Zero speed, beam seas: strip theory and Capytaine (480 panels a side)", x=0.01, ha="left", fontsize=11
    )
    if picture:
        figure.savefig(picture, dpi=85)
    else:
        plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
