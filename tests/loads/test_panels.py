"""A ship that asks for panels: the same as from a file of the same panels, solved once for a hull, refused with what to do."""

import sys
from functools import partial
from importlib.util import find_spec

import numpy as np
import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.conventions import GRAVITY, InputError
from quartering.hydro.database.dataset import write_capytaine
from quartering.hydro.source import capytaine_run as bem
from quartering.hydro.source import of_ship as ship_source
from quartering.hydro.source import panels as panel_source
from quartering.hydro.source.of_ship import Choice, source_of
from quartering.loads.comparison import compare_forces
from quartering.loads.forces import ship_force_phasors
from quartering.study.case.read import case_grid
from quartering.view.cli import app
from tests.loads.own_file import of_strips

HATS = (0.25, 0.4, 0.55, 0.7, 0.85)
HEADINGS = (0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0)
MESH = (16, 6)
installed = pytest.mark.skipif(find_spec("capytaine") is None, reason="panels need the extra `bem` (Capytaine)")


@pytest.fixture
def coarse(monkeypatch):
    """Panels by few frequencies, headings and panels."""
    make = partial(panel_source.panel_source, frequencies=HATS, headings=HEADINGS, panels=MESH)
    own = ship_source.SOURCES["panels"].own
    monkeypatch.setitem(ship_source.SOURCES, "panels", Choice(make, own))


def of_panels(ship):
    """What Capytaine gives for a ship about its own G, by the functions for one run of it, as a database to write."""
    omega = np.array(HATS) * np.sqrt(2 * GRAVITY / ship.hull.beam)
    forces = qt.bem_forces(ship, 2 * np.pi * GRAVITY / omega**2, HEADINGS, panels=MESH)
    still = bem._radiation(bem._solved(ship, np.append(0.0, omega[-1:]), np.zeros(0), MESH, True)).added_mass[0]
    forces = forces.swap_dims(wave_length="frequency").drop_vars("total")
    return forces.assign(added_mass_zero=still.drop_vars("frequency"))


@installed
@pytest.mark.usefixtures("coarse")
def test_a_ship_with_panels_is_the_ship_with_a_file_of_the_same_panels(tmp_path):
    """Agreement of two ways: solved amidships and moved to G, or solved about G, written and read; to 1e-9."""
    s60 = qt.ship("series60-cb60").with_(ends="strips", water_density=1000.0)
    write_capytaine(of_panels(s60), tmp_path / "own.nc", s60)
    for changes in ({}, {"gm": 1.1, "water_density": 1030.0}):
        panels, file = s60.with_(hydrodynamics="panels", **changes), s60.with_(database=tmp_path / "own.nc", **changes)
        omega = np.array([0.1, 0.31, 0.52, 0.7])
        ours, theirs = (qt.coefficients(one, omega, 5.0) for one in (panels, file))
        for name in ("inertia", "linear"):
            one, other = getattr(ours, name), getattr(theirs, name)
            assert (np.abs(one - other).max(axis=0) <= 1e-9 * np.abs(other).max(axis=0)).all()
        assert ours.roll_frequency == pytest.approx(theirs.roll_frequency, rel=1e-9)
        k, mu = np.linspace(0.02, 0.05, 5), np.array([20.0, 75.0, 90.0, -130.0, 165.0])
        forces = (ship_force_phasors(ship, k, np.full(5, 4.0), mu)[:2] for ship in (panels, file))
        for one, other in zip(*forces, strict=True):
            assert (np.abs(one - other).max(axis=0) <= 1e-9 * np.abs(other).max(axis=0)).all()
        motions = [
            qt.steady_motion(qt.equations(ship, qt.Wave(180.0, 2.0), 4.0, 60.0)).amplitude for ship in (panels, file)
        ]
        np.testing.assert_allclose(*motions, rtol=1e-8)
        entries = {one.name: one for one in ours.table()}
        assert entries["Y_vdot"].source.endswith("added mass of panels (Capytaine) at omega")
        assert "Ancellin19" in ours.references


