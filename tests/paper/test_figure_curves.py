"""Figs. 2-10, 14-22: the curves against limits, symmetries, independent computation, and what the paper says of them."""

import numpy as np
import pytest

import quartering as qt
from quartering.conventions import GRAVITY, InputError
from quartering.study.condition.resonance import resonant_headings
from quartering.study.paper.conditions import speed_of, wave_of
from quartering.study.paper.curves import coefficient_curves, loading_curves, response_curves
from quartering.study.paper.model import paper_ship

SHIP = paper_ship()
SPEED = speed_of(SHIP)


@pytest.fixture(scope="module")
def forces():
    return amplitudes(1.0, np.arange(0.0, 181.0, 15.0))


def amplitudes(ratio, headings):
    """Forces of every form in one wave, per metre of its amplitude."""
    found = qt.compare_forces(SHIP, [ratio * SHIP.hull.length], headings, SPEED)
    return found["amplitude"].isel(wave_length=0)


def test_no_lateral_force_in_head_and_following_seas(forces):
    """Port-starboard symmetry."""
    assert float(forces.sel(heading=[0.0, 180.0]).max()) == 0.0


def test_pressure_alone_is_as_large_from_ahead_as_from_astern(forces):
    """[H71] (B-4): k1 changes its sign with heading -> 180 - heading, which conjugates the force and leaves its amplitude."""
    without = forces.sel(form="froude-krylov")
    np.testing.assert_allclose(without, without.isel(heading=slice(None, None, -1)), rtol=1e-9, atol=1e-3)


def test_long_beam_waves_heel_the_ship_by_their_slope():
    """Closed form: |K| / A -> rho g V GM k, |Y| / A -> rho g V k (Froude-Krylov), error of order k L."""
    ratio = 400.0
    found = amplitudes(ratio, [90.0]).isel(heading=0).sel(form="froude-krylov")
    k = 2 * np.pi / (ratio * SHIP.hull.length)
    weight = qt.hydrostatics(SHIP).mass * GRAVITY
    assert float(found.sel(mode="sway")) == pytest.approx(weight * k, rel=2 * np.pi / ratio)
    assert float(found.sel(mode="roll")) == pytest.approx(weight * SHIP.loading.gm * k, rel=2 * np.pi / ratio)


def test_strip_correction_matters_most_where_the_paper_prints_the_wrong_sign(forces):
    """The printed slope sign changes the roll moment in beam seas several times over, the sway force by a few percent."""
    beam = forces.sel(heading=90.0)
    change = beam.sel(form="paper") / beam.sel(form="paper-corrected")
    assert float(change.sel(mode="roll")) > 2.0
    assert float(change.sel(mode="sway")) == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize("heading", [45.0, 120.0])
def test_response_is_the_fundamental_of_the_integrated_motion(heading):
    """Integration of the full equations and a discrete Fourier transform of its last period."""
    ds = response_curves(SHIP, [1.0], [heading]).isel(heading=0, wave_length=0)
    model = qt.equations(SHIP, wave_of(SHIP, 1.0), SPEED, heading)
    period = 2 * np.pi / model.frequency
    trace = qt.simulate(model, 41 * period, step=period / 64).isel(time=slice(40 * 64, 41 * 64))
    first = np.fft.rfft(np.stack([trace["sway_velocity"], trace["roll"], trace["yaw_rate"]]), axis=1)[:, 1] / 32
    expected = np.abs(first) / [model.frequency, 1.0, model.frequency]
    np.testing.assert_allclose([ds["sway"], ds["roll"], ds["yaw"]], expected, rtol=2e-3)


@pytest.mark.parametrize("name", ["series60-cb60", "series60-cb70"])
def test_roll_peaks_in_quartering_seas_near_encounter_resonance(name):
    """The paper's second peak; the stiffening righting arm moves it to higher frequency, so to a larger heading."""
    ds = response_curves(paper_ship(name), [0.75, 1.0, 1.5], np.arange(0.0, 181.0, 3.0))
    for one in (ds.isel(wave_length=i) for i in range(3)):
        (resonance,) = resonant_headings(one)
        peak = float(one["heading"][np.argmax(one["roll"].values)])
        assert 15.0 < peak < 90.0
        assert resonance <= peak < resonance + 12.0


