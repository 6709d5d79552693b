"""Pages made from the sources each time the documentation is built, into docs/reference."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import command_pages
import paper_code
import room_pages
from equations import tags

DOCS = Path(__file__).parents[1]
PACKAGE = DOCS.parent / "src" / "quartering"


def theory_sections(theory: Path) -> dict[str, str]:
    """Which equations the theory pages print, and in which section.

    Parameters
    ----------
    theory : Path    folder of the pages

    Returns
    -------
    dict    number -> title of the section
    """
    found = {}
    for path in sorted(theory.glob("*.md")):
        for part in re.split(r"^#+ ", path.read_text(), flags=re.MULTILINE)[1:]:
            title = part.splitlines()[0]
            found |= dict.fromkeys(tags(part), title)
    return found


def write_pages(_app: Any = None) -> None:
    """Write every generated page; one that has not changed is left alone."""
    made = room_pages.pages(PACKAGE)
    made["commands.rst"] = command_pages.page()
    made["paper_code.rst"] = paper_code.page(PACKAGE, theory_sections(DOCS / "theory"))
    made["changelog.md"] = (DOCS.parent / "CHANGELOG.md").read_text().replace("](docs/", "](../")
    folder = DOCS / "reference"
    folder.mkdir(exist_ok=True)
    for old in set(folder.iterdir()) - {folder / name for name in made}:
        old.unlink()
    for name, text in made.items():
        path = folder / name
        if not path.is_file() or path.read_text() != text:
            path.write_text(text)


def setup(app: Any) -> dict[str, bool]:
    """Connect to Sphinx."""
    app.connect("builder-inited", write_pages)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
