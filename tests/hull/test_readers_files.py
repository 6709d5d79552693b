"""Lines in files of other programs: what is written of a known hull reads back as the same hull."""

import numpy as np
import pytest

from quartering.conventions import InputError
from quartering.hull.file.read import ship
from quartering.hull.formats.meshes import box_triangles
from quartering.hull.formats.read import hull_from_lines, read_lines
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.contour import along, chord_at_height

pytestmark = pytest.mark.quick

S60 = ship("series60-cb60").hull
SIZE = {"length": S60.length, "beam": S60.beam, "draught": S60.draught}
WHOLE = hydrostatics(S60)
STATIONS = S60.wet


def outline(station, count, top):
    """Points of a Series 60 section, keel to a height, at even arc lengths."""
    curve = S60.curves[station]
    y, height, *_ = along(curve, np.linspace(0.0, chord_at_height(curve, top), count))
    return np.maximum(y, 0.0), np.maximum.accumulate(height)


def side_grid(count, top, stations=STATIONS):
    """Points (s, n, 3) of the starboard side, z from the baseline."""
    grid = []
    for s in stations:
        y, height = outline(s, count, top)
        grid.append(np.stack([np.full(count, S60.x[s]), y, height], axis=1))
    return np.array(grid)


def quads(grid):
    """Panels of a grid (s, n, 3) of the side y > 0, corners anticlockwise as seen from the water (y > 0 to port or
    starboard alike: the normal has n_y > 0)."""
    a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
    return np.stack([a, b, c, d], axis=2).reshape(-1, 4, 3)


def end_caps(grid):
    """Triangles that close the two ends of a half hull against the centreplane."""
    found = []
    for row, forward in ((grid[0], False), (grid[-1], True)):
        centre = np.array([row[0, 0], 0.0, row[-1, 2]])
        for k in range(len(row) - 1):
            corner = [centre, row[k], row[k + 1]] if forward else [centre, row[k + 1], row[k]]
            found.append(np.array(corner))
    return np.array(found)


def half_surface(count, top):
    """Triangles of the closed starboard half below a height: side and ends, open at the top and on the centreplane."""
    grid = side_grid(count, top)
    keel = grid[:, :1] * [1.0, 0.0, 1.0]  # sections that start off the centreline have a flat bottom from it
    grid = np.concatenate([keel, grid], axis=1)
    q = quads(grid)
    return np.concatenate([q[:, [0, 1, 2]], q[:, [0, 2, 3]], end_caps(grid)])


def whole_surface(count, top):
    half = half_surface(count, top)
    return np.concatenate([half, half[:, ::-1] * [1.0, -1.0, 1.0]])


def write_stl(path, triangles):
    data = bytes(80) + len(triangles).to_bytes(4, "little")
    for triangle in triangles:
        data += bytes(12) + triangle.astype("<f4").tobytes() + bytes(2)
    path.write_bytes(data)


def write_gdf(path, triangles, *, waterline, isy=1):
    corners = np.concatenate([triangles, triangles[:, 2:]], axis=1) - [0.0, 0.0, waterline]
    rows = "\n".join(" ".join(f"{value:.7f}" for value in corner) for corner in corners.reshape(-1, 3))
    path.write_text(f"Series 60\n100.0 9.81\n0 {isy}\n{len(corners)}\n{rows}\n")


def hull_of(path, **keys):
    lines = read_lines(path, draught=keys.get("draught", S60.draught))
    return hull_from_lines(str(path), lines, **{**SIZE, **keys})


def agrees(hull, tolerance):
    """Volume, centre and KM of a hull against those of the lines it was written from."""
    read = hydrostatics(hull)
    assert read.volume == pytest.approx(WHOLE.volume, rel=tolerance)
    assert read.lcb == pytest.approx(WHOLE.lcb, abs=tolerance * S60.length)
    assert read.km == pytest.approx(WHOLE.km, rel=2 * tolerance)


def test_points_written_as_csv_read_back_as_the_same_hull(tmp_path):
    grid = side_grid(60, 1.5 * S60.draught, range(len(S60.x)))
    rows = [",".join(f"{value:.6f}" for value in point) for station in grid for point in station]
    (tmp_path / "s60.csv").write_text("x,y,z\n# Series 60\n" + "\n".join(rows))
    agrees(
        hull_of(tmp_path / "s60.csv"), 5e-4
    )  # 60 straight pieces round a bilge: 1/(2 60^2) of the area, and rounding


