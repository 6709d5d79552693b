"""Branches that leave others, loops that touch none, and all motions of one condition: against shooting and closed forms."""

from functools import cache

import numpy as np
import pytest

import quartering as qt
from tests.shooting import shoot

DAMPING, ESCAPE_FREQUENCY, DUFFING_FREQUENCY = 0.1, 0.85, 0.8
IDLE = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0}


def escape(force):
    """x'' + 0.1 x' + x - x^2 = F sin wt [Thompson89], carried by the roll row."""
    terms = IDLE | {"K_p": -DAMPING, "K_phiphi": 1.0}
    return qt.Model(np.eye(3), terms, ESCAPE_FREQUENCY, (0, 0, 0), (0, force, 0))


def duffing(force):
    """x'' + 0.1 x' + x - x^3 = F sin wt: a ship whose righting moment vanishes at 1 rad."""
    terms = IDLE | {"K_p": -DAMPING, "K_phiphiphi": 1.0}
    return qt.Model(np.eye(3), terms, DUFFING_FREQUENCY, (0, 0, 0), (0, force, 0))


def shot(model, motion, periods=None):
    """The same motion by shooting, from where harmonic balance says it starts."""
    power = 2 if "K_phiphi" in model.terms else 3

    def restoring(x):
        return x - x**power, 1 - power * x ** (power - 1)

    guess = motion.state(0.0)[1:3]
    return shoot(restoring, DAMPING, model.force_sin[1], model.frequency, guess, periods or motion.periods)


@pytest.mark.parametrize(
    ("model", "periods"),
    [(escape(0.104), 2), (duffing(0.24), 1), (duffing(0.26), 1)],
    ids=["escape, two periods", "duffing, leaning", "duffing, leaning further"],
)
def test_motions_of_less_symmetry_agree_with_shooting_to_1e_8(model, periods):
    motions = [m for m in qt.all_motions(model, 15) if m.periods == periods and abs(m.mean[1]) > 0.01]
    motions = [
        m for m in motions if abs(m.verdict.multipliers[0]) < 10
    ]  # those near the vanishing angle need more harmonics
    assert motions
    for motion in motions:
        start, multipliers = shot(model, motion)
        np.testing.assert_allclose(motion.state(0.0)[1:3], start, atol=1e-8)
        for exact in multipliers:
            assert np.abs(motion.verdict.multipliers - exact).min() < 1e-7
        assert motion.stable == (np.abs(multipliers).max() < 1)


def test_leaning_motions_come_in_mirrored_pairs():
    """Symmetry: (y, t) -> (-y, t + T/2) turns a motion of [H71] eq. (3) into another one."""
    leaning = [m for m in qt.all_motions(duffing(0.24), 9) if m.periods == 1 and abs(m.mean[1]) > 0.01]
    assert len(leaning) % 2 == 0
    assert leaning
    for motion in leaning:
        later = np.linspace(0, 20, 7)
        mirror = -motion.state(later + np.pi / motion.frequency)
        assert any(np.abs(other.state(later) - mirror).max() < 1e-9 for other in leaning)


@cache
def followed(of, limits):
    """A model and its branch, which two events are looked for on."""
    model = of(1.0)
    return model, qt.branch(model, "excitation", limits=limits, harmonics=11)


@pytest.mark.parametrize(
    ("of", "limits", "event", "periods"),
    [
        (escape, (0.05, 0.108), "period-doubling", 1),
        (escape, (0.05, 0.108), "period-doubling", 2),
        (duffing, (0.15, 0.26), "symmetry-breaking", 0.5),
        (duffing, (0.15, 0.26), "period-doubling", 1),
    ],
)
def test_events_are_where_shooting_finds_the_multiplier_on_the_unit_circle(of, limits, event, periods):
    """-1 at a period doubling; +1 over half a period where a motion loses its symmetry."""
    model, ds = followed(of, limits)
    at = ds.isel(point=np.flatnonzero((ds["event"] == event) & (ds["periods"] == np.ceil(periods)))[0])
    there = qt.Model(np.eye(3), model.terms, model.frequency, (0, 0, 0), (0, float(at["excitation"]), 0))
    close = [m for m in qt.all_motions(there, 11) if m.periods == np.ceil(periods)]
    motion = min(close, key=lambda m: abs(np.degrees(m.amplitude[1]) - float(at["roll"])))
    _, multipliers = shot(there, motion, periods)
    expected = 1.0 if event == "symmetry-breaking" else -1.0
    assert multipliers[np.abs(multipliers).argmax()] == pytest.approx(expected, abs=1e-5)


