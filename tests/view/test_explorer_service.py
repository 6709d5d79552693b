"""The service beside the pages: its answers are the library's, and what it is given wrongly does not hurt it."""

import json
import re
import socket
import threading
import urllib.error
import urllib.parse
import urllib.request

import numpy as np
import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.view.cli import app
from tests.view.service import ask

CONDITION = {"ship": "series60-cb60", "speed": 7.5, "heading": 30, "wave_length": 150, "wave_height": 4}
MAP = {
    "ship": "series60-cb60",
    "gm": 0.9,
    "speed": [5.0, 7.5],
    "heading": [30, 60],
    "wave_length": [100, 150],
    "steepness": 0.02,
}


def test_verdict_is_that_of_the_command(explorer):
    status, served = ask(explorer, "/api/verdict", query=CONDITION)
    words = ["--heading", "30", "--speed", "7.5", "--wave-length", "150", "--wave-height", "4", "--json"]
    printed = json.loads(CliRunner().invoke(app, ["verdict", "series60-cb60", *words]).stdout)
    assert status == 200
    assert served.pop("notes") == []
    assert served == printed
    assert ask(explorer, "/api/verdict", CONDITION)[1] == served | {"notes": []}


def test_polar_is_that_of_the_library(explorer):
    status, served = ask(explorer, "/api/polar", MAP)
    assert status == 200
    waves = [qt.Wave(length, 0.02 * length) for length in MAP["wave_length"]]
    ds = qt.polar(qt.ship("series60-cb60").with_(gm=0.9), waves, MAP["speed"], MAP["heading"])
    for name in ("roll", "k2", "exponent"):
        np.testing.assert_allclose(np.array(served[name], dtype=float), ds[name].values, rtol=1e-12)
        assert served["units"][name] == ds[name].attrs["units"]
    assert served["verdict"][0][0][0] == "stable"
    assert "C_D" in served["estimated_coefficients"]
    assert ask(explorer, "/api/polar", query=MAP) == (405, {"error": "/api/polar takes POST, not GET"})


def test_bilge_keels_can_be_asked_for(explorer):
    keels = {"bilge_keel_length": 30.0, "bilge_keel_breadth": 0.3}
    served = ask(explorer, "/api/polar", MAP | keels)[1]
    waves = [qt.Wave(length, 0.02 * length) for length in MAP["wave_length"]]
    fitted = qt.ship("series60-cb60").with_(gm=0.9, roll_damping="ikeda", bilge_keels=(30.0, 0.3))
    ds = qt.polar(fitted, waves, MAP["speed"], MAP["heading"])
    np.testing.assert_allclose(np.array(served["roll"], dtype=float), ds["roll"].values, rtol=1e-12)


@pytest.mark.parametrize(
    ("path", "content", "reason"),
    [
        ("/api/verdict", CONDITION | {"bilge_keel_length": 30}, "give both"),
        ("/api/verdict", CONDITION | {"bilge_keel_length": 30, "bilge_keel_breadth": 9}, "it is from 0 m to 0.25 B"),
        ("/api/verdict", CONDITION | {"speed": float("nan")}, "speed = .*finite"),
        ("/api/verdict", CONDITION | {"wave_height": float("inf")}, "wave_height = .*finite"),
        ("/api/verdict", CONDITION | {"wave_height": 100}, "breaks"),
        ("/api/verdict", CONDITION | {"ship": "/etc/passwd"}, "unknown"),
        ("/api/verdict", CONDITION | {"speeed": 3}, "speeed"),
        ("/api/verdict", CONDITION | {"gm": -0.1}, "gm"),
        ("/api/verdict", CONDITION | {"harmonics": 2}, "harmonics"),
        ("/api/verdict", {"ship": "wigley"}, "speed"),
        ("/api/verdict", b"{not json", "JSON"),
        ("/api/polar", MAP | {"heading": [float("nan")]}, "finite"),
        (
            "/api/polar",
            MAP | {"heading": [i / 10 for i in range(1000)], "speed": [i / 100 for i in range(1000)]},
            "cells",
        ),
        ("/api/polar", MAP | {"wave_height": 2.0}, "one of the two"),
        ("/api/polar", MAP | {"wave_length": []}, "wave_length"),
        ("/api/polar", MAP | {"wave_length": [100, 100]}, "once"),
    ],
)
def test_a_call_that_cannot_be_is_refused_with_the_reason(explorer, path, content, reason):
    status, answer = ask(explorer, path, content)
    assert status == 422
    assert re.search(reason, answer["error"]), answer["error"]


def test_the_service_describes_itself_without_the_network(explorer):
    with urllib.request.urlopen(f"{explorer.address}/api/docs") as answer:
        page = answer.read().decode()
    assert "/api/verdict" in page
    assert "wave_length" in page
    assert "src=" not in page
    assert "https:" not in page
    with urllib.request.urlopen(f"{explorer.address}/api/openapi.json") as answer:
        names = ("verdict", "polar", "sea", "guidance", "criteria")
        assert set(json.load(answer)["paths"]) == {f"/api/{name}" for name in names}


LOST = {"ship": "dtmb5415", "gm": 0.38, "speed": 11.7, "heading": 40, "wave_length": 284, "wave_height": 21.8}
"""A motion that is unstable: the cures of it are sought, which takes some hundred verdicts."""


def test_cures_are_sought_by_post_alone(explorer):
    assert ask(explorer, "/api/verdict", query=LOST)[1]["cures"] is None
    cures = ask(explorer, "/api/verdict", LOST)[1]["cures"]
    ship, wave = qt.ship("dtmb5415").with_(gm=0.38), qt.Wave(284.0, 21.8)
    expected = [(cure.parameter, pytest.approx(cure.needed, rel=1e-9)) for cure in qt.cures(ship, wave, 11.7, 40.0)[:3]]
    assert expected
    assert [(cure["parameter"], cure["needed"]) for cure in cures] == expected


