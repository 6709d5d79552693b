"""Write what is made from the table of options: types for editors, JSON schemas, the page of the documentation.

    python tools/write_options.py

`tests/test_options.py` compares what stands there with what this would write.
"""

from __future__ import annotations

from pathlib import Path

from quartering.names import CUBIC_NAMES, LINEAR_NAMES, RESTORING_NAMES
from quartering.option_checks import Option
from quartering.options import OPTIONS, line_of, options, ship_options

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / "src" / "quartering"
_TYPES = '''"""Types of what `quartering.options` declares, for editors; written by ``tools/write_options.py``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypedDict

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from quartering.hull.autopilot import Autopilot, Rudder
    from quartering.hull.propulsion import Propulsion
    from quartering.hull.user_database import Database

{words}


class ShipOptions(TypedDict, total=False):
    """What `Ship.with_` takes."""

{ship}


class StudyAxes(TypedDict, total=False):
    """What a study may vary of a ship: one value or several, each a number or text with a unit; coefficients by factors."""

{axes}
'''
_DOC = """# What a ship can be told

Every option has one name in every door: the ship file (below `loading:`, in a group, or at the top), `ship.with_(name=..)`, the
case of a study, `--name` on the command line, the explorer and its service. A number may carry a unit everywhere: `"5.1 m"`,
`"0.38 B"`, `"15kn"`, `"1.2L"`; L, B and T are the ship's own length, beam and draught. A wave length may be given as a period,
`"9 s"`. `factors` multiply coefficients and `values` give them; a ship file says `coefficients:` for values.
This page is written from `quartering.options`.

{tables}
"""


def literal(one: Option) -> str:
    """Name of the type of a word: `Ends`."""
    return "".join(part.capitalize() for part in one.name.split("_"))


def types() -> str:
    """Text of `hull/option_types.py`."""
    words = list(options(kinds=("word",)))
    named = "\n".join(f"{literal(one)} = {one.python}" for one in words).replace("'", '"')

    def field(one: Option) -> str:
        kind = literal(one) if one.kind == "word" else one.python
        return f'    {one.name}: {kind} | None\n    """{_sentence(one)}"""'

    axis = "ArrayLike | str | Sequence[float | str]"
    axes = [f'    {one.name}: {axis}\n    """{_sentence(one)}"""' for one in ship_options() if one.axis]
    names = [name for table in (LINEAR_NAMES, RESTORING_NAMES, CUBIC_NAMES) for row in table for name in row]
    axes += [f"    {name}: {axis}" for name in names]
    return _TYPES.format(words=named, ship="\n".join(map(field, ship_options())), axes="\n".join(axes))


def _sentence(one: Option) -> str:
    line = line_of(one)
    sentence = f"{line[0].upper()}{line[1:]}."
    return sentence if len(sentence) < 115 else sentence[:111] + " ..."


def page() -> str:
    """Text of `docs/options.md`."""
    titles = {"ship": "The ship", "loading": "Its loading", "condition": "The condition"}
    return _DOC.format(tables="\n\n".join(f"## {title}\n\n{_table(place)}" for place, title in titles.items()))


def _table(place: str) -> str:
    rows = ["| option | in a ship file | meaning | allowed | without it | axis |", "|---|---|---|---|---|---|"]
    for one in OPTIONS.values():
        if one.place == place:
            default = "" if one.default is None else f"{one.default}"
            key = "" if place == "condition" else f"`{': '.join(one.path)}:`"
            allowed = "" if not one.numeric and not one.words else one.range().removeprefix("it is ")
            rows.append(
                f"| `{one.name}` | {key} | {line_of(one)} | {allowed} | {default} | {'yes' if one.axis else ''} |"
            )
    return "\n".join(rows)


def made() -> dict[Path, str]:
    """Each file and its text."""
    from quartering.hull.file.schema import ship_schema
    from quartering.study.case.read import case_schema

    return {
        SOURCE / "hull" / "file" / "ship.schema.json": ship_schema(),
        SOURCE / "study" / "case" / "case.schema.json": case_schema(),
        ROOT / "docs" / "options.md": page(),
    }


def main() -> None:
    """Write them; the types first, since the rest of the package imports them."""
    (SOURCE / "hull" / "option_types.py").write_text(types(), encoding="utf-8")
    for path, text in made().items():
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
