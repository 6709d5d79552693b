"""A decay's damping counted once: a ship with what is added decays as the record did, and never has less than its own."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import quartering as qt
from quartering.conventions import RangeWarning
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.immersed import strips
from quartering.hydro.calm_water import calm_water_exponents, state_matrix
from quartering.hydro.damping.natural_roll import free_roll
from quartering.hydro.decay.analysis import fit_decay
from quartering.hydro.decay.equation import free_decay
from quartering.hydro.decay.free_roll import QUADRATIC, damping_words, free_damping
from quartering.hydro.decay.of_ship import swings

DATA = Path(__file__).parents[1] / "data"
S60 = qt.ship("series60-cb60")
SHIPS = ("series60-cb60", "s175", "dtc")


def synthetic(ship, zeta, d, first=0.25, swings=24):
    """Record of one degree of freedom with known damping, at the ship's own frequency."""
    n2 = free_roll(ship).frequency
    t = np.linspace(0.0, swings * np.pi / n2, 40 * swings)
    return qt.decay_record(t, free_decay(t, (first, 0.0), n2, zeta, quadratic=d), unit="rad", source="synthetic.csv")


def integrated(ship, speed, first, swings):
    """Free decay of sway, roll and yaw in calm water: linear terms at n2, |q| q of the strips, K_p|p|; linear restoring.

    Written out here, with nothing of the module under test; scipy's integrator.
    """
    n2 = free_roll(ship).frequency
    c = qt.coefficients(ship, n2, speed)
    matrix, inverse = state_matrix(c), np.linalg.inv(c.inertia[0])
    wet = strips(ship.hull)
    strength = 0.5 * ship.loading.density * ship.drag_coefficient * wet.draught * wet.weight
    lever = ship.loading.kg - ship.hull.draught + wet.draught / 2
    x = wet.x - hydrostatics(ship).lcb
    own = {entry.name: entry.value for entry in c.table()}.get(QUADRATIC, 0.0)

    def rates(_, state):
        v, _, p, r = state
        q = v + x * r - lever * p
        force = -strength * np.abs(q) * q
        load = np.array([force.sum(), -(lever * force).sum() + own * abs(p) * p, (x * force).sum()])
        return matrix @ state + np.insert(inverse @ load, 1, 0.0)

    end = swings * np.pi / n2
    t = np.linspace(0.0, end, 40 * swings)
    return t, solve_ivp(rates, (0.0, end), [0.0, first, 0.0, 0.0], t_eval=t, rtol=1e-8, atol=1e-10).y[1]


@pytest.mark.parametrize("name", SHIPS)
def test_a_synthetic_decay_is_what_the_ship_has_and_what_is_added_together(name):
    """Closed form: the coefficients put in."""
    ship = qt.ship(name)
    found = qt.roll_decay(ship, synthetic(ship, 0.02, 0.4))
    assert found.notes == ()
    assert found.damped.ratio == pytest.approx(0.02, abs=2e-5)
    assert found.damped.quadratic == pytest.approx(0.4, abs=1e-3)
    assert found.damped.quadratic == found.bare.drag + found.damped.added
    assert found.damped.equivalent(0.2) == pytest.approx(found.fit.equivalent(0.2), rel=1e-6)
    roots = calm_water_exponents(found.ship, 0.0)[2:]
    assert -roots[0].real / abs(roots[0]) == pytest.approx(found.fit.damping_ratio.value, rel=1e-9)


@pytest.mark.parametrize(("name", "speed"), [("series60-cb60", 0.0), ("dtc", 0.0), ("series60-cb60", 3.0)])
def test_the_ships_own_equations_give_back_the_decay(name, speed):
    """Authority: time integration of the three equations with |q| q by strips; the envelope within 1 % of the first swing.

    The free roll of one degree of freedom is what sway and yaw leave of the three: first order in their damping.
    """
    ship = qt.ship(name)
    zeta = 0.03 if speed else 0.015
    record = synthetic(ship, zeta, 0.5)
    found = qt.roll_decay(ship, record, speed=speed)
    t, roll = integrated(found.ship, speed, 0.25, 24)
    again = fit_decay(qt.decay_record(t, roll, unit="rad"), restoring="linear")
    for amplitude in (0.05, 0.1, 0.2):
        assert again.equivalent(amplitude) == pytest.approx(found.fit.equivalent(amplitude), rel=0.02)
    np.testing.assert_allclose(highs(roll), highs(record.angle), atol=0.01 * 0.25)


