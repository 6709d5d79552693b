"""What is wrong with YAML text is said in this project's words, with the line, whatever library reads it."""

from pathlib import Path

import pytest
import yaml

from quartering.conventions import InputError
from quartering.hull.file import yaml_text
from quartering.hull.file.yaml_text import key_lines, parsed

pytestmark = pytest.mark.quick

# The lines and the kinds of fault follow from YAML 1.1; the sentences are ours.
FAULTS = {
    "deep list": ("a: 1\nb: " + "[" * 5000 + "]" * 5000, 2, "nested too deeply"),
    "deep braces": ("a: 1\nb: " + "{c: " * 3000, 2, "nested too deeply"),
    "deep block": ("\n".join(" " * i + "a:" for i in range(3000)), 101, "nested too deeply"),
    "tab": ("a:\n\tb: 1", 2, "a tab stands where spaces indent"),
    "tab in text": ("a: 1\n\tb: 1", 2, "a tab stands where spaces indent"),
    "open list": ("a: [1, 2\nb: 3", 2, "`[` of line 1 is not closed by `]`"),
    "open braces": ("a:\n  {b: 1, c: 2\n", 3, "`{` of line 2 is not closed by `}`"),
    "wrong bracket": ("a: [1}", 1, "`[` of line 1 is not closed by `]`"),
    "open quote": ("a: 1\nb: 'x\nc: 2", 2, "the quote ' of this line is not closed"),
    "open quotes": ('a: "x\nb: 2', 1, 'the quote " of this line is not closed'),
    "escape": (r'a: "C:\ships"', 1, "that means nothing in a text"),
    "two colons": ("a: b: c", 1, "a `:` where none can stand"),
    "indented": ("a: 1\n  b: 2", 2, "a `:` where none can stand"),
    "half out": ("a:\n    b: 1\n  c: 2", 3, "begin the keys (or the `-`) of one level in one column"),
    "list and keys": ("- 1\na: 2", 2, "begin the keys (or the `-`) of one level in one column"),
    "no colon": ("a: 1\nfoo\nb: 2", 2, "a line without `:`"),
    "at": ("a: @b", 1, 'a value cannot begin with "@"'),
    "star": ("a: **b**", 1, 'a value cannot begin with "*"'),
    "bar": ("a: |x\n", 1, 'a value cannot begin with "|"'),
    "alias": ("a: 1\nb: *x", 2, "not given once above"),
    "tag": ("a: !!python/object:os.system 1", 1, "begins a tag"),
    "map": ("a: !!map 3", 1, "a value that holds no keys"),
    "date": ("a: 1\nb: 2001-99-99", 2, "'2001-99-99' begins no number, date or other value"),
    "digits": ("a: " + "9" * 5000, 1, "begins no number, date or other value"),
    "two files": ("a: 1\n---\nb: 2", 2, "a second document begins here"),
    "control": ("a: 1\nb: \x01", 2, "a character that is no text"),
    "list key": ("? [a]\n: b", 1, "the key ['a'] is no word"),
    "twice": ("a: 1\nb: 2\na: 3", 3, "a is given twice (first in line 1)"),
}
READERS = [yaml.SafeLoader, *([yaml.CSafeLoader] if hasattr(yaml, "CSafeLoader") else [])]


@pytest.mark.parametrize("reader", READERS, ids=lambda reader: reader.__name__)
@pytest.mark.parametrize("name", FAULTS)
def test_each_fault_has_its_line_and_our_words_with_either_reader(name, reader, monkeypatch):
    text, line, words = FAULTS[name]
    monkeypatch.setattr(yaml_text, "_FAST", reader)
    monkeypatch.setattr(yaml_text, "_LOADER", yaml_text._careful(reader))
    with pytest.raises(InputError) as said:
        parsed(text, Path("my.yaml"))
    assert str(said.value).startswith(f"my.yaml, line {line}: ")
    assert words in str(said.value)


def test_the_words_are_kept_whatever_the_library_says(monkeypatch):
    """Another release of the library, with other words and no marks at all."""

    def other(*_, **__):
        raise yaml.scanner.ScannerError(None, None, "novel words", None)

    monkeypatch.setattr(yaml, "parse", other)
    with pytest.raises(InputError, match=r"^my.yaml, line 1: this is not YAML; write `key: value`") as said:
        parsed("a: 1", Path("my.yaml"))
    assert "novel" not in str(said.value)


def test_keys_know_their_lines():
    assert key_lines("a: 1\nb:\n  c: 2\n") == {("a",): 1, ("b",): 2, ("b", "c"): 3}
