"""Conditions a ship's own database does not hold: a status in their place, and the rest of the map as it is."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.conventions import GRAVITY, RangeWarning
from quartering.hydro.database.dataset import write_capytaine
from quartering.motion.status import Status
from quartering.study.grid import grid
from quartering.study.maps.progress import failures
from quartering.study.maps.sweep import fill
from quartering.view.cli import app
from quartering.view.plots.polar_map import polar_map
from tests.loads.own_file import S60, of_strips

HIGHEST, FIRST_HEADING = 1.3, 30.0
SPEEDS, HEADINGS, LENGTHS = [0.0, 7.5], np.array([0.0, 30.0, 90.0, 180.0]), np.array([30.0, 60.0, 122.0])


@pytest.fixture(scope="module")
def ship(tmp_path_factory):
    place = tmp_path_factory.mktemp("narrow")
    narrow = of_strips(S60, np.linspace(0.1, HIGHEST, 30), np.arange(FIRST_HEADING, 181.0, 10.0))
    write_capytaine(narrow, place / "narrow.nc", S60)
    (place / "ship.yaml").write_text("base: series60-cb60\ndatabase: narrow.nc\n")
    return place / "ship.yaml"


def outside():
    """[H71] list of symbols: omega = sigma - k U cos mu, beside what the file was written with."""
    U, mu, length = np.meshgrid(SPEEDS, HEADINGS, LENGTHS, indexing="ij")
    k = 2 * np.pi / length
    sigma = np.sqrt(GRAVITY * k)
    omega = np.abs(sigma - k * U * np.cos(np.radians(mu)))
    return (sigma > HIGHEST) | (omega > HIGHEST) | (mu < FIRST_HEADING)


def test_a_map_gives_them_a_status_and_one_warning(ship):
    waves = [qt.Wave(float(length), float(length) / 60) for length in LENGTHS]
    count = outside().sum()
    with pytest.warns(
        RangeWarning, match=f"{count} of 24 conditions have no answer, outside database narrow.nc"
    ) as said:
        ds = qt.polar(qt.ship(ship), waves, SPEEDS, HEADINGS)
    assert len(said) == 1
    np.testing.assert_array_equal(ds["status"] == Status.OUTSIDE_DATABASE, outside())
    for name in ("roll", "yaw", "k2", "exponent", "calm_exponent", "multiplier_modulus"):
        assert np.isnan(ds[name].values[outside()]).all()
    assert (ds["verdict"].values[outside()] == -1).all()
    assert np.isfinite(ds["encounter_frequency"]).all()


def test_what_is_held_is_not_touched_by_what_is_not(ship):
    """The same equations in another batch: equal to rounding."""
    one = qt.ship(ship)
    with pytest.warns(RangeWarning, match="outside database"):
        whole = qt.sweep(one, SPEEDS, HEADINGS, LENGTHS, 1.0, gm=[0.5, 0.9])
    held = {"heading": HEADINGS[1:], "wave_length": LENGTHS[2:]}
    part = qt.sweep(one, SPEEDS[:1], wave_height=1.0, gm=[0.5, 0.9], **held)
    for name in ("roll", "exponent", "verdict", "status"):
        np.testing.assert_allclose(whole[name].sel(speed=SPEEDS[:1], **held), part[name], rtol=1e-12, atol=1e-15)


def test_a_store_counts_them_with_advice(ship, tmp_path):
    counts = fill(grid(qt.ship(ship), SPEEDS, HEADINGS, LENGTHS, 1.0), tmp_path / "s")
    (group,) = failures(counts)
    assert (group.status, group.conditions) == (Status.OUTSIDE_DATABASE, outside().sum())
    assert "longer waves" in group.advice


def test_other_forms_of_the_force_need_no_wave_of_the_file(ship):
    ds = qt.sweep(qt.ship(ship), 0.0, 90.0, 122.0, 1.0, form="relative-motion")
    assert int(ds["status"].squeeze()) == Status.CONVERGED
    with pytest.warns(RangeWarning, match="1 of 2 conditions"):  # the force comes from strips, the damping does not
        ds = qt.sweep(qt.ship(ship), 0.0, [10.0], [30.0, 122.0], 0.5, form="relative-motion")
    assert ds["status"].squeeze().values.tolist() == [Status.OUTSIDE_DATABASE, Status.CONVERGED]


def test_a_loading_that_rolls_faster_than_the_file_is_refused_before_the_work(tmp_path):
    slow = of_strips(S60, np.linspace(0.1, 0.8, 20), np.arange(0.0, 181.0, 30.0))
    write_capytaine(slow, tmp_path / "slow.nc", S60)
    with pytest.raises(qt.InputError, match=r"holds 0.1 to 0.8 rad/s, and .* or that of roll"):
        grid(S60.with_(database=tmp_path / "slow.nc"), 0.0, 90.0, 200.0, 1.0, gm=[0.5, 6.0])


def test_the_command_draws_the_map_and_says_so_once(ship, tmp_path):
    words = ["--headings", "0:180:4", "--wave-lengths", "30,60,122", "--speed", "0,7.5", "-o", str(tmp_path / "m.nc")]
    found = CliRunner().invoke(app, ["polar", str(ship), *words])
    assert found.exit_code == 0, found.output
    assert found.stderr.count("outside database narrow.nc") == 1
    assert "cells without an answer: outside the frequencies or headings" in " ".join(found.stdout.split())
    assert (tmp_path / "m.png").exists()


def test_a_map_without_any_answer_is_refused_and_a_speed_without_is_not(ship, tmp_path):
    words = ["--headings", "60,90", "--wave-lengths", "30", "--speed", "0", "-o", str(tmp_path / "m.nc")]
    found = CliRunner().invoke(app, ["polar", str(ship), *words])
    assert found.exit_code == 2
    assert "no condition of this map has an answer" in found.stderr
    assert list(tmp_path.iterdir()) == []
    words = ["--headings", "150,180", "--wave-lengths", "60", "--speed", "0,12", "-o", str(tmp_path / "m.nc"), "--json"]
    facts = json.loads(CliRunner().invoke(app, ["polar", str(ship), *words]).stdout)
    assert [speed["worst_roll"] is None for speed in facts["speeds"]] == [False, True]


def test_forces_of_the_file_stand_beside_the_others_where_it_holds_them(ship, tmp_path):
    words = ["--wave-lengths", "30,122", "--speed", "0", "-o", str(tmp_path / "f.png"), "--json"]
    found = CliRunner().invoke(app, ["forces", str(ship), *words])
    assert found.exit_code == 0, found.output
    assert found.stderr.count("outside database narrow.nc") == 1
    forms = json.loads(found.stdout)["forms"]
    headings = np.arange(0.0, 181.0, 5.0)
    short, long = (np.array(forms["database"]["sway"][i], dtype=float) for i in range(2))
    assert np.isnan(short).all()
    np.testing.assert_array_equal(np.isnan(long), headings < FIRST_HEADING)
    assert np.isfinite(np.array(forms["stf"]["sway"], dtype=float)).all()
    assert (tmp_path / "f.png").stat().st_size > 10_000


def test_the_picture_says_why_cells_have_no_answer(ship):
    with pytest.warns(RangeWarning, match="outside database"):
        ds = qt.polar(qt.ship(ship), [qt.Wave(float(length), 0.5) for length in LENGTHS], [7.5], HEADINGS)
    labels = [text.get_text() for text in polar_map(ds).legends[0].get_texts()]
    assert "no answer: outside database" in labels
