"""Connections that take or send next to nothing are cut, so that nobody holds a place by being slow."""

from __future__ import annotations

import asyncio
import json
from typing import Any, Final

from uvicorn.protocols.http.auto import AutoHTTPProtocol

LONGEST_HEAD: Final = 20.0
"""Time a request may take to say what it wants [s]."""
LOOK: Final = 10.0
"""Time between two looks at a reader that keeps an answer waiting [s]."""
LEAST: Final = 10_000
"""What such a reader takes between two looks, or is cut off [bytes]."""


class Patient(AutoHTTPProtocol):  # type: ignore[misc, valid-type]
    """A connection of uvicorn with limits to its patience."""

    _head: asyncio.TimerHandle | None = None
    _reader: asyncio.TimerHandle | None = None
    _left: int = 0

    def connection_made(self, transport: Any) -> None:
        """Begin to wait for a request."""
        super().connection_made(transport)
        self._await_head()

    def data_received(self, data: bytes) -> None:
        """Wait for the rest of a request's head, or no longer."""
        super().data_received(data)
        if self._head is not None and not self._idle():
            self._head.cancel()
            self._head = None
        elif self._head is None and self._idle():
            self._await_head()

    def send_400_response(self, msg: str) -> None:
        """Answer what is no request in the shape of all refusals."""
        content = json.dumps({"error": f"this is no HTTP request: {msg}"}).encode()
        head = f"HTTP/1.1 400 \r\ncontent-type: application/json\r\ncontent-length: {len(content)}\r\nconnection: close\r\n\r\n"
        self.transport.write(head.encode() + content)
        self.transport.close()

    def pause_writing(self) -> None:
        """The reader is behind: look later whether it takes anything."""
        super().pause_writing()
        self._watch()

    def resume_writing(self) -> None:
        """The reader has caught up."""
        super().resume_writing()
        self._forget_reader()

    def connection_lost(self, exc: Exception | None) -> None:
        """Nothing is waited for any more."""
        if self._head is not None:
            self._head.cancel()
        self._forget_reader()
        super().connection_lost(exc)

    def _idle(self) -> bool:
        """Has no request begun since the last answer?"""
        return self.cycle is None or self.cycle.response_complete

    def _await_head(self) -> None:
        self._head = self.loop.call_later(LONGEST_HEAD, self._cut_silent)

    def _cut_silent(self) -> None:
        self._head = None
        if self._idle() and self.transport.get_protocol() is self:  # else it has become a socket
            self.transport.abort()

    def _watch(self) -> None:
        self._left = self.transport.get_write_buffer_size()
        self._reader = self.loop.call_later(LOOK, self._look)

    def _forget_reader(self) -> None:
        if self._reader is not None:
            self._reader.cancel()
            self._reader = None

    def _look(self) -> None:
        if self._left - self.transport.get_write_buffer_size() < LEAST:
            self.transport.abort()
        else:
            self._watch()
