"""The table of symbols in docs/conventions.md, made from `quartering.conventions.SYMBOLS`.

Usage: python docs/_extensions/symbols.py   (rewrites the table in the page; the tests compare them)
"""

from __future__ import annotations

from pathlib import Path

from quartering.conventions import SYMBOLS

MARK = "<!-- symbols: written by docs/_extensions/symbols.py from quartering.conventions.SYMBOLS -->\n"


def table() -> str:
    """The table in Markdown."""
    rows = [
        (f"`{name}`", s.symbol.replace("|", "&#124;"), "-" if s.unit == "1" else s.unit, s.meaning)
        for name, s in SYMBOLS.items()
    ]
    head = ["| name | symbol | unit | meaning |", "|---|---|---|---|"]
    return "\n".join([*head, *(f"| {' | '.join(row)} |" for row in rows)]) + "\n"


def renewed(page: str) -> str:
    """The page with the table after the mark replaced; it is the last thing on the page."""
    before, mark, _ = page.partition(MARK)
    return before + mark + table()


if __name__ == "__main__":
    conventions = Path(__file__).parents[1] / "conventions.md"
    conventions.write_text(renewed(conventions.read_text()))
