"""`quartering vary` as a user meets it, and what stands in its pictures."""

import json

import numpy as np
import pytest
import xarray as xr
from matplotlib.text import Text
from typer.testing import CliRunner

import quartering as qt
from quartering.study.paper.model import paper_ship
from quartering.view.cli import app
from quartering.view.plots.tornado import tornado_picture
from quartering.view.plots.vary import vary_picture

PAPER = ("--velocities", "absolute", "--drag", "cubic", "--ends", "strips", "--righting", "polynomial")
SHIP = paper_ship().with_(factors={"K_prr": -60.0})
LENGTH = SHIP.hull.length
AT = (qt.Wave(LENGTH, LENGTH / 30), 0.25 * np.sqrt(9.81 * LENGTH), 30.0)


@pytest.fixture
def run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    runner = CliRunner()
    return lambda *words: runner.invoke(app, ["vary", "series60-cb60", *words])


def texts(figure):
    return " ".join(text.get_text() for text in figure.findobj(Text))


def test_a_range_alone_is_enough(run, tmp_path):
    """As a user first types it: the condition has defaults, and the output says which."""
    result = run("--gm", "0.6:1.0:5", "-o", "gm.nc")
    assert result.exit_code == 0
    assert "Heading 45 deg" in result.stdout
    assert "flip" in result.stdout
    assert "--tornado 10%" in result.stdout
    with xr.open_dataset(tmp_path / "gm.nc") as ds:
        np.testing.assert_allclose(ds["gm"], np.linspace(0.6, 1.0, 5))
        assert ds["roll"].attrs["units"] == "deg"


def test_json_holds_the_curves_and_the_flips(run):
    condition = ("--heading", "30", "--speed", "0.25Fn", "--wave-height", f"{LENGTH / 30}m")
    facts = json.loads(run("--coefficient", "K_prr=-60:0:7", *condition, *PAPER, "--json").stdout)
    assert len(facts["roll"]) == len(facts["exponent"]) == 7
    (flip,) = facts["flips"]
    assert flip["below"] == "roll"
    assert -60 < flip["value"] < 0
    assert facts["parameters"]["K_prr"]["now"] == 1.0


def test_two_ranges_make_a_map_and_a_condition_may_be_one(run, tmp_path):
    result = run("--gyradius-roll", "0.32B:0.42B:3", "--heading", "30:60:4", "-o", "map.png")
    assert result.exit_code == 0
    assert "12 stable" in result.stdout
    assert (tmp_path / "map.png").stat().st_size > 10_000


def test_keels_are_fitted_where_a_size_is_a_value(run):
    """Agreement: the ship that `with_` gives those keels. A keel fitted for the question has no present value."""

    def facts(*words):
        return json.loads(run("--speed", "7", *words, "--bilge-keel-length", "0.25L", "--json").stdout)

    keels = qt.ship("series60-cb60").with_(roll_damping="ikeda", bilge_keels=("0.25 L", "0.02 B"))
    own = qt.sweep(keels, 7.0, 45.0, keels.hull.length, 0.02 * keels.hull.length)["roll"].item()
    breadths = facts("--bilge-keel-breadth", "0:0.02B:3")
    assert breadths["parameters"]["bilge_keel_breadth"]["now"] is None
    assert breadths["roll"][-1] == pytest.approx(own, rel=1e-9)
    stiffnesses = facts("--bilge-keel-breadth", "0.02B", "--gm", f"{keels.loading.gm}:1.2:2")
    assert stiffnesses["roll"][0] == pytest.approx(own, rel=1e-9)


@pytest.mark.soak
def test_tornado_lists_the_largest_effects_first(run, tmp_path):
    result = run("--tornado", "10%", "-o", "tornado.svg", "--json")
    facts = json.loads(result.stdout)
    names = [row["parameter"] for row in facts["parameters"]]
    assert names.index("gm") < names.index("N_r")
    assert facts["change"] == 0.1
    assert (tmp_path / "tornado.svg").exists()


@pytest.mark.soak
def test_the_next_step_a_tornado_names_can_be_taken(run):
    """Here KG has the largest effect; 20 % more of it would be above the metacentre."""
    printed = " ".join(run("--tornado", "10%").stdout.split())
    step = printed.split("quartering vary series60-cb60 ")[-1].split()
    assert step[-4:-2] == ["--kg", step[-3]]
    assert run(*step[:-2]).exit_code == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((), "nothing to vary"),
        (("--gm", "0.8"), "nothing to vary"),
        (("--coefficient", "K_ppp"), "K_p=0.2:2"),
        (("--tornado", "10%", "--gm", "0.5:1"), "leave the ranges out"),
        (("--tornado", "200%"), "less than 1"),
        (("--gm", "0.5:1", "-o", "gm.txt"), "must end in"),
        (("--gm", "0.5:1", "--kg", "5:6"), "leave one out"),
    ],
)
def test_what_cannot_be_done_is_one_message(run, words, said):
    result = run(*words)
    assert result.exit_code == 2
    assert said in result.stderr
    assert result.stderr.count("\n") == 1


def test_curves_name_units_and_mark_flip_and_present_value():
    figure = vary_picture(qt.vary(SHIP, *AT, {"roll_damping": np.linspace(0.05, 0.3, 6)}))
    words = texts(figure)
    for needed in ("[deg]", "[1/s]", "verdict flips at", "now, 0.05", "Floquet", "Heading 30 deg", "Estimated"):
        assert needed in words, needed
    # as many shaded spans a panel as unstable stretches: one, from the left end to the flip
    assert [sum(patch.get_hatch() is not None for patch in ax.patches) for ax in figure.axes] == [1, 1]


def test_maps_draw_the_boundary_where_the_exponent_is_zero():
    ds = qt.vary(SHIP, *AT, {"roll_damping": np.linspace(0.05, 0.3, 6), "gm": [0.7, 0.8, 0.9]})
    assert float(ds["exponent"].min()) < 0 < float(ds["exponent"].max())
    figure = vary_picture(ds)
    assert any("added roll damping" in text for text in texts(figure).split("\n"))
    assert any(getattr(c, "hatches", None) and any(c.hatches) for ax in figure.axes for c in ax.collections)


@pytest.mark.soak
def test_tornado_picture_says_what_each_value_is_and_where_it_flips():
    ds = qt.tornado(SHIP, *AT, parameters=["gm", "roll_damping", "K_prr"])
    words = texts(tornado_picture(ds, "title", "note"))
    for needed in ("GM 0.813 m", "added roll damping 0.05", "stable at x 0.4", "10 % less", "10 % more", "[1/s]"):
        assert needed in words, needed
