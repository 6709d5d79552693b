"""Roll damping by components as a ship's choice: what reaches the equations is the components' own sum."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import quartering as qt
from quartering.conventions import GRAVITY
from quartering.hydro.damping.forms import LINEAR_OF_QUADRATIC
from quartering.hydro.damping.natural_roll import free_roll
from quartering.hydro.damping.of_ship import METHODS, equivalent_fraction
from quartering.hydro.damping.roll import roll_damping
from quartering.hydro.manoeuvring.measured_ship import measured_parts
from quartering.hydro.terms import estimates
from quartering.study.effects.cure import cures
from quartering.study.effects.uncertainty import uncertain
from quartering.study.grid import grid

S60 = qt.ship("series60-cb60")
KEELS = (30.0, 0.33)
CALLED = {"ikeda": "ikeda", "ikeda-simplified": "simplified"}


def by_components(method="ikeda", keels=KEELS, ship=S60):
    return ship.with_(roll_damping=method, bilge_keels=keels)


def values(c, condition=0):
    return {entry.name: entry for entry in c.table(condition)}


@pytest.mark.parametrize("method", CALLED)
@pytest.mark.parametrize("amplitude", [5.0, 10.0, 15.0])
def test_the_equations_lose_the_energy_of_the_components_at_rest(method, amplitude):
    """[Himeno81]: B_e = B1 + (8/(3 pi)) B2 p_a, waves of the strips at the natural frequency included."""
    ship = by_components(method)
    n2 = free_roll(ship).frequency
    at = values(qt.coefficients(ship, n2, 0.0))
    equations = -at["K_p"].value - LINEAR_OF_QUADRATIC * n2 * np.radians(amplitude) * at["K_p|p|"].value
    parts = roll_damping(ship, 0.0, n2, amplitude, method=CALLED[method])
    # the regression has waves of its own, the equations have them as components in place of the strips' at n2
    assert equations == pytest.approx(parts.equivalent, rel=0.03)  # misfit of the form is 1.4 % (mean square)


def test_every_speed_has_its_own_damping_and_the_lift_of_the_regression_is_left_out():
    ship, speeds = by_components(), np.array([7.5, 0.0, 4.0, 7.5])
    n2 = free_roll(ship).frequency
    c = qt.coefficients(ship, n2, speeds)
    for k, u in enumerate(speeds):
        form = roll_damping(ship, u, n2, 10.0).quadratic
        assert values(c, k)["K_p"].value == pytest.approx(-form.linear, rel=1e-9)
        assert values(c, k)["K_p|p|"].value == pytest.approx(-form.nonlinear, rel=1e-9)
    fraction = qt.coefficients(S60, n2, speeds)
    others = np.ones((3, 3), dtype=bool)
    others[1, 1] = False
    np.testing.assert_array_equal(c.linear[:, others], fraction.linear[:, others])


def test_bilge_keels_add_damping_and_the_ships_own_are_taken():
    bare, fitted = by_components(keels=None), by_components()
    n2 = free_roll(bare).frequency
    assert roll_damping(bare, 0.0, n2, 10.0).bilge_keel == 0.0
    own = roll_damping(fitted, 0.0, n2, 10.0)
    assert own.bilge_keel == roll_damping(bare, 0.0, n2, 10.0, bilge_keel=KEELS).bilge_keel > 0.0


def test_a_map_and_one_condition_use_the_same_damping():
    ship = by_components()
    table = qt.sweep(ship, [4.0, 7.5], [60.0, 90.0], [122.0], [2.0])
    for u in (4.0, 7.5):
        for mu in (60.0, 90.0):
            motion = qt.steady_motion(qt.equations(ship, qt.Wave(122.0, 2.0), u, mu))
            mapped = float(table["roll"].sel(speed=u, heading=mu).squeeze())
            assert mapped == pytest.approx(np.degrees(motion.amplitude[1]), rel=1e-8)
    assert "K_p|p|" in table.attrs["estimated_coefficients"].split(", ")
    assert "bilge keels 30 x 0.33 m" in table.attrs["loading"]


def test_sources_name_the_method_and_say_estimated():
    at = values(qt.coefficients(by_components("ikeda-simplified"), 0.5, 5.0))
    for name in ("K_p", "K_p|p|"):
        assert at[name].kind == "estimated"
        assert at[name].source.startswith(
            "estimated: regression of Kawahara, Maekawa and Ikeda, bilge keels 30 x 0.33 m"
        )
    assert {"Kawahara09", "Ikeda78b"} <= set(qt.coefficients(by_components("ikeda-simplified"), 0.5, 5.0).references)


def test_multiplier_and_own_value_of_the_quadratic_term_count():
    ship = by_components()
    plain, halved = (
        values(qt.coefficients(s, 0.5, 5.0))["K_p|p|"].value for s in (ship, ship.with_(factors={"K_p|p|": 0.5}))
    )
    assert halved == 0.5 * plain


def test_of_a_measured_roll_damping_and_the_components_the_larger_counts():
    """Naval vessel's set [Blanke93]: measured 1.45e8 N m s at 10 m/s; without keels less is computed, with wide ones more."""
    vessel = qt.ship("s175").with_(measured="blanke-christensen-1993")
    n2 = free_roll(vessel).frequency
    measured = -float(measured_parts(vessel, np.array([10.0])).roll_damping[0])

    def at_ten_degrees(ship):
        at = values(qt.coefficients(ship, n2, 10.0))
        return -at["K_p"].value - LINEAR_OF_QUADRATIC * n2 * np.radians(10.0) * at["K_p|p|"].value

    alone = at_ten_degrees(vessel.with_(roll_damping=0.0))
    bare, wide = (by_components(keels=keels, ship=vessel) for keels in (None, (60.0, 1.0)))
    less, more = (roll_damping(ship, 10.0, n2, 10.0).added for ship in (bare, wide))
    assert less < measured < more
    assert at_ten_degrees(bare) == alone
    assert at_ten_degrees(wide) == pytest.approx(alone + more - measured, rel=0.03)


