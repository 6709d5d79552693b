"""Offsets as programs write them: steps, prisms, bulbs, encodings, units; meshes whose rows differ; what no format knows."""

import numpy as np
import pytest

from quartering.conventions import InputError
from quartering.hull.file.read import ship
from quartering.hull.formats.meshes import box_triangles
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.bulb import bulb
from quartering.hydro.source.of_ship import source_of
from tests.hull.test_datum import X, gdf, read, refused, stl

pytestmark = pytest.mark.quick

TABLE = [["x", "0", "1.5", "3", "5"]] + [[f"{x:g}", "5.5", "6", "6", "6"] for x in X]
VOLUME = 80.0 * (2 * 1.5 * 5.75 + 1.5 * 12.0)
"""Closed form of the table: the trapezium over its waterlines, times 80 m."""


def volume(folder, name="a.csv", **given):
    return hydrostatics(read(folder, name, **given)).volume


def comma(text):
    return text.replace(".", ",")


@pytest.mark.parametrize("code", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"])
@pytest.mark.parametrize(
    ("mark", "decimal"), [(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), (" ", "."), (" ", ",")]
)
def test_encodings_delimiters_and_decimal_commas_give_one_hull(tmp_path, code, mark, decimal):
    text = "\r\n".join(mark.join(row) for row in TABLE)
    (tmp_path / "a.csv").write_bytes((comma(text) if decimal == "," else text).encode(code))
    assert volume(tmp_path) == pytest.approx(VOLUME, rel=1e-9)


def test_units_stand_in_the_header_or_below_it(tmp_path):
    points = [(x, y, z) for x in X for y, z in ((0, 0), (6, 0), (6, 5))]
    mm = "\n".join(f"{1000 * x},{1000 * y},{1000 * z}" for x, y, z in points)
    for head in ("x [mm],y [mm],z [mm]", "x,y,z\nmm,mm,mm", "x,y,z\n[mm],[mm],[mm]"):
        (tmp_path / "a.csv").write_text(f"{head}\n{mm}")
        made = read(tmp_path, "a.csv")
        assert hydrostatics(made).volume == pytest.approx(2880.0)
        assert "given in mm" in made.hull.source
    feet = "\n".join(f"{x / 0.3048:.9f};{y / 0.3048:.9f};{z}" for x, y, z in points)
    (tmp_path / "a.csv").write_text(f"x (ft);y (ft);z\n{comma(feet)}")
    assert volume(tmp_path) == pytest.approx(2880.0)
    (tmp_path / "a.csv").write_text(f"x,y,z\nfurlong,m,m\n{mm}")
    assert "furlong" in refused(tmp_path, "a.csv")


def test_sections_of_both_sides_are_the_ones_of_starboard(tmp_path):
    # 36 m of box and two ends of no breadth, where both sides lie in the centreplane
    breadth = {-40.0: 0.0, -18.0: 6.0, 0.0: 6.0, 18.0: 6.0, 40.0: 0.0}
    half = [(0.0, 0.0), (1.0, 0.0), (1.0, 5.0)]

    def write(sides):
        rows = [(x, b * y, z) for x, b in breadth.items() for y, z in sides]
        (tmp_path / "a.csv").write_text("x,y,z" + "".join(f"\n{x},{y},{z}" for x, y, z in rows))

    write(half)
    starboard = volume(tmp_path)
    write([(-y, z) for y, z in half[:0:-1]] + half)
    assert volume(tmp_path) == starboard
    write([(-1.0, 4.0), (-1.0, 0.0), *half])
    assert "port and starboard differ" in refused(tmp_path, "a.csv")
    write([(0.0, 0.0), (-1.0, 0.0), (-1.0, 5.0)])
    assert "negative" in refused(tmp_path, "a.csv")


def test_a_file_without_a_unit_is_told_one(tmp_path):
    """Authority: the box, 80 x 12 x 3 m under water; WAMIT's corners are in the unit of its gravity."""
    stl(tmp_path / "a.stl", 1000.0 * box_triangles(80.0, 12.0, 5.0))
    assert "unit: mm" in refused(tmp_path, "a.stl")
    made = read(tmp_path, "{file: a.stl, unit: mm}")
    assert hydrostatics(made).volume == pytest.approx(
        2880.0, rel=1e-4
    )  # the outermost sections lie a hair inside the ends
    assert "given in mm" in made.hull.source
    assert "unit" in refused(tmp_path, "{file: a.stl, unit: inch}")
    immersed = box_triangles(80.0, 12.0, 3.0, keel=-3.0)
    gdf(tmp_path / "a.gdf", immersed / 0.3048)
    assert "are its numbers in ft?" in refused(tmp_path, "a.gdf")
    text = (tmp_path / "a.gdf").read_text()
    (tmp_path / "a.gdf").write_text(text.replace("1.0 9.81", "1.0 32.174"))
    made = read(tmp_path, "a.gdf")
    assert hydrostatics(made).volume == pytest.approx(2880.0, rel=1e-4)
    assert "given in ft" in made.hull.source
    points = [(x, y, z) for x in X for y, z in ((0, 0), (6, 0), (6, 5))]
    rows = "".join(f"\n{100 * x},{100 * y},{100 * z}" for x, y, z in points)
    (tmp_path / "a.csv").write_text(f"x,y,z{rows}")
    assert volume(tmp_path, "{file: a.csv, unit: cm}") == pytest.approx(2880.0)
    (tmp_path / "a.csv").write_text(f"x [cm],y [cm],z [cm]{rows}")
    assert "leave `unit: cm` out" in refused(tmp_path, "{file: a.csv, unit: cm}")


def test_decimal_commas_between_commas_are_refused(tmp_path):
    (tmp_path / "a.csv").write_text("\n".join(",".join(comma(cell) for cell in row) for row in TABLE))
    assert "commas" in refused(tmp_path, "a.csv") or "header" in refused(tmp_path, "a.csv")


@pytest.mark.parametrize("form", ["points", "table", "pdstrip"])
@pytest.mark.parametrize("way", [1, -1])
def test_two_stations_at_one_place_are_a_step(tmp_path, form, way):
    """Authority: closed form: 12 m wide aft of x = 0, 9 m forward: 40 3 (12 + 9) m3, moment 40 3 20 (9 - 12) m4."""
    steps = [(x, 6.0) for x in X if x <= 0] + [(x, 4.5) for x in X if x >= 0]
    steps = steps[::way]
    if form == "table":
        (tmp_path / "a.csv").write_text("x,0,5\n" + "\n".join(f"{x},{y},{y}" for x, y in steps))
    elif form == "points":
        rows = [f"{x},{y},{z}" for x, b in steps for y, z in ((0, 0), (b, 0), (b, 5))]
        (tmp_path / "a.csv").write_text("x,y,z\n" + "\n".join(rows))
    else:
        text = "".join(f"\n{x} 3 0\n0 {b} {b}\n0 0 5" for x, b in steps)
        (tmp_path / "a.out").write_text(f"{len(steps)} t 3.0{text}")
    made = read(tmp_path, "a.out" if form == "pdstrip" else "a.csv")
    floats = hydrostatics(made)
    assert floats.volume == pytest.approx(40 * 3 * 21.0, rel=1e-5)
    assert floats.lcb == pytest.approx(-20.0 * 3.0 / 21.0, rel=1e-4)
    assert "two stations at x = 0 m" in made.hull.source


def test_three_stations_at_one_place_are_refused(tmp_path):
    rows = [f"{x},6,6" for x in (*X[:5], 0, 0, *X[5:])]
    (tmp_path / "a.csv").write_text("x,0,5\n" + "\n".join(rows))
    assert "more than two stations at x = 0 m" in refused(tmp_path, "a.csv")


def test_two_stations_make_a_prism_and_two_that_differ_do_not(tmp_path):
    (tmp_path / "a.csv").write_text("x,0,5\n-40,6,6\n40,6,6")
    made = read(tmp_path, "a.csv")
    assert hydrostatics(made).volume == pytest.approx(2880.0)
    assert "the same all along" in made.hull.source
    (tmp_path / "a.csv").write_text("x,0,5\n-40,6,6\n40,2,6")
    assert "2 stations that differ" in refused(tmp_path, "a.csv")


def test_a_bulb_ahead_of_the_stem_counts_and_is_told(tmp_path):
    """Authority: closed form: a bulb 3 m long, 1.6 m wide, 1.5 m high ahead of the barge of 2880 m3."""
    rows = ["x,0,1.5,3,5", *(f"{x},6,6,6,6" for x in X), "41.5,0.8,0.8,,", "43,0.8,0.8,,"]
    (tmp_path / "a.csv").write_text("\n".join(rows))
    made = read(tmp_path, "a.csv")
    assert hydrostatics(made).volume == pytest.approx(2880.0 + 3 * 1.6 * 1.5, rel=1e-5)
    assert "2 end sections wholly under water" in made.hull.source
    left_out = bulb(made.hull)  # with the bulb carried back to the blunt end
    assert left_out.sections == 3
    assert left_out.volume == pytest.approx(3 * 1.6 * 1.5, rel=1e-3)
    assert left_out.words in source_of(made, "strips").words
    rows[4] = "-10,6,6,,"
    (tmp_path / "a.csv").write_text("\n".join(rows))
    assert "station 4 (x = -10 m) ends at height 1.5 m, below the draught" in refused(tmp_path, "a.csv")


def grid(corners, n, m):
    """Quads (n m, 4, 3) of a plane between corners a, b, c, d in turn, as pairs of triangles."""
    a, b, c, d = (np.array(one, dtype=float) for one in corners)
    u, v = np.linspace(0, 1, n + 1), np.linspace(0, 1, m + 1)
    p = np.array([[(1 - s) * ((1 - t) * a + t * d) + s * ((1 - t) * b + t * c) for t in v] for s in u])
    q = np.stack([p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]], axis=2).reshape(-1, 4, 3)
    return np.concatenate([q[:, [0, 1, 2]], q[:, [0, 2, 3]]])


