"""Operational guidance: against the response to each sea alone, limits, closed forms, and itself in other orders."""

import math
import pickle

import numpy as np
import pytest

import quartering as qt
from quartering.study.case.read import case_grid
from quartering.study.maps.executor import _one_block, prepare_pickling
from quartering.study.maps.sweep import evaluated, fill, in_pieces
from quartering.study.seas.over_seas.advice import Advice, Estimate, Judged, advised, crossings
from quartering.study.seas.over_seas.conditions import CLOSURE, SIMULATION
from quartering.study.seas.over_seas.grid import sea_grid
from quartering.study.seas.over_seas.settings import SeaSettings

SHIP = qt.ship("series60-cb60")
pytestmark = pytest.mark.filterwarnings("ignore:.* steep.*doubtful:quartering.conventions.RangeWarning")
SEAS = {"hs": [2.0, 4.0], "tp": [9.0, 12.0], "speed": [3.0, 7.5], "heading": [0.0, 60.0, 90.0, 180.0]}


@pytest.fixture(scope="module")
def found():
    return qt.guidance(SHIP, **SEAS)


def test_a_cell_is_the_response_to_its_sea_alone(found):
    """Another grid of wave cells, since that of a map serves all its seas: each errs by 1e-3 of roll at most (theory, 3)."""
    for hs, tp, speed, heading in ((2.0, 9.0, 3.0, 60.0), (4.0, 12.0, 7.5, 90.0), (4.0, 9.0, 7.5, 60.0)):
        alone = qt.sea_response(SHIP, qt.Sea(hs=hs, tp=tp, heading=heading), speed, method="closure")
        cell = found.isel(loading=0, tz=SEAS["tp"].index(tp)).sel(hs=hs, speed=speed, heading=heading)
        np.testing.assert_allclose(cell["roll_rms"], alone["roll_rms"], rtol=2e-3)
        np.testing.assert_allclose(cell["roll_mean_3h_max"], alone["roll_mean_largest"], rtol=2e-3)
        np.testing.assert_allclose(cell["roll_3h_max_upper"], alone["roll_mean_largest_bound"], rtol=2e-3)
        np.testing.assert_allclose(cell["tp"], tp, rtol=1e-12)


def test_a_cell_of_two_peaks_is_the_response_to_its_sea_alone():
    """Torsethaugen's spectrum, whose axis is the period of the larger peak; wave cells err by 1e-3 (theory_seas, 3)."""
    given = {"hs": [2.0, 4.0], "tp": [8.0, 13.0], "speed": 5.0, "heading": [60.0, 120.0], "spectrum": "torsethaugen"}
    found = qt.guidance(SHIP, **given, spreading=10).isel(loading=0, speed=0)
    assert found["roll_rms"].dims == ("hs", "tp", "heading")
    for hs, tp, heading in ((2.0, 8.0, 60.0), (4.0, 13.0, 120.0)):
        sea = qt.Sea(hs=hs, tp=tp, heading=heading, spectrum="torsethaugen", spreading=10)
        alone, cell = qt.sea_response(SHIP, sea, 5.0, method="closure"), found.sel(hs=hs, tp=tp, heading=heading)
        np.testing.assert_allclose(cell["roll_rms"], alone["roll_rms"], rtol=2e-3)
        np.testing.assert_allclose(cell["tz"], sea.tz, rtol=1e-12)


