"""Righting arms against closed forms, and the properties every one of them has."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from quartering.conventions import GRAVITY, InputError, RangeWarning
from quartering.hull.file.built_in import available_ships
from quartering.hull.file.read import ship
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.contour import along
from quartering.hull.lines.hull import Hull, box_hull
from quartering.hull.righting.arm import righting_arm, righting_polynomial
from quartering.hull.righting.heeled import cross_curve, deck_angle
from quartering.hull.ship import Loading, Ship
from quartering.hydro.coefficients import coefficients
from quartering.hydro.contributions import righting_moment
from tests.tiers import mostly_soak

SHIPS = [entry.name for entry in available_ships()]


def _box(beam: float, draught: float, depth: float, gm: float) -> Ship:
    hull = box_hull(100.0, beam, draught, depth)
    return Ship(
        "box", hull, Loading(gm=gm, kg=hydrostatics(hull).km - gm, gyradius_roll=0.35 * beam, gyradius_yaw=25.0)
    )


def _emergence(beam: float, draught: float, depth: float) -> float:
    """Heel [rad] at which the bottom comes out or the deck goes under, whichever is first."""
    return float(np.arctan(2 * min(draught, depth - draught) / beam))


boxes = st.tuples(st.floats(5, 40), st.floats(0.1, 0.9), st.floats(0.2, 1.2), st.floats(0.05, 4.0))


@settings(deadline=None, max_examples=30)
@given(boxes, st.floats(-0.99, 0.99))
def test_wall_sided_box_has_the_closed_form_arm_until_deck_or_bilge(box: tuple[float, ...], part: float) -> None:
    # closed form: GZ = sin(phi) (GM + BM tan^2(phi) / 2)
    beam, ratio, height, gm = box
    depth = height * beam
    draught = ratio * depth
    phi = part * _emergence(beam, draught, depth)
    bm = beam**2 / (12 * draught)
    expected = np.sin(phi) * (gm + 0.5 * bm * np.tan(phi) ** 2)
    found = righting_arm(_box(beam, draught, depth, gm), np.degrees(phi))
    assert float(found) == pytest.approx(expected, rel=1e-6, abs=1e-6 * (bm + gm + beam))


@settings(deadline=None, max_examples=30)
@given(boxes, st.floats(0.0, 0.99))
def test_heeled_box_keeps_its_volume_about_the_centreline(box: tuple[float, ...], part: float) -> None:
    # closed form at constant displacement: the waterline turns about its middle, freeboard (D - T) cos - (B/2) sin
    beam, ratio, height, _ = box
    depth = height * beam
    draught = ratio * depth
    phi = part * _emergence(beam, draught, depth)
    _, freeboard = cross_curve(box_hull(100.0, beam, draught, depth), (phi,))
    assert freeboard[0] == pytest.approx((depth - draught) * np.cos(phi) - beam / 2 * np.sin(phi), abs=1e-9 * beam)


@pytest.mark.parametrize("name", SHIPS)
@settings(deadline=None, max_examples=6)
@given(st.floats(1.0, 60.0))
@pytest.mark.soak
def test_heeled_ship_displaces_its_upright_volume(name: str, angle: float) -> None:
    # agreement with another way: polygons clipped edge by edge, areas by the shoelace formula
    hull, phi = ship(name).hull, np.radians(angle)
    kn, freeboard = cross_curve(hull, (phi,))
    up_edge = min(h[-1] * np.cos(phi) - abs(y[-1]) * np.sin(phi) for y, h in hull.contours)
    volume, across, _ = _clipped(hull, phi, up_edge - float(freeboard[0]))
    upright, _, _ = _clipped(hull, 0.0, hull.draught)
    assert volume == pytest.approx(upright, rel=2e-4)
    assert across == pytest.approx(float(kn[0]), rel=1e-3)


def _clipped(hull: Hull, phi: float, level: float) -> tuple[float, float, float]:
    """Volume below a heeled waterline and its centroid (across, up), by clipping polygons."""
    found = []
    for curve in hull.curves:
        ends = np.unique(np.concatenate([curve.chord, np.linspace(0.0, curve.chord[-1], 200)]))
        y, h, *_ = along(curve, ends)
        points = [*zip(y, h, strict=True), *zip(-y[::-1], h[::-1], strict=True)]
        turned = [(a * np.cos(phi) + b * np.sin(phi), b * np.cos(phi) - a * np.sin(phi)) for a, b in points]
        inside: list[tuple[float, float]] = []
        for (a0, b0), (a1, b1) in zip(turned, turned[1:] + turned[:1], strict=True):
            if b0 <= level:
                inside.append((a0, b0))
            if (b0 <= level) != (b1 <= level):
                t = (level - b0) / (b1 - b0)
                inside.append((a0 + t * (a1 - a0), level))
        a, b = np.array(inside).T if inside else (np.zeros(1), np.zeros(1))
        cross = a * np.roll(b, -1) - np.roll(a, -1) * b
        found.append([cross.sum() / 2, *(((c + np.roll(c, -1)) * cross).sum() / 6 for c in (a, b))])
    volume, across, up = hull.weight @ np.array(found)
    return float(volume), float(across / volume), float(up / volume)


@pytest.mark.parametrize("name", mostly_soak(SHIPS, "wigley", "dtmb5415", "coaster-90m"))
def test_righting_arm_is_odd_in_heel(name: str) -> None:
    angles = min(deck_angle(ship(name).hull), 20.0) * np.array([0.05, 0.35, 0.75, 0.99])  # with the deck dry
    assert righting_arm(ship(name), -angles) == pytest.approx(-righting_arm(ship(name), angles), rel=1e-9)


@pytest.mark.parametrize("name", SHIPS)
def test_righting_arm_starts_at_zero_with_slope_gm(name: str) -> None:
    loaded = ship(name)
    assert righting_arm(loaded, 0.0) == pytest.approx(0.0, abs=1e-12)
    assert righting_arm(loaded, 0.01) / np.radians(0.01) == pytest.approx(loaded.loading.gm, abs=1e-4)


@pytest.mark.parametrize("name", SHIPS)
def test_metacentre_of_the_heeled_sections_is_that_of_the_hydrostatics(name: str) -> None:
    # agreement of two integrations: KN / sin(phi) for small heel against KB + BM of the strips
    hull = ship(name).hull
    kn, _ = cross_curve(hull, (1e-4,))
    assert kn[0] / np.sin(1e-4) == pytest.approx(hydrostatics(hull).km, rel=1e-3)


@pytest.mark.parametrize("name", mostly_soak(SHIPS, "wigley", "dtmb5415", "coaster-90m"))
def test_work_of_the_righting_arm_is_what_g_rises_over_b(name: str) -> None:
    # energy at constant displacement: int GZ dphi = change of the height of G over B, from sections clipped another way
    loaded = ship(name)
    hull, kg = loaded.hull, loaded.loading.kg
    phi = np.radians(min(15.0, 0.9 * deck_angle(hull)))
    _, freeboard = cross_curve(hull, (phi,))
    up_edge = min(h[-1] * np.cos(phi) - abs(y[-1]) * np.sin(phi) for y, h in hull.contours)
    _, _, b_heeled = _clipped(hull, phi, up_edge - float(freeboard[0]))
    _, _, b_upright = _clipped(hull, 0.0, hull.draught)
    angles, weights = np.polynomial.legendre.leggauss(8)
    work = phi / 2 * (weights @ righting_arm(loaded, np.degrees(phi / 2 * (angles + 1))))
    assert work == pytest.approx(kg * (np.cos(phi) - 1) - (b_heeled - b_upright), rel=0.01)


@pytest.mark.parametrize("name", mostly_soak(SHIPS, "wigley", "dtmb5415", "coaster-90m"))
def test_small_heel_is_righted_by_gm_with_the_default_curve(name: str) -> None:
    # closed form: K_phi = -rho g V GM
    loaded = ship(name)
    assert loaded.righting == "spline"
    exact = -loaded.loading.density * GRAVITY * hydrostatics(loaded).volume * loaded.loading.gm
    table = {entry.name: entry.value for entry in coefficients(loaded, 0.5, 0.0).table()}
    assert table["K_phi"] == pytest.approx(exact, rel=1e-9)
    moment = righting_moment(loaded)
    assert moment is not None
    assert moment.derivative(0.0) == pytest.approx(exact, rel=1e-9)
    assert moment.value(1e-6) / 1e-6 == pytest.approx(exact, rel=1e-9)


def test_fit_of_a_wall_sided_ship_has_the_cubic_of_its_series() -> None:
    # closed form: GZ = GM phi + (BM/2 - GM/6) phi^3 + ..., the next term below 2e-3 of it at 3 deg
    box = _box(20.0, 5.0, 10.0, 1.5)
    bm = 20.0**2 / (12 * 5.0)
    fit = righting_polynomial(box, max_angle=3.0)
    assert fit.gm == 1.5
    assert fit.gz3 == pytest.approx(bm / 2 - 1.5 / 6, rel=5e-3)
    assert (fit.gz5, fit.gz7) == (0.0, 0.0)


@pytest.mark.parametrize("name", SHIPS)
def test_fit_adds_higher_powers_exactly_when_the_cubic_misses_by_two_per_cent(name: str) -> None:
    loaded = ship(name)
    fit = righting_polynomial(loaded)
    angles = np.arange(2.0, 41.0, 2.0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)
        gz = righting_arm(loaded, angles)
    assert np.abs(fit.arm(angles) - gz).max() / np.abs(gz).max() == pytest.approx(fit.residual, rel=1e-6)
    phi = np.radians(angles)
    cubic = np.linalg.lstsq(phi[:, None] ** 3, gz - fit.gm * phi, rcond=None)[0][0]
    miss = np.abs(fit.gm * phi + cubic * phi**3 - gz).max() / np.abs(gz).max()
    assert (fit.gz5 != 0) == (miss > 0.02)
    assert fit.gz7 != 0 or fit.residual <= 0.02


def test_deck_edge_of_a_box_goes_under_at_its_closed_form_angle() -> None:
    assert deck_angle(box_hull(100.0, 20.0, 5.0, 10.0)) == pytest.approx(np.degrees(np.arctan(0.5)), abs=0.05)
    assert deck_angle(box_hull(100.0, 20.0, 5.0, 500.0)) == np.inf


def test_immersing_the_deck_edge_is_said_once_with_the_angle() -> None:
    with pytest.warns(RangeWarning, match=r"deck edge goes under at 26\.6 deg") as said:
        righting_arm(ship("box"), [10, 20, 30, 40, 50])
    assert len(said) == 1


@pytest.mark.parametrize("angles", [[0, float("nan")], [90.0], [-120.0]])
def test_heel_angles_that_make_no_sense_are_refused(angles: list[float]) -> None:
    with pytest.raises(InputError, match="less than 90"):
        righting_arm(ship("box"), angles)


@pytest.mark.parametrize("angle", [0.0, -5.0, 85.0, float("nan")])
def test_a_fit_over_no_range_is_refused(angle: float) -> None:
    with pytest.raises(InputError, match="max_angle"):
        righting_polynomial(ship("box"), max_angle=angle)
