"""A source of coefficients made here reaches table, model, sensitivity, maps and verdict; an estimate is one everywhere."""

import pytest

import quartering as qt
from quartering.hydro import coefficients as registry
from quartering.hydro.terms import Term
from quartering.study.condition.examine import examine, facts
from quartering.view.wording import estimates_of, notes, ship_notes

S60 = qt.ship("series60-cb60")
WAVE = qt.Wave(length=S60.hull.length, height=2.0)
PER_SPEED = -2.0e7


def heeled_damping(at):
    """A throw-away source: roll damping that grows with heel and speed."""
    words = "estimated: eddies of a heeled hull, made up for this test"
    return {"K_pphiphi": Term(PER_SPEED * at.speed, "estimated", words, ("Himeno81",))}


@pytest.fixture
def heeled(monkeypatch):
    """A ship whose equations have that source too, by one line of registration."""
    monkeypatch.setattr(registry, "SOURCES", (*registry.SOURCES, heeled_damping))
    return S60.with_(gm=0.8)


def test_a_new_source_of_coefficients_reaches_everything_with_its_own_words(heeled):
    entry = next(e for e in qt.coefficients(heeled, 0.5, 7.0).table() if e.name == "K_pphiphi")
    assert (entry.value, entry.kind) == (7.0 * PER_SPEED, "estimated")
    assert qt.equations(heeled, WAVE, 7.0, 60.0).terms["K_pphiphi"] == 7.0 * PER_SPEED
    assert "K_pphiphi" in qt.sensitivity(heeled, WAVE, 7.0, 60.0)["parameter"]
    said = facts(examine(heeled, WAVE, 7.0, 60.0), [])
    assert "K_pphiphi" in said["estimated"]
    assert said["sources"]["K_pphiphi"] == entry.source
    mapped = qt.sweep(heeled, [7.0], [60.0], [WAVE.length], [2.0])
    assert estimates_of(mapped.attrs)["eddies of a heeled hull"] == ["K_pphiphi"]
    for text in (ship_notes(heeled), *notes(mapped)):
        assert "K_pphiphi (eddies of a heeled hull)" in text
        assert "velocity derivatives Y_v .. N_r (9) (regression)" in text
    halved = heeled.with_(factors={"K_pphiphi": 0.5})
    assert qt.equations(halved, WAVE, 7.0, 60.0).terms["K_pphiphi"] == 3.5 * PER_SPEED


def test_a_new_source_is_felt_by_the_motion(heeled):
    """More damping, less roll: by the sign of the term alone."""
    with_it, without = (
        qt.steady_motion(qt.equations(one, WAVE, 7.0, 60.0)).amplitude[1]
        for one in (heeled.with_(factors={"K_pphiphi": 20.0}), heeled.with_(factors={"K_pphiphi": 0.0}))
    )
    assert with_it < without


def test_estimates_of_a_component_method_are_in_verdict_table_and_map_alike():
    """One list: what the table marks is what `quartering verdict --json` and a map's notes name."""
    keels = S60.with_(roll_damping="ikeda", bilge_keels=(30.0, 0.33))
    said = facts(examine(keels, WAVE, 7.0, 60.0), [])["estimated"]
    table = [e.name for e in qt.coefficients(keels, 0.5, 7.0).table() if e.source.startswith("estimated")]
    mapped = qt.sweep(keels, [7.0], [60.0], [WAVE.length], [2.0])
    assert {"K_p", "K_p|p|"} <= set(said)
    assert set(said) == set(table) == set(mapped.attrs["estimated_coefficients"].split(", "))
    assert "K_p, K_p|p| (component method of Ikeda on the lines)" in ship_notes(keels)


def test_a_map_of_an_earlier_version_still_names_its_estimates():
    assert estimates_of({"estimated_coefficients": "Y_v, K_p"}) == {"estimates": ["Y_v", "K_p"]}
    assert estimates_of({"estimated_coefficients": ""}) == {}
