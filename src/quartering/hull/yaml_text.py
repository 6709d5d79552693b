"""YAML of the files people write: one value a key, keys that are words, and the line of what is wrong."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from quartering.conventions import InputError

_FAST: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


class _Loader(_FAST):  # type: ignore[misc]
    """Plain data; a key given twice would hide the first value, and is refused."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[str, Any]:
        lines: dict[str, int] = {}
        for key, _ in node.value:
            if key.tag == "tag:yaml.org,2002:merge":  # `<<: *other` may stand for keys that are given again
                continue
            word, line = self.construct_object(key, deep=True), key.start_mark.line + 1
            if not isinstance(word, str):
                raise yaml.MarkedYAMLError(problem=f"the key {word!r} is no word", problem_mark=key.start_mark)
            if word in lines:
                problem = f"`{word}` is given twice (first in line {lines[word]}); leave one out"
                raise yaml.MarkedYAMLError(problem=problem, problem_mark=key.start_mark)
            lines[word] = line
        return dict(super().construct_mapping(node, deep))


def read_yaml(path: Path) -> Any:
    """What a YAML file holds.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Any    texts, numbers, lists, and mappings of words

    Raises
    ------
    InputError    what `read_text` and `parsed` refuse

    Notes
    -----
    Source: YAML 1.1.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "my.yaml"
    ...     _ = file.write_text("base: box")
    ...     read_yaml(file)
    {'base': 'box'}
    """
    return parsed(read_text(path), path)


def read_text(path: Path) -> str:
    """The text of a file people write.

    Parameters
    ----------
    path : Path

    Returns
    -------
    str

    Raises
    ------
    InputError    a file that cannot be read, or is no text

    Notes
    -----
    Source: none; reading of files.
    """
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}; give a file you may read") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: not a text file; give YAML text in UTF-8") from None


def parsed(text: str, path: Path) -> Any:
    """What YAML text holds.

    Parameters
    ----------
    text : str
    path : Path    of its file, named in messages

    Returns
    -------
    Any    texts, numbers, lists, and mappings of words

    Raises
    ------
    InputError    no YAML, or a key given twice: with the line

    Notes
    -----
    Source: none; reading of files.
    """
    try:
        return yaml.load(text, Loader=_Loader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f", line {mark.line + 1}" if mark else ""
        problem = getattr(error, "problem", None) or "the text is not YAML"
        raise InputError(f"{path}{line}: {problem}; write `key: value`, indented with spaces") from None
    except RecursionError:
        raise _too_deep(path) from None


def key_lines(text: str, path: Path) -> dict[tuple[str, ...], int]:
    """The line on which each key of YAML text stands, for messages.

    Parameters
    ----------
    text : str     that `parsed` takes
    path : Path    of its file, named in messages

    Returns
    -------
    mapping of keys, the outermost first, to int    counted from 1

    Raises
    ------
    InputError    nested too deeply

    Notes
    -----
    Source: none; reading of files.

    Examples
    --------
    >>> key_lines("{ship: wigley, loading: {gm: 1 m}}", Path("my.yaml"))
    {('ship',): 1, ('loading',): 1, ('loading', 'gm'): 1}
    """
    lines: dict[tuple[str, ...], int] = {}

    def walk(node: Any, above: tuple[str, ...]) -> None:
        for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
            own = (*above, str(key.value))
            lines[own] = key.start_mark.line + 1
            walk(value, own)

    try:
        walk(yaml.compose(text, yaml.SafeLoader), ())
    except RecursionError:
        raise _too_deep(path) from None
    return lines


def _too_deep(path: Path) -> InputError:
    return InputError(f"{path}: nested too deeply; such a file has three levels at most")
