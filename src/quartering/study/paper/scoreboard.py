"""The scoreboard: every claim of the paper, measured."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import Final, NamedTuple, get_args

from quartering.conventions import RangeWarning
from quartering.study.paper import claim_method as method
from quartering.study.paper import claim_response as response
from quartering.study.paper import claim_stability as stability
from quartering.study.paper.claim import OVER_GROUND, THROUGH_WATER, Answer, Claim, Finding

CLAIMS: Final = (
    Claim(
        "The correction for the ship's presence in the wave force matters",
        "Figs. 2-4",
        response.strip_correction_matters,
    ),
    Claim("That correction is right as printed", "(B-5) to (B-11)", response.printed_correction_is_right),
    Claim("The wave's roll moment is largest near beam seas", "Fig. 3", response.moment_is_largest_in_beam_seas),
    Claim(
        "Roll peaks in quartering seas where the encounter is at the natural frequency of roll",
        "Figs. 5, 8",
        response.peak_at_encounter_resonance,
    ),
    Claim("Roll over heading has a second peak, near beam seas", "Figs. 5, 8", response.two_peaks_over_heading),
    Claim("The worst roll is met in quartering seas", "Figs. 5, 8", response.largest_roll_in_quartering_seas),
    Claim(
        "The approximate solution agrees with direct integration",
        "Fig. 11",
        method.approximation_agrees_with_integration,
    ),
    Claim("The third harmonic is small", "(A-8)", method.third_harmonic_is_small),
    Claim("Uncoupled roll is never unstable", "text on K2", stability.uncoupled_roll_is_never_unstable, moving=False),
    Claim(
        "The modified model of Table I is unstable in quartering seas, the original is not",
        "Table I",
        stability.modified_model_is_unstable_in_quartering_seas,
    ),
    Claim("It is so at a heading of 15 deg", "Figs. 12-13", stability.instability_near_fifteen_degrees),
    Claim("Linear theory does not see the instability", "text", stability.linear_theory_does_not_see_it),
    Claim(
        "Index, variational equations and integration agree on growth or decay",
        "Figs. 12-13",
        stability.three_ways_agree,
    ),
    Claim("The sign of K2 tells stable from unstable", "(13)", stability.k2_tells_stable_from_unstable),
    Claim("I1, I2, I3 with 0.3, 0.1, 0.1 are enough for K2", "I1, I2, I3", stability.short_index_is_enough),
    Claim("The roll mode alone decides stability", "(11)-(13)", stability.roll_alone_decides),
    Claim("K_ppp is the coefficient stability is most sensitive to", "Fig. 22", stability.k_ppp_matters_most),
    Claim("Halving K_ppp makes the motion unstable", "Fig. 22", stability.halving_k_ppp_destabilises),
    Claim("Less GM lowers roll at one heading and raises it at another", "Fig. 20", response.gm_moves_roll_both_ways),
    Claim("Less GM lowers stability", "Fig. 21", stability.less_gm_lowers_stability),
    Claim("The roll gyradius changes roll and stability, the yaw gyradius yaw", "Figs. 14-16", response.gyradii_matter),
    Claim("The same for the Mariner (substitute lines)", "Figs. 17-19", response.gyradii_matter_for_the_mariner),
    Claim(
        "Changes of loading that lower roll lower stability: comfort against safety",
        "conclusion 4",
        stability.response_and_stability_conflict,
    ),
    Claim(
        "The modified method beats Struble's own on Duffing's equation",
        "App. C, Fig. 23",
        method.modified_method_beats_the_plain,
        moving=False,
    ),
    Claim(
        "(C-4) and (C-5) are two approximations of one amplitude", "App. C", method.c5_is_a_rival_of_c4, moving=False
    ),
)
"""Every claim that can be measured, in the order of the paper."""


class Entry(NamedTuple):
    """A claim and what was found of it.

    Parameters
    ----------
    claim : Claim
    over_ground : Finding              with the paper's equations
    through_water : Finding or None    with the library's; None where the claim is of no ship in moving water
    """

    claim: Claim
    over_ground: Finding
    through_water: Finding | None


def scoreboard(progress: Callable[[int, int], None] | None = None) -> list[Entry]:
    """Measure every claim, with the paper's equations and through the water.

    Series 60, CB 0.60, as loaded in the library, Froude number 0.25, waves of the ship's length unless the evidence says
    otherwise; the coefficients are estimates.  Source: [H71], text, figures and conclusions.
    """
    found = []
    with warnings.catch_warnings():  # very steep waves are asked for on purpose
        warnings.simplefilter("ignore", RangeWarning)
        for done, claim in enumerate(CLAIMS, start=1):
            water = claim.measure(THROUGH_WATER) if claim.moving else None
            found.append(Entry(claim, claim.measure(OVER_GROUND), water))
            if progress is not None:
                progress(done, len(CLAIMS))
    return found


def tally(found: Sequence[Entry]) -> str:
    """How many claims hold, either way."""
    water = [entry.through_water for entry in found if entry.through_water is not None]
    return (
        f"{len(found)} claims {OVER_GROUND.words}: {_counts([entry.over_ground for entry in found])}. "
        f"{len(water)} of them {THROUGH_WATER.words}: {_counts(water)}."
    )


def _counts(found: Sequence[Finding]) -> str:
    answers = [finding.answer for finding in found]
    return ", ".join(_counted(answers.count(answer), answer) for answer in get_args(Answer))


def _counted(count: int, answer: str) -> str:
    return f"{count} {answer if count == 1 else answer.replace('does', 'do').replace('holds', 'hold')}"


def scoreboard_page(found: Sequence[Entry]) -> str:
    """The page of the scoreboard, in Markdown."""
    return (
        f"{_HEAD}\n\n{tally(found)}\n\n| claim | where | over ground | evidence | through the water | evidence |\n"
        + "|---|---|---|---|---|---|\n"
        + "\n".join(map(row_of, found))
        + _FOOT
    )


def row_of(entry: Entry) -> str:
    """A claim's row of the page."""
    cells = [entry.claim.text, entry.claim.where, *entry.over_ground, *(entry.through_water or ("", ""))]
    return f"| {' | '.join(cells)} |"


_HEAD = """# Scoreboard: the claims of the paper

Each claim of the 1971 paper, measured on a hull. This page is written by `quartering figures --scoreboard -o
docs/scoreboard.md`, never by hand, and a test computes every line anew. Series 60, CB 0.60, as loaded in the library, Fn 0.25,
waves of the ship's length, unless the line says otherwise. The claims are in our words. The coefficients are
[estimates](what_is_estimated.md) (no set measured on this hull is published), so "does not hold" means: not for these.
S = -K2/(2 n2) is the stability index. Each claim is measured twice. *Over ground*: the paper's own equations (`qt.paper_ship`:
velocities over ground, cubic drag, the fitted righting polynomial, strips without ends). *Through the water*: as the library
takes a ship by default, drag by strips on the velocity through the [moving water](moving_water.md), the hull's own righting
curve, three-dimensional ends; where a claim names or changes a cubic coefficient, the drag in powers of that velocity
(`drag="cubic"`). Two kinds of claims have one answer: those on Duffing's equation, and that on roll with sway and yaw held."""

_FOOT = """

More on single lines: [the two roll peaks](two_roll_peaks.md), [the mechanism](the_mechanism.md),
[the verdicts](do_the_verdicts_agree.md), [the errata](errata.md).
"""
