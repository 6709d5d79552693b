"""Results kept on disk: whatever is changed in them is told and computed again, never read as a result."""

import json
import shutil

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering.study.grid import grid
from quartering.study.maps.result import open_result
from quartering.study.maps.stored.store import read_store
from quartering.study.maps.sweep import fill
from tests.tiers import mostly_soak

SHIP = qt.ship("wigley")
CONDITIONS = {
    "speed": [0.0, 5.0],
    "heading": [30.0, 60.0, 120.0],
    "wave_length": [80.0, 120.0],
    "wave_height": [1.0, 2.0],
}
WANTED = grid(SHIP, **CONDITIONS, gm=[0.8, 1.0]).in_blocks_of(8)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole") / "sweep"
    fill(WANTED, folder)
    return folder


@pytest.fixture
def folder(whole, tmp_path):
    return shutil.copytree(whole, tmp_path / "sweep")


def _files(folder):
    return {file.name: file.read_bytes() for file in sorted((folder / "blocks").iterdir())}


def _flipped(data, bit):
    changed = bytearray(data)
    changed[bit // 8] ^= 1 << bit % 8
    return bytes(changed)


@pytest.mark.parametrize("flips", mostly_soak([30, 150], 30))
def test_a_flipped_bit_is_never_read_as_a_number(folder, flips):
    """By definition: after a flip each number is the one that was written, or reading is refused; a rerun sees all flips."""
    expected, block = open_result(folder).load(), folder / "blocks" / "0000001.nc"
    data, random = block.read_bytes(), np.random.default_rng(16)
    refused = []
    for bit in random.integers(0, 8 * len(data), flips).tolist():
        block.write_bytes(_flipped(data, bit))
        assert read_store(folder).damaged() == [1]
        try:
            found = open_result(folder).load()
        except qt.InputError as error:
            refused.append(str(error))
        else:
            xr.testing.assert_identical(found, expected)
    assert all("damaged" in said for said in refused)
    assert refused  # the rest lies in units, names and coordinates, which are not read


@pytest.mark.parametrize("change", ["flip", "truncate", "empty", "longer", "zeros", "swap", "unsealed", "folder"])
def test_a_damaged_block_is_computed_again_and_said(change, folder, whole):
    one, other = folder / "blocks" / "0000001.nc", folder / "blocks" / "0000002.nc"
    data = one.read_bytes()
    if change == "swap":  # both are sound, and in the wrong place
        one.write_bytes(other.read_bytes())
        other.write_bytes(data)
    else:
        one.write_bytes(
            {"flip": _flipped(data, 8 * len(data) // 2), "truncate": data[:-9], "empty": b"", "longer": data + b"\0",
             "zeros": bytes(len(data)), "unsealed": data[: data.index(b'{"variables"')], "folder": b""}[change]
        )  # fmt: skip
    if change == "folder":
        one.unlink()
        one.mkdir()
        with pytest.raises(qt.InputError, match="cannot be written"), pytest.warns(qt.DamageWarning):
            fill(WANTED, folder)
        return
    said = "2 of 6 blocks are damaged \\(1, 2\\)" if change == "swap" else "1 of 6 blocks are damaged \\(1\\)"
    with pytest.warns(qt.DamageWarning, match=f"{said}.*computed again"):
        fill(WANTED, folder)
    assert _files(folder) == _files(whole)


def test_a_block_of_another_case_is_not_taken(folder, whole, tmp_path):
    fill(grid(SHIP, **(CONDITIONS | {"wave_height": [1.0, 2.5]}), gm=[0.8, 1.0]).in_blocks_of(8), tmp_path / "other")
    shutil.copy(tmp_path / "other" / "blocks" / "0000003.nc", folder / "blocks")
    with pytest.raises(qt.InputError, match="1 of 6 blocks are missing or damaged"):
        open_result(folder)
    with pytest.warns(qt.DamageWarning, match=r"\(3\)"):
        fill(WANTED, folder)
    assert _files(folder) == _files(whole)


def test_a_sealed_block_is_still_netcdf_for_both_libraries(folder):
    block = folder / "blocks" / "0000001.nc"
    roll = open_result(folder)["roll"]
    for engine in ("scipy", "netcdf4"):
        with xr.open_dataset(block, engine=engine) as opened:
            assert np.isin(opened["roll"].values, roll.values).all()


def _changed(**parts):
    return lambda text: json.dumps(json.loads(text) | parts)


def _other_axis(text):
    content = json.loads(text)
    content["case"]["wave_height"] = [1.0, 2.0000001]
    return json.dumps(content)


def _swapped_parts(text):
    content = json.loads(text)
    content["blocks"][0], content["blocks"][1] = content["blocks"][1], content["blocks"][0]
    return json.dumps(content)


def _without_blocks(text):
    return json.dumps({name: part for name, part in json.loads(text).items() if name != "blocks"})


MANIFESTS = {
    "half of it": (lambda text: text[: len(text) // 2], "cannot be read"),
    "empty": (lambda _: "", "cannot be read"),
    "a list": (lambda _: "[1, 2]", "does not describe a case"),
    "nothing": (lambda _: "null", "does not describe a case"),
    "no text": (lambda text: b"\xff\xfe" + text.encode(), "is no text"),
    "zeros": (lambda text: bytes(len(text)), "cannot be read"),
    "nested": (lambda _: "[" * 200_000, "cannot be read"),
    "a part gone": (_without_blocks, "lacks a part .blocks"),
    "a number changed": (_other_axis, "checksum does not fit"),
    "blocks swapped": (_swapped_parts, "checksum does not fit"),
    "blocks a word": (_changed(blocks="many"), "checksum does not fit"),
    "attributes a number": (_changed(attributes=3), "checksum does not fit"),
    "case a list": (_changed(case=[]), "checksum does not fit"),
    "a word changed": (lambda text: text.replace("Wigley", "Wiglez"), "checksum does not fit"),
    "layout a word": (_changed(layout="one"), "layout one"),
}  # fmt: skip


@pytest.mark.parametrize("way", MANIFESTS)
def test_a_damaged_description_is_told_and_nothing_is_touched(way, folder):
    change, said = MANIFESTS[way]
    manifest, before = folder / "case.json", _files(folder)
    changed = change(manifest.read_text())
    manifest.write_bytes(changed if isinstance(changed, bytes) else changed.encode())
    kept = manifest.read_bytes()
    for ask in (lambda: open_result(folder), lambda: fill(WANTED, folder), lambda: open_result(folder, partial=True)):
        with pytest.raises(qt.InputError, match=said):
            ask()
    assert _files(folder) == before
    assert manifest.read_bytes() == kept
