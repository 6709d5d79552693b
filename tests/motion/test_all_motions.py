"""Coexisting motions against 40-digit references and closed forms."""

import numpy as np
import pytest

from quartering.motion.branches.search import periodic_motions as all_motions
from quartering.motion.equations.model import Model
from quartering.stability.verdict import stability
from tests.reference import DYNAMICS, model_of

UNDAMPED = [
    pytest.param(row, id=f"w={row['w']}", marks=() if row["w"] == 1.6 else pytest.mark.soak)
    for row in DYNAMICS["duffing"]["rows"]
]


def test_all_three_motions_of_the_fold_case_are_found_and_judged():
    case = DYNAMICS["cases"]["D_fold_strong"]
    model = model_of(case)
    motions = [m for m in all_motions(model) if not m.mean.any()]  # the reference lists the symmetric ones
    exact = [np.hypot(*np.array(s["harmonics_9"])[1, 0]) for s in case["solutions"]]
    np.testing.assert_allclose([m.amplitude[1] for m in motions], exact, rtol=1e-11)
    assert [stability(model, m).stable for m in motions] == [s["orbit"]["stable"] for s in case["solutions"]]


@pytest.mark.parametrize("row", UNDAMPED)
def test_every_undamped_duffing_motion_is_found(row):
    """Exact periodic solutions in 40 digits, in and out of phase."""
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -DYNAMICS["duffing"]["beta"]}
    model = Model(np.eye(3), terms, row["w"], (0, DYNAMICS["duffing"]["X0"], 0), (0, 0, 0))
    found = [m.cos[0, 1] for m in all_motions(model, 19)]
    for exact in row["exact"]:
        assert np.abs(np.array(found) - exact["a1"]).min() < 1e-8
