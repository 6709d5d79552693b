"""What a command answers: lines for people, facts for programs, files, and what to type next."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from quartering.view.console.files import File, is_table, write_files
from quartering.view.console.printed import Table, next_steps, show, show_json


@dataclass(frozen=True)
class Answer:
    """Answer of a command, which `give` prints and writes.

    Parameters
    ----------
    lines : iterable of Table or str     to print; a generator works only when they are printed
    facts : function() -> mapping        the JSON object of ``--json``, called only for that
    files : sequence of File             to write: all complete, or none
    written : str or None                what is said of the files; by default "Wrote .." of each, "" is nothing
    remarks : sequence of str            to print after that
    next_steps : sequence of str         commands to type next
    output : Path or None                the file asked for; where it is a .csv or .xlsx, the tables among the lines go there
    data : function() -> tables          further tables for that file, one line a condition
    """

    lines: Iterable[Table | str]
    facts: Callable[[], Mapping[str, Any]]
    files: Sequence[File] = ()
    written: str | None = None
    remarks: Sequence[str] = ()
    next_steps: Sequence[str] = ()
    output: Path | None = None
    data: Callable[[], Sequence[Table]] = tuple


def give(answer: Answer, as_json: bool) -> None:
    """Write the files of an answer, then print it.

    as_json: one JSON object in place of tables and lines
    """
    lines, files = answer.lines, [*answer.files]
    if is_table(answer.output):
        lines = list(lines)
        files.append(_tables(answer.output, [part for part in lines if isinstance(part, Table)], answer.data))
    write_files(*files)
    if as_json:
        show_json(answer.facts())
        return
    for part in lines:
        show(part)
    written = "\n".join(f"Wrote {file.path}" for file in files) if answer.written is None else answer.written
    show(*([written] if written else ()), *answer.remarks)
    if answer.next_steps:
        show(next_steps(*answer.next_steps))


def _tables(path: Path, printed: Sequence[Table], data: Callable[[], Sequence[Table]]) -> File:
    """The file of the tables of an answer."""
    from quartering.view.console.tables import write_tables

    return File(path, lambda part: write_tables(part, printed, data()))
