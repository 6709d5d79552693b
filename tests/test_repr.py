"""What the main records show of themselves: one short line, and a verdict in words where it is printed."""

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


def test_completion_offers_public_names_alone():
    assert dir(qt) == sorted(qt.__all__)
