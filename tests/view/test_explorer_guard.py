"""The guard before the explorer and its patience, each by itself: no kernel, no page."""

import asyncio
import json
import socket
import threading
import time
from types import SimpleNamespace

import pytest

pytest.importorskip("nicegui", reason="the explorer needs the extra `app`")

import uvicorn
from fastapi import HTTPException

from quartering.view.explorer.computing import guard, patience
from quartering.view.explorer.computing.guard import Guard
from quartering.view.explorer.computing.job_queue import JobQueue
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.service.problems import plain_names, without_paths

pytestmark = pytest.mark.quick


async def _answering(scope, receive, send):
    if scope["type"] == "websocket":
        await send({"type": "websocket.accept"})
        return
    while (await receive()).get("more_body"):
        pass
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": b"answered"})


def asked(headers, *, method="GET", path="/api/verdict", kind="http", messages=None, **own):
    """What the server says to one request."""
    said = []
    waiting = list(messages or [{"type": "http.request", "body": b"", "more_body": False}])

    async def receive():
        if not waiting:
            await asyncio.sleep(60)
        return waiting.pop(0)

    async def send(message):
        said.append(message)

    raw = [(name.encode(), value.encode("latin-1")) for name, value in headers]
    scope = {"type": kind, "method": method, "path": path, "headers": raw}
    asyncio.run(Guard(_answering, **own)(scope, receive, send))
    return said


def status(headers, **own):
    return asked(headers, **own)[0]["status"]


HERE = ("host", "127.0.0.1:8080")


@pytest.mark.parametrize(
    "host", ["127.0.0.1:8080", "localhost", "LOCALHOST:9000", "localhost.", "[::1]:8080", "127.0.0.2"]
)
def test_the_names_of_this_machine_are_answered(host):
    assert status([("host", host)]) == 200


@pytest.mark.parametrize(
    "hosts",
    [["other.example"], ["127.0.0.1.other.example"], ["localhost.other.example:80"], ["0.0.0.0"], ["10.0.0.1"], [""], [],
     ["localhost@other.example"], ["localhost", "other.example"], ["[::1"], ["[::1].other.example"]],
)  # fmt: skip
def test_a_foreign_name_is_refused(hosts):
    """A name that someone else lets lead to this machine makes a foreign page one of ours (DNS rebinding)."""
    assert status([("host", host) for host in hosts]) == 400


def test_an_open_server_is_asked_by_address_by_its_own_name_or_by_those_it_was_told():
    own = {"host": "0.0.0.0", "names": ["Ships.example"]}
    assert status([("host", "192.168.1.7:8080")], **own) == 200
    assert status([("host", socket.gethostname())], **own) == 200
    assert status([("host", "ships.example")], **own) == 200
    assert status([("host", "other.example")], **own) == 400


@pytest.mark.parametrize(
    "origin",
    ["http://other.example", "null", "", "http://127.0.0.1:3000", "http://localhost:8080", "file://", "127.0.0.1:8080"],
)
def test_a_page_of_another_origin_is_refused_on_http_and_socket(origin):
    assert status([HERE, ("origin", origin)]) == 403
    assert status([HERE, ("origin", origin)], method="POST", path="/_nicegui/client/1/upload/2") == 403
    closed = asked([HERE, ("origin", origin)], kind="websocket", path="/_nicegui_ws/socket.io/")
    assert [message["type"] for message in closed] == ["websocket.close"]


def test_our_own_pages_are_let_through_on_http_and_socket():
    own = [HERE, ("origin", "http://127.0.0.1:8080"), ("sec-fetch-site", "same-origin")]
    assert status(own) == 200
    assert asked(own, kind="websocket")[0]["type"] == "websocket.accept"
    assert status([("host", "ships.example"), ("origin", "https://ships.example:443")], names=["ships.example"]) == 200


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_a_picture_or_frame_of_another_page_starts_nothing_and_a_link_opens(site):
    def of(mode, dest):
        return [HERE, ("sec-fetch-site", site), ("sec-fetch-mode", mode), ("sec-fetch-dest", dest)]

    assert status(of("no-cors", "image")) == 403
    assert status(of("navigate", "iframe")) == 403
    assert status(of("navigate", "document"), method="POST", path="/") == 403
    assert status(of("navigate", "document"), path="/") == 200


@pytest.mark.parametrize("kind", ["", "text/plain", "application/x-www-form-urlencoded", "multipart/form-data"])
def test_what_costs_more_takes_json(kind):
    """A form of a foreign page can send these three without asking first; JSON it cannot."""
    assert status([HERE, ("content-type", kind)], method="POST") == 415
    assert status([HERE, ("content-type", "application/json; charset=utf-8")], method="POST") == 200


def test_a_refusal_has_the_shape_of_all():
    said = asked([("host", "other.example")])
    assert list(json.loads(said[1]["body"])) == ["error"]


def test_a_body_that_trickles_is_refused(monkeypatch):
    monkeypatch.setattr(guard, "_PATIENCE", 0.05)
    with pytest.raises(HTTPException) as refused:
        status([HERE], messages=[{"type": "http.request", "body": b"x", "more_body": True}])
    assert refused.value.status_code == 408


