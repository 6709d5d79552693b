"""Surf-riding of ships by the force on their own hull: the theory's force, limits, and marches of the surge equation."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import quartering as qt
from quartering.hydro.propulsion import drive_of
from quartering.study.six_modes.surf_riding import KINDS, Riding, kind_at

# N per metre of amplitude, volume integral of a low wave; theory, section 8.7, `sgisc`, wave over ship length 1, 1.5, 2
SURGE = {1.0: 2889515.8152083047, 1.5: 3534209.053920671, 2.0: 3242190.343579013}
S175 = qt.ship("s175")


@pytest.mark.parametrize(("ratio", "force"), SURGE.items())
def test_the_force_of_a_low_wave_is_that_of_the_theory(ratio, force):
    """1e-3 is the difference between its sections and ours in volume."""
    found = qt.surf_riding(S175, qt.Wave(175.0 * ratio, 0.02))
    assert found.force / 0.01 == pytest.approx(force, rel=1e-3)
    assert found.force_low / 0.01 == pytest.approx(force, rel=1e-3)


@pytest.mark.parametrize("name", ["s175", "fishing-30m", "wigley"])
def test_a_very_long_wave_pushes_with_the_weight_times_its_slope(name):
    """Closed form: a body that rides the surface feels W sin(slope); to O((kL)^2) = 0.01 at sixty ship lengths."""
    ship = qt.ship(name)
    length = 60 * ship.hull.length
    found = qt.surf_riding(ship, qt.Wave(length, 0.02 * length))
    weight = 9.81 * found.mass
    assert found.status is Riding.NO_SECOND_THRESHOLD  # no ship is as fast as such a wave
    assert found.force / (weight * 2 * math.pi / length * 0.01 * length) == pytest.approx(1.0, abs=0.01)


def test_in_a_low_wave_all_thresholds_are_the_celerity():
    """Closed form: with f -> 0 an equilibrium exists where T(c) = R(c) alone."""
    found = qt.surf_riding(S175, qt.Wave(175.0, 0.002))
    driven = drive_of(S175, estimate=True).propulsion
    at = driven.revolutions(found.celerity, S175.loading.density)
    for revolutions in (found.first_revolutions, found.revolutions_exact, found.last_revolutions):
        assert revolutions == pytest.approx(at, rel=1e-3)
    assert found.froude_exact == pytest.approx(found.celerity_froude, rel=2e-3)


def test_thresholds_are_those_of_the_force():
    driven = qt.Propulsion((0, 0, 12e3, 500.0), 6.0, 0.15, 0.2, (0.45, -0.3, -0.1))
    found = qt.surf_riding(S175, qt.Wave(200.0, 6.0), driven)
    alone = qt.surf_riding_thresholds(
        mass=found.mass,
        added_mass=found.added_mass,
        length=175.0,
        propulsion=driven,
        wave_length=200.0,
        force=found.force,
    )
    assert (found.revolutions, found.revolutions_exact) == (alone.revolutions, alone.revolutions_exact)
    assert not found.estimated
    told = qt.surf_riding(S175.with_(propulsion=driven), qt.Wave(200.0, 6.0))
    assert told.revolutions_exact == found.revolutions_exact


def starts_caught(found, driven, froude):
    """Share of starts, at 8 places of the wave with the nominal speed or the wave's, that are still on it after 80 periods."""
    unit, k, density = math.sqrt(9.81 * S175.hull.length), 2 * math.pi / found.wave.length, S175.loading.density
    tau0, tau1, tau2 = driven.thrust_terms(density)
    n = driven.revolutions(froude * unit, density)

    def rates(_, y):
        u = found.celerity + y[1]
        push = tau0 * n**2 + tau1 * n * u + tau2 * u**2 - driven.drag(u)
        return [y[1], (push - found.force * math.sin(k * y[0])) / (found.mass + found.added_mass)]

    caught = []
    for xi in np.linspace(0, found.wave.length, 8, endpoint=False):
        for begin in (froude * unit - found.celerity, 0.0):
            path = solve_ivp(rates, (0, 80 * found.wave.length / found.celerity), [xi, begin], rtol=1e-8, atol=1e-8)
            late = path.y[0, path.t > 0.8 * path.t[-1]]
            caught.append(np.ptp(late) < 0.9 * found.wave.length)
    return np.mean(caught)


@pytest.mark.parametrize(
    ("froude", "kind", "least", "most"),
    [
        (0.17, "periodic surging", 0.0, 0.0),
        (0.29, "surf-riding from some starts", 0.05, 0.95),
        (0.37, "surf-riding always", 1.0, 1.0),
    ],
)
def test_a_march_of_the_surge_equation_does_as_the_kind_says(froude, kind, least, most):
    """Authority: an independent integrator."""
    driven = drive_of(S175, estimate=True).propulsion
    found = qt.surf_riding(S175, qt.Wave(175.0, 2.8), speed=f"{froude} Fn")
    assert found.kind == kind
    assert least <= starts_caught(found, driven, froude) <= most


def test_speeds_rise_through_the_kinds_in_their_order():
    froudes = np.linspace(0.05, 0.7, 60)
    seen = [kind_at(float(one), 0.2, 0.3, 0.4, 0.5) for one in froudes]
    assert [*dict.fromkeys(seen)] == list(KINDS[1:])


def test_what_has_no_answer_says_so():
    nothing = qt.surf_riding(qt.ship("box").with_(beam=60.0), qt.Wave(100.0, 3.0))
    assert nothing.status is Riding.NO_PROPULSION
    assert math.isnan(nothing.froude)
    assert "give resistance and propeller" in nothing.sentence
    fast = qt.surf_riding(S175, qt.Wave(175.0, 3.0), speed="0.45 Fn")
    assert fast.status is Riding.FASTER_THAN_THE_WAVE
    assert "above the celerity" in fast.sentence
    deep = qt.surf_riding(S175, qt.Wave(175.0, 25.0))
    assert deep.status in (Riding.FOUND, Riding.FORCE_OF_LOW_WAVE)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"wave": qt.Wave(100.0, 0.0)}, "wave_height = 0 m; surf-riding needs a wave"),
        ({"speed": "-3"}, "speed = -3"),
        ({"propulsion": 3.0}, "propulsion = 3.0 is no Propulsion"),
        ({"ship": "s175"}, "is no Ship"),
    ],
)
def test_nonsense_is_refused(given, words):
    with pytest.raises(qt.InputError, match=words):
        qt.surf_riding(**({"ship": S175, "wave": qt.Wave(175.0, 3.0)} | given))


def test_the_map_has_the_thresholds_of_each_wave():
    ds = qt.surf_riding_map(S175, ["1 L", "1.5 L"], [0.02, 0.05])
    one = qt.surf_riding(S175, qt.Wave(262.5, 0.05 * 262.5))
    assert float(ds.second[1, 1]) == one.froude_exact
    assert float(ds.celerity[0, 0]) == pytest.approx(1 / math.sqrt(2 * math.pi), rel=1e-12)  # c/sqrt(g L), lambda = L
    assert (np.diff(ds.second, axis=1) < 0).all()  # a steeper wave catches sooner
    assert ds.attrs["propulsion"].startswith("estimated")
    with pytest.raises(qt.InputError, match="steepness"):
        qt.surf_riding_map(S175, "1 L", [0.5])
