"""Claims of the paper about stability, measured."""

from __future__ import annotations

import numpy as np

from quartering.motion.equations.model import Model
from quartering.motion.of_ship import equations
from quartering.motion.steady.motion import Motion, steady_motion
from quartering.motion.transient.simulate import simulate
from quartering.names import CUBIC_NAMES
from quartering.stability.kind import Kind
from quartering.stability.verdict import stability
from quartering.study.branches.coexisting import all_motions
from quartering.study.effects.sensitivity import sensitivity
from quartering.study.maps.sweep import sweep
from quartering.study.paper.claim import (
    HEADINGS,
    MODERATE,
    STEEP,
    VERY_STEEP,
    Finding,
    Ships,
    graded,
    over_headings,
)
from quartering.study.paper.conditions import speed_of, wave_of
from quartering.study.paper.duffing_formulas import duffing_model
from quartering.study.paper.mechanism import Onset, onset, roll_alone
from quartering.study.paper.model import modified_model, table_ratios

FED = -60.0
"""Factor on K_prr that makes yaw feed roll: an invented value, for a motion that is surely unstable."""


def uncoupled_roll_is_never_unstable(ships: Ships) -> Finding:
    """Roll alone; and the middle motion of three where it folds."""
    one = ships.cubic()
    rates = [
        float(roll_alone(one, wave_of(one, 1.0, 1 / s), speed_of(one), HEADINGS)["exponent"].max())
        for s in (MODERATE, STEEP, VERY_STEEP)
    ]
    model = duffing_model(-0.25, 0.02, 0.9, 0.02)
    motions = [motion for motion in all_motions(model, 5) if motion.periods == 1 and motion.orders[0] == 1]
    judged = [stability(model, motion) for motion in motions]
    folds = [v for v in judged if v.kind == "fold"]
    words = (
        f"largest growth rate over all headings {max(rates):+.4f} 1/s at H/lambda up to 1/{VERY_STEEP}; but {len(folds)} of "
        f"the {len(judged)} motions found of a softening roll equation near resonance are unstable, at a fold"
    )
    return graded(max(rates) < 0 and not folds, max(rates) < 0, words)


def modified_model_is_unstable_in_quartering_seas(ships: Ships) -> Finding:
    """Table I as ratios: is a motion at 10 to 77.5 deg unstable?"""
    one, strengths, headings = ships.cubic(), [], []
    original = [float(over_headings(one, s)["exponent"].max()) for s in (MODERATE, STEEP, VERY_STEEP)]
    for s in (MODERATE, STEEP, VERY_STEEP):
        found = onset(one, table_ratios(), wave_of(one, 1.0, 1 / s), speed_of(one), np.arange(10.0, 80.0, 2.5))
        strengths.append(found.strength)
        headings.append(found.heading)
    times = ", ".join(
        f"{strength:.2f} times at 1/{s}" if np.isfinite(strength) else f"more than 10 times at 1/{s}"
        for strength, s in zip(strengths, (MODERATE, STEEP, VERY_STEEP), strict=True)
    )
    words = (
        f"the change must be made {times} (H/lambda), at {np.nanmin(headings):.0f} deg or more; the original is stable, "
        f"{max(original):+.4f} 1/s"
    )
    enough = [strength <= 1 for strength in strengths]
    return graded(all(enough) and max(original) < 0, any(enough), words)


def instability_near_fifteen_degrees(ships: Ships) -> Finding:
    """Figs. 12-13: the modified model at 15 deg."""
    one = ships.cubic()
    table = onset(one, table_ratios(), wave_of(one, 1.0, 1 / STEEP), speed_of(one), [15.0], most=40.0)
    fed = onset(one, {"K_prr": 0.0}, wave_of(one, 1.0, 1 / STEEP), speed_of(one), [15.0], most=200.0)
    words = f"{_taken(table)}; " + (
        f"K_prr alone must be turned round and {fed.strength - 1:.0f} times as large (kind: {fed.kind})"
        if np.isfinite(fed.strength)
        else "K_prr alone, turned round and up to 199 times as large, makes nothing unstable"
    )
    return graded(table.strength <= 1 and table.kind == "roll", False, words)


def _taken(table: Onset) -> str:
    if not np.isfinite(table.strength):
        return "Table I, taken up to 40 times, makes nothing unstable"
    mode = "loses its course, not roll" if table.kind != "roll" else "is unstable in roll"
    return f"Table I must be taken {table.strength:.0f} times and then the ship {mode}"