def highs(roll):
    return np.array([roll[k] for k in range(1, roll.size - 1) if roll[k] > max(roll[k - 1], roll[k + 1])])


def test_the_envelope_goes_through_the_swings():
    """Authority: the swings of the integrated equation; the envelope averages over a swing, 1 % of the first."""
    record = synthetic(S60, 0.02, 0.4)
    found = qt.roll_decay(S60, record)
    time, amplitude = swings(record)
    np.testing.assert_allclose(found.envelope(time - time[0]), amplitude, atol=0.01 * amplitude[0])
    np.testing.assert_allclose(found.envelope(time - time[0], found.damped), amplitude, atol=0.01 * amplitude[0])
    slower = found.envelope(time - time[0], found.bare)
    assert np.all(slower[1:] > 1.05 * amplitude[1:])


def test_a_ship_that_decays_by_its_own_waves_and_drag_gets_nothing():
    """Authority: the ship itself; its own equations with nothing added, integrated, hold no more than they have."""
    ship = qt.ship("dtc").with_(roll_damping=0.0)
    t, roll = integrated(ship, 0.0, 0.3, 24)
    record = qt.decay_record(t, roll, unit="rad")
    fit, bare = fit_decay(record), free_damping(ship)
    assert fit.damping_ratio.value == pytest.approx(bare.ratio, abs=3e-5)
    assert fit.nonlinear.value == pytest.approx(bare.drag, rel=0.02)


def test_the_drags_share_of_a_box_is_the_closed_form():
    """sum c_s |rho_1 - h_s|^3 of a box is c L |rho_1 - h|^3 with the roll axis rho_1 = Y_pdot/(m - Y_vdot)."""
    box = qt.ship("box")
    n2 = free_roll(box).frequency
    at = {entry.name: entry.value for entry in qt.coefficients(box, n2, 0.0).table()}
    axis = at["Y_pdot"] / (at["m"] - at["Y_vdot"])
    lever = box.loading.kg - box.hull.draught / 2
    c = 0.5 * box.loading.density * box.drag_coefficient * box.hull.draught * box.hull.length
    roll = free_damping(box)
    assert roll.axis == pytest.approx(axis, rel=1e-9)
    assert roll.drag * roll.inertia == pytest.approx(c * abs(axis - lever) ** 3, rel=1e-6)


def test_less_damping_than_the_strips_or_the_drag_is_set_to_nought_with_a_word():
    bare = free_damping(S60.with_(roll_damping=0.0))
    with pytest.warns(RangeWarning) as said:
        found = qt.roll_decay(S60, synthetic(S60, 0.3 * bare.ratio, 0.3 * bare.drag, swings=60))
    words = " ".join(str(one.message) for one in said)
    assert (found.roll_damping, found.quadratic) == (0.0, 0.0)
    assert "roll_damping is set to 0" in words
    assert "no K_p|p| is added" in words
    assert "nothing can be taken off the ship's own waves" in words
    assert len(found.notes) == len(said)
    assert found.damped.ratio == pytest.approx(bare.ratio, rel=1e-12)


def test_lift_counts_at_the_speed_of_the_record():
    record = synthetic(S60, 0.05, 0.4)
    rest, ahead = (qt.roll_decay(S60, record, speed=u) for u in (0.0, 7.5))
    assert (rest.lift, ahead.lift) == (0.0, ahead.bare.ratio - rest.bare.ratio)
    assert ahead.lift > 0.01
    assert ahead.roll_damping < rest.roll_damping - 0.01
    assert ahead.damped.ratio == pytest.approx(rest.damped.ratio, rel=1e-9)
    assert "and lift" in ahead.provenance["roll_damping"]


def test_a_ship_without_drag_has_nothing_to_take_off():
    ship = replace(S60, drag_coefficient=0.0)
    found = qt.roll_decay(ship, synthetic(ship, 0.02, 0.4))
    assert found.bare.drag == 0.0
    assert found.quadratic == pytest.approx(-0.4 * found.bare.inertia, rel=3e-3)


