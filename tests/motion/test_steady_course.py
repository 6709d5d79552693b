"""A ship on a steady course in the wave's pressure: linear motion of low waves, and another integration of steep ones."""

import warnings

import numpy as np
import pytest

import quartering as qt
from quartering.loads.strips.vertical import vertical_forces
from quartering.loads.wetted_hull.floating import floating_hull
from quartering.loads.wetted_hull.pressure import Waves, direct_loads
from quartering.motion.six_modes import vertical_system
from quartering.motion.status import Status
from quartering.motion.steady_course.course import course
from quartering.motion.steady_course.orbits import amplitudes, forced_motions, symmetric_orbits
from tests.simplified_course import with_constant_coefficients

SHIP = qt.ship("s175").with_(gm=1.0, gyradius_pitch=43.75)
K = 2 * np.pi / 175.0
DENSITY, GRAVITY = 1025.0, 9.81


@pytest.mark.parametrize(
    ("heading", "speed", "across"), [(180.0, 3.3, False), (0.0, 3.0, False), (120.0, 5.0, True), (30.0, 5.0, True)]
)
def test_in_a_low_wave_nothing_is_counted_twice(heading, speed, across):
    """Double counting: the march in time on the pressure returns the linear responses, computed from coefficients alone.

    Heave and pitch within 2e-3 in head and following seas. In oblique ones the tables take the surface for straight across a
    section, which leaves out a factor sin q/q of its force, q = k B sin mu/2: 2.6 % at 120 deg. Heave, pitch, roll and yaw 3 %.
    """
    wave = qt.Wave(175.0, 0.05)
    linear = qt.responses(SHIP, wave, speed, heading)
    omega = abs(float(linear.encounter_frequency))
    period = 2 * np.pi / omega
    with pytest.warns(qt.RangeWarning, match="straight") if across else np.errstate():
        found = qt.simulate(SHIP, 160 * period, wave=wave, speed=speed, heading=heading, modes="six")
    last = slice(-48 * 20 - 1, -1)
    turn = np.exp(-1j * omega * found.time.values[last])
    names = ("surge", "heave", "pitch", *((("roll", "yaw")) if across else ()))
    for name in names:
        key = "roll_amplitude" if name == "roll" else name
        phasor = 2 * np.mean(found[name].values[last] * turn)
        wanted = float(linear[key]) * np.exp(1j * np.radians(float(linear[f"{key}_phase"])))
        assert abs(phasor - wanted) < (0.03 if across else 2e-3) * abs(wanted)


@pytest.mark.parametrize(("name", "froude", "length", "heading"), [("series60-cb80", 0.18, 2.37, 0.0), ("dtc", 0.2, 1.5, 0.0),
                                                                ("dtmb5415", 0.18, 2.33, 45.0)])  # fmt: skip
def test_a_slow_encounter_does_not_shake_a_ship_until_it_goes_under(name, froude, length, heading):
    """Linear theory: a low wave met slowly from astern moves a ship as it says, and what the start leaves dies out.

    With the coefficients of such an encounter calm water alone makes heave and pitch grow. 2 % of heave and pitch (5 % across).
    """
    ship = qt.ship(name)
    wave = qt.Wave(length * ship.hull.length, 0.02)
    speed = froude * np.sqrt(9.81 * ship.hull.length)
    linear = qt.responses(ship, wave, speed, heading)
    omega = float(linear.encounter_frequency)
    assert 0.0 < omega * np.sqrt(ship.hull.length / 9.81) < 1.5
    found = qt.simulate(ship, 60 * 2 * np.pi / omega, wave=wave, speed=speed, heading=heading, modes="six")
    last = slice(-48 * 10 - 1, -1)
    turn = np.exp(-1j * omega * found.time.values[last])
    for mode in ("heave", "pitch"):
        phasor = 2 * np.mean(found[mode].values[last] * turn)
        wanted = float(linear[mode]) * np.exp(1j * np.radians(float(linear[f"{mode}_phase"])))
        assert abs(phasor - wanted) < (0.05 if heading else 0.02) * abs(wanted)