@pytest.mark.soak
@installed
def test_roll_in_a_beam_sea_is_near_that_of_strips_with_three_dimensional_ends(monkeypatch):
    """Within 10 % from 0.8 ship lengths on: the aim, and what docs/how_good_is_it.md tabulates for Wigley (0.96 to 1.07)."""
    hats, headings = tuple(np.linspace(0.2, 0.8, 7)), (60.0, 80.0, 100.0, 120.0)
    make = partial(panel_source.panel_source, frequencies=hats, headings=headings, panels=(24, 8))
    own = ship_source.SOURCES["panels"].own
    monkeypatch.setitem(ship_source.SOURCES, "panels", Choice(make, own))
    strips = qt.ship("wigley")
    lengths = strips.hull.length * np.array([0.8, 1.0, 1.25, 1.5, 3.0, 4.0])
    at = {"speed": 0.0, "heading": 90.0, "wave_length": lengths, "wave_height": 0.05}
    rolls = [qt.sweep(ship, **at)["roll"].values.ravel() for ship in (strips, strips.with_(hydrodynamics="panels"))]
    np.testing.assert_allclose(rolls[0] / rolls[1], 1.0, atol=0.1)


@installed
@pytest.mark.usefixtures("coarse")
def test_a_hull_is_solved_once_whatever_its_loading(monkeypatch, tmp_path):
    """Counted; a second process finds it on disk, another draught is another hull."""
    monkeypatch.setenv("QUARTERING_CACHE", str(tmp_path))
    solves, solve = [], panel_source.hull_solution
    monkeypatch.setattr(panel_source, "hull_solution", lambda *given: solves.append(given[0].draught) or solve(*given))
    one = qt.ship("wigley").with_(hydrodynamics="panels", length=90.0)
    for changed in (one, one.with_(gm=1.4), one.with_(kg=4.0, gyradius_roll="0.4 B"), one.with_(water_density=1000.0)):
        qt.coefficients(changed, 0.6, 3.0)
        qt.wave_forces(changed, qt.Wave(90.0, 1.0), 0.0, 90.0)
    assert len(solves) == 1
    panel_source._solution.cache_clear()
    panel_source._moments.cache_clear()
    qt.coefficients(one.with_(gm=1.3), 0.6, 3.0)
    assert len(solves) == 1
    qt.coefficients(one.with_(draught=6.0), 0.6, 3.0)
    assert solves == [one.hull.draught, 6.0]


@installed
@pytest.mark.usefixtures("coarse")
def test_what_panels_do_not_hold_is_refused_naming_what_they_hold():
    one = qt.ship("wigley").with_(hydrodynamics="panels")
    with pytest.raises(InputError, match=r"panels \(Capytaine\) holds wave frequencies 0.35\d* to 1.19\d* rad/s"):
        qt.wave_forces(one, qt.Wave(20.0, 0.5), 0.0, 90.0)
    with pytest.raises(InputError, match=r"panels \(Capytaine\) holds 0.35\d* to 1.19\d* rad/s, and 2 rad/s"):
        qt.coefficients(one, 2.0, 0.0)


@installed
def test_waves_the_panels_do_not_resolve_are_left_out():
    """Six panels to a wave: long panels leave short waves out, and the source says so."""
    held = panel_source.panel_source(qt.ship("wigley"), panels=(8, 3)).held
    full = panel_source.panel_source(qt.ship("wigley")).held
    assert held.frequency[0] == full.frequency[0]
    shortest = 2 * np.pi * GRAVITY / held.frequency[1] ** 2
    widest = np.sqrt(np.linalg.norm(bem.hull_panels(qt.ship("wigley").hull, 8, 3).area_vectors, axis=1).max())
    assert held.frequency[1] < full.frequency[1]
    assert shortest >= 6 * widest


