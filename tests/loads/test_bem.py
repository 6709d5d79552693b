"""Three-dimensional panels (Capytaine 3.0.0) against strip theory: how far apart, and why."""

import dataclasses
import sys

import numpy as np
import pytest

import quartering as qt
from quartering.conventions import InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.hull import scaled
from quartering.hydro.database.dataset import read_capytaine
from quartering.hydro.source import capytaine_run as bem
from quartering.hydro.source.capytaine_run import bem_forces, bem_hydrodynamics

RATIOS = np.array([0.8, 1.0, 1.5, 2.0])


@pytest.fixture(scope="module")
def capytaine():
    return pytest.importorskip("capytaine", reason="the extra `bem` (Capytaine) is not installed")


def phasor(values):
    """Complex amplitude of (.., part, mode)."""
    return values.sel(part="cos").to_numpy() - 1j * values.sel(part="sin").to_numpy()


def strip(ship, lengths, heading, name="total"):
    """Phasors (n, 3) by strip theory, per metre of amplitude."""
    return np.array(
        [phasor(qt.wave_forces(ship, qt.Wave(x, x / 100), heading=heading)[name] / (x / 200)) for x in lengths]
    )


def about_waterline(ship, force):
    """Roll moment about the waterline point instead of G."""
    return force[..., 1] + (ship.loading.kg - ship.hull.draught) * force[..., 0]


def test_without_capytaine_the_message_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "capytaine", None)
    with pytest.raises(InputError, match=r"quartering\[bem\]"):
        bem_forces(qt.ship("wigley"), [100.0])


@pytest.mark.soak
@pytest.mark.usefixtures("capytaine")
@pytest.mark.parametrize("name", ["wigley", pytest.param("series60-cb60", marks=pytest.mark.soak)])
def test_pressure_of_the_undisturbed_wave_is_the_same_in_both(name):
    """Froude-Krylov forces need no theory: axes, time factor, G and mesh are right when size and phase agree."""
    ship = qt.ship(name)
    lengths, headings = ship.hull.length * np.array([1.0, 2.0]), [30.0, 90.0, 150.0]
    panels = bem_forces(ship, lengths, headings, panels=(40, 14))
    for k, heading in enumerate(headings):
        theirs, ours = phasor(panels.froude_krylov)[:, k], strip(ship, lengths, heading, "froude_krylov")
        size = np.abs(strip(ship, lengths, 150.0, "froude_krylov")).max(axis=0)  # yaw is next to nothing in beam seas
        assert (np.abs(theirs - ours) < 0.03 * np.maximum(np.abs(ours), size)).all()


def test_the_border_is_crossed_as_the_reader_of_capytaine_files_crosses_it(capytaine, tmp_path):
    """Agreement of two translations of Capytaine's own dataset."""
    ship = qt.ship("series60-cb60")
    lengths = np.array([200.0, 100.0])
    solved = bem._solved(ship, np.sqrt(2 * np.pi * 9.81 / lengths), np.array([90.0, 30.0]), (20, 5), True)
    capytaine.export_dataset(str(tmp_path / "cb60.nc"), solved.sortby(["omega", "wave_direction"]), format="netcdf")
    point = 0.0, ship.loading.kg - ship.hull.draught
    read = read_capytaine(tmp_path / "cb60.nc", ship, midship=-hydrostatics(ship).lcb, moments_about=point)
    ours = bem_forces(ship, lengths, [90.0, 30.0], panels=(20, 5))
    for k in (0, 1):
        here, there = ours.isel(wave_length=k), read.isel(frequency=k)
        for name in ("froude_krylov", "diffraction", "total"):
            np.testing.assert_allclose(
                phasor(here[name].sel(heading=[30.0, 90.0])), phasor(there[name]), rtol=1e-6, atol=1.0
            )
        for name in ("added_mass", "damping"):
            np.testing.assert_allclose(here[name], there[name], rtol=1e-6, atol=1e-6 * float(abs(there[name]).max()))


@pytest.mark.usefixtures("capytaine")
@pytest.mark.parametrize("name", ["wigley", pytest.param("series60-cb60", marks=pytest.mark.soak)])
def test_beam_sea_sway_force_is_within_ten_per_cent_beyond_0_8_ship_lengths(name):
    ship = qt.ship(name)
    lengths = RATIOS * ship.hull.length
    ratio = strip(ship, lengths, 90.0)[:, 0] / phasor(bem_forces(ship, lengths, 90.0).total)[:, 0, 0]
    assert (np.abs(np.abs(ratio) - 1) < 0.1).all(), np.abs(ratio).round(3)


@pytest.mark.usefixtures("capytaine")
@pytest.mark.parametrize(
    ("name", "most"), [("wigley", 0.2), pytest.param("series60-cb60", 0.25, marks=pytest.mark.soak)]
)
def test_beam_sea_roll_moment_differs_by_the_ends_of_the_ship(name, most):
    """Strip theory lets no water round the ends: its moment about the waterline is a fifth too large at most here.

    The same sections on a ship two and four times as long differ by about a half and a quarter of that: the difference
    goes with the inverse of the length, as that of the two ends must.
    """
    ship = qt.ship(name).with_(ends="strips")
    lengths = ship.hull.length * np.array([1.5])
    off = []
    for factor in (1, 2, 4):
        longer = dataclasses.replace(ship, hull=scaled(ship.hull, factor, 1.0, 1.0))
        panels = bem_forces(longer, lengths, 90.0, panels=(20 + 10 * factor, 8))
        ours, theirs = strip(longer, lengths, 90.0), phasor(panels.total)[:, 0]
        off.append(np.abs(about_waterline(longer, ours) / about_waterline(longer, theirs)) - 1)
    first, second, fourth = off
    assert (np.abs(first) < most).all(), first
    assert (np.abs(second) < 0.65 * np.abs(first)).all(), second
    assert (np.abs(fourth) < 0.65 * np.abs(first)).all(), fourth


@pytest.mark.soak
@pytest.mark.usefixtures("capytaine")
def test_radiation_is_symmetric_and_damped():
    """Reciprocity, to what 480 panels a side give, and energy; frequencies come back as they were asked for."""
    ds = bem_hydrodynamics(qt.ship("series60-cb60"), [0.9, 0.5, 0.9], panels=(40, 12))
    assert ds.frequency.to_numpy().tolist() == [0.9, 0.5, 0.9]
    assert bool((ds.added_mass[0] == ds.added_mass[2]).all())
    for k in (0, 1):
        for name in ("added_mass", "damping"):
            m = ds[name].to_numpy()[k]
            size = np.sqrt(np.outer(np.diag(m), np.diag(m)))
            assert (np.abs(m - m.T) < 0.05 * size).all()
        assert (np.diag(ds.damping[k]) > 0).all()


@pytest.mark.usefixtures("capytaine")
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (([0.0], [90.0]), "above 0"),
        (([100.0], [np.nan]), "no finite number"),
        (([5.0], [90.0]), "too short"),
    ],
)
def test_bad_input_is_answered_with_what_to_give(arguments, said):
    with pytest.raises(InputError, match=said):
        bem_forces(qt.ship("wigley"), *arguments)