def test_new_branches_begin_where_the_old_one_changes_and_are_stable_just_there():
    ds = qt.branch(duffing(1.0), "excitation", limits=(0.15, 0.26), harmonics=9)
    first = {int(c): ds.isel(point=np.flatnonzero(ds["curve"] == c)) for c in np.unique(ds["curve"])}
    assert [str(first[c]["origin"].values[0]) for c in (0, 1, 2)] == ["start", "symmetry-breaking", "period-doubling"]
    for old, new in ((first[0], first[1]), (first[1], first[2])):
        left = float(old["excitation"][old["event"] == str(new["origin"].values[0])][0])
        assert abs(float(new["excitation"][0]) - left) < 0.01
    assert first[1]["verdict"].values[0] == 0
    assert first[0]["verdict"].values[-1] != 0


# One-harmonic balance of x'' + x' (c - d x'^2) + x = F sin wt, s = P^2:
#   s [ (1 - w^2)^2 + w^2 (c - 3/4 d w^2 s)^2 ] = F^2,
# a cubic in s whose roots near s = 4 c/(3 d w^2) form a loop about w = 1 when F is small.
C, D, F = 0.1, 0.4, 0.01


def cubic(frequency):
    a = 0.75 * D * frequency**2
    w2 = frequency**2
    return np.array([w2 * a**2, -2 * w2 * C * a, (1 - w2) ** 2 + w2 * C**2, -(F**2)])


@pytest.mark.soak
def test_isola_of_nonlinear_damping_is_found_whole_and_obeys_its_cubic():
    """Closed form: the amplitude equation above; the ends of the loop are where its discriminant is zero."""
    terms = IDLE | {"K_p": -C, "K_ppp": D}
    ds = qt.branch(qt.Model(np.eye(3), terms, 1.0, (0, 0, 0), (0, F, 0)), limits=(0.7, 1.3), harmonics=1)
    loop = ds.isel(point=np.flatnonzero(ds["origin"] == "search"))
    assert loop.sizes["point"] > 20
    assert bool(loop["closed"].all())
    assert float(loop["roll"][0]) == pytest.approx(float(loop["roll"][-1]), rel=1e-9)
    s = np.radians(loop["roll"].values) ** 2
    frequency = loop["frequency"].values
    for one, square in zip(frequency, s, strict=True):
        assert np.abs(np.polyval(cubic(one), square)) < 1e-12
    from scipy.optimize import brentq

    def discriminant(w):
        a, b, c, d = cubic(w)
        return 18 * a * b * c * d - 4 * b**3 * d + b**2 * c**2 - 4 * a * c**3 - 27 * a**2 * d**2

    ends = [brentq(discriminant, 0.97, 1.0, xtol=1e-14), brentq(discriminant, 1.0, 1.03, xtol=1e-14)]
    np.testing.assert_allclose(np.sort(frequency[loop["event"] == "fold"]), ends, atol=1e-8)
    np.testing.assert_allclose([frequency.min(), frequency.max()], ends, atol=1e-8)


@pytest.mark.soak
def test_a_branch_may_start_at_a_fold():
    """Bad luck in the limits: the first point is itself a fold, where the tangent has no part along the parameter."""
    terms = IDLE | {"K_phiphiphi": -0.2, "K_p": -0.04}
    model = qt.Model(np.eye(3), terms, 1.0, (0, 0.1, 0), (0, 0, 0))
    whole = qt.branch(model, limits=(0.8, 1.5), harmonics=1)
    lower = float(np.sort(whole["frequency"][whole["fold"]])[0])
    ds = qt.branch(model, limits=(lower, 1.5), harmonics=1)
    assert float(ds["frequency"].max()) > 1.25
    assert np.isfinite(ds["roll"]).all()
