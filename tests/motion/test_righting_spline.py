"""The righting curve as a spline: through periodic motions, their stability and histories in time."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

import quartering as qt
from quartering.hull.righting.arm import polynomial_miss, righting_arm, righting_spline, vanishing_angle
from quartering.hull.righting.spline import odd_spline
from quartering.motion.steady.harmonic import harmonic_balance
from tests.tiers import mostly_soak

TERMS = {"Y_v": -0.4, "K_v": 0.1, "K_p": -0.05, "K_ppp": -0.08, "N_r": -0.6, "N_v": -0.1, "K_prr": 0.2}
ANGLES = np.arange(0.0, 81.0, 5.0)
FORCE = (0.85, (0.1, 0.05, 0.06), (0.0, 0.15, 0.1))


def deck_edge(angles):
    """A made-up righting moment with a deck edge at 25 deg: hardening, then losing its area, gone at about 70 deg."""
    x = np.radians(angles)
    return np.sin(x) * (1 + 0.8 * np.tan(np.minimum(x, 0.44)) ** 2) - 1.1 * np.maximum(x - 0.44, 0.0) ** 2


def model_with(moments, mean=(0.0, 0.0, 0.0), angles=ANGLES):
    return qt.Model(np.eye(3), TERMS, *FORCE, mean, restoring=(angles, moments))


@pytest.mark.parametrize("mean", [(0, 0, 0), (0, 0.1, 0)], ids=["symmetric", "heeled"])
@pytest.mark.parametrize("harmonics", [1, 9])
def test_spline_of_an_exact_cubic_is_the_polynomial(mean, harmonics):
    x = np.radians(ANGLES)
    by_spline = model_with(x + 0.25 * x**3, mean)
    exact = qt.Model(np.eye(3), TERMS | {"K_phi": -1.0, "K_phiphiphi": -0.25}, *FORCE, mean)
    found, expected = (qt.steady_motion(model, harmonics) for model in (by_spline, exact))
    np.testing.assert_allclose(found.coefficients, expected.coefficients, rtol=0, atol=1e-10)
    ours, theirs = qt.stability(by_spline, found), qt.stability(exact, expected)
    np.testing.assert_allclose(ours.exponents, theirs.exponents, rtol=0, atol=1e-9)
    assert ours.k2 == pytest.approx(theirs.k2, rel=1e-9)


def test_spline_between_its_points_is_scipys():
    spline = odd_spline(ANGLES, deck_edge(ANGLES))
    x = np.radians(np.linspace(0.0, 80.0, 333))
    theirs = CubicSpline(np.radians(ANGLES), deck_edge(ANGLES), bc_type=((2, np.zeros(())), "not-a-knot"))
    np.testing.assert_allclose(spline.value(x), theirs(x), rtol=0, atol=1e-13)
    np.testing.assert_allclose(spline.derivative(-x), theirs(x, 1), rtol=0, atol=1e-12)
    np.testing.assert_allclose(spline.value(-x), -theirs(x), rtol=0, atol=1e-13)


def test_a_known_slope_at_zero_is_met_beside_the_points():
    """Closed form: sin(x), whose slope at 0 is 1; the error of a spline every 4 deg is h^4/384 of its fourth derivative."""
    angles = np.arange(4.0, 97.0, 4.0)
    x, free = np.radians(np.arange(0.0, 90.0, 0.25)), odd_spline(angles, np.sin(np.radians(angles)))
    for slope in (1.0, 1.01):  # a slope that the points do not have bends the first piece only
        spline = odd_spline(angles, np.sin(np.radians(angles)), slope=slope)
        assert spline.slope == slope
        assert float(spline.derivative(0.0)) == slope
        np.testing.assert_allclose(spline.value(np.radians(angles)), np.sin(np.radians(angles)), atol=1e-13)
        far = x > np.radians(40.0)
        np.testing.assert_allclose(spline.value(x[far]), free.value(x[far]), atol=1e-2 * abs(slope - free.slope))
        if slope == 1.0:
            x = x[x < np.radians(80.0)]  # away from the last angle, where nothing is known of the slope
            np.testing.assert_allclose(spline.value(x), np.sin(x), atol=2 * np.radians(4.0) ** 4 / 384)
            np.testing.assert_allclose(spline.derivative(x), np.cos(x), atol=np.radians(4.0) ** 3 / 24)


def rates(t, y, spline, mean):
    """The equations written out, their righting moment scipy's spline."""
    v, phi, p, r = y
    w, cos, sin = FORCE
    wave = np.array(mean) + np.array(cos) * np.cos(w * t) + np.array(sin) * np.sin(w * t)
    righting = np.sign(phi) * spline(abs(phi))
    roll = 0.1 * v - 0.05 * p - 0.08 * p**3 + 0.2 * p * r**2 - righting
    return np.array([-0.4 * v + wave[0], p, roll + wave[1], -0.6 * r - 0.1 * v + wave[2]])


