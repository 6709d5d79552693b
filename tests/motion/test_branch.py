"""Branches, folds and coexisting motions against 40-digit references and closed forms."""

import numpy as np
import pytest

from quartering.conventions import InputError
from quartering.motion.branch import all_motions, branch
from quartering.motion.equations import Model
from quartering.stability.verdict import stability
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


def test_all_three_motions_of_the_fold_case_are_found_and_judged():
    case = DYNAMICS["cases"]["D_fold_strong"]
    model = model_of(case)
    motions = all_motions(model)
    exact = [np.hypot(*np.array(s["harmonics_9"])[1, 0]) for s in case["solutions"]]
    np.testing.assert_allclose([m.amplitude[1] for m in motions], exact, rtol=1e-11)
    assert [stability(model, m).stable for m in motions] == [s["orbit"]["stable"] for s in case["solutions"]]


@pytest.mark.parametrize("row", DYNAMICS["duffing"]["rows"], ids=lambda r: f"w={r['w']}")
def test_every_undamped_duffing_motion_is_found(row):
    """Exact periodic solutions in 40 digits, in and out of phase."""
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -DYNAMICS["duffing"]["beta"]}
    model = Model(np.eye(3), terms, row["w"], (0, DYNAMICS["duffing"]["X0"], 0), (0, 0, 0))
    found = [m.cos[0, 1] for m in all_motions(model, 19)]
    for exact in row["exact"]:
        assert np.abs(np.array(found) - exact["a1"]).min() < 1e-8


def test_unknown_parameter_is_refused():
    model = model_of(DYNAMICS["cases"]["A_roll_only"])
    with pytest.raises(InputError, match="frequency"):
        branch(model, "gm")
    with pytest.raises(InputError, match="rising"):
        branch(model, "frequency", limits=(1.0, 0.5))