def half_barge(bottom, side, end, x=(-40.0, 40.0), b=6.0, z=(-3.0, 0.0)):
    """Half a barge y >= 0 open at the top; panels along bottom and side, and down the ends, as wanted."""
    (aft, fore), (low, top) = x, z
    return np.concatenate([
        grid([(aft, b, low), (fore, b, low), (fore, 0, low), (aft, 0, low)], bottom, 2),
        grid([(aft, b, top), (fore, b, top), (fore, b, low), (aft, b, low)], side, 2),
        grid([(fore, 0, low), (fore, b, low), (fore, b, top), (fore, 0, top)], 2, end),
        grid([(aft, b, low), (aft, 0, low), (aft, 0, top), (aft, b, top)], 2, end),
    ])  # fmt: skip


@pytest.mark.parametrize(("bottom", "side", "end"), [(4, 12, 2), (5, 7, 3), (10, 10, 3), (9, 4, 5)])
def test_panels_need_no_common_corners(tmp_path, bottom, side, end):
    """Authority: closed form; every edge of one row is covered by edges of the other, so that no hole is there."""
    gdf(tmp_path / "a.gdf", half_barge(bottom, side, end))
    path = tmp_path / "a.gdf"
    path.write_text(path.read_text().replace("\n0 0\n", "\n0 1\n", 1))
    floats = hydrostatics(read(tmp_path, "a.gdf"))
    assert floats.volume == pytest.approx(2880.0, rel=1e-4)
    assert floats.kb == pytest.approx(1.5, rel=1e-4)
    assert floats.bm == pytest.approx(12.0**2 / 36.0, rel=1e-3)


