"""The moving ship: where the water and the ship stand, against the conventions; the files that are written."""

import os
import stat

import numpy as np
import pytest
from PIL import Image

import quartering as qt
from quartering.view.command import simulate as simulate_command
from quartering.view.moves import moves_of, pace_of
from quartering.view.plots.ship_in_wave import Scene, frames_shown
from quartering.view.ship_shape import shape_of

SHIP = qt.ship("wigley")
CONDITION = ["--heading", "60", "--speed", "5", "--wave-length", "1L", "--wave-height", "2"]


def scene_of(ship, wave, speed, heading, duration):
    model = qt.equations(ship, wave, speed, heading)
    trace = qt.simulate(model, duration)
    moves = moves_of(trace, 2 * np.pi / model.frequency)
    return Scene(ship, wave, speed, heading, moves, "", ""), trace


@pytest.fixture(scope="module")
def scene():
    return scene_of(SHIP, qt.Wave(100.0, 2.0), 5.0, 60.0, 120.0)[0]


def test_the_water_passes_its_mean_level_at_g_moving_down(scene):
    # docs/conventions.md, "Time"
    origin = np.zeros(1)
    assert scene.elevation(origin, origin, 0.0)[0] == pytest.approx(0.0, abs=1e-12)
    assert scene.elevation(origin, origin, 0.1)[0] < 0.0
    quarter = np.pi / 2 / scene.omega
    assert scene.elevation(origin, origin, quarter)[0] == pytest.approx(-1.0)  # half of the height


def test_a_beam_wave_runs_from_port_to_starboard_and_a_following_one_ahead():
    # docs/conventions.md, "Heading": the crest, where -sin is 1, moves to +y, or to +x
    for heading, axis in ((90.0, 1), (0.0, 0)):
        one, _ = scene_of(SHIP, qt.Wave(100.0, 2.0), 0.0, heading, 20.0)
        reach = np.linspace(-50.0, 50.0, 1001)
        places = [np.zeros_like(reach), reach] if axis else [reach, np.zeros_like(reach)]
        crests = [reach[np.argmax(one.elevation(*places, time))] for time in (0.0, 0.5)]
        assert 0.0 < crests[1] - crests[0] < 10.0


def test_in_a_long_beam_wave_the_deck_lies_along_the_drawn_water():
    # roll follows the slope of a wave much longer than the beam and slower than the ship rolls: tan phi = -d eta / dy.
    # With a natural frequency of 10 times that of the wave the quasi-static error is 1 %; drag and waves add a little
    ship = SHIP.with_(gm=1.2, gyradius_roll=3.0)
    wave = qt.Wave(3000.0, 20.0)
    one, _ = scene_of(ship, wave, 0.0, 90.0, 300.0)
    late = np.flatnonzero(one.moves.time > 200.0)
    slope = np.array([np.diff(one.elevation(np.zeros(2), np.array([-0.5, 0.5]), t))[0] for t in one.moves.time[late]])
    np.testing.assert_allclose(np.tan(one.moves.roll[late]), -slope, atol=0.1 * np.abs(slope).max())


def test_positive_roll_draws_starboard_down_and_positive_yaw_the_bow_to_starboard(scene):
    up = int(np.argmax(scene.moves.roll))
    scene.frame(up)
    outline = scene.aft_parts[2].get_xy()
    starboard, port = outline[0], outline[-2]  # ends of the deck; the polygon closes on the first
    assert scene.moves.roll[up] > 0.02
    assert starboard[0] > port[0]
    assert starboard[1] < port[1]
    turned = int(np.argmax(scene.moves.yaw))
    scene.frame(turned)
    deck = scene.above_parts[1].get_xy()
    bow, stern = deck[np.argmax(deck[:, 1])], deck[np.argmin(deck[:, 1])]
    assert bow[0] > stern[0]


def test_both_views_are_to_scale(scene):
    for ax in (scene.aft, scene.above):
        assert ax.get_aspect() == 1.0
    scene.frame(0)
    deck = scene.above_parts[1].get_xy()
    assert np.ptp(deck[:, 1]) == pytest.approx(SHIP.hull.x_fore - SHIP.hull.x_aft, rel=0.01)
    # the parabolic sections of the Wigley hull meet the calm water at half its beam
    assert shape_of(SHIP).waterline[:, 1].max() == pytest.approx(SHIP.hull.beam / 2, rel=0.005)


def test_simulate_writes_a_gif_whose_frames_last_a_known_time(run, tmp_path):
    result = run("simulate", "wigley", *CONDITION, "--duration", "40", "-o", "roll.gif")
    assert result.exit_code == 0, result.stderr
    assert "Wrote roll.gif" in result.stdout
    model = qt.equations(SHIP, qt.Wave(100.0, 2.0), 5.0, 60.0)
    period = 2 * np.pi / model.frequency
    with Image.open(tmp_path / "roll.gif") as film:
        chosen, step = frames_shown(moves_of(qt.simulate(model, 40.0), period), period)
        assert film.n_frames == chosen.size
        assert film.info["duration"] == 10 * round(100 * step / pace_of(period))


def test_a_capsize_ends_the_film_at_the_capsize():
    model = qt.equations(SHIP, qt.Wave(100.0, 2.0), 5.0, 60.0)
    trace = qt.simulate(model, 60.0, (0.0, np.radians(30.0), 2.0, 0.0))
    moves = moves_of(trace, 2 * np.pi / model.frequency)
    assert moves.time[-1] == trace.attrs["capsize_time"] < 30.0
    assert np.isfinite(np.stack(moves)).all()


def test_without_ffmpeg_a_film_is_refused_before_the_work(run, monkeypatch):
    monkeypatch.setattr(simulate_command.shutil, "which", lambda _name: None)
    result = run("simulate", "wigley", *CONDITION, "-o", "roll.mp4")
    assert result.exit_code == 2
    assert "written by ffmpeg, which is not on this machine" in result.stderr
    assert '"roll.gif"' in result.stderr


@pytest.mark.skipif(os.name == "nt", reason="the stand-in for ffmpeg is a shell script")
@pytest.mark.parametrize("fails", [False, True])
def test_ffmpeg_gets_every_frame_whole_and_its_refusal_is_told(run, tmp_path, monkeypatch, fails):
    stand_in = tmp_path / "stand-in"
    ending = 'echo "no such codec" >&2; exit 1' if fails else 'cat > "${@: -1}"'
    stand_in.write_text(f"#!/bin/bash\n{ending}\n")
    stand_in.chmod(stand_in.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setattr(simulate_command.shutil, "which", lambda _name: str(stand_in))
    result = run("simulate", "wigley", *CONDITION, "--duration", "10", "-o", "roll.mp4")
    if fails:
        assert result.exit_code == 2
        assert "no such codec" in result.stderr
        assert not (tmp_path / "roll.mp4").exists()
        return
    assert result.exit_code == 0, result.stderr
    size = (tmp_path / "roll.mp4").stat().st_size
    model = qt.equations(SHIP, qt.Wave(100.0, 2.0), 5.0, 60.0)
    period = 2 * np.pi / model.frequency
    count = frames_shown(moves_of(qt.simulate(model, 10.0), period), period)[0].size
    assert size == count * 940 * 630 * 3
