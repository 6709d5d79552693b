"""Which function implements which equation of the paper, read from the `Source:` lines of the docstrings."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

_SOURCE = re.compile(r"Source:(.*?)(?:Valid:|Examples\n|\n\n|\Z)", re.DOTALL)
_PAPER = re.compile(r"\[H71\]([^\[]*)")
_RANGE = re.compile(r"\(([ABC]?)-?(\d+)\)(?:-\(([ABC]?)-?(\d+)\))?")
_APPENDIX = re.compile(r"Appendix ([ABC])")
_FIGURES = re.compile(r"Figs?\.((?:\s|,|-|and|\d)+)")

HEAD = """Paper and code
==============

Which function rests on which place of the paper. Made from the `Source:` lines of the docstrings when these pages are
built; the tests see to it that every equation of the theory pages is found here, and the other way round. Where a
printed equation needed :doc:`a correction </errata>`, the corrected one is implemented.

.. list-table::
   :header-rows: 1
   :widths: 12 30 58

   * - place
     - section
     - code"""


class Claim(NamedTuple):
    """A docstring that names a place of the paper."""

    module: str
    name: str
    """Empty for the module itself."""

    place: str
    """`4`, `A-10`, `Fig. 22`, `Appendix A` or `list of symbols`."""


def claims(package: Path) -> list[Claim]:
    """Every place of the paper that a docstring of the package names as its source.

    Parameters
    ----------
    package : Path    folder of the sources of `quartering`

    Returns
    -------
    list of Claim     in the order of the files; compiled functions and private ones included
    """
    found = []
    for path in sorted(package.rglob("*.py")):
        module = ".".join(path.relative_to(package.parent).with_suffix("").parts).removesuffix(".__init__")
        for name, text in _docstrings(ast.parse(path.read_text())):
            found += [Claim(module, name, place) for place in places(text)]
    return found


def _docstrings(tree: ast.Module) -> Iterator[tuple[str, str]]:
    yield "", ast.get_docstring(tree) or ""
    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name, ast.get_docstring(node) or ""
        if isinstance(node, ast.ClassDef):
            for part in node.body:
                if isinstance(part, ast.FunctionDef):
                    yield f"{node.name}.{part.name}", ast.get_docstring(part) or ""


def places(docstring: str) -> list[str]:
    """Places of the paper in the `Source:` lines of a docstring.

    Examples
    --------
    >>> places("Mean.  Source: [H71] eqs. (A-10), (A-11) (one harmonic), [Krack19] eq. (3).  Valid: [H71] eq. (7).")
    ['A-10', 'A-11']
    >>> places("Source: [H71] eqs. (13)-(15), Fig. 22; [STF70].")
    ['13', '14', '15', 'Fig. 22']
    """
    found: dict[str, None] = {}
    for source in _SOURCE.findall(docstring):
        for part in _PAPER.findall(source):
            for letter, first, _, last in _RANGE.findall(part):
                for number in range(int(first), int(last or first) + 1):
                    found[f"{letter}-{number}" if letter else str(number)] = None
            found |= {f"Appendix {letter}": None for letter in _APPENDIX.findall(part)}
            found |= {f"Fig. {number}": None for run in _FIGURES.findall(part) for number in _numbers(run)}
            if "list of symbols" in part:
                found["list of symbols"] = None
    return list(found)


def _numbers(run: str) -> list[int]:
    """Numbers of "5-10, 20".

    Examples
    --------
    >>> _numbers(" 5-7, 20")
    [5, 6, 7, 20]
    """
    made: list[int] = []
    for first, last in re.findall(r"(\d+)(?:-(\d+))?", run):
        made += range(int(first), int(last or first) + 1)
    return made


def order(place: str) -> tuple[int, int]:
    """Key that sorts places as they stand in the paper.

    Examples
    --------
    >>> sorted(["A-10", "Fig. 2", "3", "A-4", "Appendix A", "list of symbols"], key=order)
    ['list of symbols', '3', 'Appendix A', 'A-4', 'A-10', 'Fig. 2']
    """
    number = int(next(iter(re.findall(r"\d+", place)), 0))
    kinds = ("list", "", "A", "B", "C", "Fig")
    head = place.split()[-1] if place.startswith("Appendix") else re.split(r"[-. ]|\d", place)[0]
    return kinds.index(head), number


def page(package: Path, meanings: dict[str, str]) -> str:
    """The page of the map.

    Parameters
    ----------
    package : Path
    meanings : dict    of the equations that the theory pages print: number -> title of the section it stands in

    Returns
    -------
    str    reStructuredText
    """
    table: dict[str, list[str]] = {}
    for claim in claims(package):
        table.setdefault(claim.place, []).append(f"{claim.module}.{claim.name}".rstrip("."))
    lines = [HEAD]
    for place in sorted(table, key=order):
        where = f":ref:`({place}) <eq-{place.lower()}>`" if place in meanings else place
        code = ", ".join(f":py:obj:`~{name}`" if "._" not in name else f"``{name}``" for name in table[place])
        lines += [f"   * - {where}", f"     - {meanings.get(place, '')}", f"     - {code}"]
    return "\n".join(lines) + "\n"
