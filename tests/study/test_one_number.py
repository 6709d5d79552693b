"""One number for roll in every door, other stable motions in maps as in verdicts, and maps carried on past their edge."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.study.branches.coexisting import all_motions
from quartering.study.condition.examine import examine, facts
from quartering.study.condition.failure_events import failure_events
from quartering.study.maps.query import coexisting, other_rolls, worst
from quartering.view.cli import app
from quartering.view.explorer.headline import headline
from quartering.view.plots.polar_map import polar_map

pytestmark = pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
SHIP, SPEED, HEADING, WAVE = qt.ship("series60-cb60"), 5.187561276746522, 80.0, qt.Wave(195.072, 195.072 / 30)
"""A condition with two stable motions, by the defaults."""


@pytest.fixture(scope="module")
def ds():
    waves = [qt.Wave(length, length * WAVE.height / WAVE.length) for length in (180.0, WAVE.length, 210.0)]
    return qt.polar(SHIP, waves, [3.0, SPEED], [HEADING, 90.0])


def test_one_cell_has_one_number_in_six_doors(ds, tmp_path):
    """By definition: the largest |roll| over a cycle of the motion that is judged, sampled finely here."""
    found = examine(SHIP, WAVE, SPEED, HEADING)
    fine = np.degrees(np.abs(found.motion.state(np.linspace(0, 2 * np.pi / found.model.frequency, 2001))[:, 1]).max())
    cell = ds.sel(speed=SPEED, heading=HEADING, wave_length=WAVE.length)
    path = tmp_path / "map.nc"
    ds.to_netcdf(path)
    asked = CliRunner().invoke(app, ["worst", str(path), "--count", str(ds["verdict"].size), "--json"])
    rows = json.loads(asked.stdout)["worst"]
    (row,) = [r for r in rows if (r["speed"], r["heading"], r["wave_length"]) == (SPEED, HEADING, WAVE.length)]
    (mesh, *_) = polar_map(ds).axes[1].collections
    drawn = mesh.get_array().compressed() if np.ma.isMaskedArray(mesh.get_array()) else mesh.get_array().ravel()
    said = float(headline(found).split("Largest roll ")[1].split("°")[0])
    for number in (float(cell["roll_peak"]), facts(found, [])["roll_peak_deg"], row["roll_peak"]):
        assert number == pytest.approx(fine, rel=2e-4)
    assert np.abs(drawn - fine).min() < 2e-4 * fine
    assert said == pytest.approx(fine, rel=5e-3)
    at = {"speed": SPEED, "heading": HEADING, "wave_length": WAVE.length}
    assert bool(failure_events(ds, fine * 0.999).sel(at))
    assert bool(failure_events(ds, fine * 1.001).sel(at)) is (int(cell["capsizes_on_the_way"]) > 0)
    assert float(worst(ds, count=1)["roll_peak"][0]) == float(ds["roll_peak"].max())


def test_a_cell_names_the_other_motion_that_the_verdict_names(ds):
    """Authority: `all_motions`, whose search is another one."""
    found = examine(SHIP, WAVE, SPEED, HEADING)
    cell = ds.sel(speed=SPEED, heading=HEADING, wave_length=WAVE.length)
    own = other_rolls(cell).dropna("other_motion").values
    assert own == pytest.approx(found.beside.others, rel=1e-6)
    stable = [np.degrees(m.peak[1]) for m in all_motions(found.model, 3) if m.stable and m.periods == 1]
    assert min(abs(one - own[0]) for one in stable) < 0.01 * own[0]
    rings = [
        line for panel in polar_map(ds).axes[:2] for line in panel.lines if line.get_gid() == "another stable motion"
    ]
    assert sum(line.get_xdata().size for line in rings) == 2 * int(coexisting(ds).sum())


def test_a_map_is_carried_on_until_its_largest_roll_stands_inside():
    """By definition: the same cells as a map asked for in full, more of them, and the largest between others."""
    ship = qt.ship("wigley")
    waves = [qt.Wave(length, length / 60) for length in (60.0, 80.0)]
    short = qt.polar(ship, waves, 5.0, [60.0, 90.0])
    assert {edge.axis for edge in qt.edges_of_largest(short)} >= {"wave_length"}
    longer = qt.polar(ship, waves, 5.0, [60.0, 90.0], extend=True)
    assert longer.sizes["wave_length"] > 2
    assert qt.edges_of_largest(longer) == [] or float(longer["wave_length"].max()) >= 80 + 20 * 24
    assert np.array_equal(
        longer["roll"].sel({name: short[name] for name in ("speed", "heading", "wave_length")}).values,
        short["roll"].values,
    )
    np.testing.assert_allclose(longer["wave_height"] / longer["wave_length"], 1 / 60)
    with pytest.raises(qt.InputError, match="neither one height nor one steepness"):
        qt.polar(ship, [qt.Wave(60.0, 1.0), qt.Wave(80.0, 3.0)], 5.0, [60.0], extend=True)
