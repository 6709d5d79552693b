"""Sources of hydrodynamics: one made here reaches coefficients, forces and equations; panels are Capytaine's own numbers."""

import numpy as np
import pytest

import quartering as qt
from quartering.conventions import GRAVITY, MODES, InputError
from quartering.hydro.source import of_ship as ship_source
from quartering.hydro.source.interpolated import tabled_moments
from quartering.hydro.source.of_ship import Choice, source_of
from quartering.hydro.source.record import Held, Hydrodynamics
from quartering.hydro.strip.integrals import moment_matrix
from quartering.hydro.strip.six_modes import by_strips
from quartering.loads.forces import ship_force_phasors
from quartering.loads.source import wave_source
from quartering.motion.of_ship import ship_system

S60 = qt.ship("series60-cb60")
MASS, DAMPING, PUSH = 4.0e6, 1.0e5, 3.0e5


def thin_plate(ship):
    """A throw-away source: added mass and damping in proportion, alike at every frequency, a sway force that knows no phase."""
    omega = np.linspace(0.05, 3.0, 6)
    matrix = np.tile(np.diag([1.0, 9.0, 900.0]), (6, 1, 1))
    moments = tabled_moments(omega, MASS * matrix, DAMPING * matrix, MASS * matrix[0])
    centre = qt.hydrostatics(ship).lcb, ship.loading.kg - ship.hull.draught

    def at_rest(frequency, heading):
        force = np.zeros((frequency.size, 4), dtype=complex)
        force[:, 1] = PUSH * np.sin(np.radians(heading))
        return {"froude_krylov": 0 * force, "diffraction": force}

    return Hydrodynamics(
        ship=ship, kind="strip", words="the thin plate", method="closed form", references=("Lamb32",),
        force_words="the thin plate, zero speed", force_references=("Lamb32",), centre=centre,
        radiation=lambda: moments, solved=lambda w: moments.at(w).about(*centre),
        held=Held((0.05, 3.0), True, (0.0, 180.0)), at_rest=at_rest, force_modes=("heave", *MODES),
    )  # fmt: skip


@pytest.fixture
def plate(monkeypatch):
    """A ship whose own source is the thin plate, by one line of registration."""
    choice = Choice(thin_plate, lambda ship: abs(ship.loading.gm - 0.8) < 1e-9)
    monkeypatch.setattr(ship_source, "SOURCES", {"plate": choice, **ship_source.SOURCES})
    return S60.with_(gm=0.8)


def test_a_new_source_of_hydrodynamics_reaches_table_forces_and_equations(plate):
    """Closed form: A, B and force about midship at the calm plane, moved rigidly to G."""
    x, z = source_of(plate).centre
    c = qt.coefficients(plate, 0.6, 0.0)
    entries = {entry.name: entry for entry in c.table()}
    assert entries["Y_vdot"].value == pytest.approx(-MASS)
    assert entries["K_vdot"].value == pytest.approx(MASS * z)  # K_G = K - z0 Y
    assert entries["N_vdot"].value == pytest.approx(MASS * x)  # N_G = N - x_G Y
    assert entries["Y_vdot"].source == "added mass of the thin plate at omega"
    assert "Lamb32" in c.references
    k, u, mu = np.array([0.04]), np.zeros(1), np.array([90.0])
    _, force, _ = ship_force_phasors(plate, k, u, mu)
    np.testing.assert_allclose(force[0], PUSH * np.array([1.0, -z, -x]), rtol=1e-9)
    system = ship_system(plate.with_(velocities="absolute"), k, u, mu).system
    assert (
        qt.wave_forces(plate, qt.Wave(157.0, 2.0), 0.0, 90.0)
        .attrs["form_meaning"]
        .startswith("the thin plate, zero speed")
    )
    assert np.isfinite(system.cos).all()


def test_speed_terms_of_a_source_are_those_of_strip_theory(plate):
    """[STF70]: N gains U times the sway momentum of the water, which is the sway force over i omega."""
    plate, k, u, mu = plate.with_(linear="strip"), np.array([0.04]), np.array([5.0]), np.array([90.0])
    x, _ = source_of(plate).centre
    _, force, omega = ship_force_phasors(plate, k, u, mu)  # in a beam sea speed leaves the frequency alone
    assert omega[0] == pytest.approx(np.sqrt(GRAVITY * k[0]))
    np.testing.assert_allclose(force[0, 0], PUSH, rtol=1e-9)
    np.testing.assert_allclose(force[0, 2], -x * PUSH + 5.0 * PUSH / (1j * omega[0]), rtol=1e-9)


def test_what_a_source_does_not_hold_is_refused(plate):
    with pytest.raises(InputError, match=r"the thin plate holds 0\.05 to 3 rad/s, and 4 rad/s"):
        qt.coefficients(plate, 4.0, 0.0)
    with pytest.raises(InputError, match="allowed: plate, database, panels, strips"):
        source_of(S60, "boxes")
    with pytest.raises(InputError, match="no database"):
        source_of(S60, "database")


def test_strips_have_matrices_of_six_modes_and_forces_of_three():
    """Sway, roll and yaw of the six are those of the three, both by integrals of the same sections."""
    strips, omega = source_of(S60), np.array([0.4, 0.9])
    lateral = np.ix_([0, 1], [1, 3, 5], [1, 3, 5])
    at, found = strips.solved(omega), by_strips(S60, omega)
    for name, three in (("added_mass", at.a), ("damping", at.b)):
        six, theirs = found[name].to_numpy(), moment_matrix(three)
        np.testing.assert_allclose(six[lateral], theirs, atol=1e-9 * np.abs(theirs).max())
    assert strips.force_modes == MODES
    assert wave_source(S60).source is None


def test_panels_give_the_numbers_of_capytaine_where_it_solved_them():
    """Splines go through what Capytaine itself gives for the same mesh: rounding, moves between midship and G included."""
    pytest.importorskip("capytaine", reason="panels need the extra `bem`")
    from quartering.hydro.source.panels import panel_source

    wigley, panels, hats = qt.ship("wigley"), (12, 5), (0.4, 0.5, 0.6, 0.7)
    source = panel_source(wigley, hats, (30.0, 60.0, 90.0, 120.0), panels)
    omega = np.array(hats[1:3]) * np.sqrt(2 * GRAVITY / wigley.hull.beam)
    direct = qt.bem_forces(wigley, 2 * np.pi * GRAVITY / omega**2, [60.0], panels=panels)
    for ours, name in zip(source.matrices(omega), ("added_mass", "damping"), strict=True):
        scale = np.sqrt(np.einsum("nii->ni", np.abs(direct[name].values)))
        theirs = (direct[name].values + direct[name].values.swapaxes(1, 2)) / 2  # strip integrals are symmetric
        np.testing.assert_array_less(np.abs(ours - theirs) / scale[:, :, None] / scale[:, None, :], 1e-9)
    from quartering.loads.source import _at_rest

    scattered, pressure = _at_rest(source, omega**2 / GRAVITY, np.array([60.0, 60.0]))
    for ours, name in ((pressure, "froude_krylov"), (scattered, "diffraction")):
        theirs = direct[name].values[:, 0, 0] - 1j * direct[name].values[:, 0, 1]
        np.testing.assert_allclose(ours, theirs, atol=1e-9 * np.abs(theirs).max(axis=0).max())