def linear_theory_does_not_see_it(ships: Ships) -> Finding:
    """Motions unstable by Floquet whose linear motion dies out."""
    unseen = total = 0
    worst = -np.inf
    for one in (ships.cubic().with_(factors={"K_prr": FED}), modified_model(ships.cubic())):
        ds = over_headings(one, VERY_STEEP)
        unstable = ds["verdict"].values > Kind.STABLE
        total += int(unstable.sum())
        unseen += int((unstable & (ds["calm_exponent"].values < 0)).sum())
        worst = max(worst, float(ds["calm_exponent"].max()))
    words = f"{unseen} of {total} unstable motions have a stable linear motion (largest linear rate {worst:+.4f} 1/s)"
    return graded(unseen == total > 0, unseen > 0, words)


def three_ways_agree(ships: Ships) -> Finding:
    """Figs. 12-13: index, variational equations and integration of the full equations, in a stable and an unstable case."""
    words, worst, signs = [], 0.0, True
    for factor in (1.0, FED):
        one = ships.cubic().with_(factors={"K_prr": factor})
        model = equations(one, wave_of(one, 1.0, 1 / STEEP), speed_of(one), 30.0)
        motion = steady_motion(model, 9, start="rest")
        verdict = stability(model, motion)
        pair = float(verdict.exponents[np.abs(verdict.exponents.imag) > 1e-6][0].real)
        rates = [-verdict.index, pair, _growth(model, motion)]
        worst = max(worst, max(abs(rate / pair - 1) for rate in rates))
        signs = signs and len({rate > 0 for rate in rates}) == 1
        words.append(f"K_prr x {factor:g}: {', '.join(f'{rate:+.4f}' for rate in rates)} 1/s")
    evidence = f"K2/(2 n2), Floquet, integration: {'; '.join(words)}; apart by {worst:.1%} at most"
    return graded(signs and worst < 0.05, signs, evidence)


def _growth(model: Model, motion: Motion) -> float:
    """Growth rate of a small disturbance of roll in the full equations, by two integrations [1/s]."""
    period, start = 2 * np.pi / model.frequency, motion.state(0.0)
    states = []
    for state0 in (start, start + 1e-5 * np.array([0.0, 1.0, 0.0, 0.0])):
        trace = simulate(model, 12 * period, state0.tolist(), step=period / 50, tolerance=1e-12)
        states.append(np.radians([trace["roll"].values, trace["roll_rate"].values]))
    angle, rate = states[1] - states[0]
    n2 = np.sqrt(-model.terms["K_phi"] / model.inertia[1, 1])
    times = np.arange(angle.size) * period / 50
    late = times > times[-1] / 3
    return float(np.polyfit(times[late], np.log(np.hypot(angle[late], rate[late] / n2)), 1)[0])


def k2_tells_stable_from_unstable(ships: Ships) -> Finding:
    """Its sign against Floquet multipliers, over headings, wave lengths and models between the original and an unstable one."""
    one = ships.cubic()
    unstable = seen = false = total = 0
    for changed in (
        one,
        one.with_(factors={"K_prr": FED / 2}),
        one.with_(factors={"K_prr": FED}),
        modified_model(ships.cubic()),
    ):
        for s in (MODERATE, STEEP):
            for ratio in (0.75, 1.0, 1.5):
                ds = over_headings(changed, s, ratio)
                answered = ds["verdict"].values >= Kind.STABLE
                floquet, k2 = ds["verdict"].values > Kind.STABLE, ds["k2"].values > 0
                total += int(answered.sum())
                unstable += int(floquet.sum())
                seen += int((floquet & k2).sum())
                false += int((k2 & ~floquet & answered).sum())
    words = (
        f"of {total} motions {unstable} are unstable by Floquet; K2 > 0 in {seen} of these, and in {false} stable ones"
    )
    return graded(seen == unstable and false == 0, seen > unstable / 2, words)


def roll_alone_decides(ships: Ships) -> Finding:
    """Stability is read from the roll mode; the measured S-175 shows the other two."""
    one = ships.one("s175").with_(measured="son-nomoto-1982", draught=8.5, gm=0.3)
    length = one.hull.length
    ds = sweep(one, [speed_of(one, 0.2), speed_of(one)], HEADINGS, [0.75 * length, length], length / 50, harmonics=3)
    course = ds["verdict"].values == Kind.COURSE
    quiet = course & (ds["k2"].values < 0)
    words = (
        f"measured S-175: {int(course.sum())} of {course.size} motions lose their course because of the wave, "
        f"with K2 < 0 in {int(quiet.sum())} of them"
    )
    return graded(not course.any(), not quiet.any(), words)