def test_a_table_of_waterlines_reads_back_as_the_same_hull(tmp_path):
    heights = S60.draught * np.concatenate([np.linspace(0, 0.1, 11), np.linspace(0.15, 1.5, 28)])
    rows = ["station;x;" + ";".join(f"{h:.5f}" for h in heights)]
    for s, (y, h) in enumerate(S60.contours):
        curve = S60.curves[s]
        half = [
            f"{along(curve, np.array([chord_at_height(curve, z)]))[0][0]:.5f}" if z >= h[0] else "" for z in heights
        ]
        half[0] = f"{y[h == 0].max():.5f}" if h[0] == 0 else ""
        rows.append(f"{s};{S60.x[s]:.5f};" + ";".join(half))
    (tmp_path / "s60.csv").write_text("\n".join(rows[:1] + rows[1:][::-1]))  # fore to aft
    agrees(hull_of(tmp_path / "s60.csv"), 2e-3)  # waterlines 0.01 T to 0.05 T apart, joined straight


@pytest.mark.parametrize("whole", [True, False])
def test_a_pdstrip_section_file_reads_back_as_the_same_hull(tmp_path, whole):
    lines = [f"{len(S60.x)} {'f' if whole else '.true.'} {S60.draught}"]
    for s in range(len(S60.x)):
        y, h = outline(s, 60, 1.5 * S60.draught)
        if whole:
            y, h = np.concatenate([y[::-1], -y]), np.concatenate([h[::-1], h])
        lines.append(f"{S60.x[s] + 60:.5f} {y.size} 1 3")
        lines += [" ".join(f"{v:.5f}" for v in y), " ".join(f"{v:.5f}" for v in h)]
    (tmp_path / "geomet.out").write_text("\n".join(lines))
    agrees(hull_of(tmp_path / "geomet.out", midship=60.0), 5e-4)


@pytest.mark.parametrize("isy", [0, 1])
def test_a_gdf_mesh_reads_back_as_the_same_immersed_hull(tmp_path, isy):
    surface = half_surface(40, S60.draught) if isy else whole_surface(40, S60.draught)
    write_gdf(tmp_path / "s60.gdf", surface, waterline=S60.draught, isy=isy)
    hull = hull_of(tmp_path / "s60.gdf")
    agrees(hull, 3e-3)  # 39 flat panels round the section, sections taken 1e-5 L off the stations
    assert hull.depth == pytest.approx(1.5 * S60.draught)
    assert "assumed straight up" in hull.source


def test_a_binary_stl_reads_back_as_the_same_hull(tmp_path):
    write_stl(tmp_path / "s60.stl", whole_surface(40, 1.4 * S60.draught))
    agrees(hull_of(tmp_path / "s60.stl"), 3e-3)


def test_a_closed_box_cut_at_even_stations_has_its_exact_volume(tmp_path):
    write_stl(tmp_path / "box.stl", box_triangles(60.0, 10.0, 6.0, keel=-4.0))
    size = {"length": 60.0, "beam": 10.0, "draught": 4.0}
    hull = hull_of(tmp_path / "box.stl", **size)
    assert hydrostatics(hull).volume == pytest.approx(2400.0, rel=1e-4)  # closed form; the ends are cut 1e-5 L inside
    assert hull.depth == pytest.approx(6.0)


def refusal(path, **keys):
    with pytest.raises(InputError) as caught:
        hull_of(path, **keys)
    return str(caught.value)


@pytest.mark.parametrize(
    ("row", "column", "cell", "words"),
    [
        (2, 3, "-0.2", ["station 2 (x = -10 m)", "waterline 3", "-0.2", "negative"]),
        (2, 3, "abc", ["station 2", "waterline 3", "'abc'", "not a number"]),
        (2, 2, "", ["station 2", "blanks"]),
        (3, 0, "nan", ["station", "x", "not a number"]),
        (3, 0, "-40", ["one way"]),
        (0, 2, "-1", ["station 1", "waterline 2", "offsets cross"]),
        (0, 0, "z", ["header"]),
    ],
)
def test_a_bad_offset_is_named_by_station_and_waterline(tmp_path, row, column, cell, words):
    table = [["x", "0", "2", "4", "6"]] + [[str(x), "4", "5", "5", "5"] for x in (-30, -10, 10, 30)]
    table[row][column] = cell
    (tmp_path / "bad.csv").write_text("\n".join(",".join(line) for line in table))
    message = refusal(tmp_path / "bad.csv", length=60.0, beam=10.0, draught=4.0)
    assert all(word in message for word in ["bad.csv", *words]), message


def test_points_of_one_station_in_two_places_are_refused(tmp_path):
    rows = [(x, y, z) for x in (-30, -10, 10, 30, -30) for y, z in ((0, 0), (5, 0), (5, 6))]
    (tmp_path / "bad.csv").write_text("x,y,z\n" + "\n".join(f"{x},{y},{z}" for x, y, z in rows))
    assert "two places" in refusal(tmp_path / "bad.csv")


def test_lines_counted_from_the_aft_perpendicular_ask_for_midship(tmp_path):
    rows = "\n".join(f"{x},5,5,5" for x in (0, 20, 40, 60))
    (tmp_path / "aft.csv").write_text("x,0,4,6\n" + rows)
    size = {"length": 60.0, "beam": 10.0, "draught": 4.0}
    assert "midship: 30" in refusal(tmp_path / "aft.csv", **size)
    assert hydrostatics(hull_of(tmp_path / "aft.csv", midship=30.0, **size)).volume == pytest.approx(2400.0)


