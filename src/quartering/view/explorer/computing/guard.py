"""The guard before the application: who may ask, from where, how much and how slowly; nothing else reads a request before."""

from __future__ import annotations

import asyncio
import ipaddress
import json
import re
import socket
import time
from collections.abc import Iterable
from typing import Final

from fastapi import HTTPException
from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LARGEST_BODY: Final = 8_200_000
"""Largest request taken: an upload with what surrounds it [bytes]."""
LOOPBACK: Final = ("127.0.0.1", "localhost", "::1")
"""Addresses that only this machine reaches."""

_PATIENCE, _SLOWEST = 30.0, 2_000.0
"""Time a body may take however small it is [s], and what it brings in each further second [bytes]."""
_TOO_LARGE = f"the request is larger than {LARGEST_BODY / 1e6:.0f} MB; send a smaller file"
_TOO_SLOW = "the request came too slowly; send it again over a better line"
_NOT_JSON = "this address takes JSON; send it with the header content-type: application/json"
METHODS: Final = ["GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE"]
"""Methods that get as far as an address, which takes them or not."""
_READS = ("GET", "HEAD", "OPTIONS")
_OWN_HEADERS: Final = (
    (b"content-security-policy", b"frame-ancestors 'self'"),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"same-origin"),
)


class Guard:
    """Lets pass what this server's own pages, and programs, ask of the server by a name it goes by.

    A page elsewhere can send its visitors' browsers here. By the browser's own words it is told from ours: ``Host`` must be a
    name of this server (else a foreign name that was pointed at this machine would count as ours), ``Origin`` must be that
    host, on http and on the socket alike, and ``Sec-Fetch-Site`` must not be another site, but for a link that a person
    follows. Programs send neither of the last two, and need not.

    Parameters
    ----------
    inside : ASGI application
    host : str                  listened on
    names : iterable of str     further names the server goes by
    """

    def __init__(self, inside: ASGIApp, host: str = LOOPBACK[0], names: Iterable[str] = ()) -> None:
        self._inside = inside
        self._open = host not in LOOPBACK
        own = {socket.gethostname(), socket.getfqdn()} if self._open else set()
        self._names = {name.lower().strip("[].") for name in ("localhost", host, *own, *names)}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, its body counted on the way, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            await self._inside(scope, receive, send)
            return
        headers = Headers(scope=scope)
        wrong = self._foreign(scope, headers) or _too_much(scope, headers)
        if wrong is not None and scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": 1008, "reason": wrong[1][:100]})
        elif wrong is not None:
            await _refuse(send, *wrong)
        elif scope["type"] == "websocket":
            await self._inside(scope, receive, send)
        else:
            await self._inside(scope, _counted(receive), _marked(send))

    def _foreign(self, scope: Scope, headers: Headers) -> tuple[int, str] | None:
        """Status and reason where a request comes by a foreign name, or from a foreign page."""
        hosts, origins = headers.getlist("host"), headers.getlist("origin")
        if len(hosts) != 1 or not self._trusted(_name(hosts[0])):
            asked = hosts[0][:80] if hosts else "no host"
            return 400, (
                f'"{asked}" is no name of this server; ask for {", ".join(sorted(self._names))}, or start it with --name'
            )
        if any(_place(origin) != _place(f"{origin.partition('://')[0]}://{hosts[0]}") for origin in origins):
            return 403, "a page of another origin may not use this server; open its own page, or ask from a program"
        followed = headers.get("sec-fetch-mode") == "navigate" and headers.get("sec-fetch-dest") == "document"
        link = scope["type"] == "http" and scope["method"] == "GET" and followed
        if headers.get("sec-fetch-site", "none") not in ("none", "same-origin") and not link:
            return 403, "a page of another site may not use this server; open its own page, or ask from a program"
        return None

    def _trusted(self, name: str) -> bool:
        """Is a name of a request one of ours? No foreign page has an address in numbers that leads here."""
        if name in self._names:
            return True
        try:
            return ipaddress.ip_address(name).is_loopback or self._open
        except ValueError:
            return False


def _name(host: str) -> str:
    """Host of a request without its port; "" where it is not written as one."""
    found = re.fullmatch(r"(?:\[([0-9a-fA-F:.]+)\]|([A-Za-z0-9._-]+))(?::[0-9]*)?", host)
    return "" if found is None else (found[1] or found[2]).lower().removesuffix(".")


def _place(origin: str) -> str:
    """Host and port of an origin as one text; that of an origin that is none is like no other's."""
    scheme, found, place = origin.lower().partition("://")
    port = {"http": ":80", "https": ":443"}.get(scheme)
    if not found or port is None:
        return f"none {origin}"
    return place.removesuffix(port)


def _too_much(scope: Scope, headers: Headers) -> tuple[int, str] | None:
    """Status and reason where a request says it is too large, or is not what its address takes."""
    if scope["type"] != "http":
        return None
    if scope["method"] not in METHODS:
        return 405, f"{scope['method'][:20]} is a method no address here takes; try GET, or POST with JSON"
    said = headers.get("content-length", "0")
    if not said.isdigit() or int(said) > LARGEST_BODY:
        return 413, _TOO_LARGE
    kind = headers.get("content-type", "").partition(";")[0].strip().lower()
    if scope["path"].startswith("/api/") and scope["method"] not in _READS and kind != "application/json":
        return 415, _NOT_JSON
    return None


def _counted(receive: Receive) -> Receive:
    """The body of a request, as much and as slowly as is taken; whoever reads it answers the refusal."""
    taken, whole, begun = 0, False, time.monotonic()

    async def counted() -> Message:
        nonlocal taken, whole
        if whole:
            return await receive()  # that the caller leaves is waited for without a limit
        left = begun + _PATIENCE + taken / _SLOWEST - time.monotonic()
        try:
            message = await asyncio.wait_for(receive(), max(left, 0.001))
        except TimeoutError:
            raise HTTPException(408, _TOO_SLOW, {"connection": "close"}) from None
        taken += len(message.get("body", b""))
        whole = not message.get("more_body", False)
        if taken > LARGEST_BODY:
            raise HTTPException(413, _TOO_LARGE, {"connection": "close"})
        return message

    return counted


def _marked(send: Send) -> Send:
    """Answers with the headers that keep foreign pages from showing ours in a frame of theirs."""

    async def marked(message: Message) -> None:
        if message["type"] == "http.response.start":
            message = {**message, "headers": [*message.get("headers", []), *_OWN_HEADERS]}
        await send(message)

    return marked


async def _refuse(send: Send, status: int, reason: str) -> None:
    headers = [(b"content-type", b"application/json"), (b"connection", b"close")]
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": json.dumps({"error": reason}).encode()})
