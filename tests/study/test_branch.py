"""Response curves: folds and changes of stability against 40-digit references and closed forms."""

import numpy as np
import pytest

from quartering.conventions import InputError
from quartering.motion.equations.model import Model
from quartering.stability.verdict import stability
from quartering.study.branches.branch import branch
from quartering.study.paper.model import paper_ship
from tests.reference import DYNAMICS, model_of


@pytest.mark.parametrize(("harmonics", "key", "tolerance"), [(1, "omega", 1e-12), (9, "omega_HB9", 1e-8)])
def test_fold_of_the_strong_case_agrees_with_reference(harmonics, key, tolerance):
    model = model_of(DYNAMICS["cases"]["D_fold_strong"])
    curve = branch(model, "frequency", limits=(0.7, 0.95), harmonics=harmonics)
    exact = DYNAMICS["folds"][0]
    found = curve["frequency"][curve["fold"]].values
    assert np.abs(found - exact[key]).min() < tolerance
    at = np.abs(found - exact[key]).argmin()
    roll = np.radians(curve["roll"][curve["fold"]].values[at])
    assert roll == pytest.approx(exact["P2" if harmonics == 1 else "P2_HB9"], abs=1e-6)


def test_both_folds_of_the_damped_duffing_curve():
    """Closed form [H71] App. C with damping: (1-w^2+3/4 b P^2)(1-w^2+9/4 b P^2) + (2 z w)^2 = 0, in 40 digits."""
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    curve = branch(Model(np.eye(3), terms, 1.0, (0, 0.1, 0), (0, 0, 0)), limits=(0.8, 1.5), harmonics=1)
    found = np.sort(curve["frequency"][curve["fold"]].values)
    exact = np.array(DYNAMICS["duffing"]["damped_folds"]["omega_P"])
    np.testing.assert_allclose(found, exact[:, 0], atol=1e-12)
    roll = np.sort(np.radians(curve["roll"][curve["fold"]].values))
    np.testing.assert_allclose(roll, np.sort(exact[:, 1]), atol=1e-6)


@pytest.mark.parametrize("upper", [1.2, pytest.param(1.5, marks=pytest.mark.soak)])
def test_a_branch_ends_on_its_limit(upper):
    """Closed form [H71] App. C with damping: P^2 ((1 - w^2 + 3/4 b P^2)^2 + (2 z w)^2) = X0^2; folds at 1.10 and 1.26."""
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    curve = branch(Model(np.eye(3), terms, 1.0, (0, 0.1, 0), (0, 0, 0)), limits=(0.8, upper), harmonics=1)
    main = curve.isel(point=curve["curve"].values == 0)
    assert main["frequency"].values[[0, -1]].tolist() == [0.8, upper]
    assert float(main["frequency"].max()) == upper
    assert int(main["fold"].sum()) == (2 if upper > 1.26 else 0)
    w, roll = upper, np.radians(float(main["roll"][-1]))
    assert roll**2 * ((1 - w**2 + 0.75 * 0.2 * roll**2) ** 2 + (0.04 * w) ** 2) == pytest.approx(0.1**2, rel=1e-9)


def test_unknown_parameter_is_refused():
    model = model_of(DYNAMICS["cases"]["A_roll_only"])
    with pytest.raises(InputError, match="frequency"):
        branch(model, "gm")
    with pytest.raises(InputError, match="rising"):
        branch(model, "frequency", limits=(1.0, 0.5))


