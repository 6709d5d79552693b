"""YAML reader that rejects duplicate and non-text keys and reports line numbers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from quartering.conventions import InputError

_FAST: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_DEEPEST = 100  # levels; no file of ours has more than four, and a library's own limit lies far above
_MOST_REPEATED = 10_000  # values that aliases may stand for in all
_TOO_DEEP = "nested too deeply; such a file has four levels at most"


class _Refusal(yaml.YAMLError):
    """What this project refuses, in its own words."""

    def __init__(self, problem: str, mark: Any) -> None:
        super().__init__(problem)
        self.problem, self.line = problem, int(mark.line) + 1


def _careful(reader: Any) -> Any:
    """A loader of the library that hides nothing and refuses in this project's words."""

    class Loader(reader):  # type: ignore[misc]
        """Plain data; a key given twice would hide the first value, and is refused."""

        def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[str, Any]:
            lines: dict[str, int] = {}
            if not isinstance(node, yaml.MappingNode):
                raise _Refusal(problem="`!!map` stands before a value that holds no keys", mark=node.start_mark)
            for key, _ in node.value:
                if key.tag == "tag:yaml.org,2002:merge":  # `<<: *other` may stand for keys that are given again
                    continue
                word, line = self.construct_object(key, deep=True), key.start_mark.line + 1
                if not isinstance(word, str):
                    raise _Refusal(problem=f"the key {word!r} is no word", mark=key.start_mark)
                if word in lines:
                    problem = f"{word} is given twice (first in line {lines[word]}); leave one out"
                    raise _Refusal(problem=problem, mark=key.start_mark)
                lines[word] = line
            return dict(super().construct_mapping(node, deep))

        def construct_object(self, node: yaml.Node, deep: bool = False) -> Any:
            try:
                return super().construct_object(node, deep)
            except (ValueError, KeyError, AttributeError, TypeError):  # a date of month 99, a number of 5,000 digits
                given = repr(str(node.value)[:20])
                problem = f"{given} begins no number, date or other value; put a text in quotes"
                raise _Refusal(problem=problem, mark=node.start_mark) from None

    return Loader


_LOADER = _careful(_FAST)


def read_yaml(path: Path) -> Any:
    """What a YAML file holds.

    Returns texts, numbers, lists, and mappings of words

    Source: YAML 1.1.
    """
    return parsed(read_text(path), path)


def read_text(path: Path) -> str:
    """The text of a file people write."""
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}; give a file you may read") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: not a text file; give YAML text in UTF-8") from None


def parsed(text: str, path: Path) -> Any:
    """What YAML text holds.

    path: of its file, named in messages
    Returns texts, numbers, lists, and mappings of words
    """
    opened: list[Any] = []
    try:
        _walk(text, path, opened)
        return yaml.load(text, Loader=_LOADER)
    except yaml.YAMLError as error:
        line, problem = _problem(error, text, opened)
        raise InputError(f"{path}, line {line}: {problem}; write `key: value`, indented with spaces") from None


def key_lines(text: str) -> dict[tuple[str, ...], int]:
    """The line on which each key of YAML text stands, for messages.

    text: that `parsed` takes
    Returns counted from 1
    """
    lines: dict[tuple[str, ...], int] = {}

    def walk(node: Any, above: tuple[str, ...]) -> None:
        for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
            own = (*above, str(key.value))
            lines[own] = key.start_mark.line + 1
            walk(value, own)

    walk(yaml.compose(text, _FAST), ())
    return lines


def _walk(text: str, path: Path, opened: list[Any]) -> None:
    """Go through the text without recursion; `opened` holds the lists and mappings open at its end or first error."""
    sizes: list[int] = [0]  # values in each open list or mapping, aliases counted as what they stand for
    named: dict[str, int] = {}
    repeated = 0
    for event in yaml.parse(text, Loader=_FAST):
        if isinstance(event, yaml.CollectionStartEvent):
            opened.append(event)
            sizes.append(0)
        elif isinstance(event, yaml.CollectionEndEvent):
            size, anchor = sizes.pop() + 1, opened.pop().anchor
            sizes[-1] += size
            if anchor is not None:
                named[anchor] = size
        elif isinstance(event, yaml.AliasEvent):
            line, name = _line_of(event), str(event.anchor)
            if any(one.anchor == event.anchor for one in opened):
                raise InputError(
                    f"{path}, line {line}: `*{event.anchor}` stands inside what it names; write the values out"
                )
            repeated += named.get(name, 1)
            sizes[-1] += named.get(name, 1)
            if repeated > _MOST_REPEATED:
                raise InputError(
                    f"{path}, line {line}: `*{event.anchor}` and the aliases above it stand for more than {_MOST_REPEATED:,} "
                    "values; write the values out"
                )
        elif isinstance(event, yaml.ScalarEvent):
            sizes[-1] += 1
            if event.anchor is not None:
                named[event.anchor] = 1
        if len(opened) > _DEEPEST:
            raise InputError(f"{path}, line {opened[-1].start_mark.line + 1}: {_TOO_DEEP}")