@pytest.mark.parametrize("gone", [0, 9, 30])
def test_a_hole_is_refused_with_the_volume_it_leaks(tmp_path, gone):
    triangles = np.delete(half_barge(4, 12, 3), gone, axis=0)
    gdf(tmp_path / "a.gdf", triangles)
    path = tmp_path / "a.gdf"
    path.write_text(path.read_text().replace("\n0 0\n", "\n0 1\n", 1))
    said = refused(tmp_path, "a.gdf")
    assert "and leaks: its volume is" in said
    assert "close the holes" in said


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_half_a_surface_is_read_as_a_half(tmp_path, side):
    """Authority: closed form."""
    triangles = half_barge(4, 4, 2, z=(0.0, 5.0))
    stl(tmp_path / "a.stl", triangles if side > 0 else triangles[:, ::-1] * [1.0, -1.0, 1.0])
    assert volume(tmp_path, "a.stl") == pytest.approx(2880.0, rel=1e-3)


def test_half_a_catamaran_is_told_as_such(tmp_path):
    one = box_triangles(80.0, 4.0, 5.0, keel=0.0)
    port, starboard = np.subtract(one, [0.0, 4.0, 0.0]), np.add(one, [0.0, 4.0, 0.0])
    stl(tmp_path / "half.stl", starboard)
    stl(tmp_path / "whole.stl", np.concatenate([starboard, port]))
    for name in ("half.stl", "whole.stl"):
        assert "half of a catamaran" in refused(tmp_path, name)
    text = "".join(f"\n{x} 4 0\n2 2 6 6\n5 0 0 5" for x in X)
    (tmp_path / "a.out").write_text(f"{X.size} t 3.0{text}")
    assert "half of a catamaran" in refused(tmp_path, "a.out")


