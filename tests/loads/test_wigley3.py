"""Journee's Wigley hull III at zero speed: strip forces and our panels against Capytaine's tabulated 3-D values.

The tables (tests/loads/wigley3_forces_3d.csv, tests/hydro/wigley3_radiation_3d.csv) were made on another mesh and are
extrapolated; their error bar is the distance to the finest mesh, 1 to 4 %.
"""

import csv
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

import quartering as qt
from quartering.hull.lines.stations import hull_from_offsets
from quartering.hull.ship import Loading, Ship
from quartering.hydro.added_mass import hydrodynamics6
from quartering.hydro.source.capytaine_run import bem_forces

LENGTH, BEAM, DRAUGHT = 3.0, 0.3, 0.1875
LATERAL = ("sway", "roll", "yaw")


def read(path):
    lines = (Path(__file__).parents[1] / path).read_text().splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


FORCES, RADIATION = read("loads/wigley3_forces_3d.csv"), read("hydro/wigley3_radiation_3d.csv")
OMEGA = np.unique([float(row["omega"]) for row in FORCES])
RATIO = 2 * np.pi * 9.81 / OMEGA**2 / LENGTH


@lru_cache
def wigley_iii(ends="strips"):
    """The hull by its formula at 33 stations, G at the waterplane centre so that moments are about it."""
    x = np.linspace(-1.5, 1.5, 33)
    t = np.linspace(1.0, 0.0, 25)
    half = BEAM / 2 * (1 - (x / 1.5) ** 2) * (1 + 0.2 * (x / 1.5) ** 2)
    contours = tuple((np.append(b * (1 - t**2), b), DRAUGHT * np.append(1 - t, 1.3)) for b in half)
    hull = hull_from_offsets("Wigley III", length=LENGTH, beam=BEAM, draught=DRAUGHT, x=x, contours=contours)
    hull = replace(hull, ends=ends)
    return Ship("Wigley III", hull, Loading(gm=0.05, kg=DRAUGHT, gyradius_roll=0.1, gyradius_yaw=0.75, density=1000.0))


def tabulated(mode, heading, force="total"):
    """Phasors (f,) of e^{i w t} in body axes, time zero as here: the table has y to port, z up, e^{-i w t}."""
    chosen = [row for row in FORCES if row["mode"] == mode and float(row["heading"]) == heading]
    wanted = ("FK", "FD") if force == "total" else (force,)
    parts = [[complex(float(r["real"]), float(r["imag"])) for r in chosen if r["force"] == part] for part in wanted]
    # the table's wave runs to port at +heading: seen from starboard it is mu = -heading, whose lateral forces are minus
    # those of mu = heading; half a turn about x turns sway and yaw once more
    turn = {"sway": 1.0, "roll": -1.0, "yaw": 1.0}[mode]
    return turn * 1j * np.conj(np.sum(parts, axis=0))


def strip(mode, heading, name="total", ends="strips"):
    ship = wigley_iii(ends)
    values = [
        qt.wave_forces(ship, qt.Wave(x * LENGTH, 0.02), heading=heading)[name].sel(mode=mode) / 0.01 for x in RATIO
    ]
    return np.array([v.sel(part="cos").item() - 1j * v.sel(part="sin").item() for v in values])


@pytest.mark.parametrize("heading", [90.0, 150.0])
@pytest.mark.parametrize("mode", ["sway", "roll"])
def test_undisturbed_pressure_is_that_of_the_table(mode, heading):
    """Froude-Krylov, within 1.5 % of the largest: axes and phases of the comparison below are right."""
    theirs = tabulated(mode, heading, "FK")
    assert np.abs(strip(mode, heading, "froude_krylov") - theirs).max() < 0.015 * np.abs(theirs).max()


def test_sway_force_is_within_ten_per_cent_beyond_0_8_ship_lengths_in_beam_seas():
    ratio = np.abs(strip("sway", 90.0) / tabulated("sway", 90.0))[RATIO > 0.8]
    assert (np.abs(ratio - 1) < 0.1).all(), ratio.round(3)