@pytest.mark.parametrize("speed", [0.0, 7.5])
def test_the_fraction_of_critical_is_what_the_components_add_at_ten_degrees(speed):
    """[Himeno81]: zeta = B_e/(2 n2 I), here of what is added to the strips at rest."""
    ship = by_components()
    roll = free_roll(ship)
    added = roll_damping(ship, speed, roll.frequency, 10.0).added
    expected = added / (2 * roll.frequency * roll.inertia)
    assert equivalent_fraction(ship, speed) == pytest.approx(expected, rel=0.03)  # misfit of the form


def test_a_number_takes_the_place_of_the_method():
    again = by_components().with_(roll_damping=0.0)
    assert (again.roll_method, again.roll_damping_words) == ("fraction", "0 of critical")
    assert again.provenance["roll_damping"].startswith("given")
    assert by_components().with_(gm=1.0).roll_method == "ikeda"


def test_what_multiplies_a_fraction_of_critical_does_not_touch_the_components():
    restless = by_components().with_(
        factors={"K_prr": -100}, velocities="absolute", drag="cubic", ends="strips", righting="polynomial"
    )
    found = cures(restless, qt.Wave(121.92, 4.0), 8.6, 30.0, parameters=["roll_damping", "K_prr"])
    assert [one.parameter for one in found] == ["K_prr"]
    with pytest.raises(qt.InputError, match=r"roll_damping is 0 for .*name the coefficient"):
        uncertain(grid(by_components(), 5.0, [60.0], 100.0, 1.0), {"roll_damping": "20%"}, draws=16)


def written(tmp_path, text):
    path = tmp_path / "ship.yaml"
    path.write_text(f"base: series60-cb60\n{text}\n")
    return path


def test_a_ship_file_names_the_method_and_its_bilge_keels(tmp_path):
    ship = qt.ship(written(tmp_path, "loading:\n  roll_damping: ikeda\nbilge_keels: {length: 0.25 L, breadth: 0.02 B}"))
    assert ship.roll_method == "ikeda"
    assert ship.bilge_keels == pytest.approx((0.25 * S60.hull.length, 0.02 * S60.hull.beam))
    assert ship.provenance["roll_damping"].startswith("estimated: component method of Ikeda")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "loading:\n  roll_damping: ikada",
            "loading, roll_damping = 'ikada'.*did you mean ikeda.*ikeda or ikeda-simplified",
        ),
        ("bilge_keels: {length: 30 m, breadth: 30 m}", "bilge_keel_breadth = 30 m; it is from 0 m to 0.25 B = 4.064 m"),
        ("bilge_keels: {length: 300 m, breadth: 0.3 m}", "bilge_keel_length = 300 m; it is from 0 m to 1 L = 121.9 m"),
        ("bilge_keels: {length: 30 m}", "bilge_keels: breadth is missing"),
        ("bilge_keels: 3", "bilge_keels = 3; it is a group of length, breadth"),
    ],
)
def test_a_wrong_word_or_size_is_refused_with_one_message(tmp_path, text, words):
    with pytest.raises(qt.InputError, match=words):
        qt.ship(written(tmp_path, text))


def test_the_method_of_the_contributing_page_works_as_it_says(monkeypatch):
    """Closed form: 2 % of critical and 10 % a Froude number in K_p, a third of it more at 10 deg."""
    page = (Path(__file__).parents[2] / "CONTRIBUTING.md").read_text()
    made: dict[str, object] = {}
    exec(next(one for one in re.findall(r"```python\n(.*?)```", page, re.DOTALL) if "SPEED = " in one), made)
    monkeypatch.setitem(METHODS, "by-speed", made["SPEED"])
    ship = replace(S60.with_(roll_damping=0.0), roll_method="by-speed")
    speeds = np.array([0.0, 7.5])
    froude = speeds / np.sqrt(GRAVITY * ship.hull.length)
    with_it, without = (qt.coefficients(one, 0.5, speeds) for one in (ship, S60.with_(roll_damping=0.0)))
    added = with_it.linear[:, 1, 1] - without.linear[:, 1, 1]
    critical = -2.0 * free_roll(ship).frequency * free_roll(ship).inertia
    np.testing.assert_allclose(added, critical * (0.02 + 0.1 * froude), rtol=1e-12)
    rate = free_roll(ship).frequency * np.radians(10.0)
    at = values(with_it, 1)["K_p|p|"]
    assert LINEAR_OF_QUADRATIC * rate * at.value == pytest.approx(added[1] / 3, rel=1e-12)
    assert (at.kind, equivalent_fraction(ship, 7.5)) == ("estimated", pytest.approx(4 / 3 * (0.02 + 0.1 * froude[1])))
    assert estimates(with_it.table())["damping by Froude number"] == ["K_p", "K_p|p|"]
