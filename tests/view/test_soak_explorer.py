"""The explorer under load: many callers, callers who leave, hulls brought by browser again and again, whatever a schema allows.

Authority: the service's own description, and the library's answer to the same condition.
"""

import json
import socket
import subprocess
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from tests.view.test_explorer import BARGE, upload
from tests.view.test_explorer_service import CONDITION, LOST, ask

pytestmark = pytest.mark.soak

CALLS, AT_A_TIME = 500, 16


def _verdict_takes(explorer):
    """Processor time of one verdict, kernels compiled [s]."""
    ask(explorer, "/api/verdict", query=CONDITION)
    taken = []
    for heading in (20, 70, 120):
        begin = explorer.worked()
        assert ask(explorer, "/api/verdict", query=CONDITION | {"heading": heading})[0] == 200
        taken.append(explorer.worked() - begin)
    return float(np.median(taken))


def test_five_hundred_calls_are_answered_or_told_to_wait_and_the_next_is_served(explorer):
    """Sixteen at a time, some of ships that keep no course, whose cures are sought in vain; one in ten leaves at once."""
    random = np.random.default_rng(500)
    unsteady = {"ship": "dtc", "speed": 11.0, "heading": 20, "wave_length": 100, "wave_height": 5}
    cases = [CONDITION | {"heading": int(random.integers(5, 175))} for _ in range(5)] + [LOST, unsteady]

    def call(number):
        case = cases[number % len(cases)]
        if number % 10 == 9:
            content = json.dumps(case).encode()
            head = "POST /api/verdict HTTP/1.1\r\nhost: localhost\r\ncontent-type: application/json\r\n"
            with socket.create_connection(("127.0.0.1", explorer.port), timeout=600) as sent:
                sent.sendall(f"{head}content-length: {len(content)}\r\n\r\n".encode() + content)
            return None, {}
        return ask(explorer, "/api/verdict", case) if number % 3 == 0 else ask(explorer, "/api/verdict", query=case)

    alone = _verdict_takes(explorer)
    with ThreadPoolExecutor(AT_A_TIME) as pool:
        answers = list(pool.map(call, range(CALLS)))
    begin = explorer.worked()
    assert ask(explorer, "/api/verdict", query=CONDITION)[0] == 200
    took = explorer.worked() - begin
    for status, answer in answers:
        assert status in (None, 200, 503), answer
        assert status != 503 or list(answer) == ["error"]
    assert sum(status == 200 for status, _ in answers) > CALLS // 3
    print(Counter(status for status, _ in answers), f"next caller {took:.2f} s of processor time, alone {alone:.2f} s")
    assert took < 2 * alone + 0.2, (took, alone)  # processor time is counted in hundredths, beside that of the pages
    assert "Traceback" not in explorer.written()


def test_hulls_brought_by_browser_again_and_again(visit, explorer):
    page = visit()
    shown = "new URL(location).searchParams.get('ship')"
    for draught in (2.0, 2.5, 3.0, 3.5) * 5:
        before = page.evaluate(shown)
        upload(page, f"barge {draught}.csv", BARGE.encode(), draught=draught)
        page.wait_for_function(f"before => {shown} != before && {shown}.startsWith('upload-')", arg=before)
        page.get_by_label("draught [m]").wait_for(state="hidden")  # else the next click is lost on the closing dialog
    upload(page, "noise.csv", bytes(range(256)) * 40)
    for name, data in (
        ("noise.stl", bytes(range(256)) * 100),
        ("words.gdf", b"no numbers\n" * 9),
        ("one.csv", b"x,0,4\n0,5,5\n"),
    ):
        page.wait_for_function("document.querySelector('.upload-box').innerText.includes('.')")
        page.locator("input[type=file]").set_input_files({"name": name, "mimeType": "text/plain", "buffer": data})
    page.get_by_role("button", name="Cancel").click()
    assert page.wrong == []
    assert ask(explorer, "/api/verdict", query=CONDITION)[0] == 200
    assert "Traceback" not in explorer.written()


def test_whatever_the_description_allows_or_forbids_is_answered_as_described(explorer):
    """Calls made from the OpenAPI document: no status, shape or type of content that it does not name, and no fault (5xx)."""
    pytest.importorskip(
        "schemathesis", reason="calls from the OpenAPI document are made by schemathesis (extra `soak`)"
    )
    checks = "not_a_server_error,status_code_conformance,content_type_conformance,response_schema_conformance"
    command = [
        sys.executable, "-m", "schemathesis.cli", "run", f"{explorer.address}/api/openapi.json", "--url", explorer.address,
        "--checks", checks, "--max-examples", "100", "--seed", "16", "--request-timeout", "600",
    ]  # fmt: skip
    found = subprocess.run(command, capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stdout[-5000:]
    assert ask(explorer, "/api/verdict", query=CONDITION)[0] == 200
    assert "Traceback" not in explorer.written()
