"""The whole chain against another strip program: S-175 at zero speed, SCORES II (tests/reference/s175_scores.csv)."""

import csv
import warnings

import numpy as np
import pytest

import quartering as qt
from tests.reference import HERE

ROWS = list(csv.DictReader((HERE / "s175_scores.csv").read_text().splitlines()[3:]))
HEADINGS = sorted({float(row["heading_deg"]) for row in ROWS})


def ours(heading: float, sections: str = "lewis") -> dict[str, np.ndarray]:
    """Amplitudes per metre of wave amplitude at the frequencies of the table, for a wave of 2 mm.

    SCORES takes the sections as Lewis forms, so they are taken as such here.
    """
    ship = qt.ship("s175").with_(gm=1.066, gyradius_roll=9.65, gyradius_yaw=70.0, roll_damping=0.0, sections=sections)
    omega = np.array([float(row["omega"]) for row in ROWS if float(row["heading_deg"]) == heading])
    lengths = 2 * np.pi * 9.81 / omega**2
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", qt.RangeWarning)
        ds = qt.sweep(ship, 0.0, heading, lengths[::-1], [0.002])
    found = {name: ds[name].values.ravel()[::-1] / 0.001 for name in ("sway", "roll", "yaw")}
    return found | {"omega": omega}


@pytest.mark.parametrize("heading", HEADINGS)
def test_lateral_motions_agree_with_scores(heading):
    """Below 0.4 rad/s within 5 % of each curve's peak; the roll peak itself is cut out.

    Within 0.012 rad/s of resonance the undamped roll of either program is a needle whose height is set by the wave
    damping alone (26.65 in 163,700 of critical in the table), so a shift of the natural frequency of 0.0006 rad/s
    (0.31801 here, 0.31738 there, from a displacement 0.6 % larger) changes it severalfold.
    """
    table = [row for row in ROWS if float(row["heading_deg"]) == heading]
    found = ours(heading)
    low = (found["omega"] < 0.4) & (np.abs(found["omega"] - 0.31738) > 0.012)
    for name, column in (("sway", "sway_m_per_m"), ("roll", "roll_deg_per_m"), ("yaw", "yaw_deg_per_m")):
        printed = np.array([float(row[column]) for row in table])
        if name == "yaw" and heading == 90.0:
            continue  # beam-sea yaw is a small difference of fore- and afterbody: 0.02 deg/m, see the next test
        difference = np.abs(found[name] - printed)[low].max()
        assert difference < 0.05 * printed.max(), f"{name}: {difference / printed.max():.3f} of the peak"


@pytest.mark.parametrize("heading", [60.0, 120.0])
def test_true_contours_stay_within_a_tenth_of_scores(heading):
    """What the choice of sections does: the true contours of the fine ends add up to 7 % of the peak to yaw, less to sway."""
    table = [row for row in ROWS if float(row["heading_deg"]) == heading]
    found = ours(heading, "auto")
    low = (found["omega"] < 0.4) & (np.abs(found["omega"] - 0.31738) > 0.012)
    for name, column in (("sway", "sway_m_per_m"), ("yaw", "yaw_deg_per_m")):
        printed = np.array([float(row[column]) for row in table])
        assert np.abs(found[name] - printed)[low].max() < 0.1 * printed.max(), name


def test_beam_sea_yaw_is_negligible_in_both_programs():
    found = ours(90.0)
    printed = [float(row["yaw_deg_per_m"]) for row in ROWS if float(row["heading_deg"]) == 90.0]
    away = np.abs(found["omega"] - 0.31738) > 0.012
    assert found["yaw"][away].max() < 0.06
    assert np.array(printed)[away].max() < 0.06


def test_natural_roll_frequency_agrees_with_scores():
    """SCORES prints 0.31738 rad/s."""
    ship = qt.ship("s175").with_(gm=1.066, gyradius_roll=9.65, gyradius_yaw=70.0)
    assert qt.coefficients(ship, 0.3, 0.0).roll_frequency == pytest.approx(0.31738, rel=5e-3)
