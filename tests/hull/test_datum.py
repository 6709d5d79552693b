"""Where heights count from is decided by the whole hull, and what makes no ship is refused.

Barges of closed form: length 80 m, breadth 12 m, draught 3 m, sides to 5 m; a prism displaces 80 12 3 = 2880 m3.
"""

import numpy as np
import pytest

from quartering.conventions import InputError, RangeWarning
from quartering.hull.file.read import ship
from quartering.hull.formats.meshes import box_triangles
from quartering.hull.hydrostatics import hydrostatics
from quartering.hydro.manoeuvring.lift import clarke_derivatives

pytestmark = pytest.mark.quick

X = np.linspace(-40.0, 40.0, 9)
SIZE = "length: 80 m\nbeam: 12 m\ndraught: {} m\n"


def points(path, keel, bar=0.0, top=5.0, lift=0.0):
    """Stations x, y, z of a barge; a bar 0.4 m wide under the keel of the five stations in the middle."""
    rows = ["x,y,z"]
    for k, (x, z) in enumerate(zip(X, np.broadcast_to(keel, X.shape), strict=True)):
        contour = [(0.0, z), (6.0, z), (6.0, top)]
        if bar and 2 <= k <= 6:
            contour = [(0.0, z - bar), (0.2, z - bar), (0.2, z), (6.0, z), (6.0, top)]
        rows += [f"{x},{y},{z + lift}" for y, z in contour]
    path.write_text("\n".join(rows))


def table(path, bar):
    """The same barge as a table, a waterline below the baseline."""
    rows = [f"x,{-bar},0,3,5"] + [f"{x},{0.2 if 2 <= k <= 6 else ''},6,6,6" for k, x in enumerate(X)]
    path.write_text("\n".join(rows))


def pdstrip(path, keel, header):
    text = f"{X.size} t {header}"
    for x, z in zip(X, keel, strict=True):
        text += f"\n{x} 3 0\n0 6 6\n{z} {z} 5"
    path.write_text(text)


def stl(path, triangles):
    rows = (f"vertex {x} {y} {z}" for x, y, z in np.asarray(triangles).reshape(-1, 3))
    path.write_text("solid barge\n" + "\n".join(rows) + "\nendsolid")


def gdf(path, triangles):
    corners = np.concatenate([triangles, triangles[:, 2:]], axis=1).reshape(-1, 3)
    rows = "\n".join(" ".join(f"{value:.6f}" for value in corner) for corner in corners)
    path.write_text(f"barge\n1.0 9.81\n0 0\n{len(triangles)}\n{rows}\n")


def read(folder, lines, draught=3.0, more=""):
    (folder / "my.yaml").write_text(SIZE.format(draught) + f"lines: {lines}\n{more}")
    return ship(folder / "my.yaml")


def refused(folder, lines, **given):
    with pytest.raises(InputError) as caught:
        read(folder, lines, **given)
    return str(caught.value)


@pytest.mark.parametrize("bar", [0.001, 0.05, 0.4])
def test_a_bar_keel_below_the_baseline_does_not_lift_the_hull(tmp_path, bar):
    """Authority: closed form, 2880 m3 and the bar, 0.4 bar m2 by the trapezium over five stations of nine."""
    points(tmp_path / "a.csv", 0.0, bar)
    made = read(tmp_path, "a.csv")
    volume = hydrostatics(made).volume
    assert volume == pytest.approx(2880.0 + 0.4 * bar * 50.0, rel=1e-3)
    assert (made.hull.datum, volume > 80 * 12 * 3) == ("keel", True)
    assert clarke_derivatives(80.0, 12.0, 3.0, volume / 2880.0)["Y_v"] < 0  # a block of 1 and what stands out below it


def test_a_waterline_below_zero_in_a_table_does_not_lift_the_hull(tmp_path):
    """Authority: closed form; between the bar and the bottom, a waterline apart, the points are joined straight."""
    table(tmp_path / "a.csv", 0.05)
    assert hydrostatics(read(tmp_path, "a.csv")).volume == pytest.approx(2880.0 + 0.05 * 6.2 * 50.0, rel=2e-3)


@pytest.mark.parametrize("header", [3.0, 0.0])
def test_a_raked_keel_keeps_volume_and_moves_its_centre_aft(tmp_path, header):
    """Authority: closed form: volume 2880 m3, moment -int r x^2 12 dx = -r 12 80^3/12 with the rake r."""
    rake = 0.012
    pdstrip(tmp_path / "a.out", rake * X, header)
    floats = hydrostatics(read(tmp_path, "a.out"))
    assert floats.volume == pytest.approx(2880.0)
    assert floats.lcb == pytest.approx(-rake * 80.0**3 / 2880.0, rel=1e-2)


@pytest.mark.parametrize("keel", [-3.0, -3.0 + 0.012 * X], ids=["even", "raked"])
def test_lines_from_the_calm_water_are_lifted(tmp_path, keel):
    points(tmp_path / "a.csv", keel, top=2.0)
    made = read(tmp_path, "a.csv")
    assert hydrostatics(made).volume == pytest.approx(2880.0)
    assert "heights from the calm water" in made.hull.source


