"""What the explorer is made of, without a browser: the link, the jobs, uploads, the case file."""

import asyncio
import threading
from urllib.parse import parse_qsl

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

import quartering as qt
from quartering.conventions import InputError
from quartering.study.maps.result import open_result
from quartering.view.cli import app

pytest.importorskip("nicegui", reason="the explorer needs the extra `app`")

from quartering.view.explorer.computing.computations import noting, scene
from quartering.view.explorer.computing.job_queue import JobQueue
from quartering.view.explorer.downloads import case_file, map_dataset, netcdf, picture, report
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.hulls.uploads import LARGEST, Sizes, hull_of_upload
from quartering.view.explorer.state import STARTING, State

BARGE = "x,0,4,6\n" + "\n".join(f"{x},5,5,5" for x in (-30, -10, 10, 30))


def lengths(low, high):
    return st.none() | st.floats(max(low, 1e-3), high)  # below, a length is no length


@given(
    gm=lengths(0.0, 10.0),
    gyradius_roll=lengths(0.0, 50.0),
    speed=st.none() | st.floats(0.0, 30.0),
    heading=st.floats(0.0, 180.0),
    wave_length=lengths(0.0, 900.0),
    damping=st.fixed_dictionaries({"roll_damping": lengths(0.0, 1.0)})
    | st.fixed_dictionaries({"bilge_keel_length": st.floats(1.0, 99.0), "bilge_keel_breadth": st.floats(0.0, 3.0)}),
    sea=st.tuples(st.sampled_from(["wave_height", "steepness"]), st.floats(1e-3, 0.14)),
    harmonics=st.sampled_from([1, 3, 5]),
    panel=st.sampled_from(["motion", "stability", "curve", "causes", "hull", "compare"]),
    beside=st.sampled_from([None, "ship=wigley", "ship=series60-cb60&gm=0.6"]),
)
def test_a_link_carries_the_whole_state(sea, damping, **values):
    state = State(**values, **damping, **dict([sea]))
    back = State.of_query(dict(parse_qsl(state.query())))
    for name, value in state:
        other = getattr(back, name)
        assert other == (pytest.approx(value, rel=1e-9, abs=1e-12) if isinstance(value, float) else value), name


@pytest.mark.parametrize(
    ("query", "reason"),
    [
        ({"heading": "nan"}, "heading"),
        ({"heading": "200"}, "180"),
        ({"gm": "-1"}, "gm"),
        ({"wave_height": "3", "steepness": "0.02"}, "leave one out"),
        ({"haeding": "30"}, "unknown"),
        ({"harmonics": "2"}, "harmonics"),
        ({"speed": "inf"}, "speed"),
        ({"bilge_keel_length": "30"}, "give both"),
        ({"bilge_keel_length": "30", "bilge_keel_breadth": "0.3", "roll_damping": "0.05"}, "not both"),
        ({"bilge_keel_length": "30", "bilge_keel_breadth": "-0.3"}, "bilge_keel_breadth"),
    ],
)
def test_a_link_that_cannot_be_is_refused_with_the_reason(query, reason):
    with pytest.raises(InputError, match=reason):
        State.of_query(query)


@pytest.mark.parametrize("name", ["/etc/passwd", "../my.yaml", "library/wigley.yaml", "", "upload-0123"])
def test_no_file_of_the_server_is_opened_by_its_name(name):
    with pytest.raises(InputError):
        ShipRegistry().known(name)


def test_an_uploaded_barge_has_the_volume_of_a_box():
    known = hull_of_upload("my barge.csv", BARGE.encode(), Sizes(draught=3.0))
    assert qt.hydrostatics(known.ship).volume == pytest.approx(60 * 10 * 3, rel=1e-9)  # L B T
    assert known.key == hull_of_upload("my barge.csv", BARGE.encode(), Sizes(draught=3.0)).key
    assert known.key != hull_of_upload("my barge.csv", BARGE.encode(), Sizes(draught=3.5)).key


def test_an_uploaded_barge_in_millimetres_is_the_same_barge():
    numbers = [[f"{float(cell) * 1000:g}" for cell in row.split(",")] for row in BARGE.removeprefix("x,").split("\n")]
    numbers[0].insert(0, "x")
    told = hull_of_upload("my barge.csv", "\n".join(map(",".join, numbers)).encode(), Sizes(draught=3.0, unit="mm"))
    assert qt.hydrostatics(told.ship).volume == pytest.approx(60 * 10 * 3, rel=1e-9)  # L B T
    assert '"unit": "mm"' in told.files["ship.yaml"].decode()


@pytest.mark.parametrize(
    ("name", "data", "reason"),
    [
        ("hull.exe", b"MZ", "taken|read"),
        ("hull.csv", bytes(range(256)) * 40, "text"),
        ("hull.stl", b"\x00" * 200, "STL"),
        ("hull.gdf", b"\xff\xfe" * 300, "GDF"),
        ("hull.csv", b"x,0,4\n0,5,5\n", "at least 4 of them"),
        ("hull.csv", b"", "empty"),
        ("hull.csv", b"x,0,5000\n-40000,6000,6000\n40000,6000,6000", "over 80000 m, .*; say the unit of its numbers"),
        ("hull.csv", b"x" * (LARGEST + 1), "MB"),
        ("hull.out", b"4 t 4.0", "."),
        ("../../etc/cron.csv", BARGE.encode(), "draught"),
        ("ship.yaml.csv", b"a: !!python/object/apply:os.system [ls]", "."),
    ],
)
def test_a_bad_upload_is_refused_by_its_own_name(name, data, reason):
    with pytest.raises(InputError, match=reason) as refused:
        hull_of_upload(name, data)
    assert "/tmp" not in str(refused.value)