@pytest.mark.parametrize("name", ["s175", "series60-cb80"])
def test_a_low_quartering_sea_leaves_a_stable_ship_stable(name):
    """Limit of small waves: the exponent of six modes is negative as calm water's roll is, at every speed and heading."""
    ship = qt.ship(name)
    length, speeds = ship.hull.length, np.array([0.0, 0.1, 0.2, 0.25]) * np.sqrt(9.81 * ship.hull.length)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", qt.RangeWarning)
        found = qt.sweep(ship, speeds, np.array([20.0, 40.0, 60.0, 140.0]), [1.5 * length], [0.01], modes="six")
    assert (found.status == 0).all()
    assert float(found.exponent.max()) < -0.005


def march_on_the_pressure(one, wave, speed, heading, surge, periods=25, steps=40):
    """Harmonics of heave, pitch and surge by Runge-Kutta of the pressure integrated anew, matrices at the encounter frequency.

    The ship surges by ``surge``, a series of phasors of multiples of the encounter; out comes that of the force it feels.
    """
    given = [np.array([value]) for value in (wave.wavenumber, speed, heading)]
    omega = float(one.signed[0])
    mass, damping, _ = vertical_system(SHIP, np.array([omega]), given[1], 43.75)
    inverse, damp = np.linalg.inv(mass[0, 1:, 1:]), damping[0, 1:, 1:]
    diffraction, floats = vertical_forces(SHIP, *given)[1][0, 1:], floating_hull(SHIP, 24)
    along = wave.wavenumber * np.cos(np.radians(heading))

    def forces(time, y):
        xi = sum((z * np.exp(1j * (j + 1) * omega * time)).real for j, z in enumerate(surge))
        phase = omega * time - along * xi
        waves = Waves(*(np.array([value]) for value in (wave.amplitude, along, 0.0, phase)))
        load = direct_loads(floats.hull, np.array([[y[0], 0.0, y[1]]]), waves)[0][0]
        force = DENSITY * GRAVITY * np.array([load[2] + floats.volume, load[4]])
        return DENSITY * GRAVITY * load[0], force + wave.amplitude * (diffraction * np.exp(1j * phase)).real

    def rate(time, y):
        return np.concatenate([y[2:], inverse @ (forces(time, y)[1] - damp @ y[2:])])

    h = 2 * np.pi / abs(omega) / steps
    y, kept = np.zeros(4), []
    for n in range(periods * steps):
        t = n * h
        k1 = rate(t, y)
        k2 = rate(t + h / 2, y + h / 2 * k1)
        k3 = rate(t + h / 2, y + h / 2 * k2)
        k4 = rate(t + h, y + h * k3)
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        kept.append([*y[:2], forces(t + h, y)[0] / floats.volume / DENSITY])  # the added mass of the water feels it too
    first = periods * steps - 2 * steps + 1
    turn = np.exp(-1j * omega * h * (first + np.arange(2 * steps))[:, None] * np.arange(1, 4))
    harmonics = 2 * np.array(kept[-2 * steps :]).T @ turn / (2 * steps)
    harmonics[2] /= -((np.arange(1, 4) * omega) ** 2)
    return harmonics


def test_the_symmetric_motion_is_that_of_the_pressure_integrated_in_time():
    """Harmonics of heave and pitch in a steep head sea (1/33, the bow goes under): first 0.5 %, second 5 % of themselves.

    The judge surges as the force along its own motion makes it, ours as linear theory has it: 5 % more.
    """
    wave = qt.Wave(175.0, 5.25)
    one = course(SHIP, wave.wavenumber, np.array([wave.amplitude]), np.array([3.3]), np.array([180.0]))
    found = amplitudes(symmetric_orbits(with_constant_coefficients(one)))[0]
    linear = wave.amplitude * (one.numbers.surge[0, 0, 0] - 1j * one.numbers.surge[0, 0, 1])
    own = march_on_the_pressure(one, wave, 3.3, 180.0, [linear])[2]
    assert abs(own[0] - linear) < 0.05 * abs(linear)
    marched = np.abs(march_on_the_pressure(one, wave, 3.3, 180.0, own))
    assert found[:, 1] == pytest.approx(marched[:2, 0], rel=5e-3)
    assert found[:, 2] == pytest.approx(marched[:2, 1], rel=5e-2)


