"""Published nonlinear oscillators carried by the roll row: forced and free Duffing, and erosion of the safe basin.

Two benchmarks of ship dynamics stay outside: heave-roll and pitch-roll resonance need a second degree of freedom with a
restoring force of its own, which sway and yaw do not have.
"""

import numpy as np
import pytest

from quartering.motion.equations.model import Model
from quartering.motion.steady.harmonic import harmonic_balance
from quartering.motion.steady.motion import motion_record
from quartering.motion.transient.basin import safe_shares
from quartering.motion.transient.simulate import simulate
from quartering.stability.verdict import stability
from quartering.study.branches.coexisting import all_motions
from quartering.study.paper.duffing_formulas import duffing_model
from tests.reference import table

FORCED = [{key: float(value) for key, value in row.items()} for row in table("duffing_forced.csv")]
FREE = [{key: float(value) for key, value in row.items()} for row in table("duffing_free.csv")]
SOFTENING = [{key: float(value) for key, value in row.items()} for row in table("melnikov_softening.csv")]
ORDERS = tuple(range(1, 22, 2))


@pytest.mark.parametrize("row", FORCED, ids=lambda r: f"beta={r['beta']:g}-w={r['omega']:g}-{r['A1']:.3f}")
def test_forced_duffing_motion_and_multipliers_agree_with_shooting_to_1e_8(row):
    """Authority: shooting, relative tolerance 1e-12, printed to 9 decimals (tests/reference/duffing_forced.csv)."""
    model = duffing_model(row["beta"], row["F"], row["omega"], row["c"])
    phasor = row["A1"] * np.exp(1j * np.radians(row["phase1_deg"]))
    start = np.zeros((1, 3, 2 * len(ORDERS)))
    start[0, 1, :2] = phasor.real, -phasor.imag
    u, status, residual = harmonic_balance(model.system, ORDERS, start=start)
    motion = motion_record(model, u[0], ORDERS, int(status[0]), float(residual[0]), "harmonic balance")
    amplitudes = np.hypot(motion.cos[:3, 1], motion.sin[:3, 1])
    np.testing.assert_allclose(amplitudes, [row["A1"], row["A3"], row["A5"]], rtol=0, atol=1e-8)
    # The table's largest |x| is that of samples in time, up to 2e-5 below the maximum.
    times = np.linspace(0, 2 * np.pi / row["omega"], 4001)
    largest = np.abs(motion.state(times)[:, 1]).max()
    assert row["max_abs_x"] - 1e-7 < largest < row["max_abs_x"] * (1 + 3e-5)
    verdict = stability(model, motion)
    for k in "12":
        exact = complex(row[f"mu{k}_re"], row[f"mu{k}_im"])
        assert np.abs(verdict.multipliers - exact).min() < 1e-8
    assert verdict.stable is bool(row["stable"])


@pytest.mark.parametrize("frequency", [1.15, 1.2, 1.3])
def test_all_motions_of_the_forced_duffing_are_the_listed_ones(frequency):
    beta = 0.1 if frequency == 1.15 else 1.0
    listed = sorted(row["A1"] for row in FORCED if row["omega"] == frequency and row["beta"] == beta)
    row = next(row for row in FORCED if row["omega"] == frequency and row["beta"] == beta)
    found = all_motions(duffing_model(beta, row["F"], frequency, row["c"]), 15)
    if len(listed) > 1:
        np.testing.assert_allclose([m.amplitude[1] for m in found], listed, atol=1e-7)
    else:
        assert found[0].amplitude[1] == pytest.approx(listed[0], abs=1e-7)


@pytest.mark.parametrize("row", FREE, ids=lambda r: f"beta={r['beta']:g}-A={r['amplitude']:g}")
def test_free_duffing_returns_after_the_period_of_the_elliptic_integral(row):
    """Closed form: the period is 4 K(m)/sqrt(1 + beta A^2)."""
    period = 2 * np.pi / row["omega"]
    trace = simulate(
        duffing_model(row["beta"], 0.0, 1.0), period, (0, row["amplitude"], 0, 0), step=period, tolerance=1e-12
    )
    end = np.radians([float(trace["roll"][-1]), float(trace["roll_rate"][-1])])
    np.testing.assert_allclose(
        end, [row["amplitude"], 0.0], rtol=0, atol=1e-9 * max(1.0, row["amplitude"] * row["omega"] ** 2)
    )


@pytest.mark.parametrize(
    "row", [r for r in FREE if abs(r["beta"]) <= 1.0], ids=lambda r: f"beta={r['beta']:g}-A={r['amplitude']:g}"
)
def test_backbone_of_the_undamped_duffing_is_the_free_motion(row):
    """At the free frequency the peaks of motions forced by +F and -F lie about the free amplitude, to the square of F."""
    missed = []
    for force in (2e-2, 1e-2):
        peaks = []
        for side in (1.0, -1.0):
            start = np.zeros((1, 3, 2 * len(ORDERS)))
            start[0, 1, 0] = row["amplitude"]
            given = side * force * abs(row["beta"]) * row["amplitude"] ** 3  # small beside the detuning
            u, status, _ = harmonic_balance(duffing_model(row["beta"], given, row["omega"]).system, ORDERS, start=start)
            assert status[0] == 0
            peaks.append(u[0, 1, ::2].sum())
        missed.append(np.mean(peaks) - row["amplitude"])
    extrapolated = (4 * missed[1] - missed[0]) / 3
    assert abs(missed[1]) < 0.35 * abs(missed[0])
    assert abs(extrapolated) < 0.02 * abs(missed[1]) + 1e-10


def softening(zeta, frequency, force):
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_p": -2 * zeta, "K_phiphiphi": 1.0}
    return Model(np.eye(3), terms, frequency, (0, force, 0), (0, 0, 0))


@pytest.mark.parametrize(
    "row", [r for r in SOFTENING if r["zeta"] == 0.05 and r["Omega"] in (0.85, 1.0)], ids=lambda r: f"w={r['Omega']:g}"
)
@pytest.mark.soak
def test_safe_basin_of_the_softening_oscillator_is_eroded_above_the_melnikov_force(row):
    """Melnikov's force, first order in damping: below it the basin's edge is smooth, well above it the basin is eaten into."""
    assert row["F_M"] == pytest.approx(
        4 * row["zeta"] * np.sinh(np.pi * row["Omega"] / np.sqrt(2)) / (3 * np.pi * row["Omega"]), abs=1e-8
    )
    angles, rates = np.meshgrid(np.linspace(-1.0, 1.0, 50), np.linspace(-0.7, 0.7, 40))
    starts = np.zeros((angles.size, 4))
    starts[:, 1], starts[:, 2] = angles.ravel(), rates.ravel()
    models = [softening(row["zeta"], row["Omega"], f * row["F_M"]) for f in (0.0, 0.8, 4.0)]
    share = safe_shares(models, starts, periods=16)
    assert share[1] > 0.9 * share[0]
    assert share[2] < 0.7 * share[0]
