"""What the server says when it refuses: one shape for every error, and no path of this machine in it."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path
from typing import Any

from fastapi.responses import JSONResponse
from pydantic import BaseModel, Field


class Problem(BaseModel):
    """What every refusal holds, whatever its status."""

    error: str = Field(description="why, and what to do about it")


STATUSES: dict[int, str] = {
    400: "the request is none, or asks for a host this server is not",
    401: "the server is open to others and asks for its token",
    403: "the request comes from a page of another origin",
    404: "no such address",
    405: "the address takes another method",
    408: "the request was sent too slowly",
    413: "the request is too large",
    415: "the request is not JSON",
    422: "what is asked for cannot be; the reason names the field",
    500: "a fault of the server",
    503: "too many callers: try again after the seconds of Retry-After",
}
"""Status of a refusal -> when it is given."""

_PATH = re.compile(r"(?<![\w.:/\\-])(?:[A-Za-z]:)?[/\\](?:[^\s/\\\"':;,]+[/\\])+")
_OWN = tuple(sorted({f"{place}/" for place in (tempfile.gettempdir(), Path.home(), Path.cwd())}, key=len, reverse=True))


def responses(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """Refusals of a route, for its description."""
    return {status: {"model": Problem, "description": STATUSES[status]} for status in statuses}


def refused(reason: str, status: int = 422, **headers: str) -> JSONResponse:
    """An answer that says why there is none."""
    if status == 503:
        headers["retry-after"] = "1"
    return JSONResponse({"error": reason}, status_code=status, headers=headers)


def without_paths(text: str) -> str:
    """A text in which files of this machine are called by their names alone."""
    for place in _OWN:
        text = text.replace(place, "/")
    text = _PATH.sub("", text)
    return re.sub(r"(?<![\w.:/\\])/(?=[\w.-]+\.\w)", "", text)


def plain_names(content: Any) -> Any:
    """The same content with `without_paths` in every text."""
    if isinstance(content, str):
        return without_paths(content) if "/" in content or "\\" in content else content
    if isinstance(content, dict):
        return {key: plain_names(value) for key, value in content.items()}
    return [plain_names(value) for value in content] if isinstance(content, (list, tuple)) else content
