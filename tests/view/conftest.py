"""An explorer for the tests that need one: a real server in a process of its own."""

import os
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request

import pytest

LONGEST_START = 600.0
"""A fresh checkout compiles its kernels first [s]."""


class Explorer:
    """A running server: its address, and what it wrote so far."""

    def __init__(self, port, log):
        self.port, self.log = port, log
        self.address = f"http://127.0.0.1:{port}"

    def written(self):
        return self.log.read_text()


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
    running = Explorer(port, log)
    try:
        _await(running, server)
        yield running
    finally:
        server.terminate()
        server.wait(30)


def _await(running, server):
    end = time.monotonic() + LONGEST_START
    while time.monotonic() < end:
        assert server.poll() is None, running.written()
        try:
            with urllib.request.urlopen(f"{running.address}/api/docs", timeout=5):
                return
        except (urllib.error.URLError, ConnectionError, TimeoutError):
            time.sleep(0.2)
    raise TimeoutError(running.written())
