"""The reference of the Python interface: the public names, and a page for every room with its modules."""

from __future__ import annotations

import ast
from importlib import import_module
from pathlib import Path

ROOMS = {
    "hull": "what floats",
    "hydro": "what the water does to a moving hull",
    "loads": "what the wave does",
    "motion": "the equations and their solutions",
    "stability": "is that motion stable",
    "study": "many conditions",
}
HEAD = """Python interface
================

``import quartering as qt`` gives these names; they are what scripts may rely on. Each opens its page in the rooms below,
where everything else stands that the rooms are made of. Units are SI and degrees unless said otherwise.

.. list-table::
   :widths: 28 72
"""
BESIDE = ("conventions", "references", "names")


def pages(package: Path) -> dict[str, str]:
    """Pages of the reference.

    Parameters
    ----------
    package : Path    folder of the sources of `quartering`

    Returns
    -------
    dict    file name -> reStructuredText
    """
    made = {f"{room}.rst": _room(package, room, words) for room, words in ROOMS.items()}
    made["beside.rst"] = _page("Beside the rooms", [f"quartering.{name}" for name in BESIDE])
    return {"python.rst": _public()} | made


def _public() -> str:
    import quartering

    lines = [HEAD]
    for name in sorted(quartering.__all__, key=str.lower):
        home = "stability.verdict" if name == "stability" else quartering._HOMES[name]
        first = (getattr(import_module(f"quartering.{home}"), name).__doc__ or "").strip().splitlines()[0]
        lines += [f"   * - :py:obj:`qt.{name} <quartering.{home}.{name}>`", f"     - {first}"]
    lines += ["", ".. toctree::", "   :maxdepth: 1", "", *(f"   {room}" for room in (*ROOMS, "beside")), ""]
    return "\n".join(lines)


def _room(package: Path, room: str, words: str) -> str:
    paths = [path for path in sorted((package / room).rglob("*.py")) if _documents_something(path)]
    modules = [".".join(path.relative_to(package.parent).with_suffix("").parts) for path in paths]
    return _page(f"{room}: {words}", modules)


def _page(title: str, modules: list[str]) -> str:
    lines = [title, "=" * len(title), ""]
    for module in modules:
        short = module.split(".", 2)[-1]
        lines += [short, "-" * len(short), "", f".. automodule:: {module}", "   :members:", ""]
    return "\n".join(lines)


def _documents_something(path: Path) -> bool:
    """Has the module a public function or class that is not compiled?"""
    if path.stem == "__init__":
        return False
    return any(
        isinstance(node, (ast.FunctionDef, ast.ClassDef))
        and not node.name.startswith("_")
        and not any(ast.unparse(decorator) in ("kernel", "inner", "batch_kernel") for decorator in node.decorator_list)
        for node in ast.parse(path.read_text()).body
    )
