"""Every example runs and draws its picture.

The paper's figures (``plot_fig*.py``) run in the gallery of the documentation; what they draw is tested in ``tests/paper``.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

SLOW = {"plot_how_good", "plot_roll_excitation"}
NEEDS = {"plot_roll_excitation": "capytaine"}
EXAMPLES = [
    pytest.param(script, id=script.stem, marks=[pytest.mark.slow] if script.stem in SLOW else [])
    for script in sorted((Path(__file__).parents[1] / "examples").glob("*.py"))
    if not script.stem.startswith("plot_fig")
]


@pytest.mark.parametrize("script", EXAMPLES)
def test_example_draws_its_picture(script, tmp_path):
    if script.stem in NEEDS:
        pytest.importorskip(NEEDS[script.stem])
    picture = tmp_path / "picture.png"
    environment = os.environ | {"MPLBACKEND": "Agg"}
    subprocess.run(
        [sys.executable, str(script), str(picture)], check=True, capture_output=True, env=environment, cwd=tmp_path
    )
    assert picture.stat().st_size > 10_000