def test_a_place_in_the_line_is_free_when_its_caller_leaves():
    async def scene():
        jobs, begun = JobQueue(), threading.Event()
        held = threading.Event()

        def long():
            begun.set()
            held.wait(60)

        first = asyncio.ensure_future(jobs.take("one", long))
        while not begun.is_set():
            await asyncio.sleep(0.01)
        others = [asyncio.ensure_future(jobs.take("many", lambda: 1 / 0)) for _ in range(50)]
        last = asyncio.ensure_future(jobs.take("last", lambda: "served"))
        await asyncio.sleep(0)
        for other in others:
            other.cancel()
        await asyncio.gather(*others, return_exceptions=True)
        assert list(jobs._lines) == ["last"]
        held.set()
        await first
        return await last

    assert asyncio.run(scene()) == "served"


@pytest.mark.parametrize(
    ("said", "shown"),
    [
        ("/srv/ships/own.yaml, line 3: gm = -1 m", "own.yaml, line 3: gm = -1 m"),
        ('"/srv/a b/own.yaml" cannot be read', None),
        (r"C:\ships\own.yaml: no", "own.yaml: no"),
        ("1/s, N/m and kg m/s2, 3/4 of B", "1/s, N/m and kg m/s2, 3/4 of B"),
        ("see https://docs.example/a/b", "see https://docs.example/a/b"),
    ],
)
def test_visitors_see_no_path_of_this_machine(said, shown):
    found = without_paths(said)
    assert found == shown if shown is not None else "/srv" not in found
    assert plain_names({"a": [said, 1.0, None]}) == {"a": [found, 1.0, None]}


def test_a_ship_file_is_named_without_its_place(tmp_path):
    (tmp_path / "mine.yaml").write_text("base: wigley\nname: mine\n")
    (tmp_path / "wigley").write_text("base: wigley\nname: another\n")
    registry = ShipRegistry(str(tmp_path / "mine.yaml"))
    assert registry.first == "mine.yaml"
    assert registry.known("mine.yaml").ship.name == "mine"
    assert not any(str(tmp_path) in words for pair in registry.options().items() for words in pair)
    with pytest.raises(ValueError, match="unknown") as refused:
        registry.known("nothing")
    assert str(tmp_path) not in str(refused.value)


@pytest.fixture
def patient():
    """A server that answers 40 MB, with its port; a test shortens what patience it tries."""

    begun = threading.Event()

    async def large(scope, _receive, send):
        if scope["type"] != "http":
            return
        begun.set()
        await send({"type": "http.response.start", "status": 200, "headers": []})
        for _ in range(640):
            await send({"type": "http.response.body", "body": bytes(65536), "more_body": True})
        await send({"type": "http.response.body", "body": b""})

    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    config = uvicorn.Config(large, port=port, http=patience.Patient, log_level="critical", lifespan="off", ws="none")
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run)
    thread.start()
    while not server.started:
        time.sleep(0.01)
    yield SimpleNamespace(address=("127.0.0.1", port), state=server.server_state, begun=begun)
    server.should_exit = True
    thread.join(60)


def _read(sent, pause, most):
    taken = 0
    try:
        while taken < most and (piece := sent.recv(65536)):
            taken += len(piece)
            time.sleep(pause)
    except ConnectionError:
        pass
    return taken


GET = b"GET / HTTP/1.1\r\nhost: localhost\r\n\r\n"


def test_a_reader_who_takes_nothing_is_cut_off(patient, monkeypatch):
    monkeypatch.setattr(patience, "LOOK", 0.3)
    with socket.create_connection(patient.address, timeout=60) as sent:
        sent.sendall(GET)
        end = time.monotonic() + 300
        assert patient.begun.wait(300)
        while patient.state.connections:
            assert time.monotonic() < end, "it is not cut off"
            time.sleep(0.05)
        assert _read(sent, 0, 40_000_000) < 20_000_000  # what the sockets held


def test_a_reader_who_takes_something_is_not_cut_off(patient, monkeypatch):
    """It reads for longer than from one look to the next, and is never away so long, however busy the machine."""
    monkeypatch.setattr(patience, "LOOK", 1.0)
    with socket.create_connection(patient.address, timeout=60) as sent:
        sent.sendall(GET)
        assert _read(sent, 0.002, 40_000_000) >= 40_000_000


@pytest.mark.parametrize("head", [b"", b"GET / HT"])
def test_a_caller_who_never_says_what_it_wants_is_cut_off(patient, head, monkeypatch):
    monkeypatch.setattr(patience, "LONGEST_HEAD", 0.5)
    with socket.create_connection(patient.address, timeout=60) as sent:
        sent.sendall(head)
        assert _read(sent, 0, 1) == 0


def test_what_is_no_request_is_refused_in_the_shape_of_all(patient):
    with socket.create_connection(patient.address, timeout=60) as sent:
        sent.sendall(b"\x16\x03\x01\x02\x00 hello\r\n\r\n")
        head, _, content = sent.recv(65536).partition(b"\r\n\r\n")
    assert head.startswith(b"HTTP/1.1 400")
    assert list(json.loads(content)) == ["error"]