@pytest.mark.parametrize("mean", mostly_soak([(0, 0, 0), (0, 0.05, 0)], (0, 0.05, 0)), ids=["symmetric", "heeled"])
def test_periodic_motion_agrees_with_direct_integration_to_1e_8(mean):
    """Authority: DOP853 at relative tolerance 1e-12 over a period, short steps; the spline beyond its knots is scipy's."""
    motion = qt.steady_motion(model_with(deck_edge(ANGLES), mean), 101)
    assert motion.peak[1] > np.radians(25.0)  # past the deck edge
    spline = CubicSpline(np.radians(ANGLES), deck_edge(ANGLES), bc_type=((2, np.zeros(())), "not-a-knot"))
    period, start = 2 * np.pi / motion.frequency, motion.state(0.0)
    end = solve_ivp(rates, (0, period), start, "DOP853", args=(spline, mean), rtol=1e-12, atol=1e-13, max_step=0.02)
    np.testing.assert_allclose(end.y[:, -1], start, rtol=0, atol=1e-8)


def test_history_agrees_with_direct_integration_to_1e_8():
    spline = CubicSpline(np.radians(ANGLES), deck_edge(ANGLES), bc_type=((2, np.zeros(())), "not-a-knot"))
    trace = qt.simulate(model_with(deck_edge(ANGLES)), 40.0, (0, 0.6, 0, 0), step=40.0, tolerance=1e-12)
    end = solve_ivp(
        rates, (0, 40.0), (0, 0.6, 0, 0), "DOP853", args=(spline, (0, 0, 0)), rtol=1e-12, atol=1e-13, max_step=0.02
    )
    assert np.radians(float(trace["roll"][-1])) == pytest.approx(end.y[1, -1], abs=1e-8)


def test_multipliers_agree_with_the_flow_near_the_orbit():
    """Authority: central differences of scipy's flow over a period, in steps short enough not to miss a knot."""
    model = model_with(deck_edge(ANGLES))
    motion = qt.steady_motion(model, 31)
    spline = CubicSpline(np.radians(ANGLES), deck_edge(ANGLES), bc_type=((2, np.zeros(())), "not-a-knot"))
    period, start, h = 2 * np.pi / motion.frequency, motion.state(0.0), 1e-5

    def flow(y):
        return solve_ivp(
            rates, (0, period), y, "DOP853", args=(spline, (0, 0, 0)), rtol=1e-12, atol=1e-13, max_step=0.01
        ).y[:, -1]

    monodromy = np.array([(flow(start + h * e) - flow(start - h * e)) / (2 * h) for e in np.eye(4)]).T
    exact = np.linalg.eigvals(monodromy)
    found = qt.stability(model, motion)
    np.testing.assert_allclose(np.sort(np.abs(found.multipliers)), np.sort(np.abs(exact)), rtol=0, atol=1e-7)
    assert found.liouville < 1e-8


def test_samples_leave_an_aliasing_error_below_1e_8():
    """The samples taken (64 a harmonic) against 16 times as many, at nine harmonics past the deck edge."""
    import quartering.motion.equations.system as at
    from quartering.motion.equations.basis import basis

    model = model_with(deck_edge(ANGLES))
    usual = qt.steady_motion(model, 9).coefficients
    orders = (1, 3, 5, 7, 9)
    fine = basis(orders, model.system.degree, True, 15 * 64 * 9)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(at, "basis", lambda *_, **__: fine)
        u, _, _ = harmonic_balance(model.system, orders)
    assert np.abs(u[0] - usual).max() < 1e-8 * np.abs(usual).max()


