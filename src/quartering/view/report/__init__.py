"""The report: one self-contained page about a ship and its map, or polar diagrams in the form of operational guidance."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr

    from quartering.hull.ship import Ship


def report_html(ship: Ship, result: xr.Dataset) -> str:
    """The report on a map at hand.

    result: of `polar` or `sweep`, of that ship
    Returns a whole HTML page that needs nothing else
    """
    from quartering.view.report.page import report_page
    from quartering.view.report.source import Source, digest_of

    return report_page(Source(ship, result, "computed for this report", digest_of(ship, result)))
