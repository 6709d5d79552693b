"""Compiled kernels are thrown away when any source changed.

The compiler's cache looks at a kernel's own file only; a kernel whose callee in another file changed would stay stale.
"""

import hashlib
import os
from pathlib import Path

import pytest
from hypothesis import settings

os.environ.setdefault("NUMBA_OPT", "1")  # as on the command line: compiled sooner, and as fast
SOURCES = Path(__file__).parents[1] / "src" / "quartering"

# Seeds are explicit: the same examples every time, so that a red run means a change.
settings.register_profile("same", derandomize=True)
settings.load_profile("same")


def pytest_configure(config):
    digest = hashlib.sha256()
    for file in sorted(SOURCES.rglob("*.py")):
        if "njit" in (text := file.read_text()) or "quartering.compiled" in text:
            digest.update(text.encode())
    if getattr(config, "cache", None) is None or config.cache.get("quartering/kernels", None) == digest.hexdigest():
        return
    for compiled in SOURCES.rglob("__pycache__/*.nb[ic]"):
        compiled.unlink(missing_ok=True)
    config.cache.set("quartering/kernels", digest.hexdigest())


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
