"""Operational guidance to print: one A4 page for each loading, three forms beside each other, limits with their source."""

from __future__ import annotations

from datetime import date
from html import escape

import xarray as xr

from quartering.study.criteria.operational import ADVICE, FORMS
from quartering.study.seas.over_seas.map_axes import period_of
from quartering.view.plots.operational import operational_picture
from quartering.view.report.pictures import inline_svg

_STYLE = """
@page { size: A4; margin: 12mm }
body { font: 8.5pt/1.3 sans-serif; color: #1a1a1a; max-width: 186mm; margin: 0 auto }
section { break-after: page } section:last-child { break-after: auto }
h1 { font-size: 13pt; margin: 0 0 2mm } p { margin: 0 0 1.5mm } figure { margin: 0 } svg { width: 100%; height: auto }
table { border-collapse: collapse; width: 100% } td, th { border-bottom: 1px solid #ccc; padding: 0.6mm 1mm; text-align: left }
td.n { text-align: right } td { vertical-align: top } td:first-child { white-space: nowrap } .quiet { color: #555 }
"""


def operational_page(ds: xr.Dataset) -> str:
    """Guidance of every loading as one HTML document, an A4 page each; nothing is fetched."""
    pages = "".join(_page(ds, i) for i in range(ds.sizes["loading"]))
    title = escape(f"{ds.attrs.get('ship', '')}: operational guidance")
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>{_STYLE}</style></head>'
        f"<body>{pages}</body></html>\n"
    )


def _page(ds: xr.Dataset, loading: int) -> str:
    part = ds.isel(loading=loading)
    picture = inline_svg(operational_picture(ds, loading), "Operational guidance, three forms")
    names = f", loading {part['loading'].item()}" if "loading" in ds.coords else ""
    about = "; ".join(str(ds.attrs[key]) for key in ("loading", "sea") if key in ds.attrs)
    rules = "".join(f"<tr><th>{form}</th><td>{escape(str(ds.attrs[f'rule_{form}']))}</td></tr>" for form in FORMS)
    hours = (
        f" Up to {ds.attrs['hours']} h simulated a condition, seed {ds.attrs['seed']}." if "seed" in ds.attrs else ""
    )
    return (
        f"<section><h1>{escape(str(ds.attrs.get('ship', '')))}{escape(names)}: operational guidance</h1>"
        f'<p class="quiet">{escape(about)}. Made {date.today().isoformat()} by quartering.{escape(hours)}</p>'
        "<p><b>Prepared in the form of MSC.1/Circ.1627, whose numbers are recalled and unverified; not accepted by any "
        "administration, and no compliance is shown.</b> Undecided: the interval of what is known straddles the limit; "
        "no advice is given there.</p>"
        f"<figure>{picture}</figure><table>{rules}</table>{_shares(part)}</section>"
    )


def _shares(part: xr.Dataset) -> str:
    """Share of the speeds and headings of each sea with each advice, by form."""
    heads = "".join(f"<th>{form}: {'; '.join(ADVICE[1:3])}</th>" for form in FORMS)
    rows = []
    for i in range(part.sizes["hs"]):
        for j in range(part.sizes[period_of(part)]):
            one = part.isel({"hs": i, period_of(part): j})
            cells = "".join(
                f'<td class="n">{100 * float((one[form] == 1).mean()):.0f} %; {100 * float((one[form] == 2).mean()):.0f} %</td>'
                for form in FORMS
            )
            rows.append(f"<tr><td>Hs {float(one['hs']):.3g} m, Tz {float(one['tz']):.3g} s</td>{cells}</tr>")
    kept = rows if len(rows) <= _MOST_ROWS else rows[:_MOST_ROWS]
    more = "" if len(kept) == len(rows) else f"<p>{len(rows) - len(kept)} further seas stand in the CSV.</p>"
    return f"<table><tr><th>sea</th>{heads}</tr>{''.join(kept)}</table>{more}"


_MOST_ROWS = 9
"""Seas in the table of a page."""