def test_a_ship_file_takes_its_lines_from_a_file_beside_it(tmp_path):
    surface = half_surface(40, S60.draught)
    write_gdf(tmp_path / "s60.gdf", np.add(surface, [60.0, 0.0, 0.0]), waterline=S60.draught)
    size = f"length: {S60.length} m\nbeam: {S60.beam} m\ndraught: {S60.draught} m\n"
    (tmp_path / "mine.yaml").write_text(size + "depth: 10 m\nlines: {file: s60.gdf, midship: 60}\nloading: {gm: 0.8}\n")
    mine = ship(tmp_path / "mine.yaml")
    agrees(mine.hull, 3e-3)
    assert mine.loading.gm == 0.8
    assert mine.hull.depth == pytest.approx(10.0)
    assert "s60.gdf" in mine.provenance["lines"]


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ("lines: nowhere.csv", ["nowhere.csv", "not there"]),
        ("offsets: a.csv", ["offsets", "lines: a.csv"]),
        ("lines: {file: a.csv, middle: 3}", ["middle", "midship"]),
        ("lines: a.csv\nshape: box", ["lines", "shape", "drop"]),
        ("lines: a.csv\nbase: box", ["lines", "base", "drop"]),
    ],
)
def test_a_ship_file_with_wrong_lines_is_refused_in_one_message(tmp_path, keys, words):
    (tmp_path / "mine.yaml").write_text(f"length: 60 m\nbeam: 10 m\ndraught: 4 m\n{keys}\n")
    with pytest.raises(InputError) as caught:
        ship(tmp_path / "mine.yaml")
    assert all(word in str(caught.value) for word in ["mine.yaml" if "nowhere" not in keys else "nowhere", *words]), (
        caught
    )


@pytest.mark.parametrize("cut", [20, 400])
def test_a_section_file_cut_short_is_refused(tmp_path, cut):
    text = "4 t 4.0" + "".join(f"\n{x} 3 0\n0 5 5\n0 0 6" for x in (-30, -10, 10, 30))
    (tmp_path / "geomet.out").write_text(text[: min(cut, len(text) - 6)])
    assert "cut short" in refusal(tmp_path / "geomet.out", length=60.0, beam=10.0, draught=4.0)


def test_a_section_with_different_sides_is_refused(tmp_path):
    text = "4 f 4.0" + "".join(f"\n{x} 5 0\n-5 -5 0 5 4\n6 0 0 0 6" for x in (-30, -10, 10, 30))
    (tmp_path / "geomet.out").write_text(text)
    assert "port and starboard differ" in refusal(tmp_path / "geomet.out")


def deep_one(triangles):
    """The largest triangle of the side that lies in the water."""
    area = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    inside = (triangles[:, :, 2].max(axis=1) < 0.9 * S60.draught) & (triangles[:, :, 1].min(axis=1) > 1.0)
    return int(np.argmax(area * inside))


def remove_one(triangles):
    return np.delete(triangles, deep_one(triangles), axis=0)


def turn_one(triangles):
    turned, one = triangles.copy(), deep_one(triangles)
    turned[one] = turned[one][::-1]
    return turned


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (remove_one, ["open along 3 edges", "close the holes"]),
        (turn_one, ["turned opposite ways"]),
        (lambda triangles: triangles[:, ::-1], ["inside out", "reverse"]),
    ],
)
@pytest.mark.parametrize("form", ["gdf", "stl"])
def test_a_mesh_with_a_hole_or_turned_inside_out_is_refused_in_one_message(tmp_path, form, change, words):
    path = tmp_path / f"bad.{form}"
    if form == "gdf":
        write_gdf(path, change(half_surface(20, S60.draught)), waterline=S60.draught)
    else:
        write_stl(path, change(whole_surface(20, 1.4 * S60.draught)))
    message = refusal(path)
    assert all(word in message for word in [path.name, *words]), message


def test_a_mesh_of_two_bodies_is_refused_by_station(tmp_path):
    low, high = box_triangles(60.0, 10.0, 3.0, keel=-4.0), box_triangles(60.0, 10.0, 3.0, keel=0.0)
    write_stl(tmp_path / "two.stl", np.concatenate([low, high]))
    message = refusal(tmp_path / "two.stl", length=60.0, beam=10.0, draught=4.0)
    assert "several pieces" in message
    assert "station" in message


def test_a_mesh_file_cut_short_is_refused(tmp_path):
    write_stl(tmp_path / "box.stl", box_triangles(60.0, 10.0, 6.0))
    data = (tmp_path / "box.stl").read_bytes()
    (tmp_path / "box.stl").write_bytes(data[:-60])
    assert "cut short" in refusal(tmp_path / "box.stl")
