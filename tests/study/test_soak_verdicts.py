"""Five hundred conditions at random: no "stable" that integration from rest contradicts without the verdict saying so.

Authority: `simulate`, adaptive, from rest in the whole wave, until disturbances have died out by the verdict's own rate.
"""

import os

import numpy as np
import pytest

import quartering as qt
from quartering.hull.file.read import available_ships
from quartering.study.condition.examine import examine

pytestmark = [pytest.mark.soak, pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")]

CONDITIONS = int(os.environ.get("QUARTERING_VERDICTS", "500"))
SEED = 15
FEWEST, MOST = 60, 400
"""Periods of a history: until exp(-6) of a disturbance is left, within these."""
SHARE, LEAST = 0.1, 1.0
"""Of the roll, and in degrees: what one harmonic may miss of a motion without being another one."""


def conditions(count):
    """Ships from full to quarter GM, waves of 1/60 to 1/12, lengths, speeds, headings."""
    random = np.random.default_rng(SEED)
    names = [entry.name for entry in available_ships()]
    for _ in range(count):
        ship = qt.ship(names[random.integers(len(names))])
        ship = ship.with_(gm=ship.loading.gm * random.uniform(0.25, 1.0))
        length = ship.hull.length * random.uniform(0.6, 3.0)
        wave = qt.Wave(length, length * np.exp(random.uniform(np.log(1 / 60), np.log(1 / 12))))
        speed = random.uniform(0.0, 0.3) * (9.80665 * ship.hull.length) ** 0.5
        yield ship, wave, speed, random.uniform(0.0, 180.0)


def contradiction(found):
    """What integration from rest says against a stable verdict that does not say it itself; "" for nothing."""
    period = 2 * np.pi / found.model.frequency
    rate = -found.verdict.exponents[0].real
    periods = int(np.clip(6.0 / (rate * period), FEWEST, MOST))
    trace = qt.simulate(found.model, periods * period, (0, 0, 0, 0), tolerance=1e-7)
    if "capsize_time" in trace.attrs:
        after = trace.attrs["capsize_time"]
        return "" if "upright" in found.beside.capsizes else f"capsizes after {after / period:.1f} periods"
    last = float(np.abs(trace["roll"].values[-3 * 60 :]).max())
    named = [np.degrees(found.motion.peak[1]), *found.beside.others]
    if any(abs(last - one) <= max(LEAST, SHARE * one) for one in named):
        return ""
    before = float(np.abs(trace["roll"].values[-9 * 60 : -6 * 60]).max())
    return f"rolls {last:.2f} deg ({before:.2f} six periods before), named {np.round(named, 2).tolist()}"


def test_no_stable_verdict_is_contradicted_by_integration_from_rest():
    """Conditions without a motion, or judged unstable, are passed over: enough must be stable for this to say something."""
    stable, against = 0, []
    for i, (ship, wave, speed, heading) in enumerate(conditions(CONDITIONS)):
        try:
            found = examine(ship, wave, speed, heading)
        except qt.InputError:  # the ship keeps pace with the wave
            continue
        if not found.verdict.stable:
            continue
        stable += 1
        words = contradiction(found)
        if words:
            against.append(f"{i}: {ship.name} GM {ship.loading.gm:.4g}, {found.verdict.sentence} {words}")
            if log := os.environ.get("QUARTERING_LOG"):
                with open(log, "a", encoding="utf-8") as file:
                    print(against[-1], found.beside, file=file, flush=True)
    assert not against, "\n".join(against)
    assert stable > CONDITIONS // 4