def test_a_swell_stands_beside_each_sea_and_turns_with_it():
    """Each cell is the response to sea + swell; a swell from port at 60 deg is one from starboard at 300 (mirror)."""
    swell = qt.Sea(hs=1.5, tp=14, heading=40)
    given = {"hs": [2.0, 4.0], "tp": [9.0], "speed": 5.0, "spreading": 10}
    found = qt.guidance(SHIP, **given, heading=[60.0, 300.0], swell=swell).isel(loading=0, speed=0, tz=0)
    for hs in (2.0, 4.0):
        both = (qt.Sea(hs=hs, tp=9, spreading=10) + swell).turned_to(60.0)
        alone = qt.sea_response(SHIP, both, 5.0, method="closure")
        np.testing.assert_allclose(found["roll_rms"].sel(hs=hs, heading=60.0), alone["roll_rms"], rtol=2e-3)
    other = qt.guidance(SHIP, **given, heading=[300.0, 60.0], swell=swell.turned_to(-40.0)).isel(
        loading=0, speed=0, tz=0
    )
    np.testing.assert_allclose(other["roll_rms"].values, found["roll_rms"].values, rtol=1e-9)
    assert (np.abs(found["roll_rms"][:, 0] / found["roll_rms"][:, 1] - 1) > 0.05).all()
    assert found.attrs["sides"] == "differ"
    calm = qt.guidance(SHIP, [1.0], 9.0, speed=5.0, swell=swell)
    assert calm["heading"].values.max() == 355.0


def test_head_and_following_seas_of_one_direction_do_not_roll(found):
    still = found.sel(heading=[0.0, 180.0])
    np.testing.assert_array_equal(still["roll_rms"].values[still["status"].values == 0], 0.0)
    np.testing.assert_array_equal(still["failure_rate"].values[still["status"].values == 0], 0.0)
    assert (still["recommended"] != int(Advice.NOT_RECOMMENDED)).all()


def test_a_low_sea_rolls_in_proportion_and_is_recommended():
    """Hs to 0: the closure becomes linear."""
    low = qt.guidance(SHIP, [0.001, 0.002], 10.0, speed=7.5, heading=[45.0, 90.0], spreading=8)
    np.testing.assert_allclose(low["roll_rms"][0, 1] / low["roll_rms"][0, 0], 2.0, rtol=1e-3)
    assert (low["recommended"] == int(Advice.RECOMMENDED)).all()


def test_danger_lines_do_not_hang_on_the_sea(found):
    """U cos mu = g/(4 w2) and half of it: closed form."""
    w2 = found.attrs["roll_frequency"]
    np.testing.assert_allclose(found["pile_up"], [9.80665 / (4 * w2), 9.80665 / (8 * w2)], rtol=1e-3)


def test_seas_that_break_are_not_computed_and_the_rest_is():
    """Hs over g Tz^2/(2 pi) above 0.1: Tz 6.22 s carries 6.04 m."""
    with pytest.warns(qt.RangeWarning, match="2 of 4 conditions are of seas that break"):
        steep = qt.guidance(SHIP, [6.0, 6.1], tz=6.22, speed=5.0, heading=[60.0, 90.0])
    assert (steep["status"].values[0, 1] == 5).all()
    assert (steep["recommended"].values[0, 1] == int(Advice.NOT_VALID)).all()
    assert np.isfinite(steep["roll_rms"].values[0, 0]).all()
    assert np.isnan(steep["roll_rms"].values[0, 1]).all()


def estimates(lower, upper, rate=(1e-9, 1e-11, 1e-7)):
    return Judged(Estimate(lower, lower, upper), Estimate(0.0, 0.0, 0.0), Estimate(*rate))


@pytest.mark.parametrize(
    ("lower", "upper", "felt", "expected"),
    [
        (10.0, 19.9, math.inf, Advice.RECOMMENDED),
        (10.0, 20.1, math.inf, Advice.UNDECIDED),
        (20.1, 30.0, math.inf, Advice.NOT_RECOMMENDED),
        (math.nan, math.nan, math.inf, Advice.UNDECIDED),
    ],
)
def test_an_interval_that_straddles_does_not_decide(lower, upper, felt, expected):
    """Twice the mean largest of three hours against 40 deg."""
    assert advised("largest", 2.0, (math.radians(40.0), felt), estimates(lower, upper)) == expected


