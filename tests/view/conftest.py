"""What many tests of the view need: a command to call, an explorer in a process of its own, a browser to visit it with."""

import os
import shutil
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from pathlib import Path
from urllib.parse import urlparse

import pytest
from typer.testing import CliRunner

from quartering.view.cli import app
from tests.view.pages import STABLE, filled

LONGEST_START = 600.0
"""A fresh checkout compiles its kernels first [s]."""


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Call a command with its words, in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return lambda *words: CliRunner().invoke(app, [str(word) for word in words])


class Explorer:
    """A running server: its address, and what it wrote so far."""

    def __init__(self, port, log, process):
        self.port, self.log, self.process = port, log, process
        self.address = f"http://127.0.0.1:{port}"

    def written(self):
        return self.log.read_text()

    def worked(self):
        """Processor time of the server [s]: what a call costs, however busy the machine."""
        if not Path("/proc/self/stat").exists():
            pytest.skip("the processor time of another program is read from /proc")
        fields = Path(f"/proc/{self.process}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@pytest.fixture(scope="session")
def explorer(tmp_path_factory):
    pytest.importorskip("nicegui", reason="the explorer needs the extra `app`")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    log = tmp_path_factory.mktemp("explorer") / "log.txt"
    words = ["app", "--no-browser", "--port", str(port)]
    call = f"import sys; sys.argv = ['quartering', *{words!r}]; from quartering.view.cli import main; main()"
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("NICEGUI", "PYTEST"))}
    with log.open("w") as out:
        server = subprocess.Popen([sys.executable, "-c", call], stdout=out, stderr=subprocess.STDOUT, env=environment)
    running = Explorer(port, log, server.pid)
    try:
        _await(running, server)
        yield running
    finally:
        server.terminate()
        try:
            server.wait(120)
        except subprocess.TimeoutExpired:
            server.kill()


def _await(running, server):
    end = time.monotonic() + LONGEST_START
    while time.monotonic() < end:
        assert server.poll() is None, running.written()
        try:
            with urllib.request.urlopen(f"{running.address}/api/docs", timeout=60):
                return
        except (urllib.error.URLError, ConnectionError, TimeoutError):
            time.sleep(0.2)
    raise TimeoutError(running.written())


FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
)  # fmt: skip
SHOWN = """() => [location.search, document.querySelector('.says').innerText, document.querySelectorAll('.wrong').length,
  ...[...document.querySelectorAll('[id^=number-]')].map(dial => Number(dial.value))].join('|')"""
"""What a page shows, in words: link, sentence, dials."""
AGAIN = "link => { history.pushState({}, '', link); dispatchEvent(new PopStateEvent('popstate')); }"
SIZE = {"width": 1440, "height": 1000}
SLOW = 300_000
"""How long a step may take on a machine that others use too [ms]."""


def _chromium():
    """The browser of this machine; a machine of CI must have one."""
    found = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if found is None and os.environ.get("CI") == "true":
        pytest.fail("no chromium on this machine, and CI must have one: `make browser` installs it", pytrace=False)
    if found is None:
        pytest.skip("no chromium on this machine; `make browser` installs it")
    return found


@pytest.fixture(scope="module")
def context():
    """One browser whose files are loaded once; every page in it is a visitor of its own."""
    playwright = pytest.importorskip("playwright.sync_api", reason="browser tests need playwright (extra `dev`)")
    chromium = _chromium()
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium, args=list(FLAGS))
        yield browser.new_context()
        browser.close()


def _opened(context, address, scheme="light", motion="reduce", **size):
    page = context.new_page()
    page.set_viewport_size(SIZE | size)
    page.emulate_media(color_scheme=scheme, reduced_motion=motion)
    page.set_default_timeout(SLOW)
    page.wrong, page.elsewhere = [], []
    page.on("pageerror", lambda error: page.wrong.append(str(error)))
    page.on("console", lambda said: page.wrong.append(said.text) if said.type == "error" else None)
    page.on("request", lambda asked: page.elsewhere.append(asked.url) if _far(asked.url) else None)
    page.goto(address)
    page.wait_for_selector(".says h1 b")
    return page


@pytest.fixture
def visit(context, explorer):
    """Open the page with a query. Errors, and requests to anywhere but this machine, are kept.

    The ship stands still unless motion is asked for: without a graphics card each picture of it is drawn by the processor.
    """
    pages = []

    def open_page(query="", **look):
        pages.append(_opened(context, f"{explorer.address}/?{query}", **look))
        return pages[-1]

    yield open_page
    for page in pages:
        page.close()


@pytest.fixture(scope="module")
def _standing(context, explorer):
    page = _opened(context, f"{explorer.address}/?{STABLE}")
    filled(page)
    page.link, page.first = page.evaluate("location.search"), page.evaluate(SHOWN)
    yield page
    page.close()


@pytest.fixture
def page(_standing):
    """A page at `STABLE` with its map, opened once a file: to open one takes five seconds of processor time.

    Before each test the link of the first view is gone to as Back does, until dials and sentence are those of the start.
    """
    _standing.set_viewport_size(SIZE)
    if _standing.locator(".dial.refused").count():  # a test that failed left a value that was refused
        _standing.reload()
    _standing.evaluate(AGAIN, _standing.link)  # whatever it shows: a link of the last test may still be under way
    _standing.wait_for_function(f"first => ({SHOWN})() === first", arg=_standing.first)
    filled(_standing)
    _standing.wrong.clear()
    _standing.elsewhere.clear()
    return _standing


def _far(url):
    return urlparse(url).scheme in ("http", "https", "ws") and urlparse(url).hostname != "127.0.0.1"
