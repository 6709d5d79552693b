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
    InputError    a file that cannot be read, is no text or no YAML, or has a key twice: with the line

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
    try:
        return yaml.load(path.read_text(encoding="utf-8"), Loader=_Loader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f", line {mark.line + 1}" if mark else ""
        problem = getattr(error, "problem", None) or "the text is not YAML"
        raise InputError(f"{path}{line}: {problem}; write `key: value`, indented with spaces") from None
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}; give a file you may read") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: not a text file; give YAML text in UTF-8") from None
    except RecursionError:
        raise InputError(f"{path}: nested too deeply; a ship file has three levels") from None
