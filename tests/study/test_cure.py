"""Cures do cure: the verdict flips exactly there."""

import pytest

import quartering as qt
from quartering.study.cure import cures
from quartering.study.paper.model import paper_ship

SHIP = paper_ship().with_(factors={"K_prr": -60.0})
WAVE, SPEED, HEADING = qt.Wave(121.92, 4.0), 8.6, 30.0


def verdict(ship=SHIP, wave=WAVE, speed=SPEED):
    model = qt.equations(ship, wave, speed, HEADING)
    return qt.stability(model, qt.steady_motion(model, 3, start="rest"))


@pytest.fixture(scope="module")
def found():
    return {cure.parameter: cure for cure in cures(SHIP, WAVE, SPEED, HEADING)}


def test_the_motion_to_cure_is_unstable():
    assert not verdict().stable


@pytest.mark.parametrize("name", ["K_prr", "roll_damping", "wave_height"])
def test_beyond_the_cure_the_motion_is_stable_and_before_it_is_not(found, name):
    """The judge is the one-case verdict, with its own integration."""
    cure = found[name]

    def at(value):
        if name == "wave_height":
            return verdict(wave=qt.Wave(WAVE.length, value))
        return verdict(SHIP.with_(factors={name: value}) if name == "K_prr" else SHIP.with_(**{name: value}))

    beyond, short = cure.now + 1.02 * (cure.needed - cure.now), cure.now + 0.98 * (cure.needed - cure.now)
    assert at(beyond).stable
    assert not at(short).stable


def test_smallest_change_stands_first_and_reads_as_a_sentence(found):
    changes = [abs(cure.change) for cure in found.values()]
    assert len(changes) >= 3
    assert found["K_prr"].sentence.endswith("less K_prr")
    assert "more added roll damping" in found["roll_damping"].sentence


def test_margin_asks_for_more():
    easy = cures(SHIP, WAVE, SPEED, HEADING, parameters=["roll_damping"])[0]
    hard = cures(SHIP, WAVE, SPEED, HEADING, parameters=["roll_damping"], margin=0.01)[0]
    assert hard.needed > easy.needed


@pytest.mark.parametrize("name", ["K_prr", "roll_damping", "wave_height"])
def test_with_a_margin_the_exponent_at_the_cure_is_minus_the_margin(name):
    """Disturbances die out at just the rate asked for, by the one-case verdict."""
    margin = 0.005
    cure = cures(SHIP, WAVE, SPEED, HEADING, parameters=[name], margin=margin)[0]
    ship, wave = SHIP, WAVE
    if name == "wave_height":
        wave = qt.Wave(WAVE.length, cure.needed)
    else:
        ship = SHIP.with_(factors={name: cure.needed}) if name == "K_prr" else SHIP.with_(**{name: cure.needed})
    assert verdict(ship, wave).exponents[0].real == pytest.approx(-margin, abs=2e-6)


def test_a_stable_motion_needs_no_cure_and_a_negative_margin_is_refused():
    assert cures(qt.ship("series60-cb60"), WAVE, SPEED, HEADING) == []
    with pytest.raises(qt.InputError, match="margin"):
        cures(SHIP, WAVE, SPEED, HEADING, margin=-1.0)