@pytest.mark.soak
def test_error_falls_with_the_fifth_power_of_the_number_of_harmonics():
    """The third derivative of the spline jumps: the moment's harmonics fall as n^-4, the roll's as n^-6, their sum as n^-5.

    Measured by least squares over 9 to 61 harmonics against 151; single steps scatter, as phases at the knots do.
    """
    model = model_with(deck_edge(ANGLES))
    times = np.linspace(0.0, 2 * np.pi / model.frequency, 400)
    exact = qt.steady_motion(model, 151).state(times)[:, 1]
    counts = np.arange(9, 62, 4)
    errors = [np.abs(qt.steady_motion(model, int(h)).state(times)[:, 1] - exact).max() for h in counts]
    assert -np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(5.0, abs=1.0)


@pytest.mark.parametrize("name", ["box", "series60-cb60", "dtmb5415"])
def test_spline_of_a_ship_keeps_to_her_righting_arm_where_the_polynomial_does_not(name):
    ship = qt.ship(name)
    angles = np.arange(1.0, 80.0, 1.0)
    with pytest.warns(qt.RangeWarning, match="deck edge"):
        arms = righting_arm(ship, angles)
    missed = np.abs(righting_spline(ship).value(np.radians(angles)) - arms).max() / np.abs(arms).max()
    assert missed < 0.003
    assert polynomial_miss(ship, 79.0) > 10 * missed


def test_polynomial_that_misses_within_the_motion_is_warned_of_and_the_spline_is_not():
    """The box's polynomial misses her curve by 7 % between 10 and 15 deg; warnings are errors here."""
    box, wave = qt.ship("box").with_(ends="strips", righting="polynomial"), qt.Wave(430.0, 12.0)
    with pytest.warns(qt.RangeWarning, match='righting="spline"'):
        qt.polar(box, wave, [0.0], [90.0])
    assert float(qt.polar(box.with_(righting="spline"), wave, [0.0], [90.0])["roll_peak"].max()) > 10.0
    assert float(qt.polar(box, qt.Wave(430.0, 0.2), [0.0], [90.0])["roll_peak"].max()) < 1.0


def test_a_ship_with_a_spline_says_so_and_refuses_half_a_polynomial(tmp_path):
    file = tmp_path / "my.yaml"
    file.write_text("base: wigley\nrighting: spline\n")
    ship, by_powers = qt.ship(file), qt.ship("wigley").with_(righting="polynomial")
    table = {entry.name: entry for entry in qt.coefficients(ship, 0.5, 5.0).table()}
    assert "spline" in table["K_phiphiphi"].source
    assert table["K_phi"].value == pytest.approx(
        next(e.value for e in qt.coefficients(by_powers, 0.5, 5.0).table() if e.name == "K_phi"), rel=1e-9
    )
    model = qt.equations(ship, qt.Wave(100.0, 1.0), 5.0, 40.0)
    assert model.system.knots.shape[1] > 1
    with pytest.raises(qt.InputError, match='righting="polynomial"'):
        qt.coefficients(ship.with_(factors={"K_phiphiphi": 2.0}), 0.5, 5.0)
    with pytest.raises(qt.InputError, match="polynomial"):
        ship.with_(righting="table")


def test_vanishing_angle_of_a_spline_is_that_of_the_lines():
    ship = qt.ship("box").with_(righting="spline")
    assert float(righting_spline(ship).value(np.radians(vanishing_angle(ship)))) == pytest.approx(0.0, abs=2e-3)


def test_rolling_beyond_the_last_angle_of_a_curve_is_said():
    with pytest.warns(qt.RangeWarning, match="righting curve"):
        qt.steady_motion(model_with(np.sin(np.radians([5.0, 10.0, 15.0])), angles=[5.0, 10.0, 15.0]), 3)


@pytest.mark.parametrize(
    ("angles", "moments", "words"),
    [
        ([10, 20], [1, 2], "at least 3"),
        ([10, 20, 20], [1, 2, 3], "ascending"),
        ([0, 10, 20, 30], [0.1, 1, 2, 3], "balance"),
        ([10, 20, 30], [1, 2], "a number for each"),
        ([10, 20, 30], [1, np.nan, 2], "a number for each"),
    ],
)
def test_a_bad_righting_curve_is_refused(angles, moments, words):
    with pytest.raises(qt.InputError, match=words):
        model_with(moments, angles=angles)
