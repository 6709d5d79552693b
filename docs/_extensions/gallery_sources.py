"""Copies of the examples with a title, as the gallery wants them; the scripts themselves stay plain."""

from __future__ import annotations

import ast
import builtins
import re
from pathlib import Path

FOLDER = "build/examples"

HEAD = """Gallery
=======

Every picture is drawn by the script beside it, from the `examples` folder; all of them run when these pages are built.
"""


def titled_copies(root: Path) -> str:
    """Copy `examples/plot_*.py` into a folder of their own, each with a title in its docstring.

    Parameters
    ----------
    root : Path    of the project

    Returns
    -------
    str    the folder; files that have not changed are left as they are, so that the gallery does not run them again
    """
    made = root / FOLDER
    made.mkdir(parents=True, exist_ok=True)
    wanted = {"GALLERY_HEADER.rst": HEAD}
    wanted |= {path.name: titled(path.read_text()) for path in sorted((root / "examples").glob("plot_*.py"))}
    for old in set(made.glob("*.py")) - {made / name for name in wanted}:
        old.unlink()
    for name, text in wanted.items():
        if not (made / name).is_file() or (made / name).read_text() != text:
            (made / name).write_text(text)
    return str(made)


def titled(script: str) -> str:
    """The script with the beginning of its docstring, up to a colon or the end of the sentence, made a title.

    Examples
    --------
    >>> print(titled('\"\"\"The map: roll over heading.\\n\\nMore.\\n\"\"\"\\nx = 1\\n').split("x = 1")[0].strip('\"\\n'))
    The map
    =======
    <BLANKLINE>
    Roll over heading.
    <BLANKLINE>
    More.
    """
    tree = ast.parse(script)
    whole = ast.get_docstring(tree) or "Example"
    first, _, rest = whole.partition("\n\n")
    if first.splitlines()[-1].strip("=-~") == "":
        return script  # it has one
    title, body = _split(" ".join(first.split()))
    body = "\n\n".join(part for part in (body, rest) if part)
    code = "".join(script.splitlines(keepends=True)[tree.body[0].end_lineno if ast.get_docstring(tree) else 0 :])
    quoted = f"{title}\n{'=' * len(title)}\n\n{body}\n".replace("\\", "\\\\")
    return f'"""{quoted}"""\n{code}'


def _split(sentence: str) -> tuple[str, str]:
    """Title and what follows it; a short sentence is the title itself.

    Examples
    --------
    >>> _split("How good is it? Sections beside measurements."), _split("A map.")
    (('How good is it?', 'Sections beside measurements.'), ('A map', ''))
    """
    found = re.match(r"(.{,80}?)(: |[.] |(?<=[?]) )", sentence)
    if found is None:
        return sentence.rstrip("."), ""
    after = sentence[found.end() :]
    return found[1], after[0].upper() + after[1:]


def in_its_place(_settings: object, copy: str) -> None:
    """Tell a script that it is the one in `examples`: the gallery runs it without a ``__file__``."""
    builtins.__file__ = str(Path(__file__).parents[2] / "examples" / Path(copy).name)  # type: ignore[attr-defined]
