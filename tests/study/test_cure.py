"""Cures do cure: the verdict flips exactly there."""

import numpy as np
import pytest

import quartering as qt
from quartering.study.effects import cure as search
from quartering.study.effects.cure import cures
from quartering.study.effects.nearest import Reached, nearest, rounded
from quartering.study.effects.trials import Trials
from quartering.study.loadings import loaded
from quartering.study.paper.model import paper_ship

SHIP = paper_ship().with_(factors={"K_prr": -60.0})
WAVE, SPEED, HEADING = qt.Wave(121.92, 4.0), 8.6, 30.0


def verdict(ship=SHIP, wave=WAVE, speed=SPEED):
    model = qt.equations(ship, wave, speed, HEADING)
    return qt.stability(model, qt.steady_motion(model, 3, start="rest"))


@pytest.fixture(scope="module")
def found():
    return {cure.parameter: cure for cure in cures(SHIP, WAVE, SPEED, HEADING, harmonics=3)}


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
    easy = cures(SHIP, WAVE, SPEED, HEADING, parameters=["roll_damping"], harmonics=3)[0]
    hard = cures(SHIP, WAVE, SPEED, HEADING, parameters=["roll_damping"], margin=0.01, harmonics=3)[0]
    assert hard.needed > easy.needed


@pytest.mark.parametrize("name", ["K_prr", "roll_damping", "wave_height"])
def test_with_a_margin_the_exponent_at_the_cure_is_minus_the_margin(name):
    """Disturbances die out at just the rate asked for, by the one-case verdict."""
    margin = 0.005
    cure = cures(SHIP, WAVE, SPEED, HEADING, parameters=[name], margin=margin, harmonics=3)[0]
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


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"margin": "x"}, "margin = 'x'; that is no finite number with a unit"),
        ({"margin": None}, "margin = None; that is no finite number"),
        ({"margin": float("inf")}, "margin = inf 1/s; that is no finite number"),
        ({"margin": [1.0, 2.0]}, "one number is wanted here"),
        ({"margin": "1 m"}, 'margin = 1 m; unit "m" is not known'),
        ({"parameters": "gm"}, "parameters = 'gm'; they are a list of names"),
        ({"parameters": None}, "parameters = None; they are a list of names"),
        ({"parameters": ["gmm"]}, "parameters: gmm is unknown; did you mean gm"),
        ({"parameters": ["heading"]}, "parameters: heading is unknown"),
        ({"parameters": [3]}, "parameters: 3 is unknown; known are speed"),
        ({"harmonics": "x"}, "harmonics='x': give an odd number"),
        ({"form": 3}, "form 3 given; allowed: paper"),
    ],
)
def test_an_argument_that_cannot_be_is_refused_in_one_message(given, words):
    with pytest.raises(qt.InputError, match=words):
        cures(SHIP, WAVE, SPEED, HEADING, **given)


def test_a_margin_may_carry_a_unit():
    """0.6 a minute is 0.01 a second."""
    one, other = (cures(SHIP, WAVE, SPEED, HEADING, parameters=["roll_damping"], margin=m) for m in ("0.6 1/min", 0.01))
    assert one == other


SPECIMENS = [
    (SHIP, WAVE, SPEED, HEADING),
    (
        paper_ship("dtmb5415").with_(ends="three-dimensional"),
        qt.Wave(200.0, 10.0),
        14.0,
        50.0,
    ),  # ends in a jump: motions appear and vanish at folds
]


def applied(cure, ship, wave, speed, heading, value):
    """The condition with one cure made, as a user would make it."""
    if cure.parameter == "speed":
        return ship, wave, value, heading
    if cure.parameter == "wave_height":
        return ship, qt.Wave(wave.length, value), speed, heading
    return loaded(ship, {cure.parameter: value}), wave, speed, heading


@pytest.mark.filterwarnings(
    "ignore::quartering.conventions.RangeWarning"
)  # 21 m/s of a ship for 10 is one of the cures
@pytest.mark.parametrize(
    ("case", "harmonics"), [(SPECIMENS[0], 1), (SPECIMENS[0], 9), (SPECIMENS[1], 1), (SPECIMENS[1], 5)]
)
def test_every_cure_applied_anew_is_stable_at_the_verdicts_own_harmonics(case, harmonics):
    """The judge is the verdict on the changed condition: at the number itself, and at the one the sentence rounds it to."""
    healing = cures(*case, harmonics=harmonics)
    assert len(healing) >= 4
    for cure in healing:
        for value in (cure.needed, cure.rounded):
            model = qt.equations(*applied(cure, *case, value))
            again = qt.stability(model, qt.steady_motion(model, harmonics, start="rest"))
            assert again.stable, cure.sentence
            assert again.exponents[0].real < -2e-7