@pytest.mark.parametrize(
    ("mode", "heading", "most"),
    [("roll", 90.0, 0.21), ("sway", 150.0, 0.07), ("roll", 150.0, 0.07), ("yaw", 150.0, 0.2)],
)
def test_moments_and_bow_seas_differ_by_what_the_added_mass_differs(mode, heading, most):
    """Waves of 1.5 ship lengths and more, per the largest force.

    Strip theory over 3-D panels gives A22 1.12, A24 1.21, A44 1.29 and A66 1.25 times in these waves (it lets no water
    round the stems), and the force, of which diffraction is a part, is wrong by a part of that. In bow seas about as long
    as the ship, where the force along the ship cancels, the difference rises to a fifth of the largest force.
    """
    theirs = tabulated(mode, heading)
    off = np.abs(strip(mode, heading) - theirs)[RATIO > 1.5] / np.abs(theirs).max()
    assert (off < most).all(), off.round(3)


@pytest.mark.parametrize(
    ("quantity", "mode", "low", "high"),
    [("A", "sway", 1.0, 1.15), ("A", "roll", 1.0, 1.35), ("A", "yaw", 1.0, 1.4)],
)
def test_lateral_added_mass_over_3d_in_waves_longer_than_the_ship(quantity, mode, low, high):
    """The other strip program found 1.12, 1.29 and 1.24 at most (it leaves out the stem lines, which adds to yaw here)."""
    rows = [r for r in RADIATION if (r["quantity"], r["force"], r["motion"]) == (quantity, mode, mode)]
    rows = [r for r in rows if float(r["omega"]) < 2.51 * np.sqrt(9.81 / LENGTH)]
    ds = hydrodynamics6(wigley_iii(), [float(r["omega"]) for r in rows], reference="waterline")
    ratio = ds.added_mass.sel(mode=mode, mode_of_motion=mode).to_numpy() / [float(r["value"]) for r in rows]
    assert low < ratio.min()
    assert ratio.max() < high


@pytest.mark.parametrize(
    ("force", "motion", "most"),
    [("sway", "sway", 0.05), ("sway", "roll", 0.05), ("roll", "roll", 0.05), ("yaw", "yaw", 0.1)],
)
def test_three_dimensional_ends_bring_added_mass_to_that_of_panels(force, motion, most):
    """Added mass in waves of the ship's length and more. The table is good to 4 %, and yaw has no potential of its own:
    the ends are those of a swaying ship."""
    rows = [r for r in RADIATION if (r["quantity"], r["force"], r["motion"]) == ("A", force, motion)]
    rows = [r for r in rows if float(r["omega"]) < 2.51 * np.sqrt(9.81 / LENGTH)]
    omega = [float(r["omega"]) for r in rows]
    ds = hydrodynamics6(wigley_iii("three-dimensional"), omega, reference="waterline")
    turned = 1 if force == motion else -1  # the table's axes have half a turn about x
    ratio = turned * ds.added_mass.sel(mode=force, mode_of_motion=motion) / [float(r["value"]) for r in rows]
    assert (np.abs(ratio - 1) < most).all(), ratio


@pytest.mark.parametrize(("mode", "heading"), [("sway", 90.0), ("roll", 90.0), ("yaw", 150.0)])
def test_three_dimensional_ends_bring_forces_to_those_of_panels(mode, heading):
    """Waves of the ship's length and more, modulus within 6 %; strips are up to 18 and 24 % off in roll and yaw.

    Yaw 7 %: the correction begins to fade here, which costs it 2 % (and gains more in shorter waves, `test_end_forces`).
    """
    ratio = np.abs(strip(mode, heading, ends="three-dimensional") / tabulated(mode, heading))[RATIO > 1.0]
    assert (np.abs(ratio - 1) < (0.07 if mode == "yaw" else 0.06)).all(), ratio


def test_our_mesh_gives_the_tabulated_panel_forces():
    """Capytaine 3.0.0 on another mesh, extrapolated (bar up to 4 %): sway within 3 %, roll 6 % of the largest."""
    pytest.importorskip("capytaine", reason="the extra `bem` (Capytaine) is not installed")
    total = bem_forces(wigley_iii(), RATIO[:7:2] * LENGTH, 90.0, panels=(40, 12)).total
    for mode, most in (("sway", 0.03), ("roll", 0.06)):
        chosen = total.sel(mode=mode, heading=90.0)
        ours = chosen.sel(part="cos").to_numpy() - 1j * chosen.sel(part="sin").to_numpy()
        theirs = tabulated(mode, 90.0)
        off = np.abs(ours - theirs[:7:2]) / np.abs(theirs).max()
        assert off.max() < most, (mode, off.round(4))
