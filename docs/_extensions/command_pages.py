"""The command line's reference, read from the commands themselves."""

from __future__ import annotations

from typing import Any

HEAD = """Command line
============

Every command prints a table, writes the one file it was asked for and says what to type next. With ``--json`` it prints
one JSON object instead. It ends with 0, or with 2 and one message when the input cannot be used. A *ship* is the name of a
built-in ship or the path of a ship file; lengths may be given in ship lengths (``1.2L``), speeds in knots (``15kn``) or as
Froude number (``0.25Fn``).
"""


def page() -> str:
    """The page of all commands.

    Returns
    -------
    str    reStructuredText
    """
    import typer.main

    from quartering.view.cli import app

    group: Any = typer.main.get_command(app)
    lines = [HEAD]
    for name, command in group.commands.items():
        lines += _command(name, command)
    return "\n".join(lines) + "\n"


def _command(name: str, command: Any) -> list[str]:
    arguments = [p for p in command.params if p.param_type_name == "argument"]
    options = [p for p in command.params if p.param_type_name == "option"]
    words = " ".join(
        ["quartering", name, *(a.name.upper() if a.required else f"[{a.name.upper()}]" for a in arguments)]
    )
    required = " ".join(f"{o.opts[-1]} .." for o in options if o.required)
    lines = [name, "-" * len(name), "", *_plain(command.help), "", "::", "", f"    {words} {required}".rstrip(), ""]
    lines += [".. list-table::", "   :header-rows: 1", "   :widths: 26 54 20", ""]
    lines += ["   * - argument or option", "     - meaning", "     - default"]
    for parameter in (*arguments, *options):
        names = parameter.name.upper() if parameter in arguments else ", ".join(parameter.opts)
        lines += [f"   * - ``{names}``", f"     - {' '.join(_plain(parameter.help))}", f"     - {_default(parameter)}"]
    return [*lines, ""]


def _default(parameter: Any) -> str:
    if parameter.required:
        return "required"
    given = parameter.default() if callable(parameter.default) else parameter.default
    return "" if given is None or given is False or given == () else f"``{given}``"


def _plain(text: str | None) -> list[str]:
    """Lines of a help text, literal in reStructuredText.

    Examples
    --------
    >>> _plain("List *.nc of `quartering polar`.")
    ['List \\\\*.nc of `quartering polar`.']
    """
    return (text or "").replace("\\", "\\\\").replace("*", "\\*").replace("|", "\\|").splitlines()