def test_surge_is_that_of_linear_theory_and_of_the_force_along_a_small_motion():
    """Authority: `qt.responses`, from coefficients alone, 1e-6; the pressure over the whole hull in a wave of 2 cm, 1e-4."""
    low = qt.Wave(175.0, 0.02)
    for heading, speed in ((180.0, 3.3), (0.0, 3.0), (0.0, 18.0)):
        linear = qt.responses(SHIP, low, speed, heading)
        one = course(SHIP, K, np.array([0.01]), np.array([speed]), np.array([heading]))
        c, s = one.numbers.surge[0, 0]
        wanted = float(linear.surge) * np.exp(1j * np.radians(float(linear.surge_phase)))
        assert abs(0.01 * (c - 1j * s) - wanted) < 1e-6 * abs(wanted)
    one = course(SHIP, K, np.array([0.01]), np.array([3.3]), np.array([180.0]))
    linear = 0.01 * (one.numbers.surge[0, 0, 0] - 1j * one.numbers.surge[0, 0, 1])
    own = march_on_the_pressure(one, low, 3.3, 180.0, [linear])[2, 0]
    assert abs(own - linear) < 1e-4 * abs(linear)


def test_the_motion_an_oblique_sea_forces_is_that_of_a_march():
    """Bow seas, 1/58: first harmonics of heave, pitch, sway, roll and yaw within 0.5 % of a march of the same equations.

    The march keeps the water's coefficients at the encounter frequency, so the balance does here. Nobody steers the march; the
    balance holds the course, so means are not compared.
    """
    one = course(SHIP, K, np.array([1.5]), np.array([5.0]), np.array([120.0]))
    motion = forced_motions(with_constant_coefficients(one, half=False))
    with pytest.warns(qt.RangeWarning, match="straight"):
        marched = qt.simulate(SHIP, 1200.0, wave=qt.Wave(175.0, 3.0), speed=5.0, heading=120.0, modes="six")
    names = ("heave", "pitch", "sway_velocity", "roll", "yaw_rate")
    for name, part in zip(names, motion.basis.parts(motion.x[0]), strict=True):
        values = marched[name].values[-48 * 20 - 1 : -1]
        values = np.radians(values) if marched[name].units.startswith("deg") else values
        first = 2 * np.abs(np.fft.rfft(values)[20]) / values.size
        assert float(np.hypot(part[1], part[2])) == pytest.approx(first, rel=5e-3)
    with pytest.warns(qt.RangeWarning, match="straight"):
        found = qt.parametric_roll(SHIP, qt.Wave(175.0, 3.0), 5.0, 120.0)
    assert (found.kind, len(found.amplitude)) == ("forced", 1)
    assert "the wave rolls it" in found.sentence


def test_a_motion_that_does_not_exist_says_so():
    """Where the ship keeps pace with the wave, or dives, there is a status with advice and no number."""
    celerity = float(np.sqrt(GRAVITY / K))
    many = course(SHIP, K, np.array([1.0, 1.0]), np.array([celerity, 3.0]), np.array([0.0, 180.0]))
    found = symmetric_orbits(many)
    assert found.status.tolist() == [Status.ENCOUNTER_FREQUENCY_NEAR_ZERO, Status.CONVERGED]
    assert np.isnan(found.x[0]).all()
    assert np.isfinite(found.x[1]).all()


def test_a_ship_marches_with_three_modes_or_six():
    wave = qt.Wave(175.0, 2.0)
    three = qt.simulate(SHIP, 20.0, wave=wave, speed=5.0, heading=150.0)
    same = qt.simulate(qt.equations(SHIP, wave, 5.0, 150.0), 20.0)
    np.testing.assert_array_equal(three["roll"], same["roll"])
    for given, words in (
        ({"wave": wave, "modes": "four"}, 'it is "three"'),
        ({"modes": "six"}, "wave is missing"),
    ):
        with pytest.raises(qt.InputError, match=words):
            qt.simulate(SHIP, 20.0, **given)
    with pytest.raises(qt.InputError, match="a Model has its wave"):
        qt.simulate(qt.equations(SHIP, wave, 5.0, 150.0), 20.0, modes="six")


def test_water_over_the_deck_is_said_of_a_march():
    with pytest.warns(qt.RangeWarning, match="over the top of the offsets"):
        qt.simulate(SHIP, 60.0, wave=qt.Wave(175.0, 20.0), speed=3.3, heading=180.0, modes="six")