@installed
@pytest.mark.usefixtures("coarse")
def test_every_door_asks_for_panels(tmp_path):
    """File, Python, case and command."""
    file = tmp_path / "my.yaml"
    file.write_text("base: wigley\nhydrodynamics: panels\n")
    assert source_of(qt.ship(file)).words == "panels (Capytaine)"
    assert source_of(qt.ship(file).with_(hydrodynamics="strips")).words == source_of(qt.ship("wigley")).words
    case = tmp_path / "case.yaml"
    case.write_text(
        "ship: wigley\nwith: {hydrodynamics: panels}\nspeed: 5\nheading: 30\nwave_length: 1 L\nwave_height: 1\n"
    )
    assert case_grid(case).ship.hydrodynamics == "panels"
    answer = CliRunner().invoke(app, ["hull", "wigley", "--hydrodynamics", "panel"])
    assert (answer.exit_code, 'did you mean "panels"?' in answer.output) == (2, True)
    assert CliRunner().invoke(app, ["hull", "wigley", "--hydrodynamics", "panels"]).exit_code == 0


@installed
@pytest.mark.usefixtures("coarse")
def test_panels_of_a_ship_stand_beside_the_forms_of_strips():
    one = qt.ship("wigley").with_(hydrodynamics="panels")
    found = compare_forces(one, [100.0], [60.0, 90.0])
    strips = compare_forces(qt.ship("wigley"), [100.0], [60.0, 90.0])
    assert set(found["form"].to_numpy()) - set(strips["form"].to_numpy()) == {"database"}
    np.testing.assert_array_equal(found["force"].sel(form="stf"), strips["force"].sel(form="stf"))
    with pytest.warns(qt.RangeWarning, match=r"all six modes are by strips, and panels \(Capytaine\) is left out"):
        qt.hydrodynamics6(one, [0.6])


def test_without_capytaine_every_door_says_what_to_install(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "capytaine", None)
    words = "hydrodynamics = 'panels'; that needs Capytaine, which is not installed; install it with"
    with pytest.raises(InputError) as of_python:
        qt.ship("wigley").with_(hydrodynamics="panels")
    assert str(of_python.value).startswith(f"{qt.ship('wigley').name}: {words} `pip install 'quartering[bem]'`")
    file = tmp_path / "my.yaml"
    file.write_text("base: wigley\nhydrodynamics: panels\n")
    with pytest.raises(InputError, match=r"line 2: hydrodynamics = 'panels'; that needs Capytaine"):
        qt.ship(file)
    answer = CliRunner().invoke(app, ["hull", "wigley", "--hydrodynamics", "panels"])
    assert (answer.exit_code, answer.output.startswith(f"quartering: --hydrodynamics: {words}")) == (2, True)


@installed
def test_panels_beside_what_they_take_the_place_of_are_refused(tmp_path):
    wigley = qt.ship("wigley").with_(ends="strips")
    write_capytaine(of_strips(wigley), tmp_path / "own.nc", wigley)
    with pytest.raises(InputError, match=r"hydrodynamics = panels, and database own.nc .*leave one of the two out"):
        wigley.with_(database=tmp_path / "own.nc", hydrodynamics="panels")
    with pytest.raises(InputError, match=r"hydrodynamics = panels, and database own.nc .*leave one of the two out"):
        wigley.with_(hydrodynamics="panels").with_(database=tmp_path / "own.nc")
    with pytest.raises(InputError, match=r'ends = "three-dimensional" corrects the strips, and panels take'):
        wigley.with_(hydrodynamics="panels", ends="three-dimensional")
    file = tmp_path / "my.yaml"
    file.write_text("base: wigley\ndatabase: own.nc\nhydrodynamics: panels\n")
    with pytest.raises(InputError, match=r"line 3: hydrodynamics = panels, and database own.nc"):
        qt.ship(file)
