"""What the main records show of themselves: one short line, and a verdict in words where it is printed."""

from importlib import metadata

import pytest

import quartering as qt


@pytest.fixture(scope="module")
def records():
    ship = qt.ship("wigley")
    model = qt.equations(ship, qt.Wave(length=100.0, height=1.0), speed=0.0, heading=90.0)
    motion = qt.steady_motion(model)
    return {"Ship": ship, "Hull": ship.hull, "Model": model, "Motion": motion, "Verdict": qt.stability(model, motion)}


@pytest.mark.parametrize("name", ["Ship", "Hull", "Model", "Motion", "Verdict"])
def test_a_record_is_one_line_that_names_what_it_is(records, name):
    shown = repr(records[name])
    assert shown.startswith(f"<{name} ")
    assert shown.endswith(">")
    assert "\n" not in shown
    assert len(shown) < 250


def test_a_motion_shows_its_amplitudes_in_the_units_people_read(records):
    motion = records["Motion"]
    assert f"roll {motion.amplitude[1] * 57.29578:.3g} deg" in repr(motion)


def test_a_printed_verdict_is_its_sentence(records):
    assert str(records["Verdict"]) == records["Verdict"].sentence


@pytest.mark.parametrize(
    ("name", "shows"),
    [("Ship", ("<svg", "GM [m]")), ("Model", ("K_phi", "SI unit")), ("Motion", ("roll [deg]",)), ("Verdict", ("K2",))],
)
def test_a_notebook_shows_a_picture_or_a_table(records, name, shows):
    page = records[name]._repr_html_()
    assert all(words in page for words in shows)
    assert page.count("<table") == page.count("</table>") == 1


def test_datasets_draw_themselves_and_refuse_what_they_are_not():
    ship, waves = qt.ship("wigley"), [qt.Wave(80.0, 1.0), qt.Wave(100.0, 1.0), qt.Wave(120.0, 1.0)]
    polar = qt.polar(ship, waves, 5.0, [0.0, 60.0, 120.0, 180.0])
    assert polar.quartering.map().axes
    assert "<svg" in polar.quartering._repr_html_()
    with pytest.raises(qt.InputError, match="not a branch"):
        polar.quartering.branch()
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    curve = qt.branch(
        qt.Model([[1, 0, 0], [0, 1, 0], [0, 0, 1]], terms, 1.0, (0, 0.1, 0), (0, 0, 0)), limits=(0.8, 1.2), harmonics=1
    )
    assert len(curve.quartering.branch().axes) == 2
    assert (curve["roll_amplitude"] == curve["roll"]).all()
    with pytest.raises(qt.InputError, match="not a map"):
        curve.quartering.map()


def test_the_version_is_that_of_the_installed_package():
    assert qt.__version__ == metadata.version("quartering")


def test_completion_offers_public_names_alone():
    assert dir(qt) == sorted(qt.__all__)
