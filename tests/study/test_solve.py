"""Thousands of models in one call: each has the answer it has alone, whoever stands beside it."""

import numpy as np
import pytest

import quartering as qt
from quartering.motion.status import Status
from quartering.stability.kind import Kind

TERMS = {"Y_v": -0.4, "K_phi": -1.0, "K_p": -0.05, "K_ppp": -0.08, "N_r": -0.6}


def numbers(stiffness, force, **more):
    return qt.Model(np.eye(3), TERMS | {"K_phiphiphi": stiffness}, 0.85, (0, force, 0), (0, 0.02, 0), **more)


@pytest.fixture(scope="module")
def mixture():
    """Softening, hardening, leaning and steered models, and a ship with drag by strips."""
    ship, wave = qt.ship("wigley"), qt.Wave(120.0, 3.0)
    steered = ship.with_(autopilot={"gain": 1.0, "rate_gain": 2.0}, rudder={"area": 8.0, "aspect": 1.5})
    return [
        numbers(-0.25, 0.05), qt.equations(ship, wave, 5.0, 60.0), numbers(0.3, 0.1),
        numbers(-0.25, 0.05, force_mean=(0, 0.02, 0)), qt.equations(steered, wave, 5.0, 60.0),
        qt.equations(ship, wave, 5.0, 90.0),
    ]  # fmt: skip


@pytest.mark.parametrize("harmonics", [1, 3, 5])
def test_a_model_has_the_answer_it_has_alone(mixture, harmonics):
    """Against `steady_motion` and `stability`, which solve one condition; multipliers of maps are good to 5e-6."""
    ds = qt.solve(mixture, harmonics)
    for k, model in enumerate(mixture):
        motion = qt.steady_motion(model, harmonics, fixed=True)
        verdict, row = qt.stability(model, motion), ds.isel(model=k)
        assert row.status == motion.status
        np.testing.assert_allclose(row.cos.values[[h - 1 for h in motion.orders]], motion.cos, rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(row["mean"], motion.mean, rtol=1e-9, atol=1e-12)
        assert float(row.roll_peak) == pytest.approx(np.degrees(motion.peak[1]), rel=1e-9)
        assert Kind(int(row.verdict)).label == verdict.kind
        moduli = np.sort(row.multiplier_modulus.values[~np.isnan(row.multiplier_modulus.values)])
        np.testing.assert_allclose(moduli, np.sort(np.abs(verdict.multipliers)), rtol=0, atol=5e-5)
        assert float(row.k2) == pytest.approx(verdict.k2, rel=1e-7)


def test_neighbours_change_no_byte(mixture):
    alone = qt.solve(mixture[:1])
    among = qt.solve(mixture[:1] * 70 + [numbers(-0.2, 0.01 * k) for k in range(1, 9)])
    for name in alone.data_vars:
        assert alone[name].values[0].tobytes() == among[name].values[40].tobytes(), name


def test_a_model_without_an_answer_has_a_status_and_takes_no_other_with_it():
    """The softening spring escapes at 0.577 of its vanishing angle's moment, K phi (1 - 0.25 phi^2): 0.77 here."""
    ds = qt.solve([numbers(-0.25, 0.02), numbers(-0.25, 5.0), numbers(-0.25, 0.03)])
    assert ds.status.values[[0, 2]].tolist() == [0, 0]
    assert not Status(int(ds.status[1])).ok
    assert np.isnan(ds.roll_amplitude[1])
    assert int(ds.verdict[1]) == -1
    assert np.isfinite(ds.roll_amplitude[[0, 2]]).all()


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ([], "is empty"), (numbers(0.1, 0.1), "one Model"), ([numbers(0.1, 0.1), 3], r"models\[1\] = 3 is no Model"),
        (7, "a list of Model"),
    ],
)  # fmt: skip
def test_what_is_no_list_of_models_is_refused(given, words):
    with pytest.raises(qt.InputError, match=words):
        qt.solve(given)


def test_harmonics_and_start_are_those_of_a_steady_motion():
    with pytest.raises(qt.InputError):
        qt.solve([numbers(0.1, 0.1)], 4)
    with pytest.raises(qt.InputError):
        qt.solve([numbers(0.1, 0.1)], start="top")
    assert "verdict" not in qt.solve([numbers(0.1, 0.1)], stability=False)
