"""Lines, strips and the rules they are integrated with."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from quartering.conventions import InputError
from quartering.hull.file.built_in import available_ships
from quartering.hull.file.read import ship
from quartering.hull.lines.contour import along, chord_at_height, contour_curve
from quartering.hull.lines.hull import Hull, at_draught, box_hull, scaled, wigley_hull, with_depth
from quartering.hull.lines.immersed import immersed_curve, strips
from quartering.hull.lines.quadrature import station_weights
from quartering.hull.lines.stations import hull_from_offsets

pytestmark = pytest.mark.quick

SHIPS = [entry.name for entry in available_ships()]
SERIES60 = [name for name in SHIPS if name.startswith("series60")]
FROM_OFFSETS = [name for name in SHIPS if name not in ("box", "wigley")]
AREAS = Path(__file__).parent / "series60_sectional_areas.csv"
MIDSHIP = {
    "cb60": 0.977,
    "cb65": 0.982,
    "cb70": 0.986,
    "cb75": 0.990,
    "cb80": 0.994,
}  # [Todd63], all but the first remembered
MISPRINTS = {("cb75", 4.0), ("cb80", 20.0)}


def _areas(column: str) -> dict[float, float]:
    with AREAS.open() as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        return {float(row["station"]): float(row[column]) * MIDSHIP[column] for row in rows}


@pytest.mark.parametrize("name", SERIES60)
def test_sectional_areas_are_those_tabulated_by_todd(name: str) -> None:
    hull, column = ship(name).hull, name.removeprefix("series60-")
    s = strips(hull)
    found = {round(10 - 20 * float(x) / hull.length, 3): area for x, area in zip(s.x, s.area, strict=True)}
    for station, tabulated in _areas(column).items():
        if (column, station) in MISPRINTS:
            continue
        # at the AP the bottom lies somewhere between waterlines 0.75 and 1.0: half a triangle of that height is open
        allowed = 0.003 if station < 20 else 0.25 / 2 * s.half_breadth[0] / (hull.beam / 2)
        assert found[station] / (hull.beam * hull.draught) == pytest.approx(tabulated, abs=allowed), station


@pytest.mark.parametrize("name", SERIES60)
def test_series60_midship_section_is_a_flat_bottom_a_circular_bilge_and_a_vertical_side(name: str) -> None:
    # closed form: a circle of radius R takes 2 (1 - pi/4) R^2 off the rectangle; [Todd63] gives CM, so R
    hull = ship(name).hull
    radius = np.sqrt((1 - MIDSHIP[name.removeprefix("series60-")]) * hull.beam * hull.draught / (2 - np.pi / 2))
    y, height = hull.contours[int(np.argmin(np.abs(hull.x)))]
    assert height[:4] / hull.draught == pytest.approx([0, 0, 0.075, 0.25])
    below = np.maximum(radius - height[1:4], 0.0)
    circle = hull.beam / 2 - radius + np.sqrt(radius**2 - below**2)
    assert y[1:4] / (hull.beam / 2) == pytest.approx(circle / (hull.beam / 2), abs=3e-3)  # CM is given to 0.001


@pytest.mark.parametrize("name", SERIES60)
def test_series60_midship_bilge_has_no_hollow_and_no_ledge(name: str) -> None:
    # geometry: the tangent of a convex bilge only turns upwards, from the flat bottom to the side
    hull = ship(name).hull
    curve = hull.curves[int(np.argmin(np.abs(hull.x)))]
    _, _, dy, dheight = along(curve, np.linspace(0.0, chord_at_height(curve, hull.draught), 2001))
    angle = np.degrees(np.arctan2(dheight, dy))
    assert angle[0] == pytest.approx(0.0)
    assert angle[-1] == pytest.approx(90.0)
    assert np.diff(angle).min() > -1e-9


@pytest.mark.parametrize("name", SHIPS)
def test_strips_reproduce_the_fine_integral_of_every_section(name: str) -> None:
    hull = ship(name).hull
    s = strips(hull)
    fine = []
    for i in hull.wet:
        curve, end = immersed_curve(hull, i)
        y, height, *_ = along(curve, np.linspace(0.0, end, 4001))
        fine.append(np.sum((y[1:] + y[:-1]) * np.diff(height)))
    assert np.abs(s.area - fine).max() < 5e-4 * max(fine)
    assert s.weight @ s.area == pytest.approx(s.weight @ np.array(fine), rel=1e-4)


@pytest.mark.parametrize("name", FROM_OFFSETS)
def test_station_weights_agree_with_monotone_cubics_along_the_ship(name: str) -> None:
    from scipy.interpolate import PchipInterpolator  # another rule, from another library

    hull = ship(name).hull
    s = strips(hull)
    area = np.zeros(len(hull.x))
    area[list(hull.wet)] = s.area
    other = float(PchipInterpolator(hull.x, area).integrate(hull.x[0], hull.x[-1]))
    assert s.weight @ s.area == pytest.approx(other, rel=1e-3)


@pytest.mark.parametrize("name", SHIPS)
def test_contours_run_from_the_centreline_at_the_keel_to_the_waterline(name: str) -> None:
    s = strips(ship(name).hull)
    assert s.dy.sum(axis=1) == pytest.approx(s.half_breadth)
    assert -s.dz.sum(axis=1) == pytest.approx(s.draught)
    assert (s.y >= 0).all()
    assert (s.z >= 0).all()
    assert (s.weight > 0).all()
    assert (np.diff(s.x) > 0).all()


@pytest.mark.parametrize("name", SHIPS)
def test_sections_and_strips_describe_the_same_stations(name: str) -> None:
    hull = ship(name).hull
    s = strips(hull)
    assert len(hull.sections) == len(s.x)
    for section, breadth, draught in zip(hull.sections, s.half_breadth, s.draught, strict=True):
        assert section.draught == pytest.approx(draught)
        assert section.half_breadth == pytest.approx(breadth)


@pytest.mark.parametrize("heading", [30.0, 90.0, 150.0])
@pytest.mark.parametrize("wave_length", [50.0, 100.0, 300.0])
def test_wigley_strips_integrate_wave_pressure_like_the_volume_form(heading: float, wave_length: float) -> None:
    # Green's theorem, as between the pressure integral and [H71] eq. (B-4):
    # int e^{-kz} cos(k2 y) dz (keel to waterline) = -(1 - e^{-kT})/k + (k2/k) int_0^b sin(k2 y) (1 - e^{-kF}) dy
    length, breadth, draught = 100.0, 10.0, 6.25
    k = 2 * np.pi / wave_length
    k1, k2 = -k * np.cos(np.radians(heading)), k * np.sin(np.radians(heading))
    s = strips(wigley_hull(length, breadth, draught, 10.0))
    contour = s.weight @ (np.exp(1j * k1 * s.x) * (np.exp(-k * s.z) * np.cos(k2 * s.y) * s.dz).sum(axis=1))
    nodes, weights = np.polynomial.legendre.leggauss(80)
    x, t = length / 2 * nodes, 0.5 * (nodes + 1)
    b = breadth / 2 * (1 - (2 * x / length) ** 2)[:, None]
    y, dy = b * (1 - t**2), 2 * b * t  # on the hull F = T t
    inner = (np.sin(k2 * y) * (1 - np.exp(-k * draught * t)) * dy) @ (0.5 * weights)
    expected = (length / 2 * weights * np.exp(1j * k1 * x)) @ (-(1 - np.exp(-k * draught)) / k + k2 / k * inner)
    assert abs(contour - expected) < 1e-12 * (s.weight @ np.abs(s.dz.sum(axis=1)))


@pytest.mark.parametrize("wave_length", [30.0, 50.0, 100.0, 300.0])
def test_box_strips_integrate_wave_pressure_in_closed_form(wave_length: float) -> None:
    # closed form: side int e^{-kz} dz cos(k2 B/2), bottom e^{-kT} sin(k2 B/2)/k2, along the ship 2 sin(k1 L/2)/k1
    length, breadth, draught = 100.0, 20.0, 5.0
    k = 2 * np.pi / wave_length
    k1 = k2 = k / np.sqrt(2)
    s = strips(box_hull(length, breadth, draught, 10.0))
    phase = np.exp(1j * k1 * s.x)
    side = s.weight @ (phase * (np.exp(-k * s.z) * np.cos(k2 * s.y) * s.dz).sum(axis=1))
    bottom = s.weight @ (phase * (np.exp(-k * s.z) * np.cos(k2 * s.y) * s.dy).sum(axis=1))
    along_ship = 2 * np.sin(k1 * length / 2) / k1
    exact_side = -(1 - np.exp(-k * draught)) / k * np.cos(k2 * breadth / 2) * along_ship
    exact_bottom = np.exp(-k * draught) * np.sin(k2 * breadth / 2) / k2 * along_ship
    assert abs(side - exact_side) < 1e-12 * length * draught
    assert abs(bottom - exact_bottom) < 1e-12 * length * breadth / 2


def test_offset_strips_of_sampled_wigley_sections_converge_to_the_formula() -> None:
    # agreement: the same hull as formula and as offsets, finer and finer; the thin plates at its ends hold 4e-5 of it
    exact = strips(wigley_hull(100.0, 10.0, 6.25, 10.0))
    volume = exact.weight @ exact.area
    errors = []
    for stations, heights in ((11, 7), (21, 13), (41, 25)):
        s = strips(_sampled_wigley(stations, heights), 64)
        errors.append(abs(s.weight @ s.area - volume) / volume)
    assert errors[-1] < 5e-5
    assert errors[0] > errors[1] > errors[2]


def _sampled_wigley(stations: int, heights: int) -> Hull:
    x = np.linspace(-50.0, 50.0, stations)
    t = np.linspace(0.0, 1.0, heights)
    profile = np.append(1 - (1 - t) ** 2, 1.0)
    contours = tuple((5.0 * (1 - (xi / 50.0) ** 2) * profile, np.append(6.25 * t, 10.0)) for xi in x)
    return hull_from_offsets("sampled", length=100.0, beam=10.0, draught=6.25, x=x, contours=contours)


def test_station_weights_are_of_fourth_order() -> None:
    # measured order on stations of uneven spacing; [Gill72] gives the fourth
    errors = []
    for count in (40, 80, 160, 320):
        u = np.linspace(0.0, 1.0, count + 1)
        x = 0.5 * (u + u**2)
        errors.append(abs(station_weights(x) @ np.exp(2 * x) - (np.exp(2.0) - 1) / 2))
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert (orders > 3.6).all()
    assert orders[-1] == pytest.approx(4.0, abs=0.15)


@settings(deadline=None, max_examples=50)
@given(st.lists(st.floats(0.5, 1.5), min_size=5, max_size=30), st.floats(-5.0, 5.0))
def test_station_weights_integrate_cubics_exactly_on_uneven_stations(steps: list[float], shift: float) -> None:
    x = shift + np.concatenate([[0.0], np.cumsum(steps)])
    weights = station_weights(x)
    assert weights.sum() == pytest.approx(x[-1] - x[0])
    middle = 0.5 * (x[0] + x[-1])
    half = 0.5 * (x[-1] - x[0])
    if weights.min() > 0 and len(x) > 4:  # the trapezoidal fallback is exact for straight lines only
        u = (x - middle) / half
        trapezoid = np.allclose(weights[1:-1], 0.5 * (x[2:] - x[:-2]))
        assert trapezoid or weights @ u**2 == pytest.approx(2 * half / 3, rel=1e-9)
        assert weights @ u == pytest.approx(0.0, abs=1e-9 * half)


def test_contour_curve_passes_its_points_keeps_corners_and_does_not_overshoot() -> None:
    y, height = np.array([0.0, 4.0, 6.0, 6.0, 6.5]), np.array([0.0, 0.0, 1.0, 3.0, 5.0])
    curve = contour_curve(y, height)
    found_y, found_height, *_ = along(curve, curve.chord)
    assert found_y == pytest.approx(y)
    assert found_height == pytest.approx(height)
    fine_y, fine_height, *_ = along(curve, np.linspace(0.0, curve.chord[-1], 500))
    assert fine_y.max() <= 6.5 + 1e-12
    assert (np.diff(fine_height) >= -1e-12).all()
    flat = fine_y < 4.0 - 1e-9
    assert fine_height[flat] == pytest.approx(0.0, abs=1e-12)


@given(st.floats(0.05, 0.95))
def test_chord_at_height_is_where_the_contour_reaches_it(fraction: float) -> None:
    curve = contour_curve(np.array([0.0, 3.0, 5.0, 5.5]), np.array([0.0, 0.5, 2.0, 6.0]))
    s = chord_at_height(curve, 6.0 * fraction)
    assert along(curve, np.array([s]))[1][0] == pytest.approx(6.0 * fraction, abs=1e-9)


@pytest.mark.parametrize("draught", [4.0, 6.25, 8.0])
def test_wigley_at_another_draught_keeps_its_exact_volume(draught: float) -> None:
    # closed form: int (1 - (1 - h/T)^2) dh to the lesser of draught and T, and a wall above
    t = max(0.0, 1 - draught / 6.25)
    profile = 6.25 * ((1 - t) - (1 - t**3) / 3) + max(0.0, draught - 6.25)
    s = strips(at_draught(wigley_hull(100.0, 10.0, 6.25, 10.0), draught))
    assert s.weight @ s.area == pytest.approx(10.0 * profile * 100.0 * 2 / 3, rel=1e-12)


def test_deeper_sides_are_vertical_and_leave_the_immersed_hull_alone() -> None:
    hull = ship("series60-cb60").hull
    raised = with_depth(hull, 12.0)
    assert raised.depth == pytest.approx(12.0)
    assert strips(raised).area == pytest.approx(strips(hull).area)


def test_a_station_of_no_breadth_keeps_its_depth() -> None:
    # the stem line of Series 60 at the FP: no breadth to the design waterline, full draught
    s = strips(ship("series60-cb60").hull)
    assert s.draught[-1] == pytest.approx(6.5024)
    assert 0 < s.half_breadth[-1] < 0.002 * 16.256


def _contours(**change: object) -> dict[str, object]:
    side = (np.array([0.0, 5.0, 5.0]), np.array([0.0, 0.0, 6.0]))
    base = {"length": 60.0, "beam": 10.0, "draught": 4.0, "x": np.linspace(-30, 30, 7), "contours": (side,) * 7}
    return {**base, **change}


def _with_side(index: int, y: list[float], height: list[float]) -> dict[str, object]:
    plain = _contours()
    sides = list(plain["contours"])  # type: ignore[call-overload]
    sides[index] = (np.array(y), np.array(height))
    return {**plain, "contours": tuple(sides)}


@pytest.mark.parametrize(
    ("given_hull", "words"),
    [
        (_contours(x=np.array([-30.0, -20, -10, -10, 10, 20, 30])), ["station 4", "-10"]),
        (_contours(x=np.array([-30.0, -20, np.nan, 0, 10, 20, 30])), ["not a number"]),
        (_contours(contours=()), ["0 contours"]),
        (_with_side(2, [0, 5, 5, 5], [0, 3, 2, 6]), ["station 3", "waterline 3", "2 m", "3 m", "cross"]),
        (_with_side(2, [0, -5, 5], [0, 3, 6]), ["station 3", "waterline 2", "-5", "negative"]),
        (_with_side(2, [0, np.nan, 5], [0, 3, 6]), ["station 3", "waterline 2", "not a number"]),
        (_with_side(2, [0, 5], [0, 3, 6]), ["station 3", "2 half breadths and 3 heights"]),
        (_with_side(2, [0, 5], [1, 1]), ["station 3", "no height"]),
        (_with_side(2, [0, 5], [0, 3]), ["station 3", "ends at height 3 m", "draught of 4 m"]),
        (_contours(draught=-1.0), ["draught -1 m"]),
        (_contours(draught=float("nan")), ["draught nan"]),
        (_contours(beam=20.0), ["5 m", "10 m", "breadths"]),
        (_contours(length=6000.0), ["6000 m", "unit of x"]),
    ],
)
def test_offsets_that_cannot_be_a_hull_are_named_by_station_and_waterline(given_hull: dict, words: list[str]) -> None:
    with pytest.raises(InputError) as refusal:
        hull_from_offsets("barge", **given_hull)
    for word in ["barge", *words]:
        assert word in str(refusal.value)


def test_a_station_above_the_water_between_others_is_refused_and_an_overhang_is_not() -> None:
    dry = ([0.0, 5.0, 5.0], [4.5, 4.5, 6.0])
    with pytest.raises(InputError, match=r"barge: station 4 \(x = 0 m\) lies above the water.*4.5 m.*draught 4 m"):
        strips(hull_from_offsets("barge", **_with_side(3, *dry)))
    assert len(strips(hull_from_offsets("barge", **_with_side(0, *dry))).x) == 6


@pytest.mark.parametrize("points", [0, 6, 13])
def test_strips_refuse_a_number_of_points_they_cannot_place(points: int) -> None:
    with pytest.raises(InputError, match="even number"):
        strips(box_hull(100.0, 20.0, 5.0, 10.0), points)


def test_a_hull_is_refused_a_draught_outside_its_lines_and_a_scale_that_is_no_number() -> None:
    box = box_hull(100.0, 20.0, 5.0, 10.0)
    with pytest.raises(InputError, match="at most 10 m"):
        at_draught(box, 12.0)
    with pytest.raises(InputError, match="scale factors"):
        scaled(box, 1.0, float("nan"), 1.0)
    with pytest.raises(InputError, match="deck lies at or above"):
        with_depth(box, 3.0)