def test_the_worse_of_roll_and_acceleration_decides_and_rates_by_their_own():
    calm, limits = estimates(1.0, 2.0), (math.radians(40.0), 9.81)
    assert advised("largest", 2.0, limits, calm) == Advice.RECOMMENDED
    assert advised("largest", 2.0, limits, calm._replace(felt=Estimate(6.0, 5.0, 7.0))) == Advice.NOT_RECOMMENDED
    assert advised("largest", 2.0, limits, calm._replace(felt=Estimate(5.0, 4.0, 6.0))) == Advice.UNDECIDED
    for threshold, expected in ((1e-6, 0), (1e-9, 2), (1e-12, 1)):
        assert advised("rate", threshold, limits, calm) == expected


def test_crossings_of_a_gaussian_motion_are_rices():
    """theory, reference table passage: exp(-b^2/2)/pi to both sides at w0 = 1, by its own quadrature; no limit, no failure."""
    for b, rate in ((2.0, 0.0430786), (3.0, 0.0035361), (4.0, 0.000106783)):
        np.testing.assert_allclose(crossings((1.0, 1.0, 1.0), b), rate, rtol=3e-5)
    assert crossings((1.0, 1.0, 1.0), math.inf) == crossings((0.0, 0.0, 0.0), 1.0) == 0.0


def test_where_the_closure_does_not_decide_a_simulation_does():
    """The same blocks as `irregular` draws, stopped after the first row that decides."""
    given = {"hs": [5.0], "tp": 11.0, "speed": 7.5, "heading": [45.0, 120.0]}
    closed = qt.guidance(SHIP, **given)
    assert closed["recommended"].values.ravel().tolist() == [int(Advice.UNDECIDED), int(Advice.RECOMMENDED)]
    some = qt.guidance(SHIP, **given, hours=96, seed=3)
    assert some["rung"].values.ravel().tolist() == [SIMULATION, CLOSURE]
    own = some.isel(loading=0, hs=0, tz=0, speed=0, heading=0)
    alone = qt.irregular(SHIP, qt.Sea(hs=5, tp=11, heading=45), 7.5, hours=float(own["exposure"]), seed=3)
    np.testing.assert_allclose(own["roll_mean_3h_max"], alone["roll_mean_largest"], rtol=1e-6)
    np.testing.assert_allclose(own["roll_rms"], alone["roll_rms"], rtol=1e-6)
    np.testing.assert_allclose(
        own["roll_3h_max_upper"] - own["roll_mean_3h_max"], 1.96 * alone["roll_mean_largest_error"], rtol=1e-6
    )
    assert np.isnan(some["exposure"].values.ravel()[1])


def test_blocks_workers_and_an_interrupt_do_not_change_a_number(tmp_path):
    """The same bits in one block and in many, by another process' payload, and from a store filled in two goes."""
    told = SeaSettings(spreading=8)
    wanted = sea_grid(SHIP, SEAS["speed"], SEAS["heading"], SEAS["hs"], SEAS["tp"], settings=told, gm=[0.8, 1.0])
    whole = evaluated(wanted.in_blocks_of(10_000))
    assert len(wanted.in_blocks_of(6).blocks) > 8
    assert whole.identical(evaluated(wanted.in_blocks_of(6)))
    prepare_pickling()
    part = wanted.in_blocks_of(6)
    block = part.blocks[3]
    found = _one_block(pickle.dumps(part), 3)
    flat = whole["roll_rms"].transpose("loading", "speed", "heading", "tz", "hs").values.reshape(2, -1, 2)
    np.testing.assert_array_equal(found["roll_rms"], flat[block.loadings, block.points])

    def stop(done, _):
        if done > 10:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fill(part, tmp_path / "s", told=stop)
    again = qt.guidance(SHIP, **SEAS, gm=[0.8, 1.0], spreading=8, store=tmp_path / "s")
    assert set(whole.data_vars) == set(again.data_vars)
    for name in whole.data_vars:
        np.testing.assert_array_equal(again[name].values, whole[name].values, err_msg=name)
    with pytest.raises(qt.InputError, match="another case"):
        qt.guidance(SHIP, **SEAS, spreading=8, store=tmp_path / "s")


CASE = """ship: wigley
speed: [4, 6]
heading: 0..180 deg step 90
sea:
  hs: [1, 2 m]
  tp: 7..9 s count 2
  spreading: cos2
  judge: rate
loading:
  gm: [1.0, 1.2]
"""


