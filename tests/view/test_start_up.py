"""What a command loads: counted, not timed, so that no idle machine is asked for."""

import subprocess
import sys

import pytest

VERDICT = ("verdict", "wigley", "--heading", "60", "--speed", "5", "--wave-length", "1L", "--wave-height", "1")
SLOW_TO_LOAD = {
    "scipy.linalg", "scipy.special", "scipy.interpolate", "scipy.optimize", "scipy.stats", "xarray", "pandas", "netCDF4",
    "matplotlib", "jinja2", "nicegui",
}  # fmt: skip
COMPILER = {"numba", "llvmlite"}
VALIDATORS = {"pydantic", "typer._adapters"}
"""Built by typer for every option, given or not, unless it is a text as typed."""
TABLES_OF_THE_COMPILER = "numba.np.arraymath"
"""Loaded by numba as it prepares to compile, and with it `scipy.linalg`."""


def loaded(*words):
    """Modules that one command has loaded at its end."""
    call = (
        f"import sys; sys.argv = ['quartering', *{words!r}]\n"
        "from quartering.view.cli import main\n"
        "try: main()\n"
        "except SystemExit as end: assert not end.code\n"
        "print('', *sys.modules, sep='\\nmodule ')"
    )
    result = subprocess.run([sys.executable, "-c", call], capture_output=True, text=True, check=True)
    return {line.removeprefix("module ") for line in result.stdout.splitlines() if line.startswith("module ")}


@pytest.fixture(scope="module")
def compiled():
    """The kernels of a verdict and the coefficients of its hull, kept by an earlier command."""
    loaded(*VERDICT)


@pytest.mark.usefixtures("compiled")
def test_a_verdict_loads_kept_kernels_and_nothing_that_takes_long():
    modules = loaded(*VERDICT)
    assert not modules & SLOW_TO_LOAD
    assert modules >= COMPILER
    assert TABLES_OF_THE_COMPILER not in modules
    assert "typer._adapters" not in modules


@pytest.mark.usefixtures("compiled")
@pytest.mark.parametrize("command", ["hull", "coefficients"])
def test_what_has_no_wave_loads_no_kernel(command):
    assert not loaded(command, "wigley") & (SLOW_TO_LOAD | COMPILER)


@pytest.mark.parametrize("words", [("ships",), ("--help",)])
def test_a_list_loads_no_arrays(words):
    assert not loaded(*words) & (SLOW_TO_LOAD | COMPILER | VALIDATORS | {"numpy", "yaml"})


@pytest.mark.usefixtures("compiled")
def test_a_map_in_three_modes_loads_nothing_of_six(tmp_path):
    modules = loaded(
        "polar", "wigley", "--headings", "30:60:2", "--wave-lengths", "1L", "-o", str(tmp_path / "map.csv")
    )
    assert not modules & {
        "scipy.optimize",
        "scipy.interpolate",
        "matplotlib",
        "quartering.motion.steady_course.doubled",
        "dask.array",
        "distributed",
    }


@pytest.mark.parametrize(
    ("words", "hidden"),
    [
        (("polar", "wigley"), True),
        (("sweep", "a.yaml", "--cluster", "local:2"), False),
        (("--cluster=local:2",), False),
    ],
)
def test_dask_is_found_where_a_cluster_is_asked_for_alone(words, hidden):
    """Where it is installed xarray asks for it with the first dataset, and a map then took a fifth longer."""
    call = (
        f"import sys; sys.argv = ['quartering', *{words!r}]\n"
        "from quartering.view import cli; cli._leave_dask_alone()\n"
        "print(sys.modules.get('dask', 'not asked for'))"
    )
    result = subprocess.run([sys.executable, "-c", call], capture_output=True, text=True, check=True)
    assert (result.stdout.strip() == "None") == hidden
