"""A ship that a wave carries along: closed forms, other codes of this library, and integration in time."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import quartering as qt
from quartering.hydro.coefficients import coefficients
from quartering.hydro.propulsion import drive_of
from quartering.loads.forces import ship_force_phasors
from quartering.loads.lift import ship_lift_phasors
from quartering.loads.wetted_hull.frozen import along_following
from quartering.motion.wave_equilibria import Search, places, straight
from quartering.motion.wave_riding import PLACE, ROLL, STATES, YAW, P, R, Rider, U, V
from quartering.study.six_modes.broaching import OnTheWave

S175 = qt.ship("s175")
DRIVEN = drive_of(S175, estimate=True).propulsion
WAVE = qt.Wave(175.0, 6.0)
SPEED = 0.35 * math.sqrt(9.81 * 175.0)
TURNS = DRIVEN.revolutions(SPEED, S175.loading.density)


def on_the_wave(rider, turns=TURNS):
    """Search over heading, and the equilibrium straight ahead that is stable in surge."""
    search = Search(rider, "heading", turns)
    place = next(where for where, stable in places(rider, turns) if stable)
    return search, search.at(straight(rider, place))


def test_surge_on_the_wave_is_a_mass_on_a_spring():
    """Closed form: s^2 - (T_u - R_u)/M s - k X'/M = 0, X' by a difference of the balanced force."""
    rider = Rider(S175, WAVE, DRIVEN, None)
    search, point = on_the_wave(rider)
    k, c, density = WAVE.wavenumber, rider.celerity, S175.loading.density
    tau0, tau1, tau2 = DRIVEN.thrust_terms(density)
    del tau0
    mass = qt.surf_riding(S175, WAVE).mass + qt.surf_riding(S175, WAVE).added_mass
    drag = np.polynomial.Polynomial(DRIVEN.resistance).deriv()(c)
    places_, held = along_following(S175, k, WAVE.amplitude, 720)
    slope = np.interp(point[0], places_, np.gradient(held.load[:, 0], places_))
    expected = np.roots([1.0, -(tau1 * TURNS + 2 * tau2 * c - drag) / mass, -k * slope / mass])
    found = search.judged(point).eigenvalues
    for one in expected:
        assert np.abs(found - one).min() < 1e-4 * abs(one)


def test_on_a_low_wave_the_course_is_that_of_calm_water():
    """Limit: eigenvalues of inertia, derivatives at no frequency, GM and autopilot, put together here; 1e-3."""
    ship = S175.with_(autopilot="1,10s")
    low = qt.Wave(175.0, 0.002)
    rider = Rider(ship, low, DRIVEN, ship.autopilot)
    turns = DRIVEN.revolutions(rider.celerity, ship.loading.density)
    search, point = on_the_wave(rider, turns)
    c = coefficients(ship, np.zeros(1), np.array([rider.celerity]))
    matrix = np.zeros((5, 5))
    weight = 9.81 * qt.hydrostatics(ship).mass
    right = np.zeros((3, 5))
    right[:, :3] = c.linear[0]
    right[1, 3] = -weight * ship.loading.gm
    right[:, 4] -= c.rudder[0]
    right[:, 2] -= 10.0 * c.rudder[0]
    matrix[:3] = np.linalg.solve(c.inertia[0], right)
    matrix[3, 1] = matrix[4, 2] = 1.0
    found = search.judged(point).eigenvalues
    for one in np.linalg.eigvals(matrix):
        assert np.abs(found - one).min() < 1e-3 * abs(one) + 1e-5


@pytest.mark.parametrize("place", [-1.0, 0.5, 2.0])
def test_forces_by_heading_are_those_of_the_strips_at_a_small_heading(place):
    """Authority: phasors of the linear wave force and of lift in moving water, low wave, a heading of 1e-4 rad; 1 %."""
    low, small = qt.Wave(175.0, 0.2), 1e-4
    rider = Rider(S175, low, DRIVEN, None)
    at, zero = np.array([place]), np.zeros(1)
    by = [rider.loads(at, zero, np.array([turn])).load[0, [1, 3, 5]] for turn in (small, -small)]
    still = np.zeros((1, 3))
    lift = rider._lateral(np.array([rider.celerity]), still, at, zero, np.array([small]), zero)[0] / small
    condition = (np.array([v]) for v in (low.wavenumber, rider.celerity, -math.degrees(small)))
    k, speed, heading = condition
    crest = -1j * np.exp(-1j * (place - math.pi)) * low.amplitude / small  # the wave passes the ship from behind
    froude_krylov = (ship_force_phasors(S175, k, speed, heading)[0][0] * crest).real
    moving = ship_lift_phasors(S175, coefficients(S175, np.zeros(1), speed), k, speed, heading)[0] * crest
    np.testing.assert_allclose(
        (by[0] - by[1]) / (2 * small), froude_krylov, rtol=0.01, atol=0.01 * abs(froude_krylov[1])
    )
    np.testing.assert_allclose(lift, moving.real, rtol=0.01)


@pytest.mark.parametrize("pilot", [None, qt.Autopilot(0.3, 5.0, 2.0)])
def test_a_deviation_grows_in_time_as_the_eigenvalue_says(pilot):
    """Authority: an independent integrator of the whole nonlinear equations, from a small deviation; 2 %."""
    rider = Rider(S175, WAVE, DRIVEN, pilot)
    search, point = on_the_wave(rider)
    judged = search.judged(point)
    assert judged.growth > 0
    assert abs(judged.eigenvalues[0].imag) < 1e-9
    values, vectors = np.linalg.eig(rider.matrix(judged.state, TURNS, 0.0))
    along = vectors[:, values.real.argmax()].real
    begin, span = judged.state + 1e-4 * along / np.abs(along).max(), 2.0 / judged.growth
    path = solve_ivp(
        lambda _, y: rider.rates(y[None], TURNS, 0.0)[0],
        (0, span),
        begin,
        rtol=1e-7,
        atol=1e-10,
        t_eval=[0.2 * span, span],
    )
    measured = math.log((path.y[YAW, 1] - judged.state[YAW]) / (path.y[YAW, 0] - judged.state[YAW])) / (0.8 * span)
    assert measured == pytest.approx(judged.growth, rel=0.02)


def test_the_critical_gain_parts_stable_from_unstable():
    found = qt.broaching(S175.with_(autopilot="0.2,10s"), WAVE, SPEED)
    assert found.kind == "broaches"
    for factor, stable in ((0.98, False), (1.02, True)):
        steered = S175.with_(autopilot=qt.Autopilot(factor * found.critical_gain, 10.0))
        assert (qt.broaching(steered, WAVE, SPEED).growth < 0) is stable
    assert found.yaw_slope > 0  # the wave turns the ship away from its direction on the face
    assert qt.broaching(S175, WAVE, SPEED).critical_gain > 0


def test_port_and_starboard_are_alike():
    """Symmetry: equilibria at the opposite heading are mirrored."""
    rider = Rider(S175, WAVE, DRIVEN, qt.Autopilot(1.0, 10.0))
    search, point = on_the_wave(rider)
    ahead = [np.array([*point[:5], angle]) for angle in (0.1, -0.1)]
    one, other = (search.at(guess) for guess in ahead)
    np.testing.assert_allclose(other, one * np.array([1, -1, -1, -1, 1, -1]), atol=1e-7)
    both = [search.judged(state).eigenvalues for state in (one, other)]
    np.testing.assert_allclose(np.sort_complex(both[0]), np.sort_complex(both[1]), atol=1e-6)


@pytest.mark.soak
def test_the_wave_lets_the_ship_go_where_its_equilibria_fold():
    """Two equilibria meet at the fold: a real eigenvalue passes zero there, and beyond it none is found."""
    steered = S175.with_(autopilot="1,10s")
    ds = qt.broaching_branch(steered, WAVE, SPEED)
    fold = int(np.flatnonzero(ds.event.values == 1)[0])
    assert ds.heading.values[fold] == pytest.approx(ds.heading.values.max())
    found = qt.broaching(steered, WAVE, SPEED)
    assert found.exists_to == pytest.approx(float(ds.heading.max()), abs=0.01)
    assert 0 < found.stable_to < found.exists_to
    beyond = qt.broaching(steered, WAVE, SPEED, found.exists_to + 1.0)
    assert beyond.status is OnTheWave.LOST_ON_THE_WAY
    assert "end at" in beyond.sentence
    assert (ds.event.values == 2).any()
    swings = qt.broaching(steered, WAVE, SPEED, 0.5 * (found.stable_to + found.exists_to))
    assert swings.kind == "oscillates"
    assert abs(swings.eigenvalues[0].imag) > 0.01


def test_over_revolutions_the_branch_ends_where_no_equilibrium_is_left():
    """First threshold of surf-riding, of a wave so low that thrust is needed: X = R - T has its largest value there."""
    low = qt.Wave(175.0, 2.5)
    speed = 0.37 * math.sqrt(9.81 * 175.0)
    ds = qt.broaching_branch(S175.with_(autopilot="1,10s"), low, speed, over="revolutions")
    _, held = along_following(S175, low.wavenumber, low.amplitude, 720)
    rider = Rider(S175, low, DRIVEN, None)
    first = DRIVEN.revolutions(rider.celerity, S175.loading.density, -float(held.load[:, 0].max()))
    assert float(ds.revolutions.min()) == pytest.approx(first, rel=2e-3)


def test_what_has_no_answer_says_so():
    passed = qt.broaching(S175, qt.Wave(175.0, 0.5), "5 kn")
    assert (passed.status, passed.kind) == (OnTheWave.PASSED, "not on the wave")
    assert math.isnan(passed.growth)
    assert "no surf-riding" in passed.sentence
    nothing = qt.broaching(qt.ship("box").with_(beam=60.0), qt.Wave(100.0, 3.0), 5.0)
    assert nothing.status is OnTheWave.NO_PROPULSION
    wild = qt.broaching(S175.with_(autopilot="8,20s"), WAVE, SPEED, 25.0)
    assert wild.status in (OnTheWave.FOUND, OnTheWave.BEYOND_THE_RUDDER)
    assert (abs(wild.rudder) > 35) is (wild.status is OnTheWave.BEYOND_THE_RUDDER)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"wave": qt.Wave(175.0, 0.0)}, "wave_height = 0 m; broaching needs a wave"),
        ({"heading": 20.0}, "without an autopilot no heading is held"),
        ({"heading": 90.0}, "from 0 .following. to 60 deg"),
        ({"speed": -1.0}, "speed = -1"),
        ({"ship": 1}, "is no Ship"),
    ],
)
def test_nonsense_is_refused(given, words):
    with pytest.raises(qt.InputError, match=words):
        qt.broaching(**({"ship": S175, "wave": WAVE, "speed": SPEED} | given))


def test_states_have_the_order_they_are_named_in():
    assert STATES[:7] == ("u", "v", "p", "r", "place", "roll", "yaw")
    assert [STATES[i] for i in (U, V, P, R, PLACE, ROLL, YAW)] == list(STATES[:7])
