"""Compiled kernels are thrown away when any source changed; what a run left out is said at its end.

The compiler's cache looks at a kernel's own file only; a kernel whose callee in another file changed would stay stale.
"""

import hashlib
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

os.environ.setdefault("NUMBA_OPT", "1")  # as on the command line: compiled sooner, and as fast
LEFT_OUT = pytest.StashKey[dict[str, int]]()
SOURCES = Path(__file__).parents[1] / "src" / "quartering"

# Seeds are explicit: the same examples every time, so that a red run means a change; and no clock decides, so that a busy
# machine changes nothing.
settings.register_profile("same", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("same")


def pytest_configure(config):
    digest = hashlib.sha256()
    for file in sorted(SOURCES.rglob("*.py")):
        if "njit" in (text := file.read_text()) or "quartering._machine.compiled" in text:
            digest.update(text.encode())
    if getattr(config, "cache", None) is None or config.cache.get("quartering/kernels", None) == digest.hexdigest():
        return
    for compiled in SOURCES.rglob("__pycache__/*.nb[ic]"):
        compiled.unlink(missing_ok=True)
    config.cache.set("quartering/kernels", digest.hexdigest())
    if getattr(config.option, "numprocesses", None):
        _compile_once()


def _compile_once():
    """Compile what a map needs before there are workers, each of which would compile it for itself."""
    map_of_little = ("polar", "wigley", "--headings", "30:60:2", "--wave-lengths", "1L", "--json")
    call = f"import sys; sys.argv = ['quartering', *{map_of_little!r}]; from quartering.view.cli import main; main()"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-c", call], cwd=folder, stdout=subprocess.DEVNULL, check=False)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    from tests.scheduling import LongestFirst

    return LongestFirst(config, log) if config.option.dist == "loadfile" else None


def pytest_deselected(items):
    """Count what a tier leaves out. In a run on several processes each of them collects everything: one count is enough."""
    if not items:
        return
    config, soak = items[0].config, sum("soak" in item.keywords for item in items)
    left = getattr(config, "workeroutput", config.stash.setdefault(LEFT_OUT, {}))
    left["soak"], left["others"] = left.get("soak", 0) + soak, left.get("others", 0) + len(items) - soak


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node):
    node.config.stash.setdefault(LEFT_OUT, {}).update(
        {key: count for key, count in getattr(node, "workeroutput", {}).items() if key in ("soak", "others")}
    )


def pytest_terminal_summary(terminalreporter, config):
    left, skipped = config.stash.get(LEFT_OUT, {}), len(terminalreporter.stats.get("skipped", []))
    if soak := left.get("soak", 0):
        terminalreporter.line(
            f"{soak} tests of the long tier were left out (kills, peak memory, samples by chance): `make soak` runs them"
        )
    if config.option.markexpr == "quick" and (others := left.get("others", 0)):
        terminalreporter.line(f"{others} tests of the other tiers were left out: `make test` runs them")
    if skipped:
        terminalreporter.line(f"{skipped} tests were skipped, each with its reason above")


@pytest.fixture(autouse=True, scope="session")
def _own_cache(tmp_path_factory):
    """Section tables are kept in a folder of this run, shared by its workers and apart from the user's."""
    before, folder = os.environ.get("QUARTERING_CACHE"), tmp_path_factory.getbasetemp()
    run = folder.parent if "PYTEST_XDIST_WORKER" in os.environ else folder
    os.environ["QUARTERING_CACHE"] = str(run / "section-tables")
    yield
    if before is None:
        del os.environ["QUARTERING_CACHE"]
    else:
        os.environ["QUARTERING_CACHE"] = before