@pytest.mark.parametrize(
    ("method", "path", "headers", "data", "status"),
    [
        ("GET", "/api/nothing", {}, None, 404),
        ("GET", "/api/polar", {}, None, 405),
        ("DELETE", "/api/verdict", {"content-type": "application/json"}, None, 405),
        ("POST", "/api/verdict", {"content-type": "text/plain"}, b"{}", 415),
        ("POST", "/api/polar", {"content-type": "application/x-www-form-urlencoded"}, b"ship=wigley", 415),
        ("POST", "/api/polar", {"content-type": "application/json", "origin": "http://other.example"}, b"{}", 403),
        ("GET", "/api/verdict", {"host": "other.example"}, None, 400),
        ("GET", "/api/verdict", {"origin": "null"}, None, 403),
        ("GET", "/api/verdict", {"sec-fetch-site": "cross-site", "sec-fetch-dest": "image"}, None, 403),
        ("GET", "/api/verdict", {}, None, 422),
        ("POST", "/api/verdict", {"content-type": "application/json"}, b"{", 422),
        ("POST", "/api/verdict", {"content-type": "application/json"}, b"\xff\x02", 400),
        ("PROPFIND", "/api/verdict", {}, None, 405),
        ("GET", "/_nicegui_ws/socket.io/?EIO=4&transport=polling", {"origin": "http://other.example"}, None, 403),
    ],
)
def test_every_refusal_has_the_documented_shape(explorer, method, path, headers, data, status):
    request = urllib.request.Request(explorer.address + path, data, headers, method=method)
    with pytest.raises(urllib.error.HTTPError) as refused, urllib.request.urlopen(request, timeout=600):
        pass
    with refused.value as answer:
        assert answer.code == status
        assert answer.headers["access-control-allow-origin"] is None
        content = json.loads(answer.read())
    assert list(content) == ["error"]
    assert content["error"]


def test_the_refusals_are_described(explorer):
    with urllib.request.urlopen(f"{explorer.address}/api/openapi.json") as answer:
        described = json.load(answer)
    for path, methods in described["paths"].items():
        for method, route in methods.items():
            for status in set(route["responses"]) - {"200"}:
                shape = route["responses"][status]["content"]["application/json"]["schema"]
                assert shape == {"$ref": "#/components/schemas/Problem"}, (path, method, status)
    assert described["components"]["schemas"]["Problem"]["required"] == ["error"]


def test_a_caller_who_leaves_frees_its_place_at_once(explorer):
    """Sixty callers ask for large maps and leave; of those who stay none is told to wait, and a verdict is answered."""
    large = MAP | {
        "heading": [i / 2 for i in range(360)],
        "speed": [1.0, 2.0, 3.0, 4.0],
        "wave_length": list(range(100, 110)),
    }
    content = json.dumps(large).encode()
    head = "POST /api/polar HTTP/1.1\r\nhost: localhost\r\ncontent-type: application/json\r\n"
    head += f"content-length: {len(content)}\r\n\r\n"
    for _ in range(60):
        with socket.create_connection(("127.0.0.1", explorer.port), timeout=300) as sent:
            sent.sendall(head.encode() + content)
    for _ in range(3):
        assert ask(explorer, "/api/verdict", CONDITION)[0] == 200


def test_a_200_megabyte_upload_is_refused_before_it_is_sent(explorer):
    head = "POST /_nicegui/client/x/upload/1 HTTP/1.1\r\nhost: localhost\r\ncontent-length: 200000000\r\n\r\n"
    with socket.create_connection(("127.0.0.1", explorer.port), timeout=300) as sent:
        sent.sendall(head.encode())
        assert b" 413 " in sent.recv(200)


def sent_until_cut(sent, piece, most):
    """Number of pieces the other side took."""
    for count in range(most):
        try:
            sent.sendall(piece)
        except OSError:
            return count
    return most


def test_an_endless_upload_is_cut_off_and_others_notice_nothing(explorer):
    head = "POST /api/polar HTTP/1.1\r\nhost: localhost\r\ncontent-type: application/json\r\ntransfer-encoding: chunked\r\n\r\n"
    with socket.create_connection(("127.0.0.1", explorer.port), timeout=300) as sent:
        sent.sendall(head.encode())
        pieces = sent_until_cut(sent, b"10000\r\n" + b"x" * 65536 + b"\r\n", 3200)
    assert pieces * 65536 < 60e6  # what was taken, and what the sockets hold
    assert ask(explorer, "/api/verdict", CONDITION)[0] == 200
    assert "Traceback" not in explorer.written()


def test_many_callers_at_once_all_get_their_own_answer(explorer):
    headings = list(range(10, 170, 10))
    found = {}

    def call(heading):
        found[heading] = ask(explorer, "/api/verdict", CONDITION | {"heading": heading})[1]["condition"]["heading"]

    callers = [threading.Thread(target=call, args=(heading,)) for heading in headings]
    for caller in callers:
        caller.start()
    for caller in callers:
        caller.join()
    assert found == {heading: heading for heading in headings}


def test_a_port_that_is_taken_is_refused(explorer):
    result = CliRunner().invoke(app, ["app", "--no-browser", "--port", str(explorer.port)])
    assert result.exit_code == 2
    assert f"port {explorer.port}" in result.stderr
    assert "--port" in result.stderr


def test_a_missing_extra_is_one_message(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    result = CliRunner().invoke(app, ["app", "--no-browser"])
    assert result.exit_code == 2
    assert "pip install 'quartering[app]'" in result.stderr
