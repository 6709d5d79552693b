"""Results of a sweep on disk: one small netCDF file a block, complete or not there at all, and a description of the case."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from quartering._machine.digest import fingerprint, source_digest
from quartering._machine.publish import publish
from quartering.conventions import InputError
from quartering.study.dataset import plain_attributes
from quartering.study.grid import Grid
from quartering.study.maps.kinds import StudyKind, kind_of
from quartering.study.maps.stored.block_file import Arrays, belongs, block_file, counted, part_of
from quartering.study.maps.stored.seal import DamagedError, is_sound, read_index, read_variable

LAYOUT = 3
"""Number of the layout of the folder; another one is refused."""
MANIFEST = "case.json"
_BLOCKS = "blocks"
_CHECKED = ("hash", "case", "text", "block_size", "blocks", "attributes")


@dataclass(frozen=True)
class Store:
    """A folder that holds the results of one case.

    Parameters
    ----------
    folder : Path
    content : mapping    of its manifest: layout, version, case, hash, text, blocks, attributes
    """

    folder: Path
    content: Mapping[str, Any]

    def block(self, index: int) -> Path:
        """File of one block."""
        return self.folder / _BLOCKS / f"{index:07d}.nc"

    @property
    def count(self) -> int:
        """Number of blocks."""
        return len(self.content["blocks"])

    def missing(self) -> list[int]:
        """Blocks that are not there, or whose seal is not that of this case and place."""
        return [i for i in range(self.count) if self.index(i) is None]

    def damaged(self) -> list[int]:
        """Blocks that are there, but not byte for byte as they were written: every byte is read."""
        there = [i for i in range(self.count) if self.block(i).exists()]
        return [i for i in there if self.index(i) is None or not is_sound(self.block(i))]

    def index(self, index: int) -> dict[str, Any] | None:
        """What the seal of a block holds; None where there is none, or that of another case or place."""
        try:
            found = read_index(self.block(index))
        except (OSError, DamagedError):
            return None
        own = belongs(self.content["hash"], self.content["blocks"][index])
        return found if own.items() <= found.items() else None


def open_store(folder: str | Path, grid: Grid) -> Store:
    """The store of a grid: made when the folder is new or empty, checked when it holds results already."""
    path = Path(folder)
    if path.exists() and not path.is_dir():
        raise InputError(f'store "{path}" is a file; give the name of a folder to put the results in')
    if (path / MANIFEST).exists():
        return _same_case(read_store(path), grid)
    if path.is_dir() and any(not entry.name.endswith(".part") for entry in path.iterdir() if entry.name != _BLOCKS):
        raise InputError(
            f'store "{path}" holds other files and no {MANIFEST}, so it is not a sweep; give a new or empty folder'
        )
    if any((path / _BLOCKS).glob("*.nc")):
        raise InputError(
            f'store "{path}" holds blocks of a case that is not known, since {MANIFEST} is missing; put that file back, or give'
            " another folder"
        )
    content = _manifest(grid)
    try:
        (path / _BLOCKS).mkdir(parents=True, exist_ok=True)
        publish(path / MANIFEST, json.dumps(content, indent=1).encode())
    except OSError as error:
        raise InputError(
            f'store "{path}" cannot be written ({error.strerror or error}); give a folder you may write to'
        ) from None
    return Store(path, content)


def begun_block_size(folder: str | Path) -> int | None:
    """Conditions of a block in the store that a folder holds, None where it holds none yet."""
    if not (Path(folder) / MANIFEST).exists():
        return None
    return int(read_store(folder).content.get("block_size", 0))


def read_store(folder: str | Path) -> Store:
    """The store in a folder, its manifest checked."""
    path = Path(folder)
    try:
        content = json.loads((path / MANIFEST).read_bytes().decode("utf-8"))
        layout = content["layout"]
        lacking = [name for name in (*_CHECKED, "version", "code", "checksum") if name not in content]
        changed = not lacking and content["checksum"] != _checksum(content)
    except FileNotFoundError:
        raise InputError(f'"{path}" is not the result of a sweep: there is no {MANIFEST} in it') from None
    except (OSError, ValueError, LookupError, TypeError, RecursionError) as error:
        raise InputError(
            f'"{path / MANIFEST}" cannot be read ({_words(error)}); the blocks beside it are untouched: put the file back, or'
            " compute into another folder"
        ) from None
    if layout != LAYOUT:
        raise InputError(
            f'"{path}" was written in layout {layout} by quartering {content.get("version")}; this is quartering'
            f" {version('quartering')}, which reads layout {LAYOUT}: compute into another folder, or use that version"
        )
    if lacking:
        raise InputError(
            f'"{path / MANIFEST}" lacks a part ({", ".join(lacking)}); the blocks beside it are untouched: put the whole file'
            " back, or compute into another folder"
        )
    if changed:
        raise InputError(
            f'"{path / MANIFEST}" is not what was written: its checksum does not fit; the blocks beside it are untouched: put'
            " the file back as it was, or compute into another folder"
        )
    return Store(path, content)


def _words(error: Exception) -> str:
    """Why a manifest cannot be read, without the words of the interpreter."""
    if isinstance(error, OSError):
        return error.strerror or str(error)
    if isinstance(error, UnicodeDecodeError):
        return f"byte {error.start} is no text"
    return f"no JSON: {error}" if isinstance(error, json.JSONDecodeError) else "it does not describe a case"


def _checksum(content: Mapping[str, Any]) -> str:
    """Checksum of all that a manifest says of its case; version and code are compared by themselves."""
    return fingerprint({name: content[name] for name in _CHECKED})


def write_block(store: Store, index: int, found: Arrays, grid: Grid) -> dict[str, int]:
    """Put one block of results into a store, whole or not at all.

    found: from `evaluate_block`
    Returns what it counts, see `counted`
    """
    counts = counted(found, kind_of(grid))
    data = block_file(index, found, grid, counts)
    try:
        publish(store.block(index), data)
    except OSError as error:
        raise InputError(
            f'store "{store.folder}" cannot be written ({error.strerror or error}); the finished blocks are kept: free'
            " some space and run the same command again, only what is missing is computed"
        ) from None
    return counts


def block_counts(store: Store, index: int) -> dict[str, int]:
    """What a block already written counts."""
    counts: dict[str, int] = _index(store, index)["counts"]
    return counts


def _index(store: Store, index: int) -> dict[str, Any]:
    found = store.index(index)
    if found is None:
        raise _lost(store, index)
    return found


def _lost(store: Store, index: int) -> InputError:
    what = "is damaged" if store.block(index).exists() else "is missing"
    return InputError(
        f'"{store.folder}": block {index} of {store.count} {what}; run the same sweep again, only what is missing or damaged is'
        " computed"
    )


def read_block(store: Store, index: int, name: str) -> NDArray[np.generic]:
    """One variable of one block.

    name: of a result, or encounter_frequency
    Returns (l, m, h, ...): in this machine's byte order
    """
    found = _index(store, index)
    try:
        return read_variable(store.block(index), name, found)
    except (OSError, DamagedError):
        raise _lost(store, index) from None


def _manifest(grid: Grid) -> dict[str, Any]:
    """What a store says about its case."""
    content = {
        "layout": LAYOUT,
        "version": version("quartering"),
        "code": code_digest(kind_of(grid)),
        "hash": fingerprint(grid.described),
        "case": grid.described,
        "text": grid.text,
        "block_size": grid.block_size,
        "blocks": [part_of(block) for block in grid.blocks],
        "attributes": plain_attributes(kind_of(grid).heading(grid)),
    }
    return content | {"checksum": _checksum(json.loads(json.dumps(content)))}


def _same_case(store: Store, grid: Grid) -> Store:
    """The store, when it belongs to this case and version."""
    content, wanted = store.content, _manifest(grid)
    if content.get("hash") != wanted["hash"] or content.get("blocks") != wanted["blocks"]:
        old = content.get("case", {})
        changed = [key for key, value in wanted["case"].items() if old.get(key) != value]
        raise InputError(
            f'store "{store.folder}" holds another case: {_changes(old, wanted["case"], changed)}. What it holds is kept;'
            " go back to that case to continue it, or give another folder for this one"
        )
    if content.get("version") != wanted["version"]:
        raise InputError(
            f'store "{store.folder}" was begun by quartering {content.get("version")}, this is {wanted["version"]}: blocks of'
            " two versions are not mixed; use that version to finish it, or give another folder"
        )
    if content.get("code") != wanted["code"]:
        raise InputError(
            f'store "{store.folder}" was begun with other source files of quartering {wanted["version"]}, so its blocks may'
            " differ from new ones; go back to those files to finish it, or give another folder"
        )
    return store


def code_digest(kind: StudyKind) -> str:
    """Digest of the source files that decide the numbers.

    Returns 16 hexadecimal digits, equal for equal installations
    """
    return source_digest("hull", "hydro", "loads", "motion", "stability", *kind.code)


def _changes(old: Mapping[str, Any], new: Mapping[str, Any], keys: list[str]) -> str:
    """What differs between two cases, in words."""

    def words(value: Any) -> str:
        if isinstance(value, list) and len(value) > 1:
            return f"{len(value)} values from {min(value):g} to {max(value):g}"
        if isinstance(value, list):
            return f"{value[0]:g}" if value else "none"
        if isinstance(value, dict) and "digest" in value:
            return f"{value['name']} ({value['digest'][:8]})"
        if isinstance(value, dict):
            return ", ".join(f"{k} {words(v)}" for k, v in value.items()) or "none"
        return "none" if value is None else str(value)

    return "; ".join(f"{key} there {words(old.get(key))}, here {words(new[key])}" for key in keys) or "other blocks"