def _line_of(event: Any) -> int:
    """The line an event begins in, counted from 1."""
    return int(event.start_mark.line) + 1


# The library says what is wrong in words that change with its releases. Its kind of error and the two places it
# marks (where it stopped, where the piece began that it could not end) do not change: the words follow from them.
def _problem(error: yaml.YAMLError, text: str, opened: list[Any]) -> tuple[int, str]:
    """The line of an error, counted from 1, and what is wrong there."""
    if isinstance(error, _Refusal):
        return error.line, error.problem
    if isinstance(error, yaml.reader.ReaderError):
        return _unprintable(text), "a character that is no text"
    lines = [*text.splitlines(), ""]
    mark, context = getattr(error, "problem_mark", None), getattr(error, "context_mark", None)
    if mark is None:
        return 1, "this is not YAML"
    line, here = mark.line + 1, _at(lines, mark)
    if isinstance(error, yaml.composer.ComposerError):
        if _line(lines, mark).startswith("---"):
            return line, "a second document begins here; give one in each file"
        return line, "a name after `*` or `&` that is not given once above; put a text in quotes"
    if isinstance(error, yaml.constructor.ConstructorError):
        return line, f"`{here}` begins a tag or a value of another kind; give plain words, numbers and lists"
    return _unscanned(error, lines, mark, context, opened)


def _unscanned(error: yaml.YAMLError, lines: list[str], mark: Any, context: Any, opened: list[Any]) -> tuple[int, str]:
    """Line and words for text that does not keep to the form of YAML."""
    line, own, here = mark.line + 1, _line(lines, mark), _at(lines, mark)
    if "\t" in own[: len(own) - len(own.lstrip())]:
        return line, "a tab stands where spaces indent"
    began = _at(lines, context) if context else ""
    if began in ("'", '"'):
        if began == '"' and "\\" in own:
            return line, "a `\\` that means nothing in a text between `\"`; put it between `'`"
        return context.line + 1, f"the quote {began} of this line is not closed"
    if opened and opened[-1].flow_style:
        before = "\n".join([*lines[: mark.line], own[: mark.column]])  # what was looked at ahead of `opened`
        if before.count("[") + before.count("{") - before.count("]") - before.count("}") > _DEEPEST:
            return line, _TOO_DEEP
        first, last = "[]" if isinstance(opened[-1], yaml.SequenceStartEvent) else "{}"
        return line, f"`{first}` of line {opened[-1].start_mark.line + 1} is not closed by `{last}` before this"
    scanner = isinstance(error, yaml.scanner.ScannerError)
    if scanner and context and context.line < mark.line and ":" not in _line(lines, context)[context.column :]:
        return context.line + 1, "a line without `:`"
    if here == ":":
        return line, "a `:` where none can stand: put a text that holds `: ` in quotes, begin keys in one column"
    for sign in (here, began):
        if sign and sign in "@`%&*!|>,]}?":
            return line, f'a value cannot begin with "{sign}"; put a text in quotes'
    return line, "this does not fit the lines above: begin the keys (or the `-`) of one level in one column"


def _unprintable(text: str) -> int:
    """The line, counted from 1, of the first character that is no text."""
    for number, line in enumerate(text.splitlines(), 1):
        if not all(letter.isprintable() or letter in "\t\xa0" or letter.isspace() for letter in line):
            return number
    return 1


def _line(lines: list[str], mark: Any) -> str:
    """The text of a marked line."""
    return lines[min(mark.line, len(lines) - 1)]


def _at(lines: list[str], mark: Any) -> str:
    """The marked character, or nothing at the end of its line."""
    return _line(lines, mark)[mark.column : mark.column + 1]