def short_index_is_enough(ships: Ships) -> Finding:
    """K2 from I1, I2, I3 with the printed 0.3, 0.1, 0.1 against K2 with every average."""
    models = {
        "as estimated": ships.one(),
        f"K_prr x {FED:g}": ships.cubic().with_(factors={"K_prr": FED}),
        "Table I": modified_model(ships.cubic()),
    }
    words, worst, best, signs = [], 0.0, np.inf, True
    for label, one in models.items():
        ds = over_headings(one, STEEP)
        ok = np.isfinite(ds["k2"].values)
        full, short, own = (ds[name].values[ok] for name in ("k2", "k2_paper", "k2_rho"))
        part, part_own = (float(np.abs(k2 - full).max() / np.abs(full).max()) for k2 in (short, own))
        worst, best = max(worst, part), min(best, part)
        signs = signs and bool((np.sign(short) == np.sign(full)).all())
        words.append(f"{label}: {part:.0%} (with this ship's rho {part_own:.0%})")
    right = "its sign is right everywhere" if signs else "at some headings its sign is wrong"
    evidence = f"largest error over the headings, of the largest K2: {'; '.join(words)}; {right}"
    return graded(worst < 0.1, best < 0.1, evidence)


def k_ppp_matters_most(ships: Ships) -> Finding:
    """Fig. 22: K2 against the percentage change of each coefficient."""
    one, words, ranks = ships.cubic(), [], []
    for heading in (30.0, 60.0):
        ds = sensitivity(one, wave_of(one, 1.0, 1 / STEEP), speed_of(one), heading)
        effect = {str(name): abs(float(ds["k2"].sel(parameter=name))) for name in ds["parameter"].values}
        cubics = sorted((name for row in CUBIC_NAMES for name in row if name in effect), key=lambda name: -effect[name])
        ranks.append(cubics.index("K_ppp") + 1)
        own, largest = effect["K_ppp"], effect[cubics[0]]
        words.append(
            f"{heading:g} deg: number {ranks[-1]} of {len(cubics)} cubics, {own / largest:.0%} of {cubics[0]}, "
            f"{own / effect['K_p']:.1%} of K_p"
        )
    return graded(max(ranks) == 1, min(ranks) == 1, "; ".join(words))


def halving_k_ppp_destabilises(ships: Ships) -> Finding:
    """Fig. 22 and the text on it."""
    one = ships.cubic()
    half = one.with_(factors={"K_ppp": 0.5})
    rate, change = -np.inf, 0.0
    for s in (MODERATE, STEEP, VERY_STEEP):
        before, after = over_headings(one, s), over_headings(half, s)
        rate = max(rate, float(after["exponent"].max()))
        change = min(change, float((after["index"] / before["index"] - 1).min()))
    words = (
        f"no motion becomes unstable (largest rate {rate:+.4f} 1/s, H/lambda up to 1/{VERY_STEEP}); S falls by {-change:.1%} "
        "at most"
    )
    return graded(rate > 0, change < -0.1, words)


def response_and_stability_conflict(ships: Ships) -> Finding:
    """Conclusion 4: changes of GM and gyradius that lower roll lower stability as well."""
    one, words, shares = ships.one(), [], []
    before = over_headings(one, MODERATE)
    for name, symbol in (("gm", "GM"), ("gyradius_roll", "k_xx"), ("gyradius_yaw", "k_zz")):
        lower = conflict = 0
        for factor in (0.9, 1.1):
            after = over_headings(one.with_(**{name: factor * getattr(one.loading, name)}), MODERATE)
            less_roll = (after["roll"] < before["roll"]).values
            lower += int(less_roll.sum())
            conflict += int((less_roll & (after["index"] < before["index"]).values).sum())
        shares.append(conflict / lower)
        words.append(f"{symbol} {conflict} of {lower}")
    return graded(
        min(shares) > 0.9,
        max(shares) > 0.25,
        "changes of 10 % that lower roll at a heading and lower S there too: " + ", ".join(words),
    )


def less_gm_lowers_stability(ships: Ships) -> Finding:
    """Fig. 21."""
    one = ships.one()
    before, after = (
        over_headings(ship, MODERATE)["index"].values for ship in (one, one.with_(gm=0.9 * one.loading.gm))
    )
    change = after / before - 1
    words = (
        f"10 % less GM: S changes by {change.min():+.1%} to {change.max():+.1%} over the headings, falling at "
        f"{int((change < 0).sum())} of {change.size}"
    )
    return graded(bool((change < 0).all()), bool((change < 0).mean() > 0.5), words)