def test_a_case_file_has_two_peaks_and_a_swell(tmp_path):
    file, beside = tmp_path / "my.yaml", "  swell: {hs: 1 m, tp: 13 s, heading: 30, spreading: 8}\n"
    file.write_text(CASE.replace("  spreading", f"{beside}  spectrum: torsethaugen\n  spreading"))
    made = case_grid(file)
    own = sea_grid(
        qt.ship("wigley"), [4, 6], [0, 90, 180], [1, 2], [7, 9], gm=[1.0, 1.2],
        settings=SeaSettings(spectrum="torsethaugen", spreading="cos2", judge="rate",
                             swell=qt.Sea(hs=1, tp=13, heading=30, spreading=8)),
    )  # fmt: skip
    assert made.described == own.described
    for old, new, words in (
        ("hs: 1 m, tp", "hs: 0, tp", "line 7: swell: hs = 0"),
        ("heading: 30", "hading: 30", "line 7: hading is unknown; did you mean heading"),
        ("  tp: 7..9 s count 2", "  tz: 7", "tz of a spectrum of two peaks"),
    ):
        file.write_text(CASE.replace("  spreading", f"{beside}  spectrum: torsethaugen\n  spreading").replace(old, new))
        with pytest.raises(qt.InputError) as refusal:
            case_grid(file)
        assert words in str(refusal.value)


def test_a_case_file_has_seas(tmp_path):
    file = tmp_path / "my.yaml"
    file.write_text(CASE)
    made = case_grid(file)
    assert made.shape == (2, 2, 3, 2, 2)
    own = qt.guidance(
        qt.ship("wigley"), [1, 2], [7, 9], speed=[4, 6], heading=[0, 90, 180], spreading="cos2", judge="rate",
        gm=[1.0, 1.2],
    )  # fmt: skip
    assert own.identical(evaluated(made))
    assert own["gm"].values.tolist() == [1.0, 1.2]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("hs: [1, 2 m]", "hz: 1", "line 5: hz is unknown; did you mean tz"),
        ("  hs: [1, 2 m]\n", "", "line 4: key `hs` is missing"),
        ("hs: [1, 2 m]", "hs: -1", "line 5: hs = -1 m; it is above 0 m"),
        ("hs: [1, 2 m]", "hs: 20", "every sea asked for breaks"),
        ("cos2", "wide", "line 7: spreading = 'wide'"),
        ("judge: rate", "judge: rat", "line 8: judge: 'rat' is given; did you mean 'rate'"),
        ("judge: rate", "threshold: 0", "threshold = 0; it is from 1 to 10"),
        ("loading:", "wave_height: 2\nloading:", "line 9: wave_height is of regular waves and sea of irregular ones"),
        ("speed: [4, 6]", "speed: [4, 6]\nharmonics: 3", "line 3: harmonics are of motions in regular waves"),
        ("  tp: 7..9 s count 2\n", "", "tp and tz are missing"),
        ("tp: 7..9 s count 2", "tp: 3 m", 'line 6: tp = 3 m; unit "m"'),
    ],
)
def test_a_mistake_in_a_sea_is_answered_with_its_line(tmp_path, old, new, words):
    assert old in CASE
    file = tmp_path / "my.yaml"
    file.write_text(CASE.replace(old, new))
    with pytest.raises(qt.InputError) as refusal:
        case_grid(file)
    assert words in str(refusal.value)


def test_a_map_in_pieces_is_the_map():
    """Piece by piece the same bits; what is not yet computed is NaN."""
    wanted = sea_grid(SHIP, [3.0, 7.5], [0.0, 60.0, 90.0], 2.0, 9.0).in_blocks_of(3)
    (done, first), (count, whole) = in_pieces(wanted)
    assert (done, count) == (3, 6)
    assert np.isfinite(first["roll_rms"]).values.ravel().tolist() == [True] * 3 + [False] * 3
    assert whole.identical(evaluated(wanted))
