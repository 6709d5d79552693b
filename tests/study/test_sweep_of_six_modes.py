"""Studies in six modes go through the sweep, the store and the case file as those in three do.

Authority: by definition; each number of a sweep is that of `polar` in six modes, which integration judges elsewhere.
"""

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering.study.case.read import case_grid
from quartering.study.grid import grid
from quartering.study.maps.result import open_result
from quartering.study.maps.sweep import evaluated, fill
from quartering.study.six_modes.grid import in_six_modes
from tests.tiers import mostly_soak

pytestmark = pytest.mark.filterwarnings("ignore::quartering.RangeWarning")
SHIP = qt.ship("series60-cb60")
LENGTH = SHIP.hull.length
CONDITIONS = {
    "speed": [4.0, 8.0],
    "heading": [0.0, 60.0, 180.0],
    "wave_length": [0.9 * LENGTH],
    "wave_height": [2.0, 4.0],
}
SIZES = [3, 5, 12]


@pytest.fixture(scope="module")
def swept() -> xr.Dataset:
    return qt.sweep(SHIP, **CONDITIONS, modes="six")


def test_a_sweep_has_the_numbers_of_the_map(swept):
    for height in (2.0, 4.0):
        asked = ([qt.Wave(0.9 * LENGTH, height)], CONDITIONS["speed"], CONDITIONS["heading"])
        own, cells = qt.polar(SHIP, *asked, modes="six"), swept.sel(wave_height=height)
        assert cells.attrs["modes"] == "six"
        for name in ("roll_peak", "exponent", "verdict", "status", "encounter_frequency"):
            np.testing.assert_array_equal(cells[name], own[name], name)
    assert np.isfinite(swept["exponent"]).all()


@pytest.mark.parametrize("size", mostly_soak(SIZES, 5))
def test_a_store_of_any_block_size_that_was_interrupted_has_the_same_bytes(tmp_path, swept, size):
    wanted = in_six_modes(grid(SHIP, **CONDITIONS)).in_blocks_of(size)

    def stopped(done, _counts):
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fill(wanted, tmp_path / "s", told=stopped)
    counts = fill(wanted, tmp_path / "s")
    assert sum(n for name, n in counts.items() if name.startswith("status ")) == wanted.count
    kept = open_result(tmp_path / "s").load()
    for name in swept.data_vars:
        assert kept[name].values.tobytes() == swept[name].values.tobytes(), name
    assert kept.attrs["steady_motion"] == swept.attrs["steady_motion"]


def test_a_loading_is_the_ship_with_that_loading():
    one = {**CONDITIONS, "heading": [180.0], "wave_height": [4.0]}
    both = qt.sweep(SHIP, **one, gm=[0.6, 0.9], modes="six")
    own = qt.sweep(SHIP.with_(gm=0.6), **one, modes="six")
    np.testing.assert_array_equal(both["exponent"].sel(loading=0), own["exponent"])
    assert (both["exponent"].sel(loading=0) != both["exponent"].sel(loading=1)).any()


CASE = "ship: wigley\nspeed: [3 m/s]\nheading: [180 deg]\nwave_length: 100 m\nwave_height: [1 m]\nmodes: six\n"


def test_a_case_file_says_modes(tmp_path):
    (tmp_path / "c.yaml").write_text(CASE)
    wanted = case_grid(tmp_path / "c.yaml")
    assert wanted.described["kind"] == "six modes"
    own = qt.sweep(qt.ship("wigley"), 3.0, 180.0, 100.0, 1.0, modes="six")
    xr.testing.assert_equal(evaluated(wanted), own)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("harmonics: 3", "harmonics and diffraction of its own"),
        ("form: paper", "harmonics and diffraction of its own"),
        ("modes: five", "modes"),
        ("wave_height: [0 m]", "give heights above 0"),
    ],
)
def test_what_six_modes_do_not_take_is_refused_in_a_case(tmp_path, line, words):
    name = line.split(":")[0]
    kept = [one for one in CASE.splitlines() if not one.startswith(f"{name}:")]
    (tmp_path / "c.yaml").write_text("\n".join([*kept, line]) + "\n")
    with pytest.raises(qt.InputError, match=words):
        case_grid(tmp_path / "c.yaml")


def test_other_modes_are_refused_in_python_too():
    with pytest.raises(qt.InputError, match='it is "three"'):
        qt.sweep(SHIP, **CONDITIONS, modes="four")