def test_the_marked_resonance_solves_the_encounter_relation():
    """Closed form: cos(mu) = (sigma - n2) / (k U)."""
    ds = response_curves(SHIP, [1.0], np.arange(0.0, 181.0, 2.0)).isel(wave_length=0)
    k = 2 * np.pi / SHIP.hull.length
    cosine = (np.sqrt(GRAVITY * k) - ds.attrs["natural_roll_frequency"]) / (k * SPEED)
    assert resonant_headings(ds)[0] == pytest.approx(np.degrees(np.arccos(cosine)), abs=0.05)


def test_loading_curves_agree_with_the_judgement_of_one_motion():
    """The single-case path: equations, steady motion, stability."""
    ds = loading_curves(SHIP, "gyradius_roll", [5.0, 7.0], [30.0]).isel(loading=1, heading=0)
    model = qt.equations(SHIP.with_(gyradius_roll=7.0), wave_of(SHIP, 1.0), SPEED, 30.0)
    motion = qt.steady_motion(model, start="rest")
    verdict = qt.stability(model, motion)
    assert float(ds["k2"]) == pytest.approx(verdict.k2, rel=1e-6)
    assert float(ds["exponent"]) == pytest.approx(verdict.exponents[0].real, rel=1e-4)
    assert float(ds["yaw"]) == pytest.approx(np.degrees(motion.amplitude[2]), rel=1e-6)


def test_less_gm_lowers_roll_at_one_heading_and_raises_it_at_another():
    """[H71] Fig. 20."""
    ds = loading_curves(SHIP, "gm", [0.5, 0.8], [45.0, 62.0])["roll"]
    low, high = ds.isel(loading=0), ds.isel(loading=1)
    assert float(low.sel(heading=45.0)) > 1.5 * float(high.sel(heading=45.0))
    assert float(low.sel(heading=62.0)) < 0.7 * float(high.sel(heading=62.0))


@pytest.mark.parametrize("name", ["series60-cb60", "mariner"])
def test_a_larger_radius_in_roll_costs_stability_and_one_in_yaw_hardly_any(name):
    """[H71] Figs. 15, 18: the same damping works on more inertia; yaw enters the index through its amplitude alone."""
    ship = paper_ship(name)
    roll = loading_curves(ship, "gyradius_roll", [0.3 * ship.hull.beam, 0.45 * ship.hull.beam], [30.0, 90.0])["index"]
    yaw = loading_curves(ship, "gyradius_yaw", [0.22 * ship.hull.length, 0.28 * ship.hull.length], [30.0, 90.0])
    assert (roll.isel(loading=1) < 0.75 * roll.isel(loading=0)).all()
    np.testing.assert_allclose(yaw["index"].isel(loading=1), yaw["index"].isel(loading=0), rtol=0.02)
    assert (yaw["yaw"].isel(loading=1) < yaw["yaw"].isel(loading=0)).all()


def test_slopes_of_k2_are_those_of_the_exact_derivatives():
    """`sensitivity` differentiates a three-harmonic balance; the linear third harmonic of Fig. 22 differs from it in the
    fourth power of the roll amplitude, which is small in this low wave."""
    names, wave = ["K_p", "K_ppp", "K_pvv", "K_prr"], wave_of(SHIP, 1.0, 1 / 200)
    curves = coefficient_curves(SHIP, names, [-1.0, 0.0, 1.0], wave, SPEED, 45.0)["k2"]
    slope = (curves.isel(change=2) - curves.isel(change=0)) / 0.02
    exact = qt.sensitivity(SHIP, wave, SPEED, 45.0)["k2"]
    np.testing.assert_allclose(slope, [float(exact.sel(parameter=name)) for name in names], rtol=1e-3)


def test_halving_roll_damping_by_k_ppp_does_not_undo_the_estimated_ship():
    """Against the paper's Fig. 22: with cross-flow drag K_ppp is small beside K_p, so K2 hardly feels it."""
    curves = coefficient_curves(SHIP, ["K_ppp", "K_p"], [-50.0, 0.0], wave_of(SHIP, 1.5, 1 / 20), SPEED, 30.0)
    k2 = curves["k2"]
    assert (curves["verdict"] == 0).all()
    fall = k2.sel(change=-50.0) / k2.sel(change=0.0)
    assert float(fall.sel(coefficient="K_ppp")) > 0.99
    assert float(fall.sel(coefficient="K_p")) < 0.7


def test_what_is_no_loading_is_refused():
    with pytest.raises(InputError, match="gyradius_roll"):
        loading_curves(SHIP, "K_ppp", [1.0])
