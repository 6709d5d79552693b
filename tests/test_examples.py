"""Every quick example runs and draws its picture.

The gallery of the documentation runs all of them (`make docs`): the paper's figures (``plot_fig*.py``), whose content is
tested in ``tests/paper``, and the comparisons that take longest run there alone.
"""

import ast
import os
import subprocess
import sys
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pytest

import quartering as qt

ALL = sorted((Path(__file__).parents[1] / "examples").glob("*.py"))
SLOW = {"plot_how_good", "plot_roll_excitation"}
QUICK = {"plot_polar_map"}
"""The example that every run draws; the others are of the long tier, and of `make docs`."""
EXAMPLES = [
    pytest.param(script, id=script.stem, marks=() if script.stem in QUICK else pytest.mark.soak)
    for script in ALL
    if not script.stem.startswith("plot_fig") and script.stem not in SLOW
]


@pytest.mark.parametrize("script", ALL, ids=lambda script: script.stem)
def test_what_an_example_imports_is_there(script):
    """Without running it: a name that moved in the library is missed where nobody runs the long tier."""
    for node in ast.walk(ast.parse(script.read_text())):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("quartering"):
            module = import_module(node.module)
            for one in node.names:
                assert hasattr(module, one.name) or find_spec(f"{node.module}.{one.name}"), one.name
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "qt":
            assert hasattr(qt, node.attr), node.attr


@pytest.mark.parametrize("script", EXAMPLES)
def test_example_draws_its_picture(script, tmp_path):
    picture = tmp_path / "picture.png"
    environment = os.environ | {"MPLBACKEND": "Agg"}
    subprocess.run(
        [sys.executable, str(script), str(picture)], check=True, capture_output=True, env=environment, cwd=tmp_path
    )
    assert picture.stat().st_size > 10_000
