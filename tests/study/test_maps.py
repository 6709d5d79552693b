"""Sweeps and polar maps: the batch gives what one condition gives, symmetries hold, nothing is silent."""

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering.motion.status import Status
from quartering.stability.kind import Kind

PAPER = {"velocities": "absolute", "drag": "cubic", "ends": "strips", "righting": "polynomial"}
SHIP = qt.ship("series60-cb60")
LENGTH = SHIP.hull.length
SPEED = 0.25 * np.sqrt(9.81 * LENGTH)


@pytest.fixture(scope="module")
def small_map() -> xr.Dataset:
    waves = [qt.Wave(factor * LENGTH, factor * LENGTH / 50) for factor in (0.6, 1.0, 1.6)]
    return qt.polar(SHIP, waves, [0.0, SPEED], np.arange(0.0, 181.0, 30.0))


@pytest.mark.parametrize("cell", [(0, 3, 1), (1, 1, 0), (1, 2, 1), (1, 4, 2)])
def test_a_cell_of_the_map_is_the_single_condition(small_map, cell):
    """Agreement: the same condition through the public one-case functions."""
    at = small_map.isel(speed=cell[0], heading=cell[1], wave_length=cell[2])
    wave = qt.Wave(float(at["wave_length"]), float(at["wave_height"]))
    model = qt.equations(SHIP, wave, float(at["speed"]), float(at["heading"]))
    motion = qt.steady_motion(model, start="rest")
    verdict = qt.stability(model, motion)
    sway, roll, yaw = motion.amplitude
    assert float(at["sway"]) == pytest.approx(sway, rel=1e-9)
    assert float(at["roll"]) == pytest.approx(np.degrees(roll), rel=1e-9)
    assert float(at["yaw"]) == pytest.approx(np.degrees(yaw), rel=1e-9)
    assert float(at["roll_peak"]) == pytest.approx(np.degrees(motion.peak[1]), rel=1e-9)
    for name in ("k2", "k2_rho", "k2_paper", "index"):
        assert float(at[name]) == pytest.approx(getattr(verdict, name), rel=1e-8), name
    assert float(at["exponent"]) == pytest.approx(verdict.exponents[0].real, abs=1e-6)  # the map asks for 1e-6
    assert Kind(int(at["verdict"])).label == verdict.kind
    np.testing.assert_allclose(at["slow"], verdict.slow, rtol=1e-8)


def test_wave_heights_share_forces_but_not_answers():
    conditions = {"speed": SPEED, "heading": [30.0, 90.0], "wave_length": LENGTH}
    together = qt.sweep(SHIP, **conditions, wave_height=[1.0, 2.0, 4.0])
    alone = qt.sweep(SHIP, **conditions, wave_height=[2.0])
    xr.testing.assert_allclose(together.sel(wave_height=[2.0]), alone, rtol=1e-9)
    steepened = together["roll"].isel(heading=0, speed=0, wave_length=0).values
    assert (np.diff(steepened) > 0).all()


def test_loading_axes_are_the_changed_ship():
    conditions = {"speed": SPEED, "heading": 45.0, "wave_length": LENGTH, "wave_height": 2.0}
    ds = qt.sweep(SHIP, **conditions, gm=[0.6, 1.0], N_v=[0.5, 2.0])
    assert dict(ds.sizes)["loading"] == 4
    assert ds["gm"].values.tolist() == [0.6, 0.6, 1.0, 1.0]
    alone = qt.sweep(SHIP.with_(gm=1.0, factors={"N_v": 0.5}), **conditions)
    assert float(ds["roll"].isel(loading=2).squeeze()) == pytest.approx(float(alone["roll"].squeeze()), rel=1e-12)
    assert float(ds["exponent"].isel(loading=2).squeeze()) == pytest.approx(
        float(alone["exponent"].squeeze()), rel=1e-9
    )


def test_waves_from_port_and_starboard_give_mirrored_motion():
    """Symmetry of the hull: mu -> -mu."""
    wave = qt.Wave(LENGTH, LENGTH / 50)
    starboard, port = (qt.polar(SHIP, wave, [SPEED], [sign * h for h in (20.0, 70.0, 130.0)]) for sign in (1, -1))
    for name in ("sway", "roll", "yaw", "exponent", "k2"):
        np.testing.assert_allclose(port[name], starboard[name], rtol=1e-9, atol=1e-12, err_msg=name)


def test_no_roll_in_head_and_following_seas(small_map):
    assert float(small_map["roll"].sel(heading=[0.0, 180.0]).max()) < 1e-12


