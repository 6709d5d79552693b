r"""Formulas as MathML, which browsers draw by themselves, with the paper's numbers: ``\tag{A-10}`` gives number and anchor."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml

_TAG = re.compile(r"\s*\\tag\{([^}]*)\}")
_ACCENT = re.compile(r"(\\(?:d?dot|hat|bar|tilde)\{[^{}]*\})")
_FUNCTION = re.compile(r"(<mi>(?:sin|cos|ln|exp)</mi>)")
_ANGLE = re.compile("<mo>([⟨⟩])</mo>")
_THIN = '<mspace width="0.14em"></mspace>'


def anchor(tag: str) -> str:
    """Name of an equation's place in a page.

    Examples
    --------
    >>> anchor("A-10")
    'eq-a-10'
    """
    return f"eq-{tag.lower()}"


def tags(text: str) -> list[str]:
    r"""Numbers of the equations in a text.

    Examples
    --------
    >>> tags(r"$$ a = b \tag{4} $$ and $$ c \tag{A-3} $$")
    ['4', 'A-3']
    """
    return _TAG.findall(text)


def _mathml(text: str, as_block: bool) -> str:
    """An accented letter is made one thing first, or its index would go under it.

    Marked as an accent, a dot is drawn inside the letter by browsers that find no mathematical font.
    """
    made = str(tex2mathml(_ACCENT.sub(r"{\1{}}", _TAG.sub("", text)), as_block=as_block))
    return _FUNCTION.sub(
        rf"{_THIN}\1{_THIN}", _ANGLE.sub(r'<mo stretchy="false">\1</mo>', made.replace(' accent="true"', ""))
    )


def _inline(translator: Any, node: nodes.math) -> None:
    translator.body.append(_mathml(node.astext(), as_block=False))
    raise nodes.SkipNode


def _block(translator: Any, node: nodes.math_block) -> None:
    text = node.astext()
    numbers = tags(text)
    made = _mathml(text, as_block=True)
    number = "".join(f'<span class="eqno">({tag})</span>' for tag in numbers)
    place = f' id="{anchor(numbers[0])}"' if numbers else ""
    translator.body.append(f'<div class="formula"{place}>{made}{number}</div>\n')
    raise nodes.SkipNode


def _register(app: Any, document: nodes.document) -> None:
    """Let other pages refer to a tagged equation."""
    labels = app.env.get_domain("std")
    for node in document.findall(nodes.math_block):
        for tag in tags(node.astext()):
            name, page = anchor(tag), app.env.docname
            labels.anonlabels[name] = (page, name)
            labels.labels[name] = (page, name, f"({tag})")


def setup(app: Any) -> dict[str, bool]:
    """Connect to Sphinx."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    app.connect("doctree-read", _register)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
