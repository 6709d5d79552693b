"""Sections of many points: their integrals, and the work they take."""

import numpy as np
import pytest

from quartering.hull.file.read import ship
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines import panels
from quartering.hull.lines.contour import chord_at_height, contour_curve
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.panels import panel_ends, panel_nodes

# y = 5 sin(a)^0.5, z = 4 (1 - cos a), a from 0 to 90 deg: int sin^1.5 da = sqrt(pi)/2 gamma(5/4)/gamma(7/4)
HALF_AREA = 20.0 * 0.8740191847640399
HALF_MOMENT = 80.0 * (0.8740191847640399 - 0.4)  # about the keel line, int sin^1.5 cos da = 1/2.5


def contour(points):
    a = np.linspace(0.0, np.pi / 2.0, points)
    return np.append(5.0 * np.sin(a) ** 0.5, 5.0), np.append(4.0 * (1.0 - np.cos(a)), 6.0)


def barge(folder, points, stations=5):
    y, z = contour(points)
    rows = [f"{x:g},{b:.5f},{h:.5f}" for x in np.linspace(-30.0, 30.0, stations) for b, h in zip(y, z, strict=True)]
    (folder / "barge.csv").write_text("\n".join(["x,y,z", *rows]))
    file = folder / "barge.yaml"
    file.write_text("name: barge\nlength: 60 m\nbeam: 10 m\ndraught: 4 m\nlines: barge.csv\n")
    return file


@pytest.mark.parametrize(("points", "tolerance"), [(100, 6e-4), (400, 1e-4), (1500, 5e-5)])
def test_volume_and_its_centre_of_a_barge_of_many_points(tmp_path, points, tolerance):
    """Closed form: 2097.646 m3 and KB 2.16938 m; a polygon of few points lies inside the curve."""
    found = hydrostatics(ship(str(barge(tmp_path, points))))
    assert found.volume == pytest.approx(120.0 * HALF_AREA, rel=tolerance)
    assert found.kb == pytest.approx(HALF_MOMENT / HALF_AREA, rel=tolerance)
    assert found.bm == pytest.approx(60.0 * 10.0**3 / 12.0 / (120.0 * HALF_AREA), rel=tolerance)


def test_the_barge_of_four_hundred_points_has_the_volume_of_its_polygons(tmp_path):
    """Trapezium over the points times the length, in which the rule of 12 panels loses less than 1e-4."""
    y, z = contour(400)
    polygon = 60.0 * float(((y[1:] + y[:-1]) * np.diff(z))[: y.size - 2].sum())
    assert polygon == pytest.approx(2097.6, abs=0.05)
    assert hydrostatics(ship(str(barge(tmp_path, 400)))).volume == pytest.approx(polygon, rel=1e-4)


@pytest.mark.parametrize("outline", ["smooth", "straight"])
@pytest.mark.parametrize("points", [200, 1000, 5000])
def test_many_joints_at_a_time_cost_no_accuracy(monkeypatch, points, outline):
    """One joint at a time and many, each against the closed forms; the polygon of 200 points is short by 1.5e-4."""
    y, z = contour(points)
    curve = contour_curve(y, z, outline)
    end = chord_at_height(curve, float(z[-2]))
    lost = []
    for many in (panels.MANY, 10**6):
        if many > panels.MANY and points > 1000:
            continue
        monkeypatch.setattr(panels, "MANY", many)
        ends = panel_ends(curve, end, 12)
        assert ends.size == 13
        assert np.isin(ends, curve.chord).all()  # panels end at points of the contour
        y2, h2, _, dh = panel_nodes(curve, ends[:-1], ends[1:])
        area, moment = float((y2 * dh).sum()), float((y2 * h2 * dh).sum())
        lost.append(max(abs(area / HALF_AREA - 1.0), abs(moment / HALF_MOMENT - 1.0)))
    assert max(lost) < 2.5e-4


def test_work_for_a_contour_does_not_grow_with_its_points(monkeypatch):
    """Steps on whole arrays grow with the logarithm of the points, steps on single joints not at all."""
    calls = {"_losses": 0, "_loss": 0, "along": 0}

    def counted(name):
        real = getattr(panels, name)

        def count(*arguments, **named):
            calls[name] += 1
            return real(*arguments, **named)

        monkeypatch.setattr(panels, name, count)

    for name in calls:
        counted(name)
    for points in (70, 400, 3000, 20_000):
        calls.update(dict.fromkeys(calls, 0))
        y, z = contour(points)
        curve = contour_curve(y, z)
        panel_ends(curve, float(curve.chord[-2]), 12)
        assert calls["_loss"] <= 2 * panels.MANY
        assert calls["_losses"] <= 2 + np.log(max(1.0, points / panels.MANY)) / np.log(4 / 3)
        assert calls["along"] == 3


@pytest.mark.parametrize("name", ["dtc", "dtmb5415", "s175"])
def test_losses_of_single_joints_are_those_of_whole_arrays(name):
    """The same operations, so the same bits; hulls of up to 50 points a section keep the panels they had."""
    hull = ship(name).hull
    for curve in hull.curves[::4]:
        chord = np.unique(curve.chord)
        after, before = (np.stack(panels.along(curve, chord, side=side), axis=1) for side in ("right", "left"))
        ends, size = panels._Ends(chord, after, before), (hull.beam, hull.draught)
        exact = panels._moments(panels._gauss_nodes(curve, chord), size)
        for k, known in enumerate(panels._losses(ends, exact, size)):
            both = (exact[k] + exact[k + 1]).tolist()
            width = float(chord[k + 2] - chord[k])
            assert panels._loss(width, after[k].tolist(), before[k + 2].tolist(), both, size) == known


def test_sections_of_many_points_have_the_strips_of_fewer(tmp_path):
    """Geometry: 400 and 1,500 points describe one contour."""
    one, other = (strips(ship(str(barge(tmp_path, n))).hull) for n in (400, 1500))
    np.testing.assert_allclose(one.area, other.area, rtol=1e-4)
    np.testing.assert_allclose(one.half_breadth, other.half_breadth, rtol=1e-6)