def test_ship_overtaking_the_wave_is_a_normal_condition():
    """Encounter frequency below zero: stern quartering, U cos(mu) > g/sigma (closed form)."""
    wave = qt.Wave(length=30.0, height=0.5)
    ds = qt.polar(SHIP, wave, [12.0], [20.0])
    assert float(ds["encounter_frequency"].squeeze()) < 0
    assert np.isfinite(float(ds["roll"].squeeze()))
    assert int(ds["status"].squeeze()) == Status.CONVERGED


def test_keeping_pace_with_the_wave_is_a_status_with_advice():
    """Closed form: omega = 0 at U = sqrt(g lambda / 2 pi) in following seas."""
    wave = qt.Wave(length=60.0, height=1.0)
    ds = qt.polar(SHIP, wave, [np.sqrt(9.81 * 60.0 / (2 * np.pi))], [0.0, 40.0])
    cell = ds.sel(heading=0.0).squeeze()
    assert Status(int(cell["status"])) is Status.ENCOUNTER_FREQUENCY_NEAR_ZERO
    assert Kind(int(cell["verdict"])) is Kind.NO_ANSWER
    assert np.isnan(float(cell["roll"]))
    assert "broaching" in Status(int(cell["status"])).advice
    assert np.isfinite(float(ds["roll"].sel(heading=40.0).squeeze()))
    with pytest.raises(qt.InputError, match="keeps pace"):
        qt.equations(SHIP, wave, float(ds["speed"][0]), 0.0)


def test_roll_beyond_the_fitted_arm_is_warned_of():
    with pytest.warns(qt.RangeWarning, match="40 deg"):
        qt.sweep(
            SHIP.with_(**PAPER),
            0.0,
            90.0,
            2.4 * LENGTH,
            [LENGTH / 10],
        )


def test_dataset_is_labelled_and_survives_the_disk(small_map, tmp_path):
    file = tmp_path / "map.nc"
    small_map.to_netcdf(file)
    with xr.open_dataset(file) as back:
        xr.testing.assert_identical(back["roll"], small_map["roll"])
        for name, variable in back.data_vars.items():
            assert variable.attrs["units"], name
            assert variable.attrs["long_name"], name
            assert "symbol" in variable.attrs, name
        assert back["verdict"].dtype == np.int8
        meanings = dict(zip(back["verdict"].flag_values, back["verdict"].flag_meanings.split(), strict=True))
        assert meanings[Kind.STABLE] == "stable"
        assert meanings[Kind.COURSE_IN_CALM_WATER] == "course_in_calm_water"
        for key in ("ship", "heading_convention", "reference_point", "axes", "coefficient_sources", "references"):
            assert back.attrs[key], key
        assert "estimated" in back.attrs["coefficient_sources"]
        assert back.attrs["source"].startswith("quartering ")
    assert "Haddara" in qt.cite(small_map)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"speed": []}, "at least one"),
        ({"heading": [0.0, float("nan")]}, "finite"),
        ({"wave_length": [-5.0]}, "length"),
        ({"wave_height": [40.0]}, "steep"),
        ({"speed": "fast"}, "number"),
        ({"gm": [0.0]}, "metacentric"),
        ({"K_pppp": [1.0]}, "K_ppp"),
    ],
)
def test_bad_axes_are_refused_with_one_message(changes, message):
    good = {"speed": [5.0], "heading": [30.0], "wave_length": [LENGTH], "wave_height": [2.0]}
    with pytest.raises(qt.InputError, match=message):
        qt.sweep(SHIP, **(good | changes))


def test_calm_water_course_instability_is_told_from_the_waves_doing():
    """A full hull is course-unstable by regression: its cells must say so, and its calm exponent be positive."""
    ship = qt.ship("box").with_(ends="strips")
    length = ship.hull.length
    ds = qt.polar(ship, qt.Wave(length, length / 100), [0.25 * np.sqrt(9.81 * length)], [20.0])
    if float(ds["calm_exponent"].squeeze()) > 0:
        assert Kind(int(ds["verdict"].squeeze())) is Kind.COURSE_IN_CALM_WATER
    else:
        assert Kind(int(ds["verdict"].squeeze())) is not Kind.COURSE_IN_CALM_WATER


def test_progress_counts_every_condition():
    seen = []
    qt.sweep(
        SHIP,
        [0.0, 5.0],
        [30.0, 60.0],
        [100.0],
        [1.0, 2.0],
        gm=[0.7, 0.9],
        progress=lambda done, of: seen.append((done, of)),
    )
    assert seen[-1] == (16, 16)
    assert [done for done, _ in seen] == sorted(done for done, _ in seen)
