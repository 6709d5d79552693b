"""The paper's mechanism on a real hull: every number of docs/the_mechanism.md, and what must hold whatever they are."""

import importlib.util
import re
from pathlib import Path

import numpy as np
import pytest

import quartering as qt
from quartering.study.paper.mechanism import onset, roll_alone, smallest_change
from quartering.study.paper.model import table_ratios

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "the_mechanism.md").read_text()

_spec = importlib.util.spec_from_file_location("mechanism", ROOT / "benchmarks" / "mechanism.py")
made = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(made)

pytestmark = pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
SHIP, SPEED = made.SHIP, made.SPEED


def quoted(*cells: str) -> bool:
    return "| " + " | ".join(cells) + " |" in PAGE


@pytest.mark.parametrize("steepness", [50, 30, 20])
@pytest.mark.soak
def test_page_quotes_the_four_statements(steepness):
    assert quoted(*made.stated(steepness))


@pytest.mark.parametrize("heading", [15.0, 30.0, 45.0, 60.0])
@pytest.mark.soak
def test_page_quotes_the_factor_each_coefficient_needs(heading):
    assert quoted(f"{heading:g}", *(made.needed(name, heading) for name in made.ALONE))


@pytest.mark.parametrize("heading", [15.0, 30.0, 45.0])
@pytest.mark.soak
def test_page_quotes_the_smallest_change(heading):
    assert quoted(*made.search(heading))


def test_page_quotes_the_measured_ship():
    for name in ("K_prr", "K_vrr"):
        assert (
            f"| {name} | {made.prime(SHIP, name, SPEED):+.2e} | {made.prime(made.measured(), name, 10.29):+.2e} |"
            in PAGE
        )
    assert f"| {float(made.needed('K_prr', 30.0)) * made.prime(SHIP, 'K_prr', SPEED):+.2e} |" in PAGE
    count, rolls, largest = made.measured_verdicts()
    assert rolls == 0
    assert f"In {count} conditions" in PAGE
    assert float(re.search(r"stays below (-[\d.]+) 1/s", PAGE)[1]) == pytest.approx(largest, abs=5e-4)


def test_measured_k_vrr_is_the_published_one():
    """Published: Son and Nomoto (1982), K'_vrr = 0.0010565 about the height of G; moved to our G by less than 1 %."""
    assert made.prime(made.measured(), "K_vrr", 10.29) == pytest.approx(0.0010565, rel=0.01)


def test_table_turns_the_sign_of_i3():
    """I3 = rho_1 K_vrr + K_prr: the paper's reading of its own table, on our coefficients."""
    model = qt.equations(SHIP, made.wave(30), SPEED, 30.0)
    inverse = np.linalg.inv(model.inertia)
    rho, k_vrr, k_prr = inverse[0, 1] / inverse[1, 1], model.terms["K_vrr"], model.terms["K_prr"]
    ratios = table_ratios()
    before, after = rho * k_vrr + k_prr, rho * ratios["K_vrr"] * k_vrr + ratios["K_prr"] * k_prr
    assert before < 0 < after
    assert f"{before:+.2e}" in PAGE
    assert f"{after:+.2e}" in PAGE
    assert f"{rho:.4f} m" in PAGE
    edge = rho * k_vrr + float(made.needed("K_prr", 30.0)) * k_prr
    assert f"{edge:+.2e}" in PAGE
    assert float(re.search(r"(\d+) times that", PAGE)[1]) == pytest.approx(edge / after, rel=0.01)


def test_roll_alone_decays_at_its_mean_damping():
    """Closed form (Liouville): the sum of the two exponents of roll is <K_p + 3 K_ppp p^2>/I, each half of it for a pair."""
    heading, wave = 60.0, made.wave(30)
    ds = roll_alone(SHIP, wave, SPEED, [heading], harmonics=5)
    model = qt.equations(SHIP, wave, SPEED, heading)
    inertia = model.inertia[1, 1]
    speed = model.frequency * np.radians(float(ds["roll"][0]))
    expected = (model.terms["K_p"] + 1.5 * model.terms["K_ppp"] * speed**2) / (2 * inertia)
    # beyond the fundamental, harmonics of a roll of 23 deg change <p^2> by about a part in a thousand of a small term
    assert float(ds["exponent"][0]) == pytest.approx(expected, rel=2e-3)


def test_k_vpp_feeds_the_motion_table_i_makes_unstable():
    found = onset(SHIP, table_ratios(), made.wave(30), SPEED, [65.0])
    factors = {name: 1 + 1.002 * found.strength * (ratio - 1) for name, ratio in table_ratios().items()}
    model = qt.equations(SHIP.with_(factors=factors), made.wave(30), SPEED, 65.0)
    verdict = qt.stability(model, qt.steady_motion(model, 5, start="rest"))
    assert (verdict.kind, verdict.strongest[0]) == ("roll", "K_vpp")


def test_onset_is_where_the_one_case_verdict_changes():
    wave, heading = made.wave(30), 30.0
    found = onset(SHIP, {"K_prr": 0.0}, wave, SPEED, [heading], most=40.0, harmonics=3)
    for side, stable in ((0.999, True), (1.001, False)):
        ship = SHIP.with_(factors={"K_prr": 1 - side * found.strength})
        model = qt.equations(ship, wave, SPEED, heading)
        assert qt.stability(model, qt.steady_motion(model, 3, start="rest")).stable is stable


def test_smallest_change_is_smaller_than_any_single_one_and_stationary():
    """Necessary condition of a minimum: the change is parallel to the gradient of the growth rate there."""
    wave, heading, names = made.wave(30), 30.0, ["K_prr", "K_pvv", "K_vpp"]
    found = smallest_change(SHIP, wave, SPEED, heading, names)
    change = np.array([found[name] - 1 for name in names])
    assert np.linalg.norm(change) < abs(float(made.needed("K_prr", heading)) - 1)

    def growth(factors):
        model = qt.equations(SHIP.with_(factors=dict(zip(names, factors, strict=True))), wave, SPEED, heading)
        return -qt.stability(model, qt.steady_motion(model, 3, start="rest")).index

    assert growth(1 + change) == pytest.approx(0.0, abs=1e-5)
    slope = [(growth(1 + change + step) - growth(1 + change - step)) / 0.2 for step in 0.1 * np.eye(3)]
    cosine = change @ slope / np.linalg.norm(change) / np.linalg.norm(slope)
    assert cosine == pytest.approx(1.0, abs=1e-5)


def test_a_motion_that_is_unstable_already_and_an_empty_change_are_refused():
    with pytest.raises(qt.InputError, match="unstable as it is"):
        smallest_change(SHIP.with_(factors={"K_prr": -60.0}), made.wave(30), SPEED, 30.0)
    with pytest.raises(qt.InputError, match="at least one"):
        onset(SHIP, {}, made.wave(30), SPEED, [30.0])
