"""The Python of the pages, run when they are built: what a page shows is what the library gives, or the build says so."""

from __future__ import annotations

import doctest
import re
from typing import Any

LENIENT = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def blocks(text: str, language: str) -> list[str]:
    """Blocks of code of a page in one language.

    Examples
    --------
    >>> blocks("```pycon\\n>>> 1 + 1\\n2\\n```", "pycon")
    ['>>> 1 + 1\\n2\\n']
    """
    return re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)


def tried(text: str, name: str) -> tuple[int, str]:
    """How many statements of a page were run, in one session from top to bottom, and what went otherwise than shown.

    Examples
    --------
    >>> tried("```pycon\\n>>> 1 + 1\\n2\\n```", "page")
    (1, '')
    >>> "Expected:" in tried("```pycon\\n>>> 1 + 1\\n3\\n```", "page")[1]
    True
    """
    session = "\n".join(blocks(text, "pycon"))
    example = doctest.DocTestParser().get_doctest(session, {}, name, name, 0)
    found: list[str] = []
    count = doctest.DocTestRunner(optionflags=LENIENT).run(example, out=found.append).attempted
    return count, "".join(found)


def _run(app: Any, page: str, source: list[str]) -> None:
    """Run the examples of a page as it is read; `GALLERY=False` leaves them out, as it does the gallery."""
    if str(app.config.plot_gallery) not in ("True", "1") or not blocks(source[0], "pycon"):
        return
    from sphinx.util import logging

    _, wrong = tried(source[0], page)
    if wrong:
        logging.getLogger(__name__).warning(
            "an example gives something else than the page shows\n%s", wrong, location=page
        )


def setup(app: Any) -> dict[str, bool]:
    """Register with Sphinx."""
    app.connect("source-read", _run)
    return {"parallel_read_safe": True}
