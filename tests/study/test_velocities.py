"""`velocities` is one choice at every door: ship file, Python, case, sweep, cut, command line."""

import numpy as np
import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.hull.file.read import ship
from quartering.study.case.read import case_grid
from quartering.study.maps.query import cut
from quartering.view.cli import app

CASE = "ship: wigley\nspeed: 5 m/s\nheading: [60 deg]\nwave_length: 2 L\nwave_height: 1 m\n"
CONDITION = ["--heading", "60", "--speed", "5", "--wave-length", "2L", "--wave-height", "1"]


def test_relative_is_what_a_ship_has_unless_told():
    assert ship("series60-cb60").velocities == "relative"
    assert ship("series60-cb60").with_(velocities="absolute").with_(gm=1.0).velocities == "absolute"


def test_a_file_chooses_and_a_new_file_says_it(tmp_path):
    run = CliRunner().invoke
    assert run(app, ["new", "wigley", str(tmp_path / "new.yaml")]).exit_code == 0
    assert "velocities: relative" in (tmp_path / "new.yaml").read_text()
    (tmp_path / "my.yaml").write_text("base: wigley\nvelocities: absolute\n")
    assert ship(tmp_path / "my.yaml").velocities == "absolute"


def test_both_are_an_axis_of_a_study():
    """Each half of the sweep is the ship with that choice."""
    wigley = ship("wigley")
    both = qt.sweep(wigley, 5.0, [60.0, 120.0], 200.0, 1.0, velocities=["relative", "absolute"])
    assert both["velocities"].attrs["flag_meanings"] == "relative absolute"
    for word in ("relative", "absolute"):
        alone = qt.sweep(wigley.with_(velocities=word), 5.0, [60.0, 120.0], 200.0, 1.0)
        np.testing.assert_allclose(cut(both, velocities=word)["roll"].values, alone["roll"].values, rtol=1e-12)
    assert not np.allclose(both["roll"][0], both["roll"][1])


def test_a_case_takes_one_word_or_both(tmp_path):
    (tmp_path / "one.yaml").write_text(CASE + "loading: {velocities: absolute}\n")
    (tmp_path / "two.yaml").write_text(CASE + "loading:\n  velocities: [relative, absolute]\n")
    assert case_grid(tmp_path / "one.yaml").loaded(0).velocities == "absolute"
    assert [case_grid(tmp_path / "two.yaml").loaded(i).velocities for i in (0, 1)] == ["relative", "absolute"]


def test_the_command_line_chooses_and_hands_the_choice_on():
    told = CliRunner().invoke(app, ["verdict", "wigley", *CONDITION, "--velocities", "absolute"])
    assert told.exit_code == 0
    assert "--velocities absolute" in told.stdout
    plain = CliRunner().invoke(app, ["verdict", "wigley", *CONDITION])
    assert "--velocities" not in plain.stdout
    assert told.stdout.splitlines()[3:8] != plain.stdout.splitlines()[3:8]


def test_a_misspelt_word_gets_the_nearest_one_at_every_door(tmp_path):
    with pytest.raises(qt.InputError, match='did you mean "relative"'):
        ship("wigley").with_(velocities="relativ")
    with pytest.raises(qt.InputError, match='did you mean "absolute"'):
        qt.sweep(ship("wigley"), 5.0, 60.0, 200.0, 1.0, velocities=["absolut"])
    (tmp_path / "my.yaml").write_text("base: wigley\nvelocities: relativ\n")
    with pytest.raises(qt.InputError, match='did you mean "relative"'):
        ship(tmp_path / "my.yaml")
    (tmp_path / "case.yaml").write_text(CASE + "loading: {velocities: absolut}\n")
    with pytest.raises(qt.InputError, match=r"line 6.*absolute"):
        case_grid(tmp_path / "case.yaml")
    told = CliRunner().invoke(app, ["verdict", "wigley", *CONDITION, "--velocities", "absolut"])
    assert told.exit_code == 2
    assert 'did you mean "absolute"' in told.stderr


def test_a_measured_set_without_its_speed_is_refused(tmp_path):
    """Its lift is that of one speed: a set that does not say which is no set."""
    from quartering.hydro.manoeuvring.measured import LIBRARY

    text = (LIBRARY / "son-nomoto-1982.yaml").read_text()
    (tmp_path / "set.yaml").write_text(text.replace("speed: 10.29, ", ""))
    with pytest.raises(qt.InputError, match="no speed is given"):
        qt.coefficients(ship("s175").with_(measured=tmp_path / "set.yaml"), 0.5, 8.0)


@pytest.mark.parametrize(("speed", "heading", "length"), [(20.0, 0.0, 60.0), (16.0, 30.0, 80.0)])
def test_a_ship_that_overtakes_the_wave_has_a_motion(speed, heading, length):
    """omega < 0: conjugate phasors at |omega|; the force is finite and, off the following sea, not nothing."""
    s175 = ship("s175")
    assert qt.encounter_frequency(qt.Wave(length, 1.0).frequency, speed, heading) < 0.0
    force = qt.wave_forces(s175, qt.Wave(length, 1.0), speed, heading)["lift"]
    assert np.isfinite(force.values).all()
    assert bool((force != 0.0).any()) == (heading != 0.0)