def test_a_rounded_cure_does_not_fall_short_of_the_number():
    """2.6747 m of wave height or less: 2.67 m; 1.5191 m of GM or more: 1.52 m; half of a coefficient, and none of it."""
    for name, now, needed, told, words in (
        ("wave_height", 4.0, 2.6747, 2.67, "1.33 m less wave height (4 -> 2.67 m)"),
        ("gm", 0.8128, 1.5121, 1.52, "0.707 m more GM (0.813 -> 1.52 m)"),
        ("K_prr", 1.0, 0.4677, 0.46, "54% less K_prr"),
        ("K_prr", 1.0, -0.2011, -0.21, "K_prr times -0.21"),
    ):
        cure = search.Cure(name, now, needed, "1" if name == "K_prr" else "m")
        assert cure.rounded == pytest.approx(told, abs=1e-12)
        assert cure.sentence == words


@pytest.mark.parametrize("case", SPECIMENS)
def test_a_search_takes_little_work(monkeypatch, case):
    """Seven parameters: the ship itself, one more for each coefficient and roll damping, eight for GM and gyradius, and three
    or four to settle each but speed and height; a pass over speeds for each batch: 1 + 3 + 16 + 20 + 6.

    A batch holds what all parameters ask: three lengths of the ladder (the last two in two pieces), five of sections at most,
    four of the secant, one beyond, one as told; settled ones beside the others. (One parameter after
    the other took 31 batches of 959 conditions.)
    """
    made = []

    class Counted(search.Trials):
        def __init__(self, *given):
            super().__init__(*given)
            made.append(self)

    monkeypatch.setattr(search, "Trials", Counted)
    cures(*case)
    assert made[0].ships_built <= 46
    assert made[0].batches <= 20
    assert made[0].judged <= 500


def value_of(search, answer):
    """What a search returns, its questions answered."""
    asked = next(search)
    while True:
        try:
            asked = search.send(answer(asked.factors))
        except StopIteration as end:
            return end.value


def test_a_value_that_does_not_hold_as_told_is_moved_on_by_units_of_its_last_digit():
    """Beside a jump: stable from 1.5004 to 1.5096, and from 1.525 on.

    1.5004 is told as 1.51, which is unstable, and so is 1.52; the first told value that is stable is 1.53.
    """

    def growth(factors):
        inside = ((factors > 1.5004) & (factors < 1.5096)) | (factors > 1.525)
        return np.where(inside, -0.05, 0.05)

    one = nearest(Reached, Reached(0.2, 5.0), 0.05, -1e-6, lambda factor, units: rounded(factor, 1.0, 2, units))
    assert value_of(one, growth) == 1.53


def test_course_instability_of_calm_water_is_no_matter_of_the_wave():
    """A hull unstable on course without any wave, by the eigenvalues of its linear motion: no cure of this condition."""
    ship = SHIP.with_(factors={"N_v": 6.0})
    model = qt.equations(ship, qt.Wave(121.92, 1.0), SPEED, 60.0)
    verdict = qt.stability(model, qt.steady_motion(model, start="rest"))
    assert verdict.kind == "course-in-calm-water"
    assert cures(ship, qt.Wave(121.92, 1.0), SPEED, 60.0) == []


def test_other_wave_heights_match_the_cubic_drag_anew():
    """Cubic drag through the water has its reference velocity at the motion: each height tried is that of new equations."""
    ship, wave, speed, heading = qt.ship("series60-cb60").with_(drag="cubic"), qt.Wave(180.0, 6.0), 9.0, 60.0
    heights = np.array([0.25, 1.0, 1.3])
    tried = Trials(ship, wave, speed, heading, 3, "stf").exponents({"wave_height": heights}, settled=True)[
        "wave_height"
    ]
    anew = []
    for factor in heights:
        model = qt.equations(ship, qt.Wave(wave.length, wave.height * factor), speed, heading)
        anew.append(qt.stability(model, qt.steady_motion(model, 3, start="rest")).exponents[0].real)
    np.testing.assert_allclose(tried, anew, rtol=1e-6)
    assert abs(tried[0] / tried[1] - 1) > 1e-3  # and the height matters