@pytest.mark.parametrize("keel", [0.0, -0.05, -3.0])
def test_a_surface_is_counted_from_where_its_keel_lies(tmp_path, keel):
    """Authority: closed form; 0.05 m below the baseline is a thicker bottom plate, 80 12 3.05."""
    stl(tmp_path / "a.stl", box_triangles(80.0, 12.0, 5.0, keel=keel))
    depth = 3.05 if keel == -0.05 else 3.0
    assert hydrostatics(read(tmp_path, "a.stl")).volume == pytest.approx(960.0 * depth, rel=1e-3)


@pytest.mark.parametrize("told", [2.0, 2.5, 4.0])
@pytest.mark.parametrize("form", ["csv", "gdf", "stl"])
def test_another_draught_than_that_of_lines_from_the_calm_water_is_refused_with_both(tmp_path, form, told):
    if form == "csv":
        points(tmp_path / "a.csv", -3.0, top=2.0)
    else:
        triangles = box_triangles(80.0, 12.0, 5.0 if form == "stl" else 3.0, keel=-3.0)
        triangles = triangles if form == "stl" else triangles[~(triangles[:, :, 2] == 0.0).all(axis=1)]
        (stl if form == "stl" else gdf)(tmp_path / f"a.{form}", triangles)
    said = refused(tmp_path, f"a.{form}", draught=told)
    assert f"{told:g} m" in said
    assert "3 m deep" in said or "datum: keel" in said


def test_datum_decides_where_lines_fit_both_or_neither(tmp_path):
    """A keel half a draught below zero is deeper than a block from the baseline; one 1 m over it displaces 80 12 2."""
    points(tmp_path / "a.csv", 1.0)
    assert "`datum: keel` or `datum: waterline`" in refused(tmp_path, "a.csv")
    assert hydrostatics(read(tmp_path, "a.csv", more="datum: keel")).volume == pytest.approx(960.0 * 2.0)
    points(tmp_path / "a.csv", -1.5)
    assert "`datum: keel` or `datum: waterline`" in refused(tmp_path, "a.csv")
    assert "block coefficient of 1.5" in refused(tmp_path, "a.csv", more="datum: keel")
    assert "1.5 m deep" in refused(tmp_path, "a.csv", more="datum: waterline")
    afloat = read(tmp_path, "a.csv", draught=1.5, more="datum: waterline")
    assert hydrostatics(afloat).volume == pytest.approx(960.0 * 1.5)
    assert afloat.value("datum") == "waterline"


def test_datum_is_refused_where_no_lines_are_read():
    with pytest.raises(InputError, match="acts while lines of a file are read"):
        ship("box").with_(datum="waterline")
    assert ship("box").with_(datum="keel").value("datum") == "keel"


def test_another_datum_asked_of_lines_already_read_names_the_one_they_were_read_by(tmp_path):
    points(tmp_path / "a.csv", -3.0, top=2.0)
    stations = [{"x": float(x), "heights": [-3, -3, 2], "half_breadths": [0, 6, 6]} for x in X]
    (tmp_path / "own.yaml").write_text(SIZE.format(3.0) + f"offsets: {{unit: m, stations: {stations}}}\n")
    for made in (read(tmp_path, "a.csv"), ship(tmp_path / "own.yaml")):
        assert made.with_(datum="waterline", gm=0.5).hull.datum == "waterline"
        with pytest.raises(InputError, match="were counted from waterline as they were read"):
            made.with_(datum="keel")


def test_own_offsets_of_a_ship_file_are_counted_alike(tmp_path):
    stations = [{"x": float(x), "heights": [-3, -3, 2], "half_breadths": [0, 6, 6]} for x in X]
    (tmp_path / "my.yaml").write_text(
        SIZE.format(3.0) + f"offsets: {{unit: m, outline: straight, stations: {stations}}}\n"
    )
    assert hydrostatics(ship(tmp_path / "my.yaml")).volume == pytest.approx(2880.0)


def test_the_deck_no_ship_has_is_refused_by_station(tmp_path):
    for deck in (2e9, 600.0, 40.0):
        pdstrip(tmp_path / "a.out", 0.0 * X, 3.0)
        text = (tmp_path / "a.out").read_text().replace("\n0.0 3 0\n0 6 6\n0.0 0.0 5", f"\n0.0 3 0\n0 6 6\n0 0 {deck}")
        (tmp_path / "a.out").write_text(text)
        assert "station 5 (x = 0 m) ends at height" in refused(tmp_path, "a.out")


def test_a_half_breadth_beyond_the_beam_is_refused_by_station_and_waterline(tmp_path):
    (tmp_path / "a.csv").write_text("x,0,1,3,5\n" + "\n".join(f"{x},{700 if x == 20 else 6},6,6,6" for x in X))
    assert "station 7 (x = 20 m), waterline 1 (height 0 m): half breadth 700 m" in refused(tmp_path, "a.csv")


def test_a_hull_that_hardly_floats_is_refused_with_its_block_coefficient(tmp_path):
    points(tmp_path / "a.csv", 2.9, top=5.0)
    assert "block coefficient of 0.03333" in refused(tmp_path, "a.csv", more="datum: keel")


def test_a_very_fine_block_is_told(tmp_path):
    points(tmp_path / "a.csv", 2.6, top=5.0)
    with pytest.warns(RangeWarning, match="block coefficient is 0.133"):
        read(tmp_path, "a.csv", more="datum: keel")
