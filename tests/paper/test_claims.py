"""The scoreboard: the page is what the functions measure now, and each recorded answer stands."""

import re
from pathlib import Path

import pytest

from quartering.study.paper.claim import OVER_GROUND, THROUGH_WATER, Finding
from quartering.study.paper.scoreboard import CLAIMS, Entry, scoreboard_page, tally

PAGE = Path(__file__).parents[2] / "docs" / "scoreboard.md"
NUMBER = re.compile(r"-?\d+\.?\d*")

ANSWERS = {
    "strip_correction_matters": "holds",
    "printed_correction_is_right": "holds in part",
    "moment_is_largest_in_beam_seas": "holds in part",
    "peak_at_encounter_resonance": "holds",
    "two_peaks_over_heading": "holds in part",
    "largest_roll_in_quartering_seas": "holds in part",
    "approximation_agrees_with_integration": "holds",
    "third_harmonic_is_small": "holds",
    "uncoupled_roll_is_never_unstable": "holds in part",
    "modified_model_is_unstable_in_quartering_seas": "holds in part",
    "instability_near_fifteen_degrees": "does not hold",
    "linear_theory_does_not_see_it": "holds",
    "three_ways_agree": "holds",
    "k2_tells_stable_from_unstable": "holds in part",
    "short_index_is_enough": "holds in part",
    "roll_alone_decides": "does not hold",
    "k_ppp_matters_most": "does not hold",
    "halving_k_ppp_destabilises": "does not hold",
    "gm_moves_roll_both_ways": "holds",
    "less_gm_lowers_stability": "holds",
    "gyradii_matter": "holds",
    "gyradii_matter_for_the_mariner": "holds",
    "response_and_stability_conflict": "holds in part",
    "modified_method_beats_the_plain": "holds in part",
    "c5_is_a_rival_of_c4": "holds in part",
}
"""What each claim is recorded as, over ground. A change of physics that moves one of them must say so here."""

THROUGH_WATER_ANSWERS = ANSWERS | {
    "modified_model_is_unstable_in_quartering_seas": "does not hold",
    "k2_tells_stable_from_unstable": "holds",
    "short_index_is_enough": "does not hold",
    "k_ppp_matters_most": "holds in part",
}
"""The same with the library's own equations: four answers are other ones."""


def line_of(text: str) -> str:
    (line,) = [line for line in PAGE.read_text().splitlines() if line.startswith(f"| {text} |")]
    return line


def assert_same_to_printed_digits(found: str, quoted: str) -> None:
    """Equal words; numbers equal but for one in the last digit, which the compiler's rounding may move."""
    assert NUMBER.sub("#", found) == NUMBER.sub("#", quoted)
    for one, other in zip(NUMBER.findall(found), NUMBER.findall(quoted), strict=True):
        digits = len(other.partition(".")[2])
        assert float(one) == pytest.approx(float(other), abs=1.001 * 10.0**-digits if digits else 1e-9)


def cells_of(text):
    """Claim, place, and answer and evidence twice, from the page."""
    return line_of(text).removeprefix("| ").removesuffix(" |").split(" | ")


LONG = {"modified_model_is_unstable_in_quartering_seas", "approximation_agrees_with_integration"}
TWICE = ("k2_tells_stable_from_unstable", "k_ppp_matters_most")
"""Claims that depend on the velocities and are always answered with both; the others with the default ones, both by `soak`."""


def tier(claim, ships):
    name = claim.measure.__name__
    again = ships is OVER_GROUND and claim.moving and name not in TWICE
    return pytest.mark.soak if name in LONG or again else ()


@pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
@pytest.mark.parametrize(
    ("claim", "ships"),
    [
        pytest.param(one, ships, id=f"{one.measure.__name__}-{name}", marks=tier(one, ships))
        for one in CLAIMS
        for name, ships in (("ground", OVER_GROUND), ("water", THROUGH_WATER))
    ],
)
def test_claim_is_answered_as_recorded_and_as_the_page_says(claim, ships):
    cells = cells_of(claim.text)
    assert cells[:2] == [claim.text, claim.where]
    answers, printed = (ANSWERS, cells[2:4]) if ships is OVER_GROUND else (THROUGH_WATER_ANSWERS, cells[4:])
    if ships is THROUGH_WATER and not claim.moving:
        assert printed == ["", ""]
        return
    found = claim.measure(ships)
    assert found.answer == answers[claim.measure.__name__] == printed[0]
    assert_same_to_printed_digits(found.evidence, printed[1])


def test_page_has_every_claim_once_and_counts_them():
    """The page, taken apart, is what the code makes of its own answers and evidence."""
    cells = [cells_of(claim.text) for claim in CLAIMS]
    found = [
        Entry(claim, Finding(*row[2:4]), Finding(*row[4:]) if claim.moving else None)
        for claim, row in zip(CLAIMS, cells, strict=True)
    ]
    assert PAGE.read_text() == scoreboard_page(found)
    assert tally(found) in PAGE.read_text()
    assert {claim.measure.__name__ for claim in CLAIMS} == set(ANSWERS)


def test_a_changed_number_or_word_is_noticed():
    """The comparison itself can fail."""
    for other in ("S falls by 6.6%", "S rises by 6.8%", "S falls by 6.8% or 7%"):
        with pytest.raises((AssertionError, ValueError)):
            assert_same_to_printed_digits("S falls by 6.8%", other)
    assert_same_to_printed_digits("S falls by 6.8%", "S falls by 6.7%")