def test_a_bulb_of_a_mesh_counts_and_is_told(tmp_path):
    """Authority: closed form: a bulb 3 x 1.6 x 1.5 m ahead of half a barge, its corners those of the end it stands on."""
    barge = half_barge(4, 4, 2)
    x = 40.0
    end = np.concatenate([
        grid([(x, 0, -3), (x, 0.8, -3), (x, 0.8, -1.5), (x, 0, -1.5)], 1, 1),
        grid([(x, 0.8, -3), (x, 6, -3), (x, 6, -1.5), (x, 0.8, -1.5)], 1, 1),
        grid([(x, 0.8, -1.5), (x, 6, -1.5), (x, 6, 0), (x, 0.8, 0)], 1, 1),
        grid([(x, 0, -1.5), (x, 0.8, -1.5), (x, 0.8, 0), (x, 0, 0)], 1, 1),
    ])  # fmt: skip
    open_end = barge[~(barge[:, :, 0] == x).all(axis=1)]
    bulb = half_barge(1, 1, 1, x=(40.0, 43.0), b=0.8, z=(-3.0, -1.5))
    lid = grid([(40, 0, -1.5), (43, 0, -1.5), (43, 0.8, -1.5), (40, 0.8, -1.5)], 1, 1)
    bulb = bulb[~(bulb[:, :, 0] == x).all(axis=1)]
    gdf(tmp_path / "a.gdf", np.concatenate([open_end, end[2:], bulb, lid]))
    path = tmp_path / "a.gdf"
    path.write_text(path.read_text().replace("\n0 0\n", "\n0 1\n", 1))
    made = read(tmp_path, "a.gdf")
    assert hydrostatics(made).volume == pytest.approx(2880.0 + 7.2, rel=2e-4)
    assert "wholly under water" in made.hull.source


@pytest.mark.parametrize("name", ["a.igs", "a.step", "a.3dm", "a.obj"])
def test_an_unknown_format_is_named_as_unknown(tmp_path, name):
    (tmp_path / name).write_text("v 0.0 0.0 0.0\nv 1.0 0.0 0.0\n")
    said = refused(tmp_path, name)
    assert name[1:] in said
    assert "unknown" in said
    assert "pdstrip" in said


def test_a_pdstrip_file_without_sections_is_refused(tmp_path):
    (tmp_path / "a.out").write_text("0 t 3.0\n")
    assert "0 sections" in refused(tmp_path, "a.out")


def test_sections_of_several_hundred_points_have_their_trapezium(tmp_path):
    """Authority: the trapezium over the points, times the length."""
    angle = np.linspace(0.0, np.pi / 2, 400)
    y, z = 6.0 * np.sqrt(np.sin(angle)), 3.0 * (1 - np.cos(angle))
    rows = [f"{x},{b:.6f},{h:.6f}" for x in X for b, h in [*zip(y, z, strict=True), (6.0, 5.0)]]
    (tmp_path / "a.csv").write_text("x,y,z\n" + "\n".join(rows))
    assert volume(tmp_path) == pytest.approx(80.0 * 2 * np.trapezoid(y, z), rel=1e-4)


def test_a_message_names_the_file_that_is_no_text(tmp_path):
    (tmp_path / "a.csv").write_bytes(bytes(range(256)) * 4)
    with pytest.raises(InputError, match=r"a\.csv"):
        read(tmp_path, "a.csv")
    assert ship("box").hull.length == 100.0
