"""Section tables on disk: found again to the bit, and never believed when a file is not whole."""

import os
import subprocess
import sys
import time

import numpy as np
import pytest

from quartering._machine import cache
from quartering._machine.cache import cache_folder, cached
from quartering.hull.file.read import ship
from quartering.hull.lines.immersed import strips
from quartering.hydro.strip import table
from quartering.hydro.strip.table import default_frequencies, radiation_table
from tests.tiers import mostly_soak

DTC = ship("dtc").hull
W = default_frequencies(DTC.beam, DTC.draught, 12)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv(cache.PLACE, str(tmp_path / "kept"))
    return tmp_path / "kept"


def test_a_table_read_from_disk_is_the_one_computed_to_the_bit(folder, monkeypatch):
    first = radiation_table(strips(DTC), W, 1025.0)
    assert len(list(folder.iterdir())) == 1
    monkeypatch.setattr(table, "close_fit", lambda *_, **__: pytest.fail("computed again"))
    again = radiation_table(strips(DTC), W, 1025.0)
    for name in ("frequency", "a", "b", "y", "z", "ny", "nz", "psi", "a_zero", "a_infinite"):
        one, other = getattr(first, name), getattr(again, name)
        assert one.tobytes() == other.tobytes()
        assert one.dtype == other.dtype
        assert other.flags.c_contiguous
        assert other.flags.writeable


@pytest.mark.usefixtures("folder")
def test_a_table_of_lewis_forms_read_from_disk_has_its_forms(monkeypatch):
    first = radiation_table(strips(DTC), W, 1025.0, method="lewis")
    monkeypatch.setattr(table, "radiation", lambda *_, **__: pytest.fail("computed again"))
    again = radiation_table(strips(DTC), W, 1025.0, method="lewis")
    assert first.a.tobytes() == again.a.tobytes()
    assert first.forms.a1.tobytes() == again.forms.a1.tobytes()


@pytest.mark.parametrize(
    "change", mostly_soak(["frequency", "density", "method", "contour", "source"], "contour", "source")
)
def test_whatever_a_table_follows_from_makes_another_file(folder, monkeypatch, change):
    radiation_table(strips(DTC), W, 1025.0)
    hull, w, density, method = DTC, W, 1025.0, "auto"
    if change == "frequency":
        w = W * (1 + 1e-15)
    elif change == "density":
        density = 1000.0
    elif change == "method":
        method = "lewis"
    elif change == "contour":
        hull = ship("dtc").with_(draught=DTC.draught * 0.99).hull
    else:
        monkeypatch.setattr(table, "source_digest", lambda *_: "other source")
    radiation_table(strips(hull), w, density, method=method)
    assert len(list(folder.iterdir())) == 2


def broken(data, how):
    if how == "cut short":
        return data[: len(data) // 2]
    if how == "one bit":
        return data[:-100] + bytes([data[-100] ^ 1]) + data[-99:]
    return {"empty": b"", "foreign": b"not ours" * 50}[how]


@pytest.mark.parametrize("how", ["cut short", "one bit", "empty", "foreign"])
def test_a_damaged_file_is_made_anew(folder, how):
    made = cached("name", lambda: {"a": np.arange(100.0)})
    path = folder / "name.npz"
    path.write_bytes(broken(path.read_bytes(), how))
    again = cached("name", lambda: {"a": np.arange(100.0) + 1})
    assert again["a"].tolist() == (made["a"] + 1).tolist()
    assert cached("name", lambda: pytest.fail("not kept"))["a"].tolist() == again["a"].tolist()


def test_a_whole_file_under_another_name_is_not_believed(folder):
    cached("one", lambda: {"a": np.zeros(3)})
    (folder / "one.npz").rename(folder / "two.npz")
    assert cached("two", lambda: {"a": np.ones(3)})["a"].tolist() == [1.0, 1.0, 1.0]


def test_a_folder_that_cannot_be_written_is_no_error(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv(cache.PLACE, str(tmp_path / "file" / "kept"))
    assert cached("name", lambda: {"a": np.ones(1)})["a"].tolist() == [1.0]


def test_off_keeps_nothing(tmp_path, monkeypatch):
    monkeypatch.setenv(cache.PLACE, "off")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_folder() is None
    cached("name", lambda: {"a": np.ones(1)})
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(sys.platform != "linux", reason="the folder of other systems is theirs")
def test_the_usual_folder_is_the_one_of_the_desktop_standard(tmp_path, monkeypatch):
    monkeypatch.delenv(cache.PLACE)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_folder() == tmp_path / "quartering"
    monkeypatch.setenv("XDG_CACHE_HOME", "relative/is/ignored")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert cache_folder() == tmp_path / ".cache" / "quartering"


def test_the_files_unused_for_longest_go_when_there_is_no_room(folder, monkeypatch):
    monkeypatch.setattr(cache, "LARGEST", 3 * 8 * 1100)
    for k, name in enumerate("abc"):
        cached(name, lambda: {"a": np.zeros(1000)})
        os.utime(folder / f"{name}.npz", (1e9 + k, 1e9 + k))
    cached("a", lambda: pytest.fail("was kept"))  # used now
    abandoned = folder / ".x.npz.1.2.part"
    abandoned.write_bytes(b"killed")
    os.utime(abandoned, (time.time() - 7200,) * 2)
    cached("d", lambda: {"a": np.zeros(1000)})
    assert sorted(file.name for file in folder.iterdir()) == ["a.npz", "c.npz", "d.npz"]


def test_processes_that_write_the_same_file_at_once_leave_it_whole(folder):
    line = (
        "import numpy as np; from quartering._machine.cache import _write, cache_folder\n"
        "for _ in range(40): _write(cache_folder() / 'name.npz', {'a': np.arange(20000.0)})"
    )
    writers = [subprocess.Popen([sys.executable, "-c", line], env=os.environ) for _ in range(2)]
    while any(writer.poll() is None for writer in writers):
        if (folder / "name.npz").exists():
            assert cache._read(folder / "name.npz")["a"].sum() == 199990000.0
    assert [writer.returncode for writer in writers] == [0, 0]
