"""What notebooks show of a ship, equations, a motion and a verdict: a picture or a table."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from html import escape
from typing import Any, Final

import numpy as np

from quartering.conventions import MODES
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.ship import Ship
from quartering.motion.equations.model import Model
from quartering.motion.steady.motion import Motion
from quartering.names import unit
from quartering.stability.verdict import Verdict
from quartering.view.wording import exponents_words

_MOST_TERMS: Final = 60


def page_of(record: Any) -> str:
    """HTML of a record: its line, and below it a body plan or a table.

    >>> from quartering.hull.file.read import ship
    >>> page = page_of(ship("wigley"))
    >>> "<svg" in page, "GM [m]" in page
    (True, True)
    """
    return next(page(record) for kind, page in _PAGES.items() if isinstance(record, kind))


def _ship(ship: Ship) -> str:
    from quartering.view.report.pictures import hull_svg

    hull, loading, water = ship.hull, ship.loading, hydrostatics(ship)
    rows = [
        ("length [m]", f"{hull.length:.5g}"), ("beam [m]", f"{hull.beam:.4g}"), ("draught [m]", f"{hull.draught:.4g}"),
        ("volume [m3]", f"{water.volume:.5g}"), ("KG [m]", f"{loading.kg:.4g}"), ("GM [m]", f"{loading.gm:.4g}"),
        ("k_xx [m]", f"{loading.gyradius_roll:.4g}"), ("added roll damping", ship.roll_damping_words),
    ]  # fmt: skip
    return f"<p><b>{escape(ship.name)}</b></p>{_table(('', ''), rows)}{hull_svg(ship)}"


def _model(model: Model) -> str:
    terms = sorted(model.terms.items(), key=lambda term: ("YKN".find(term[0][0]), term[0]))
    rows: list[tuple[str, ...]] = [(name, f"{value:.4g}", unit(name)) for name, value in terms if value]
    if len(rows) > _MOST_TERMS:
        rows = [*rows[:_MOST_TERMS], (f"and {len(rows) - _MOST_TERMS} more", "", "")]
    return f"<p>{escape(repr(model))}</p>{_table(('term', 'value', 'SI unit'), rows)}"


def _motion(motion: Motion) -> str:
    scale = np.array([1.0, math.degrees(1.0), math.degrees(1.0)])
    size = np.hypot(motion.cos, motion.sin) * scale
    units = [f"{name} [{'m' if name == 'sway' else 'deg'}]" for name in MODES]
    rows = [(str(h), *(f"{value:.4g}" for value in row)) for h, row in zip(motion.orders, size, strict=True)]
    return f"<p>{escape(repr(motion))}</p>{_table(('harmonic', *units), rows)}"


def _verdict(verdict: Verdict) -> str:
    rows = [
        ("Floquet exponents [1/s]", exponents_words(verdict.exponents), "decide: all below 0 is stable"),
        ("K2 [1/s2]", f"{verdict.k2:.3g}", "below 0 is stable"),
        ("S = -K2/(2 n2) [1/s]", f"{verdict.index:.3g}", "above 0 is stable"),
    ]
    return f"<p>{escape(verdict.sentence)}</p>{_table(('quantity', 'value', 'remark'), rows)}"


_PAGES: Final[dict[type, Callable[[Any], str]]] = {Ship: _ship, Model: _model, Motion: _motion, Verdict: _verdict}


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    lines = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    top = "".join(f"<th>{escape(name)}</th>" for name in head)
    return f"<table><thead><tr>{top}</tr></thead><tbody>{lines}</tbody></table>"