def test_a_ships_branch_over_wave_height_agrees_with_single_conditions():
    """Agreement: the splined family against the ship's own equations at the same height."""
    import quartering as qt

    ship = paper_ship()
    wave = qt.Wave(ship.hull.length, 2.0)
    curve = branch(ship, "wave_height", limits=(0.5, 3.0), wave=wave, speed=8.0, heading=60.0)
    at = curve.isel(point=curve.sizes["point"] // 2)
    model = qt.equations(ship, qt.Wave(wave.length, float(at["wave_height"])), 8.0, 60.0)
    motion = qt.steady_motion(model, 9, start="rest")
    assert float(at["roll"]) == pytest.approx(np.degrees(motion.amplitude[1]), rel=1e-6)
    assert float(at["exponent"]) == pytest.approx(stability(model, motion).exponents[0].real, abs=1e-7)


def test_the_harmonics_taken_unless_told_see_at_large_roll_what_fifteen_see():
    """Convergence: a fold near 70 deg where fifteen harmonics put it; three show a symmetry breaking there besides."""
    import quartering as qt

    ship = paper_ship()
    given = {"wave": qt.Wave(ship.hull.length, 4.0), "speed": 8.0, "heading": 60.0, "limits": (1.0, 14.0)}
    few, usual, many = (
        branch(ship, "wave_height", **given, **more) for more in ({"harmonics": 3}, {}, {"harmonics": 15})
    )
    events = [ds.isel(point=np.flatnonzero(ds["event"] != "")) for ds in (few, usual, many)]
    assert [ds["event"].values.tolist() for ds in events] == [["fold", "symmetry-breaking"], ["fold"], ["fold"]]
    assert float(events[2]["roll_peak"][0]) > 65.0  # large roll, where three harmonics no longer do
    assert float(events[1]["wave_height"][0]) == pytest.approx(float(events[2]["wave_height"][0]), rel=2e-4)


@pytest.mark.soak
def test_an_idle_autopilot_leaves_the_changes_of_stability_where_they_are():
    """The heading is free then: one more multiplier, exactly 1, beside those of the bare ship."""
    from dataclasses import replace

    from quartering.hull.autopilot import Autopilot

    model = model_of(DYNAMICS["cases"]["C_ship_unstable_I3"])
    bare, idle = (
        branch(one, "excitation", limits=(0.05, 1.0), harmonics=3)
        for one in (model, replace(model, autopilot=Autopilot(0.0, 0.0)))
    )
    at = [ds["excitation"][ds["event"] == "neimark-sacker"].values for ds in (bare, idle)]
    assert at[0].size > 0
    np.testing.assert_allclose(at[1], at[0], rtol=1e-7)


def test_neimark_sacker_point_is_where_the_index_changes_sign():
    """Agreement: Floquet's growing roll begins, to first order, where K2 passes zero ([H71] eq. (13))."""
    model = model_of(DYNAMICS["cases"]["C_ship_unstable_I3"])
    curve = branch(model, "excitation", limits=(0.05, 1.0), harmonics=5)
    events = curve["event"].values
    assert "neimark-sacker" in events
    share = float(curve["excitation"][events == "neimark-sacker"].values[0])
    s = model.system
    from dataclasses import replace

    from quartering.motion.steady.motion import steady_motions
    from quartering.stability.assessment import assess

    at = replace(s, cos=share * s.cos, sin=share * s.sin)
    u, orders, _, _ = steady_motions(at, 5)
    first = assess(at, u, orders).first_order
    whole, _, _, _ = steady_motions(s, 5)
    assert abs(first.k2[0]) < 0.02 * abs(assess(s, whole, orders).first_order.k2[0])


def test_two_folds_close_together_are_found_and_the_branch_ends():
    """Theory of Floquet: at a fold one multiplier is 1. Two folds within 0.01 m leave Newton's method little room."""
    import quartering as qt

    ship, wave = (
        paper_ship().with_(roll_damping=0.02),
        qt.Wave(120.0, 4.0),
    )
    folds = qt.branch(ship, "wave_length", wave=wave, speed=7.5, heading=72.0).query(point="fold")
    assert folds.sizes["point"] == 3
    multipliers = folds["multiplier_real"].values + 1j * folds["multiplier_imag"].values
    assert np.abs(multipliers - 1.0).min(axis=1).max() < 1e-6
