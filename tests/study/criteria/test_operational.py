"""Operational guidance in three forms: intervals against limits by hand, the simplified form in closed form, page and table."""

import csv
import io
import json
import math

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

import quartering as qt
from quartering.study.criteria.operational import ADVICE, FORMS, guidance_csv
from quartering.view.cli import app
from quartering.view.report.operational import operational_page

AXES = {
    "hs": [3.0, 8.0], "tz": [7.0, 11.0], "speed": [0.0, 5.0, 10.0, 14.0], "heading": np.linspace(0.0, 180.0, 13),
}  # fmt: skip
LENGTH = 175.0


def seas(loadings=1):
    """A made-up map: rates and motions that rise with height and towards beam seas, intervals of a factor about them."""
    hs, tz, speed, heading = (xr.DataArray(v, dims=k, coords={k: v}) for k, v in AXES.items())
    roll = 2.0 * hs * (0.2 + np.abs(np.sin(np.radians(heading)))) * (1 + 0.01 * speed) * (tz / tz)
    rate = 1e-9 * np.exp(roll / 2.5)
    made = {
        "failure_rate": rate, "rate_lower": rate / 3, "rate_upper": 3 * rate,
        "roll_mean_3h_max": roll, "roll_3h_max_lower": 0.95 * roll, "roll_3h_max_upper": 1.05 * roll,
    }  # fmt: skip
    ds = xr.Dataset(made, attrs={"ship": "made up", "ship_length": LENGTH, "roll_limit": 40.0, "hours": 64, "seed": 7})
    return xr.concat([ds] * loadings, "loading").assign_coords(loading=[f"case {i}" for i in range(loadings)])


def test_an_interval_on_one_side_decides_and_one_that_straddles_does_not():
    """By hand: rate limit 1e-6 1/s; twice the mean largest roll against 40 deg."""
    ds = qt.operational_guidance(seas())
    low, high = ds["rate_lower"].values, ds["rate_upper"].values
    expected = np.where(high <= 1e-6, 0, np.where(low > 1e-6, 1, 2))
    np.testing.assert_array_equal(ds["probabilistic"], expected)
    roll = ds["roll_mean_3h_max"].values
    expected = np.where(1.05 * roll <= 20.0, 0, np.where(0.95 * roll > 20.0, 1, 2))
    np.testing.assert_array_equal(ds["deterministic"], expected)
    assert {0, 1, 2} == set(np.unique(ds["probabilistic"]))
    assert "recalled, unverified" in ds.attrs["rule_probabilistic"]
    stricter = qt.operational_guidance(seas(), rate_limit=1e-8, safety_factor=3.0)
    assert (stricter["probabilistic"] == 0).sum() < (ds["probabilistic"] == 0).sum()
    assert "given; that of the circular is 1e-06" in stricter.attrs["rule_probabilistic"]


def test_the_simplified_form_is_its_closed_form():
    """sqrt(175) = 13.23: pure loss from U cos mu 9.95 m/s on, surf-riding from 12.43 within 45 deg, Hs above 7 m and a wave
    g (1.0864 Tz)^2/(2 pi) above 140 m (Tz above 8.7 s)."""
    ds = qt.operational_guidance(seas()).isel(loading=0)
    for i, hs in enumerate(AXES["hs"]):
        for j, tz in enumerate(AXES["tz"]):
            for k, speed in enumerate(AXES["speed"]):
                for m, heading in enumerate(AXES["heading"]):
                    along = speed * math.cos(math.radians(heading))
                    wave = 9.81 * (1.0864 * tz) ** 2 / (2 * math.pi)
                    surf = (
                        along > 0.94 * math.sqrt(LENGTH)
                        and heading <= 45
                        and hs > 0.04 * LENGTH
                        and wave > 0.8 * LENGTH
                    )
                    lost = along > 0.752 * math.sqrt(LENGTH)
                    assert bool(ds["simplified"].values[i, j, k, m]) is (surf or lost)
    still = ds["simplified"].sel(speed=0.0)
    assert not still.any()  # at rest nothing is said


def test_acceleration_counts_where_it_is_known_and_cells_without_an_answer_stay_so():
    ds = seas()
    for end in ("lower", "upper"):
        ds[f"lateral_acceleration_3h_max_{end}"] = 6.0 + 0 * ds["failure_rate"]
    ds.attrs["acceleration_limit"] = 9.81
    assert (qt.operational_guidance(ds)["deterministic"] == 1).all()  # 2 x 6 is above 9.81
    ds["recommended"] = xr.full_like(ds["failure_rate"], 3, dtype=np.int8)
    found = qt.operational_guidance(ds)
    assert (found["probabilistic"] == 3).all()
    assert not (found["simplified"] == 3).any()


@pytest.mark.filterwarnings("ignore::quartering.RangeWarning")
def test_the_forms_agree_with_the_advice_of_the_map_itself():
    """`guidance` judges by its own intervals, by largest motions or by rates: the same limits give the same advice."""
    asked = {
        "hs": [4.0, 10.0],
        "tz": [8.0, 10.0],
        "speed": [0.0, 8.0],
        "heading": [30.0, 60.0, 90.0, 120.0],
        "hours": 0,
    }
    for judge, form in (("largest", "deterministic"), ("rate", "probabilistic")):
        found = qt.guidance(qt.ship("s175"), spreading="cos2", judge=judge, **asked)
        advised = qt.operational_guidance(found)
        np.testing.assert_array_equal(advised[form], found["recommended"])
        assert len(np.unique(found["recommended"])) > 1


def test_page_and_table_hold_every_loading():
    ds = qt.operational_guidance(seas(2).isel(tz=[0]))
    page = operational_page(ds)
    assert page.count("<section>") == page.count("</section>") == 2
    assert "case 0" in page
    assert "case 1" in page
    assert "no compliance is shown" in page
    assert "Undecided" in page
    assert "http" not in page.replace("http://www.w3.org", "")
    rows = list(csv.reader(io.StringIO(guidance_csv(ds))))
    assert len(rows) == 1 + ds["probabilistic"].size
    assert rows[0][:8] == ["loading", "hs [m]", "tz [s]", "speed [m/s]", "heading [deg]", *FORMS]
    first = dict(zip(rows[0], rows[1], strict=True))
    assert first["probabilistic"] == ADVICE[int(ds["probabilistic"].values.flat[0])]
    assert float(first["failure_rate [1]"]) == pytest.approx(float(ds["failure_rate"].values.flat[0]), rel=1e-3)


def test_the_command_writes_both_and_refuses_nonsense(tmp_path):
    data, page, table = tmp_path / "guidance.nc", tmp_path / "page.html", tmp_path / "all.csv"
    seas().isel(tz=[0]).to_netcdf(data)
    answer = CliRunner().invoke(app, ["operational", str(data), "-o", str(page), "--csv", str(table), "--json"])
    assert answer.exit_code == 0, answer.output
    told = json.loads(answer.stdout)
    assert sum(told["shares"]["probabilistic"].values()) == pytest.approx(1.0)
    assert page.read_text().endswith("</html>\n")
    assert table.read_text().startswith("loading,hs [m]")
    xr.Dataset({"a": 1.0}).to_netcdf(tmp_path / "other.nc")
    for words, said in (
        ([str(tmp_path / "none.nc")], "is no file"),
        ([str(tmp_path / "other.nc")], "is no map over seas"),
        ([str(data), "--rate-limit", "-1"], "rate_limit = -1"),
    ):
        refused = CliRunner().invoke(app, ["operational", *words])
        assert refused.exit_code == 2
        assert said in " ".join(refused.output.split())
