"""Read this project's docstrings: `name : type    meaning` on one line, short lists of internal functions, plain formulas."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

_FIELD = type(NamedTuple("_Any", [("field", int)]).field)
"""A field of a named tuple: its class lists it among the parameters, and Python's own words for it say nothing."""

_SECTIONS = ("Parameters", "Returns", "Raises", "Yields", "Attributes")
_ENTRY = re.compile(r"(Returns|Yields) |\*{0,2}[a-z_][\w*, ]*( \([^()]*\))?(: \S|$)")
"""A line such as `speed (n,): U [m/s]` of an internal function; its first letter is small, that of a sentence is not."""

_LITERAL = re.compile(r"(``.*?``|`[^`]+`|:\w+:`[^`]+`)")
_MARKUP = re.compile(r"([|*])|(?<=\w)_(?=[\s,.;:)\]]|$)")


def plain(lines: list[str]) -> list[str]:
    """Docstring in the form the numpydoc reader of Sphinx expects.

    Parameters
    ----------
    lines : list of str    of one docstring, indentation taken off

    Returns
    -------
    list of str    meanings on lines of their own; bars and stars outside code made literal

    Examples
    --------
    >>> plain(["Returns", "-------", "(n,) float    |v| v [m2/s2]"])
    ['Returns', '-------', '``(n,) float``', '    \\\\|v\\\\| v [m2/s2]']
    """
    made: list[str] = []
    section, code = "", False
    for i, line in enumerate(lines):
        if i + 1 < len(lines) and set(lines[i + 1].strip()) == {"-"}:
            section = line.strip()
        code = line.lstrip().startswith(">>>") or (code and line.strip() != "")
        entry = section in _SECTIONS and line[:1].strip() and line.strip() != section and set(line) != {"-"}
        if code:
            made.append(line)
        elif entry:
            head, _, meaning = (part.strip() for part in line.partition("   "))
            made += [_typed(head, section), *([f"    {_literal(meaning)}"] if meaning else [])]
        elif section in _SECTIONS and line.startswith(" "):
            made.append(f"    {_literal(line.strip())}")
        else:
            made.append(_literal(line))
    return made


def listed(lines: list[str]) -> list[str]:
    """Docstring of an internal function, its lines on arguments and results made a list.

    Examples
    --------
    >>> listed(["Sum.", "", "a (n,): numbers", "    of any kind", "Returns their sum", "", "Source: none."])
    ['Sum.', '', '- a (n,): numbers', '  of any kind', '- Returns their sum', '', 'Source: none.']
    """
    made, inside = [], False
    for i, line in enumerate(lines):
        begins = i > 1 and not lines[i - 1].strip()
        inside = bool(line.strip()) and (inside or (begins and _ENTRY.match(line) is not None))
        if not inside:
            made.append(line)
        else:
            made.append(f"  {line.strip()}" if line.startswith(" ") else f"- {line}")
    return made


def _typed(head: str, section: str) -> str:
    """Name and type of an entry; the type is code, for its words are shapes and not names to link to.

    Examples
    --------
    >>> _typed("force : (n, 3) float", "Parameters"), _typed("InputError", "Raises")
    ('force : ``(n, 3) float``', 'InputError')
    """
    if section == "Raises" or "`" in head:
        return _literal(head)
    name, colon, kind = head.partition(" : ")
    if colon:
        return f"{_literal(name)} : ``{kind}``"
    return f"``{name}``" if section in ("Returns", "Yields") else _literal(name)


def _literal(text: str) -> str:
    pieces = _LITERAL.split(text)
    return "".join(piece if i % 2 else _MARKUP.sub(r"\\\g<0>", piece) for i, piece in enumerate(pieces))


def setup(app: Any) -> dict[str, bool]:
    """Connect to Sphinx, before the numpydoc reader."""

    def process(_app: Any, _what: str, _name: str, _obj: Any, _options: Any, lines: list[str]) -> None:
        in_sections = any(set(line.strip()) == {"-"} for line in lines)
        lines[:] = plain(lines if in_sections else listed(lines))

    def skip(_app: Any, _what: str, _name: str, obj: Any, _skip: bool, _options: Any) -> bool | None:
        return True if isinstance(obj, _FIELD) else None

    app.connect("autodoc-process-docstring", process, priority=400)
    app.connect("autodoc-skip-member", skip)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