def test_clients_take_turns_and_what_is_given_up_is_skipped():
    done = []

    async def run():
        queue, hold = JobQueue(), threading.Event()
        first = asyncio.create_task(queue.take("many", hold.wait))
        await asyncio.sleep(0.01)
        jobs = [asyncio.create_task(queue.take("many", lambda i=i: done.append(f"many {i}"))) for i in range(4)]
        await asyncio.sleep(0.01)
        one = asyncio.create_task(queue.take("one", lambda: done.append("one")))
        await asyncio.sleep(0.01)
        jobs[1].cancel()
        hold.set()
        await asyncio.gather(first, one, *jobs, return_exceptions=True)
        queue.close()

    asyncio.run(run())
    assert done == ["many 0", "one", "many 2", "many 3"]


def test_the_server_answers_others_while_a_computation_runs():
    async def run():
        jobs = JobQueue()
        go_on = threading.Event()
        slow = asyncio.create_task(jobs.take("a", lambda: go_on.wait(600)))
        for _ in range(5):  # were the loop held up, it would come to the end of this only after the computation
            await asyncio.sleep(0.01)
        assert not slow.done()
        go_on.set()
        heard = await slow
        jobs.close()
        return heard

    assert asyncio.run(run())


def test_an_error_in_a_turn_reaches_its_own_waiter_only():
    def fail():
        raise InputError("no such thing")

    async def run():
        jobs = JobQueue()
        found = await asyncio.gather(jobs.take("a", fail), jobs.take("b", lambda: 7), return_exceptions=True)
        jobs.close()
        return found

    failed, fine = asyncio.run(run())
    assert isinstance(failed, InputError)
    assert fine == 7


@pytest.mark.parametrize(
    "changes",
    [
        pytest.param({"steepness": None, "wave_height": 3.0, "gm": 0.8}, marks=pytest.mark.soak),
        pytest.param({"steepness": 0.02, "gm": 0.8}, marks=pytest.mark.soak),
        {"steepness": 1 / 30, "bilge_keel_length": 36.0, "bilge_keel_breadth": 0.4, "harmonics": 3},
    ],
)
def test_the_case_file_gives_the_map_again_by_the_command_line(tmp_path, changes):
    state = STARTING.changed(heading=52.0, **changes)
    of = scene(state, ShipRegistry().known(state.ship))
    name, content = case_file(state, of)
    (tmp_path / name).write_bytes(content)
    made = CliRunner().invoke(app, ["sweep", str(tmp_path / name), "-o", str(tmp_path / "result")])
    assert made.exit_code == 0, made.output
    rerun = open_result(tmp_path / "result").load().squeeze(drop=True)
    shown, _ = noting(lambda: map_dataset(of))()
    again = rerun.sel(heading=shown["heading"], wave_length=shown["wave_length"])
    for variable in ("roll", "exponent", "k2"):
        # The forces are the same; the two paths put them together in another order of operations.
        np.testing.assert_allclose(again[variable].values, shown[variable].values[0], rtol=1e-9, atol=1e-12)
    assert (again["verdict"].values == shown["verdict"].values[0]).all()
    assert 52.0 in rerun["heading"].values
    assert of.wave.length in rerun["wave_length"].values


def test_the_map_goes_home_as_picture_and_as_dataset(tmp_path):
    state = State(ship="wigley", steepness=0.01)
    of = scene(state, ShipRegistry().known("wigley"))
    assert picture(of, "png").startswith(b"\x89PNG")
    assert b"<svg" in picture(of, "svg")[:2000]
    (tmp_path / "map.nc").write_bytes(netcdf(of))
    ds = xr.load_dataset(tmp_path / "map.nc")
    again = qt.polar(qt.ship("wigley"), of.waves, [of.speed], ds["heading"].values)
    np.testing.assert_allclose(ds["roll"].values, again["roll"].values, rtol=1e-12)
    assert ds.attrs["provenance"] == again.attrs["provenance"]


def test_the_report_goes_home_where_there_is_one():
    pytest.importorskip("quartering.view.report", reason="no report yet")
    of = scene(State(ship="wigley", steepness=0.01), ShipRegistry().known("wigley"))
    assert b"Wigley" in report(of)


def test_waves_that_break_are_left_out_of_the_map():
    state = State(ship="wigley", wave_height=8.0, wave_length=100.0, speed=20.0)
    of = scene(state, ShipRegistry().known("wigley"))
    assert all(wave.steepness <= 1 / 7 for wave in of.waves)
    shown, notes = noting(lambda: map_dataset(of))()
    assert shown["roll"].sizes["wave_length"] == len(of.waves) < 20
    assert any("Froude number" in note for note in notes)
