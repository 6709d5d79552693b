"""Pictures inside a page: SVG that stands in the HTML itself."""

from __future__ import annotations

import io
import re
import warnings
from contextlib import AbstractContextManager
from pathlib import Path

import matplotlib as mpl
import numpy as np
import xarray as xr
from markupsafe import Markup, escape
from matplotlib.figure import Figure

from quartering.conventions import RangeWarning
from quartering.hull.righting.arm import righting_arm, righting_polynomial
from quartering.hull.ship import Ship
from quartering.study.maps.query import sea_of
from quartering.view.plots import style
from quartering.view.plots.hull import hull_picture
from quartering.view.plots.polar_map import polar_map
from quartering.view.plots.response import response_picture
from quartering.view.stored import map_of
from quartering.view.wording import sea_words

_FEWEST_RINGS, _MOST_HEIGHTS, _MOST_PAIRED = 3, 4, 4


def pictures_for(page: Path) -> AbstractContextManager[None]:
    """While the body runs, pictures as a page of this ending takes them.

    In PDF letters stay letters, which a reader can search; WeasyPrint would draw each outline as a picture of its own, half the
    time of a page. In HTML they are outlines, since a browser may have another font.
    """
    return mpl.rc_context({"svg.fonttype": "none" if page.suffix.lower() == ".pdf" else "path"})


def inline_svg(figure: Figure, words: str) -> Markup:
    """A figure as SVG to stand in HTML, with words for those who cannot see it."""
    page = io.StringIO()
    with mpl.rc_context({"svg.hashsalt": words, "savefig.dpi": 130}):  # names in one picture must not meet another's
        style.lay_out(figure)
        figure.savefig(page, format="svg", metadata={"Date": None})
    text = page.getvalue()
    text = re.sub(r"<metadata>.*?</metadata>", "", text[text.index("<svg") :], flags=re.DOTALL)
    prefix = re.sub(r"\W", "", words)[:24] + f"{len(words)}-"
    text = re.sub(r'\b(id="|href="#|url\(#)', rf"\g<1>{prefix}", text)
    return Markup(text.replace("<svg", f'<svg role="img" aria-label="{escape(words)}"', 1))


def hull_svg(ship: Ship) -> Markup:
    """Body plan and righting arm."""
    angles = np.linspace(0.0, 60.0, 61)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)  # the picture shows where the deck goes under
        arms = righting_arm(ship, angles)
    return inline_svg(
        hull_picture(ship, angles, arms, righting_polynomial(ship), style.PAGE), f"Body plan and GZ of {ship.name}"
    )


def map_svgs(result: xr.Dataset) -> list[Markup]:
    """Maps of a result: one, or one for each of up to four wave heights or steepnesses."""
    sea = sea_of(result)
    count = result.sizes[sea] if sea else 1
    made = []
    for i in sorted({int(i) for i in np.linspace(0, count - 1, _MOST_HEIGHTS)}):
        flat = map_of(result.isel({sea: i}) if sea else result)
        words = "Map of roll and stability" + (f", {sea_words(sea, float(result[sea][i]))}" if sea else "")
        several = flat.sizes["wave_length"] >= _FEWEST_RINGS
        made.append(inline_svg(_map(flat) if several else response_picture(flat, columns=2), words))
    return made


def _map(flat: xr.Dataset) -> Figure:
    """The polar map of a page: two panels beside each other, three where there are many."""
    return polar_map(flat, 2 if flat.sizes["speed"] <= _MOST_PAIRED else 3, style.PAGE)
