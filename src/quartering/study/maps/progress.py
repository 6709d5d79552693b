"""Progress of a run: rate, time left, findings, conditions without an answer."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from quartering.motion.status import OnTheWay, Status
from quartering.stability.kind import Kind
from quartering.study.maps.estimate import duration
from quartering.study.seas.over_seas.advice import Advice


class Failures(NamedTuple):
    """Conditions without an answer for one reason."""

    status: Status
    conditions: int
    advice: str


def outcome(counts: Mapping[str, int]) -> tuple[int, int, int]:
    """Numbers of stable, unstable and failed conditions.

    counts: as from `fill`
    """
    verdicts = {int(key[8:]): n for key, n in counts.items() if key.startswith("verdict ")}
    stable, failed = verdicts.get(Kind.STABLE, 0), verdicts.get(Kind.NO_ANSWER, 0)
    return stable, sum(verdicts.values()) - stable - failed, failed


def failures(counts: Mapping[str, int]) -> tuple[Failures, ...]:
    """Conditions without an answer by reason, the most frequent first, each with what to try.

    counts: as from `fill`
    """
    found = [(Status(int(key[7:])), n) for key, n in counts.items() if key.startswith("status ")]
    failed = sorted(((status, n) for status, n in found if not status.ok), key=lambda pair: -pair[1])
    return tuple(Failures(status, n, status.advice) for status, n in failed)


def progress_line(done: int, total: int, begun: int, seconds: float, counts: Mapping[str, int]) -> str:
    """One line that says how far a run has come.

    done, total: conditions
    begun: conditions that were there when the run began
    seconds: since then
    counts: as from `fill`
    """
    rate = (done - begun) / seconds if seconds > 0 else 0.0
    left = f", {duration((total - done) / rate)} left" if rate > 0 and done < total else ""
    return f"{done:,} of {total:,} ({100 * done / max(total, 1):.0f} %), {rate:,.0f} a second{left}: {_so_far(counts)}"


def _so_far(counts: Mapping[str, int]) -> str:
    """What was found so far: verdicts in regular waves, advice in irregular seas."""
    if any(key.startswith("recommended ") for key in counts):
        return ", ".join(f"{number:,} {words}" for words, number in advice_counted(counts).items())
    stable, unstable, failed = outcome(counts)
    return f"{stable:,} stable, {unstable:,} unstable, {failed:,} failed"


def advice_counted(counts: Mapping[str, int]) -> dict[str, int]:
    """Numbers of conditions in irregular seas by what guidance says.

    >>> advice_counted({"recommended 0": 5, "recommended 2": 1, "status 0": 6})
    {'recommended': 5, 'not recommended': 0, 'undecided': 1, 'not valid': 0}
    """
    return {one.label: counts.get(f"recommended {int(one)}", 0) for one in Advice}


def summary(counts: Mapping[str, int], seconds: float) -> dict[str, Any]:
    """What a run found, in types JSON knows.

    counts: as from `fill`
    seconds: it took
    Returns conditions, stable, unstable, failed, by_verdict, failures (status, count, advice), capsize_on_the_way,
        more_harmonics, seconds
    """
    stable, unstable, failed = outcome(counts)
    kinds = sorted((int(key[8:]), n) for key, n in counts.items() if key.startswith("verdict "))
    return {
        "conditions": stable + unstable + failed,
        "stable": stable,
        "unstable": unstable,
        "failed": failed,
        "by_verdict": {Kind(kind).label: n for kind, n in kinds},
        "failures": [
            {"status": f.status.name.lower(), "count": f.conditions, "advice": f.advice} for f in failures(counts)
        ],
        "capsize_on_the_way": sum(counts.get(f"capsizes_on_the_way {int(way)}", 0) for way in OnTheWay if way.capsizes),
        "more_harmonics": counts.get("more harmonics", 0),
        "beyond_fitted_righting_arm": counts.get("beyond", 0),
        "seconds": seconds,
    }
