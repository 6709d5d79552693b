"""Duffing over frequency: exact motions in 40-digit arithmetic, closed-form folds, and what each formula is worth where."""

import numpy as np
import pytest

from quartering.conventions import InputError
from quartering.study.paper.duffing import duffing_curves, duffing_table
from tests.reference import DYNAMICS
from tests.tiers import mostly_soak

REFERENCE = DYNAMICS["duffing"]

HARDENING, SOFTENING = (0.2, 0.3, 1.6, 0.05), (-0.2, 0.1, 0.85, 0.02)


@pytest.mark.parametrize("row", REFERENCE["rows"], ids=lambda r: f"w={r['w']}")
def test_table_holds_the_exact_motions(row):
    """Fundamental and value at t = 0 in 40-digit arithmetic."""
    found = duffing_table(REFERENCE["beta"], REFERENCE["X0"], row["w"])
    exact = sorted(row["exact"], key=lambda motion: abs(motion["a1"]))
    np.testing.assert_allclose([f["fundamental"] for f in found], [e["a1"] for e in exact], atol=1e-8)
    # The peak is sampled at 256 phases; it is the value at t = 0 of these motions.
    np.testing.assert_allclose([f["peak"] for f in found], [e["x0"] for e in exact], rtol=1e-4)


def test_undamped_fold_of_one_harmonic_is_where_closed_form_says():
    """[H71] (C-4): d(omega^2)/dP = 0 at P^3 = -2 X0/(3 beta), omega^2 = 1 + 9/4 beta P^2."""
    beta, force = 0.2, 0.3
    curves = duffing_curves(beta, force, harmonics=1)
    fold = curves.isel(point=np.flatnonzero(curves["fold"]))
    p = -np.cbrt(2 * force / (3 * beta))
    np.testing.assert_allclose(fold["fundamental"], [p], rtol=1e-6)
    np.testing.assert_allclose(fold["frequency"], [np.sqrt(1 + 2.25 * beta * p**2)], rtol=1e-9)


def test_damped_curve_of_one_harmonic_lies_on_its_closed_form():
    """[(1 - w^2 + 3/4 beta P^2)^2 + (d w)^2] P^2 = X0^2."""
    beta, force, damping = 0.2, 0.3, 0.05
    curves = duffing_curves(beta, force, damping, harmonics=1)
    w, p = curves["frequency"].values, curves["fundamental"].values
    assert set(curves["curve"].values) == {0}
    np.testing.assert_allclose(((1 - w**2 + 0.75 * beta * p**2) ** 2 + (damping * w) ** 2) * p**2, force**2, rtol=1e-8)


def test_damped_motion_is_unstable_exactly_between_its_folds():
    """Floquet multipliers against the turning of the curve, found without them; the points next to a fold are left out."""
    curves = duffing_curves(0.2, 0.3, 0.05, harmonics=7)
    first, last = np.flatnonzero(curves["fold"])
    inside = np.zeros(curves.sizes["point"], dtype=bool)
    inside[first + 1 : last] = True
    clear = np.ones(inside.size, dtype=bool)
    clear[[first - 1, first, first + 1, last - 1, last, last + 1]] = False
    np.testing.assert_array_equal(~curves["stable"].values[clear], inside[clear])


@pytest.mark.parametrize(
    ("beta", "force", "w", "damping"), mostly_soak([HARDENING, SOFTENING], SOFTENING, several=True)
)
def test_table_and_curves_find_the_same_motions(beta, force, w, damping):
    """Two ways to them: from the closed form at one frequency, and along the curve from both ends."""
    found = duffing_table(beta, force, w, damping)
    curves = duffing_curves(beta, force, damping, (0.5, 2.0), harmonics=5)
    passed = []
    for index in np.unique(curves["curve"]):
        own = curves.isel(point=np.flatnonzero(curves["curve"] == index))
        f, p = own["frequency"].values, np.abs(own["fundamental"].values)
        here = np.flatnonzero((f[:-1] - w) * (f[1:] - w) < 0)
        passed += [p[i] + (w - f[i]) / (f[i + 1] - f[i]) * (p[i + 1] - p[i]) for i in here]
    assert len(found) == 3
    np.testing.assert_allclose(
        [abs(row["fundamental"]) for row in found], sorted(passed), rtol=0.02
    )  # linear between points
    assert [row["stable"] for row in found].count(False) == 1


def backbone_errors(square):
    """Errors of C-4 and C-5 against the fundamental of nearly free motion with omega^2 = 1 + square."""
    large = duffing_table(0.2, 1e-6, np.sqrt(1 + square))[-1]
    return np.array([abs(large[name] / large["fundamental"] - 1) for name in ("C-4", "C-5")])


def test_on_the_backbone_c5_is_the_fundamental_to_one_order_more_than_c4():
    """Putting C = beta A^3/(4 (9 w^2 - 1)) into the balance of the fundamental gives C-5 where 3/4 beta A^2 = w^2 - 1."""
    c4, c5 = backbone_errors(0.2) / backbone_errors(0.1)
    assert c4 == pytest.approx(2.0, rel=0.15)
    assert c5 == pytest.approx(4.0, rel=0.25)


def test_away_from_resonance_c5_is_the_peak():
    """Fundamental plus third harmonic, to first order in beta: the error falls with beta^2, that of C-4 with beta."""

    def errors(beta):
        (row,) = duffing_table(beta, 0.3, 0.6)
        return np.array([abs(row[name] / row["peak"] - 1) for name in ("C-4", "C-5")])

    c4, c5 = errors(0.04) / errors(0.02)
    assert c4 == pytest.approx(2.0, rel=0.15)
    assert c5 == pytest.approx(4.0, rel=0.25)


def test_numbers_that_cannot_be_are_refused():
    with pytest.raises(InputError, match="damping"):
        duffing_curves(0.2, 0.3, -0.1)
    with pytest.raises(InputError, match="rising"):
        duffing_curves(0.2, 0.3, 0.0, (2.0, 1.0))
    with pytest.raises(InputError, match="no forced motion at frequency 1;"):
        duffing_table(0.0, 0.3, 1.0)
    with pytest.raises(InputError, match="other than 0"):
        duffing_table(0.2, 0.0, 0.9)


def test_a_curve_may_start_at_the_natural_frequency():
    """Closed form of one harmonic there: 3/4 beta P^3 = X0. Without damping there is no linear motion to start from."""
    curves = duffing_curves(0.2, 0.3, limits=(1.0, 1.5), harmonics=1)
    assert float(curves["fundamental"][0]) == pytest.approx(np.cbrt(0.3 / (0.75 * 0.2)), rel=1e-9)
