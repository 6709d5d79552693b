"""What a command answers: lines for people, facts for programs, files, and what to type next."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from quartering.view.console.files import File, write_files
from quartering.view.console.printed import next_steps, show, show_json

if TYPE_CHECKING:
    from rich.table import Table


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
    """

    lines: Iterable[Table | str]
    facts: Callable[[], Mapping[str, Any]]
    files: Sequence[File] = ()
    written: str | None = None
    remarks: Sequence[str] = ()
    next_steps: Sequence[str] = ()


def give(answer: Answer, as_json: bool) -> None:
    """Write the files of an answer, then print it.

    as_json: one JSON object in place of tables and lines
    """
    write_files(*answer.files)
    if as_json:
        show_json(answer.facts())
        return
    for part in answer.lines:
        show(part)
    written = "\n".join(f"Wrote {file.path}" for file in answer.files) if answer.written is None else answer.written
    show(*([written] if written else ()), *answer.remarks)
    if answer.next_steps:
        show(next_steps(*answer.next_steps))