def test_what_was_added_before_does_not_count():
    record = synthetic(S60, 0.02, 0.4)
    plain = qt.roll_decay(S60, record)
    keels = S60.with_(roll_damping="ikeda", bilge_keels=(30.0, 0.33))
    own = replace(S60, overrides={QUADRATIC: -1e9})
    for other in (keels, own):
        again = qt.roll_decay(other, record)
        assert (again.roll_damping, again.quadratic) == (plain.roll_damping, plain.quadratic)
        assert again.ship.roll_method == "fraction"


@pytest.mark.parametrize(
    ("ship", "words"),
    [
        (S60.with_(factors={"K_p": 0.5}), r"K_p \(.*times 0.5\).*leave out"),
        (replace(S60, overrides={"K_p": -1e8}), r"K_p \(given\).*leave out"),
        (replace(S60, drag="cubic", overrides={"K_ppp": -1e8}), r"K_ppp \(given\).*leave it out"),
        (replace(S60, multipliers={QUADRATIC: 2.0}), r"multiplier.*K_p\|p\|"),
        (qt.ship("s175").with_(measured="blanke-christensen-1993"), r"measured: none"),
    ],
)
def test_damping_told_by_other_means_is_refused(ship, words):
    with pytest.raises(qt.InputError, match=words):
        qt.roll_decay(ship, synthetic(S60, 0.02, 0.4))


def test_another_period_is_said_with_the_radius_that_would_give_it():
    """Authority: a ship with that radius has the period of the record within 1 %."""
    n2 = free_roll(S60).frequency
    t = np.linspace(0.0, 24 * np.pi / n2, 1200)
    record = qt.decay_record(t, free_decay(t, (0.25, 0.0), n2 / 1.15, 0.02, quadratic=0.3), unit="rad")
    with pytest.warns(RangeWarning, match=r"its period is .* gyradius_roll of about") as said:
        qt.roll_decay(S60, record)
    radius = float(str(said[0].message).split("about ")[1].split(" m")[0])
    assert free_roll(S60.with_(gyradius_roll=radius)).frequency == pytest.approx(n2 / 1.15, rel=0.01)


def test_anthineas_from_particulars_offsets_and_decay():
    """Model tests at Ecole Centrale de Nantes (tests/data heads): volume 247.1 m3, period 6.38 s at 7 deg, measured damping.

    The tests' own analysts use b44 = 17400 N m s and 1450000 N m s2, 0.034 of critical at 5 deg.
    """
    ship = qt.ship(DATA / "anthineas.yaml")
    assert hydrostatics(ship).volume == pytest.approx(247.1, rel=0.01)
    assert 2 * np.pi / free_roll(ship).frequency == pytest.approx(6.38, rel=0.02)
    found = qt.roll_decay(ship, DATA / "anthineas_roll_decay.csv")
    linear = found.fit.damping_ratio
    assert (
        found.roll_damping < linear.high - linear.low
    )  # the waves of the strips are all of it, but for the fit's error
    assert found.damped.ratio == pytest.approx(linear.value, rel=1e-9)
    assert found.damped.equivalent(np.radians(5.0)) == pytest.approx(0.034, rel=0.05)
    total = -found.quadratic + found.bare.drag * found.bare.inertia
    assert total == pytest.approx(
        1450000.0, rel=0.13
    )  # d spans 0.649 to 0.79 between the ways and the analysts, and the inertia 3 %
    assert found.provenance[QUADRATIC].startswith("measured: decay record anthineas_roll_decay.csv")


def test_the_line_on_damping_says_what_is_added_and_what_there_is_in_all():
    """Authority: first order, added over I/(I_x + a44) and waves, from the coefficients themselves."""
    roll, n2 = free_roll(S60), free_roll(S60).frequency
    c = qt.coefficients(S60.with_(roll_damping=0.0), n2, 0.0)
    inertia = 1 / np.linalg.inv(c.inertia[0])[1, 1]
    shape = np.linalg.inv(c.inertia[0])[:, 1] * inertia
    waves = -(shape @ c.linear[0] @ shape) / (2 * n2 * inertia)
    total = 0.05 * roll.inertia / inertia + waves
    assert free_damping(S60).ratio == pytest.approx(total, rel=1e-3)
    words = damping_words(S60)
    assert words.startswith("added roll damping 5 % of critical; in a free roll at rest with the waves of the strips")
    assert f"{100 * total:.3g} %" in words
    assert "lift" in damping_words(S60, 7.5)
