"""Change values in the text of a ship file, keeping its comments and layout."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final, NamedTuple

import yaml

from quartering.conventions import InputError
from quartering.hull.file.built_in import available_ships
from quartering.hull.file.new import write_ship
from quartering.hull.file.yaml_text import parsed, read_text

Values = Mapping[str, Mapping[str, float | str]]
"""Group of keys (`loading`, `coefficients`, `provenance`) -> key -> value."""

_FILES: Final = (("lines",), ("lines", "file"), ("database",), ("database", "file"), ("measured",))


class _Edit(NamedTuple):
    start: int
    end: int
    text: str


def changed_text(name_or_path: str, values: Values, target: Path) -> str:
    """Text of a ship file with some values changed; what else it says stays as it is.

    name_or_path: built-in ship, whose starting file is taken, or a ship file
    values: group -> key -> number or text
    target: where the text will be written

    Values are put where they stand in the text (marks of the YAML nodes). Where that does not give the values wanted, as with
    anchors, the whole is written anew without its comments.
    """
    text, data = _start(name_or_path, target)
    wanted = {**data, **{group: {**(data.get(group) or {}), **own} for group, own in values.items()}}
    try:
        for group, own in values.items():
            for key, value in own.items():
                text = _with_value(text, group, key, value)
        right = yaml.safe_load(text) == wanted
    except yaml.YAMLError:
        right = False
    return text if right else yaml.safe_dump(wanted, sort_keys=False, allow_unicode=True)


def _start(name_or_path: str, target: Path) -> tuple[str, dict[str, Any]]:
    """Text of the file to change, and what it holds."""
    if name_or_path in [entry.name for entry in available_ships()]:
        with tempfile.TemporaryDirectory() as folder:
            text = write_ship(name_or_path, Path(folder) / "start.yaml").read_text(encoding="utf-8")
        return text, dict(parsed(text, target))
    path = Path(name_or_path)
    text = read_text(path)
    data = dict(parsed(text, path))
    beside = [word for keys in _FILES if (word := _file_named(data, keys, path.parent))]
    if beside and path.parent.resolve() != target.parent.resolve():
        raise InputError(
            f'{path} names the file "{beside[0]}" beside it; write the new ship file into the same folder, "{path.parent}"'
        )
    return text, data


def _file_named(data: Any, keys: tuple[str, ...], folder: Path) -> str | None:
    """A file beside the ship file that it names under these keys."""
    for key in keys:
        data = data.get(key) if isinstance(data, dict) else None
    if not isinstance(data, str) or Path(data).is_absolute():
        return None
    return data if (folder / data).is_file() else None


def _with_value(text: str, group: str, key: str, value: float | str) -> str:
    """The text with one value of a group set."""
    root = yaml.compose(text, Loader=yaml.SafeLoader)
    assert isinstance(root, yaml.MappingNode)  # a ship was read from it
    said = f"{_quoted(key)}: {_scalar(value)}"
    node = _child(root, group)
    if node is None:
        end = "" if text.endswith("\n") else "\n"
        if root.flow_style:
            return _applied(text, _into_flow(root, f"{group}: {{{said}}}"))
        return f"{text}{end}{' ' * root.start_mark.column}{group}:\n{' ' * root.start_mark.column}  {said}\n"
    if not isinstance(node, yaml.MappingNode):
        return text  # nothing that can be changed in its place: the caller sees that the values are not there
    old = _child(node, key)
    if old is not None:
        return _applied(text, _over(text, old, _scalar(value)))
    if node.flow_style:
        return _applied(text, _into_flow(node, said))
    start = node.start_mark.index
    return _applied(text, _Edit(start, start, f"{said}\n{' ' * node.start_mark.column}"))


def _child(node: yaml.MappingNode, key: str) -> yaml.Node | None:
    return next((value for name, value in node.value if name.value == key), None)


def _into_flow(node: yaml.MappingNode, said: str) -> _Edit:
    """A key put first into {..}."""
    start = node.start_mark.index + 1
    return _Edit(start, start, said + (", " if node.value else ""))


def _over(text: str, node: yaml.Node, scalar: str) -> _Edit:
    """A value put in place of another; a comment behind it on its line spoke of the old one and goes."""
    end = _end(node)
    line = text.find("\n", end)
    rest = text[end : line if line >= 0 else len(text)]
    if rest.lstrip().startswith("#"):
        end += len(rest)
    return _Edit(node.start_mark.index, end, scalar)


def _end(node: yaml.Node) -> int:
    """Where a value ends: a block of keys at the end of its last value, not at the next key."""
    if isinstance(node, yaml.MappingNode) and not node.flow_style and node.value:
        return _end(node.value[-1][1])
    return int(node.end_mark.index)


def _applied(text: str, edit: _Edit) -> str:
    return text[: edit.start] + edit.text + text[edit.end :]


def _scalar(value: float | str) -> str:
    """A number to ten digits, with the point YAML needs beside an exponent; a text in double quotes."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return repr(rounded(value))


def _quoted(key: str) -> str:
    return json.dumps(key) if "|" in key else key


def rounded(value: float) -> float:
    """A value as it is written: to six digits."""
    return float(f"{value:.6g}")
