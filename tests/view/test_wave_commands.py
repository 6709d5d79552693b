"""`quartering hull` on a wave and `quartering responses`: the numbers are those of Python, the files open."""

import json

import numpy as np
import pytest
import xarray as xr

import quartering as qt


def test_hull_prints_and_draws_gm_on_a_wave(run, tmp_path):
    result = run("hull", "wigley", "--wave-length", "1.0L", "--wave-height", "2", "--heading", "180", "-o", "hull.png")
    assert result.exit_code == 0
    assert "On a wave of 100 m, 2 m high, heading 180 deg" in result.stdout
    assert (tmp_path / "hull.png").stat().st_size > 10_000
    said = json.loads(run("hull", "wigley", "--wave-length", "1.0L", "--wave-height", "2", "--json").stdout)["on_wave"]
    found = qt.gm_in_waves(qt.ship("wigley"), qt.Wave(100.0, 2.0))
    assert said["gm"] == pytest.approx(found.gm.to_numpy(), abs=1e-12)
    alone = run("hull", "wigley", "--wave-height", "2")
    assert alone.exit_code == 2
    assert "--wave-length is missing" in alone.stderr


def test_responses_write_a_table_and_a_dataset(run, tmp_path):
    words = ["responses", "wigley", "--speed", "0.2Fn", "--wave-lengths", "1L,2L", "--headings", "90,180"]
    assert run(*words, "-o", "r.nc").exit_code == 0
    result = run(*words, "-o", "r.csv", "--place", "0.4 L,0 m,12 m")
    assert result.exit_code == 0
    assert "assumed: 0.25 L" in result.stdout
    speed = 0.2 * np.sqrt(9.81 * 100.0)
    alone = qt.responses(qt.ship("wigley"), qt.Wave(200.0, 2.0), speed, 180.0)  # of 1 m amplitude
    with xr.open_dataset(tmp_path / "r.nc") as table:
        found = table.sel(heading=180.0, wave_length=200.0).isel(speed=0)
        assert float(found.pitch) == pytest.approx(float(alone.pitch), rel=1e-9)
        assert table.pitch.attrs["units"] == "deg m-1"
    lines = [line for line in (tmp_path / "r.csv").read_text().splitlines() if not line.startswith("#")]
    assert len(lines) == 1 + 4
    refused = run(*words, "-o", "r.txt")
    assert refused.exit_code == 2
    assert ".csv or .xlsx or .nc" in refused.stderr
