"""A commented ship file to start from."""

from __future__ import annotations

from pathlib import Path

from quartering.conventions import InputError
from quartering.hull.file.built_in import available_ships
from quartering.hull.file.read import ship
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.ship import Ship
from quartering.option_checks import Option
from quartering.options import OPTIONS, line_of, options

_HEAD = """\
# yaml-language-server: $schema={schema}
# Ship file of quartering, started from the built-in ship {base}.
# Values carry their unit: m, ft, kg/m3; L, B and T stand for length, beam and draught of this file ("0.05 B").
# A line left out keeps the value of {base}; remove the # of one to use it. A value may also say where it comes from:
#   gm: {{value: 0.81 m, status: published, source: inclining test}}    # status: published, derived, assumed or given
"""
_SHOWN = ("length", "beam", "design_draught", "draught", "linear", "righting", "sections", "ends", "drag_coefficient")
"""Options below the name a new file gives a value; the others stand in it as comments."""
_WIDTH = 31


def write_ship(name: str, path: str | Path) -> Path:
    """Write a commented ship file that starts from a built-in ship, a unit on every line.

    name: built-in ship
    path: file to write; one that exists is not overwritten
    Returns the file, which reads back as the same ship

    Source: values of the built-in ship; the comments say which are assumed.
    """
    names = [entry.name for entry in available_ships()]
    if name not in names:
        refuse_lines(name)
        ship(name) if not Path(name).is_file() else None  # says which names there are
        raise InputError(f'"{name}" is a file; a new ship file starts from a built-in ship: {", ".join(names)}')
    target = Path(path)
    if target.exists():
        raise InputError(f"{target} exists; it is not overwritten; give another name, or remove it first")
    try:
        target.write_text(_text(name, ship(name)), encoding="utf-8")
    except OSError as error:
        raise InputError(f"{target} cannot be written: {error.strerror}; give a file in a folder that exists") from None
    return target


def refuse_lines(name: str) -> None:
    """Refuse a file that is no ship file in the place of a built-in ship, and say how lines of one's own are given."""
    given = Path(name)
    if given.is_file() and given.suffix.lower() not in (".yaml", ".yml"):
        raise InputError(
            f'"{name}" is a file, no built-in ship; to start from lines of your own (CSV, PDSTRIP, GDF, STL), try '
            f"`quartering new --offsets {name}`"
        )


def _text(base: str, ship: Ship) -> str:
    """A line for every option: with the value of the base ship, or as a comment with an example."""
    status = {key: note.split(":")[0] for key, note in ship.provenance.items()}
    top = [one for one in OPTIONS.values() if one.place == "ship" and not one.group and one.name != "name"]
    hull = [one for one in top if one.name in _SHOWN and one.kind == "length"]
    rest = [one for one in top if one not in hull]
    loading = [one for one in options(place="loading") if one.kind != "table" and one.name != "kg"]
    tables = [one for one in options(place="loading") if one.kind == "table"]
    lines = [
        _HEAD.format(base=base, schema=SCHEMA).rstrip(),
        _line(f"name: {ship.name} (copy)", ""),
        _line(f"base: {base}", "the lines come from this built-in ship (`quartering ships` lists them)"),
        "",
        *(_option(one, ship, status) for one in hull),
        "",
        "loading:",
        *(f"  {_centre(ship, status) if one.name == 'gm' else _option(one, ship, status)}" for one in loading),
        *(_option(one, ship, status).replace("# ", "  # ", 1) for one in tables),
        "",
        *(_option(one, ship, status) for one in rest),
    ]
    return "\n".join(lines) + "\n"


def _line(left: str, note: str) -> str:
    return f"{left:<{_WIDTH}} # {note}" if note else left


def _option(one: Option, ship: Ship, status: dict[str, str]) -> str:
    """The line of one option."""
    value = ship.value(one.name) if one.name in _SHOWN or (one.place == "loading" and one.home) else None
    if value is None:
        example = one.example or one.usual or one.default
        return _line(f"# {one.path[-1]}: {example}", line_of(one))
    if one.name == "roll_damping" and ship.roll_method != "fraction":
        return _line(f"{one.path[-1]}: {ship.roll_method}", line_of(one))
    text = f"{value:.10g} {one.unit}".removesuffix(" 1") if one.numeric and not isinstance(value, str) else str(value)
    ratio = {"gyradius_roll": ("B", ship.hull.beam), "gyradius_yaw": ("L", ship.hull.length)}.get(one.name)
    notes = [line_of(one), status.get(one.name, ""), f"{value / ratio[1]:.3f} {ratio[0]}" if ratio else ""]
    return _line(f"{one.path[-1]}: {text}", "; ".join(note for note in notes if note))


def _centre(ship: Ship, status: dict[str, str]) -> str:
    """The line of gm, or of kg when that is what the ship's own file gives."""
    loading, km = ship.loading, hydrostatics(ship.hull).km
    if status["gm"] == "derived":
        words = f"height of G over the keel, below KM = {km:.3f} m; or give `gm:`, here {loading.gm:.3f} m"
        return _line(f"kg: {loading.kg:.10g} m", f"{words}; {status['kg']}")
    words = f"metacentric height, above 0; or give `kg:`, height of G over the keel, here {loading.kg:.3f} m"
    return _line(f"gm: {loading.gm:.10g} m", f"{words}; {status['gm']}")


SCHEMA = Path(__file__).with_name("ship.schema.json")
"""JSON schema of the ship file, for editors."""
