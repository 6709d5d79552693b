"""What stands beside a stable verdict, against integration in time and the amplitude equation of one harmonic."""

import numpy as np
import pytest

import quartering as qt
from quartering.study.condition.beside import capsizes_on_the_way, other_stable_motions
from quartering.study.condition.examine import examine, facts

DESTROYER = qt.ship("dtmb5415").with_(velocities="absolute", righting="polynomial", drag="cubic")
WAVE = qt.Wave(2.18 * DESTROYER.hull.length, 2.18 * DESTROYER.hull.length / 20)


@pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
def test_a_stable_motion_that_is_not_reached_from_upright_says_so():
    """Authority: `simulate`, another integrator, from rest; its step is chosen by the error, here it is fixed."""
    found = examine(DESTROYER, WAVE, 7.0, 91.0)
    assert found.verdict.stable
    trace = qt.simulate(found.model, 10 * 2 * np.pi / found.model.frequency, (0, 0, 0, 0))
    period = 2 * np.pi / found.model.frequency
    assert trace.attrs["capsize_time"] < 2 * period
    assert found.beside.capsizes["upright"] == pytest.approx(trace.attrs["capsize_time"], abs=0.05 * period)
    assert "raised" not in found.beside.capsizes
    (said,) = found.beside.sentences
    after = found.beside.capsizes["upright"]
    assert said.startswith(f"Stable motion, capsizes on the way: from upright in the whole wave after {after:.0f} s")


def test_the_wave_at_a_share_of_its_height_is_a_lower_wave():
    """Identity: the equations of the lower wave, made anew; every part of them is in proportion to its height."""
    for ship in (qt.ship("dtmb5415"), DESTROYER):
        model = qt.equations(ship, qt.Wave(150.0, 3.0), 7.0, 60.0)
        lower = qt.equations(ship, qt.Wave(150.0, 1.0), 7.0, 60.0)
        third = model.system.raised(np.array([1 / 3]))
        for name in ("cos", "sin", "inputs", "strips", "linear", "coefficients"):
            np.testing.assert_allclose(
                getattr(third, name), getattr(lower.system, name), rtol=1e-12, atol=1e-15, err_msg=name
            )


def test_a_motion_that_is_reached_both_ways_is_left_alone():
    """Linear equations capsize nowhere."""
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_p": -0.1}
    assert capsizes_on_the_way(qt.Model(np.eye(3), terms, 0.8, (0, 0.1, 0), (0, 0, 0))) == {}


@pytest.mark.parametrize("harmonics", [3, 9])
def test_the_other_stable_motion_is_the_one_long_integration_comes_to(harmonics):
    """Softening roll with two stable motions, 1.73 and 37.96 deg: integration of the upper one over sixteen decays."""
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_p": -0.00808, "K_phiphiphi": 0.9795}
    model = qt.Model(np.eye(3), terms, 0.83386, (0, 0.00918, 0), (0, 0, 0))
    known = qt.steady_motion(model, harmonics, start="rest")
    (other,) = other_stable_motions(model, known, harmonics)
    (upper,) = [m for m in qt.all_motions(model, 9) if m.stable and m.amplitude[1] > 0.5]
    end = qt.simulate(model, 4000.0, tuple(upper.state(0.0) * [1, 1.01, 1.01, 1]))
    last = np.radians(end["roll"].values[-200:])
    assert other == pytest.approx(np.abs(last).max(), rel=2e-3)


# Defaults throughout (velocities through the water, fitted curve of the lines).
DEFAULT = qt.ship("dtmb5415").with_(gm=0.38), qt.Wave(252.0, 19.5), 11.7, 56.0
TWO = qt.ship("wigley").with_(gm=0.23), qt.Wave(184.0, 14.3), 4.2, 79.0


@pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
def test_with_the_defaults_too_a_stable_motion_may_not_be_reached():
    """Authority: `simulate` from rest."""
    found = examine(*DEFAULT)
    assert found.verdict.stable
    period = 2 * np.pi / found.model.frequency
    trace = qt.simulate(found.model, 10 * period, (0, 0, 0, 0))
    assert found.beside.capsizes["upright"] == pytest.approx(trace.attrs["capsize_time"], abs=0.05 * period)
    assert facts(found, [])["capsizes_on_the_way"] == found.beside.capsizes


@pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
def test_with_the_defaults_too_another_stable_motion_may_exist_and_is_named():
    """Authority: integration from beside the other motion, fifty periods, stays at it."""
    found = examine(*TWO)
    assert found.verdict.stable
    assert found.beside.others
    assert f"also {found.beside.others[0]:.3g}" in found.beside.sentences[-1]
    others = [m for m in qt.all_motions(found.model, 3) if m.stable and m.periods == 1]
    other = min(others, key=lambda m: abs(np.degrees(m.peak[1]) - found.beside.others[0]))
    trace = qt.simulate(found.model, 50 * 2 * np.pi / found.model.frequency, tuple(other.state(0.0)))
    assert np.abs(trace["roll"].values[-400:]).max() == pytest.approx(found.beside.others[0], rel=0.05)
