"""Hulls people bring: files of limited size and known type, read as data in a private folder that is gone afterwards."""

from __future__ import annotations

import hashlib
import json
import re
import tempfile
from pathlib import Path
from typing import NamedTuple

from quartering.conventions import InputError
from quartering.hull.file.new_from_offsets import beam_afloat, checked_extent
from quartering.hull.file.read import ship
from quartering.hull.formats.offset_tables import Lines
from quartering.hull.formats.read import read_lines
from quartering.view.explorer.hulls.ship_registry import Known

LARGEST = 8_000_000
"""Largest file taken [bytes]."""

ENDINGS = (".csv", ".txt", ".tsv", ".gdf", ".stl", ".out", ".dat", ".pdstrip")
"""Endings taken; the last three are read as PDSTRIP section files."""

_SHIP_FILE = "ship.yaml"


class Sizes(NamedTuple):
    """Dimensions that go with a file of lines [m], and the unit of its numbers; None: taken from the lines where they tell."""

    length: float | None = None
    beam: float | None = None
    draught: float | None = None
    unit: str | None = None


def check_file(name: str, size: int) -> None:
    """Refuse a file by its name or size, before it is looked into.

    >>> check_file("hull.exe", 100)
    Traceback (most recent call last):
    ...
    quartering.conventions.InputError: hull.exe: files that end in .csv, .txt, .tsv, .gdf, .stl, .out, .dat or .pdstrip ...
    """
    if Path(name).suffix.lower() not in ENDINGS:
        raise InputError(f"{name}: files that end in {', '.join(ENDINGS[:-1])} or {ENDINGS[-1]} can be read")
    if not 0 < size <= LARGEST:
        raise InputError(
            f"{name}: {size / 1e6:.3g} MB; a file of up to {LARGEST / 1e6:g} MB is taken, not an empty one"
        )


def hull_of_upload(name: str, data: bytes, sizes: Sizes = Sizes()) -> Known:  # noqa: B008  # immutable
    """Ship of an uploaded file of lines, with assumed loading.

    name: of the file, as its owner calls it
    sizes: draught is needed where heights count from the baseline
    Returns its key is the digest of file and dimensions
    """
    called = _safe(name)
    check_file(called, len(data))
    with tempfile.TemporaryDirectory(prefix="quartering-") as folder:
        path = Path(folder) / called
        path.write_bytes(data)
        try:
            text = _ship_file(called, read_lines(path, None, sizes.draught, unit=sizes.unit), sizes)
            (Path(folder) / _SHIP_FILE).write_text(text, encoding="utf-8")
            made = ship(Path(folder) / _SHIP_FILE)
        except InputError as error:
            raise InputError(_without(folder, str(error))) from None
        except (ArithmeticError, LookupError, ValueError, MemoryError) as error:
            raise InputError(f"{called}: no hull can be made of it ({type(error).__name__}: {error})") from None
    digest = hashlib.sha256(data + text.encode()).hexdigest()[:24]
    return Known(f"upload-{digest}", called, made, {_SHIP_FILE: text.encode(), called: data})


def _ship_file(name: str, lines: Lines, sizes: Sizes) -> str:
    """Ship file that points at the lines; JSON is YAML, and quotes every text."""
    longest = checked_extent(name, lines)
    lowest = min(float(height[0]) for _, height in lines.contours)
    draught = sizes.draught or (-lowest if lines.afloat else None)
    if draught is None:
        raise InputError(f"{name}: its heights count from the baseline; give the draught and draw it again")
    content = {
        "name": Path(name).stem,
        "length": f"{sizes.length or longest:.10g} m",
        "beam": f"{sizes.beam or beam_afloat(lines, draught):.10g} m",
        "draught": f"{draught:.10g} m",
        "lines": {"file": name, "midship": 0.5 * (float(lines.x[0]) + float(lines.x[-1]))}
        | ({"unit": sizes.unit} if sizes.unit else {}),
    }
    return "".join(f"{key}: {json.dumps(value)}\n" for key, value in content.items())


def _safe(name: str) -> str:
    """The last part of a name, without anything a file system might mind."""
    last = re.split(r"[/\\]", name)[-1]
    cleaned = re.sub(r"[^A-Za-z0-9._-]+", "-", last).lstrip(".-")[-80:]
    return cleaned if Path(cleaned).stem not in ("", Path(_SHIP_FILE).stem) else f"hull-{cleaned or 'file'}"


def _without(folder: str, message: str) -> str:
    """A message that does not tell where the server keeps its files."""
    for hidden in (f"{folder}/{_SHIP_FILE}: ", f"{folder}/", folder):
        message = message.replace(hidden, "")
    return message
