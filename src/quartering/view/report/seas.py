"""A report on maps over irregular seas: advice in each sea, diagrams, and what it rests on."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from quartering._machine.digest import fingerprint
from quartering.references import cite
from quartering.study.seas.over_seas.advice import Advice
from quartering.study.seas.over_seas.map_axes import period_of
from quartering.study.seas.response import SeaStatus
from quartering.view.plots.sea_polar import limit_words, sea_polar
from quartering.view.report.page import filled
from quartering.view.report.pictures import inline_svg
from quartering.view.report.source import axes_of
from quartering.view.report.tables import Row, Table
from quartering.view.wording import estimated_words, estimates_of

_WHY: Final = {
    SeaStatus.BREAKS: "are of seas that break: not computed",
    SeaStatus.SURF_RIDING: "have over 20 % of the energy near encounter frequency 0: not valid",
    SeaStatus.UNSTABLE: "have a motion that grows about its mean",
    SeaStatus.NOT_CONVERGED: "have no Gaussian motion",
    SeaStatus.PAST_CAPSIZE_LIMIT: "roll past the capsize limit in three hours, where no Gaussian method is sound",
}


def seas_page(result: xr.Dataset, origin: str) -> str:
    """The report on guidance as HTML, pictures inside it.

    origin: file or folder the result stands in
    """
    about = {
        "steady_motion": "statistical linearisation",
        "axes": "body axes: x to the bow, y to starboard, z down, origin at G",
        **result.attrs,
    }
    line, half = result["pile_up"].values
    words = f"{about['threshold_words']} ({about['threshold_source']}); {limit_words(result)}."
    return filled(
        "seas.html",
        title=f"{about['ship']}: operational guidance in irregular seas",
        attributes=about,
        estimated=estimated_words(estimates_of(about), _provenance(str(about["provenance"]))),
        warnings=_warnings(result),
        origin=origin,
        digest=fingerprint(
            [axes_of(result), about["loading"], about["sea"], about["judge"], float(about["threshold"])]
        ),
        axes=[
            f"{name} {_span(result[name].values)} [{result[name].attrs['units']}]"
            for name in ("speed", "heading", "hs", period_of(result))
        ],
        case=axes_of(result),
        citation=cite(result).splitlines(),
        judged=words[0].upper() + words[1:],
        several=result.sizes["loading"] if result.sizes["loading"] > 1 else 0,
        summary=_summary(result),
        danger=f"speed times cosine of the heading {line:.3g} and {half:.3g} m/s",
        diagrams=inline_svg(sea_polar(result), f"Polar diagrams of {about['ship']} in irregular seas"),
    )


def _provenance(text: str) -> dict[str, str]:
    """Where a ship's values come from, by name, out of an attribute."""
    return dict(part.split(": ", 1) for part in text.split("; ") if ": " in part)


def _span(values: np.ndarray) -> str:
    few = values.size == 1
    return f"{values.min():.4g}" if few else f"{values.min():.4g} to {values.max():.4g}, {values.size} values"


def _summary(result: xr.Dataset) -> Table:
    rows = []
    for i in range(result.sizes["hs"]):
        for j in range(result.sizes[period_of(result)]):
            one = result.isel({"hs": i, period_of(result): j})
            roll, rate = one["roll_mean_3h_max"].values, one["rate_upper"].values
            known = np.isfinite(roll).any()
            counts = (str(int((one["recommended"] == int(kind)).sum())) for kind in Advice)
            cells = (f"{float(one['hs']):.3g}", f"{float(one['tp']):.3g}", f"{np.nanmax(roll):.3g}" if known else "-",
                     f"{np.nanmax(rate):.2g}" if known else "-", *counts)  # fmt: skip
            rows.append(Row(cells))
    heads = ("Hs [m]", "Tp [s]", "largest roll of 3 h, mean, at worst [deg]", "failures, at most [1/s]")
    return Table((*heads, *(kind.label for kind in Advice)), rows, tuple(range(8)))


def _warnings(result: xr.Dataset) -> list[str]:
    status, size = result["status"].values, result["status"].size
    counts = {kind: int((status == int(kind)).sum()) for kind in _WHY}
    return [f"{number} of {size} conditions {_WHY[kind]}." for kind, number in counts.items() if number]
