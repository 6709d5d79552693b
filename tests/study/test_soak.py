"""Sweeps that are killed, interrupted, starved of disk, or share what they keep: whole programs, and in part by chance.

Authority: by definition; what a run leaves behind, and the run after it, hold the bytes of a run that nothing disturbed.
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
from pathlib import Path

import numpy as np
import pytest

import quartering as qt
from quartering.study.maps.result import open_result
from quartering.study.maps.stored.store import read_store

pytestmark = [pytest.mark.soak, pytest.mark.skipif(sys.platform == "win32", reason="POSIX signals")]

KILLS = int(os.environ.get("QUARTERING_KILLS", "50"))
"""Kills of each kind of run together."""
LIMIT = 900
"""Time after which a program that has done no work is given up, or one that has worked for four times that [s]."""
SOURCE = Path(qt.__file__).parent

RUN = textwrap.dedent(
    """
    import sys, time, warnings
    warnings.simplefilter("ignore")
    import numpy as np, quartering as qt
    from quartering.study.maps import estimate
    estimate._seconds_each = lambda *_: 1e-5  # the same blocks in every run, however busy the machine
    ship = qt.ship("series60-cb60")
    if __name__ == "__main__":
        qt.sweep(
            ship, [0.0, 4.0, 8.0], np.arange(0.0, 181.0, 10.0), ship.hull.length * np.linspace(0.5, 2.0, 12),
            [0.5, 1.5, 3.0], gm=[0.6, 0.9, 1.2], store=sys.argv[1], cluster=(sys.argv[2:] or [None])[0],
            progress=lambda done, of: time.sleep(0.05),
        )
    """
)


def _begin(*words, **more):
    """A program of its own, as `python program words`."""
    return subprocess.Popen(
        [sys.executable, *(str(word) for word in words)],
        stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a job in the background is started deaf to it
        **more,
    )  # fmt: skip


def _worked(process):
    """Processor time of a program and of those it has waited for [s]; 0 where it cannot be read."""
    try:
        fields = Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    except OSError:
        return 0.0
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")


def _said(process):
    """What a program wrote to its end, which it may take its time to on a machine that others use too."""
    worked, since = _worked(process), time.monotonic()
    while True:
        try:
            return process.communicate(timeout=10)[1]
        except subprocess.TimeoutExpired:
            now = _worked(process)
            if now > worked + 1.0:
                worked, since = now, time.monotonic()
            if time.monotonic() - since > LIMIT or now > 4 * LIMIT:
                process.kill()
                raise


def _done(process):
    said = _said(process)
    assert process.returncode == 0, said
    return said


def _kill(process):
    process.kill()
    process.communicate(timeout=LIMIT)  # its end, and that of its pipe


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    path = tmp_path_factory.mktemp("program") / "run.py"
    path.write_text(RUN)
    return path


@pytest.fixture(scope="module")
def undisturbed(program, tmp_path_factory):
    folder = tmp_path_factory.mktemp("undisturbed") / "sweep"
    _done(_begin(program, folder))
    return folder


@pytest.fixture(scope="module")
def expected(undisturbed):
    return _files(undisturbed)


def _files(folder):
    return {file.name: file.read_bytes() for file in (folder / "blocks").glob("[0-9]*.nc")}


def _whole_so_far(folder, expected):
    """Every block that has its name is byte for byte what it is to be."""
    found = _files(folder) if (folder / "blocks").is_dir() else {}
    assert found.items() <= expected.items()
    return len(found)


def _wait_for(folder, count, process):
    end = time.monotonic() + LIMIT
    while (
        process.poll() is None and time.monotonic() < end and len(list((folder / "blocks").glob("[0-9]*.nc"))) < count
    ):
        time.sleep(0.002)


@pytest.mark.parametrize("cluster", [None, "local:2"])
def test_runs_killed_at_random_leave_whole_blocks_and_go_on(cluster, program, expected, tmp_path):
    random, folder, at = np.random.default_rng(50), tmp_path / "sweep", 0
    for _ in range(KILLS if cluster is None else max(KILLS // 5, 2)):
        process = _begin(program, folder, *([cluster] if cluster else []))
        _wait_for(folder, at + int(random.integers(0, 2)), process)
        time.sleep(float(random.uniform(0, 0.1)))
        _kill(process)
        at = _whole_so_far(folder, expected)
        if at == len(expected):
            shutil.rmtree(folder)
            at = 0
    _done(_begin(program, folder))
    assert _files(folder) == expected


@pytest.fixture
def cluster(tmp_path):
    """A scheduler and two workers, programs of their own; killed in the end whatever became of them."""
    pytest.importorskip("distributed")
    said = tmp_path / "scheduler.json"
    environment = {**os.environ, "DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "10s"}
    command = ["-m", "distributed.cli.dask_scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", said]
    programs = [_begin(*command, env=environment)]
    end = time.monotonic() + LIMIT
    while not said.exists() and time.monotonic() < end:
        time.sleep(0.1)
    worker = [
        "-m",
        "distributed.cli.dask_worker",
        "--scheduler-file",
        said,
        "--nthreads",
        "1",
        "--no-dashboard",
        "--no-nanny",
    ]
    programs += [_begin(*worker, env=environment, cwd=tmp_path) for _ in range(2)]
    import json

    yield json.loads(said.read_text())["address"], programs
    for one in programs:
        _kill(one)


@pytest.mark.parametrize("who", ["worker", "scheduler"])
def test_a_killed_worker_or_scheduler_costs_no_block(who, cluster, program, expected, tmp_path):
    address, programs = cluster
    folder = tmp_path / "sweep"
    process = _begin(program, folder, address)
    _wait_for(folder, 2, process)
    programs[0 if who == "scheduler" else 1].kill()
    said = _said(process)
    _whole_so_far(folder, expected)
    if who == "scheduler":
        assert process.returncode != 0
        assert "the cluster was lost" in said
        _done(_begin(program, folder))
    else:
        assert process.returncode == 0, said
    assert _files(folder) == expected


CASE = """\
ship: series60-cb60
speed: [0, 4 m/s, 8 m/s]
heading: 0..180 deg step 1
wave_length: 0.5..2 L count 60
wave_height: [1 m, 3 m]
"""


def test_an_interrupt_at_ten_moments_is_one_line(tmp_path):
    """From the first import to the last block; the time of a whole run is measured first, and cut into ten."""
    (tmp_path / "big.yaml").write_text(CASE)
    command = ["-c", "from quartering.view.cli import main; main()", "sweep", "big.yaml", "--yes"]
    begin = time.monotonic()
    _done(_begin(*command, cwd=tmp_path))
    took, whole = time.monotonic() - begin, open_result(tmp_path / "big").load()
    for tenth in range(10):
        shutil.rmtree(tmp_path / "big", ignore_errors=True)
        process = _begin(*command, cwd=tmp_path)
        time.sleep(took * (tenth + 0.5) / 10)
        process.send_signal(signal.SIGINT)
        said = _said(process)
        if process.returncode == -signal.SIGINT:
            continue  # before the program had begun: the interpreter's own end
        assert process.returncode in (0, 130), said
        assert "Traceback" not in said
        if (tmp_path / "big" / "case.json").exists():
            assert read_store(tmp_path / "big").damaged() == []
    _done(_begin(*command, cwd=tmp_path))
    assert open_result(tmp_path / "big").load().equals(whole)


def test_a_disk_that_fills_during_a_run_loses_nothing(program, expected, tmp_path):
    if os.geteuid() != 0:
        pytest.skip("a small disk is mounted for this: needs root")
    disk = tmp_path / "disk"
    disk.mkdir()
    size = sum(map(len, expected.values())) // 2
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", disk], capture_output=True, check=False
    )
    if mounted.returncode:
        pytest.skip(f"this machine mounts no small disk: {mounted.stderr.decode().strip()}")
    try:
        process = _begin(program, disk / "sweep")
        said = _said(process)
        assert process.returncode != 0
        assert "No space left on device" in said
        assert "finished blocks are kept" in said
        assert 0 < _whole_so_far(disk / "sweep", expected) < len(expected)
        assert not list((disk / "sweep" / "blocks").glob("*.part"))
        shutil.copytree(disk / "sweep", tmp_path / "more")
        _done(_begin(program, tmp_path / "more"))
    finally:
        subprocess.run(["umount", disk], check=False)
    assert _files(tmp_path / "more") == expected


def test_a_clock_set_back_changes_nothing(program, expected, tmp_path):
    """The clock goes back by a year in the middle of a run whose files are then of the future, kept tables included."""
    back = tmp_path / "back.py"
    back.write_text(
        "import time\nreal, calls = time.time, [0]\n"
        "def behind():\n    calls[0] += 1\n    return real() - (3e7 if calls[0] > 3 else 0)\n"
        f"time.time = behind\nexec(compile(open({str(program)!r}).read(), 'run', 'exec'))\n"
    )
    environment = {**os.environ, "QUARTERING_CACHE": str(tmp_path / "cache")}
    folder = tmp_path / "sweep"
    process = _begin(back, folder, env=environment)
    _wait_for(folder, 2, process)
    _kill(process)
    for file in [*folder.rglob("*"), *(tmp_path / "cache").rglob("*")]:
        os.utime(file, (time.time() + 3e7,) * 2)
    _done(_begin(back, folder, env=environment))
    assert _files(folder) == expected


def test_two_programs_that_compile_and_keep_at_the_same_time_agree(program, expected, tmp_path):
    environment = {
        **os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "kernels"), "QUARTERING_CACHE": str(tmp_path / "tables"),
    }  # fmt: skip
    both = [_begin(program, tmp_path / name, env=environment) for name in ("one", "two")]
    for process in both:
        _done(process)
    assert _files(tmp_path / "one") == _files(tmp_path / "two") == expected
    _done(_begin(program, tmp_path / "three", env=environment))  # what they kept is whole
    assert _files(tmp_path / "three") == expected


def test_a_read_only_package_under_another_user_works(program, expected):
    if os.geteuid() != 0:
        pytest.skip("another user is taken for this: needs root")
    place = Path(tempfile.mkdtemp(prefix="quartering-"))
    try:
        place.chmod(0o755)
        shutil.copytree(SOURCE, place / "src" / "quartering", ignore=shutil.ignore_patterns("__pycache__"))
        subprocess.run(["chmod", "-R", "a-w,a+rX", place / "src"], check=True)
        shutil.copy(program, place / "run.py")
        (place / "run.py").chmod(0o644)
        (place / "out").mkdir()
        os.chown(place / "out", 65534, 65534)
        environment = {"PATH": os.environ["PATH"], "PYTHONPATH": str(place / "src"), "HOME": "/nonexistent"}
        try:
            subprocess.run([sys.executable, "-c", "import numpy"], user=65534, group=65534, cwd="/", check=True)
        except (OSError, subprocess.CalledProcessError):
            pytest.skip(f"another user may not run {sys.executable}: needs a Python that all may read")
        process = _begin(place / "run.py", place / "out" / "sweep", env=environment, user=65534, group=65534, cwd="/")
        _done(process)
        assert _files(place / "out" / "sweep") == expected
    finally:
        shutil.rmtree(place, ignore_errors=True)


THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")


@pytest.mark.parametrize("count", ["1", "2", "3"])
def test_programs_with_any_number_of_threads_give_the_same_bytes(count, program, expected, tmp_path):
    environment = {**os.environ, **dict.fromkeys(THREADS, count), "QUARTERING_CACHE": "off"}
    _done(_begin(program, tmp_path / "sweep", env=environment))
    assert _files(tmp_path / "sweep") == expected


def test_a_lesser_processor_gives_the_same_to_twelve_digits(program, undisturbed, tmp_path):
    """The same machine told to be one of 2004: no wide vectors in kernels, arrays or linear algebra, and no fused products."""
    environment = {
        **os.environ, "NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": "", "OPENBLAS_CORETYPE": "Prescott",
        "NPY_DISABLE_CPU_FEATURES": "AVX2 FMA3 AVX512F AVX512CD AVX512_SKX", "NUMBA_CACHE_DIR": str(tmp_path / "kernels"),
        "QUARTERING_CACHE": "off",
    }  # fmt: skip
    _done(_begin("-W", "ignore", program, tmp_path / "sweep", env=environment))
    there, here = open_result(tmp_path / "sweep").load(), open_result(undisturbed).load()
    for name in there:
        if there[name].dtype.kind == "i":
            np.testing.assert_array_equal(there[name], here[name], err_msg=name)
        else:
            # `missed` is a share of roll: its whole is 1, however little of it the harmonics leave out
            size = 1.0 if name == "missed" else float(np.nan_to_num(np.abs(here[name].values)).max())
            np.testing.assert_allclose(there[name], here[name], rtol=1e-12, atol=1e-12 * size, err_msg=name)
