"""Direct assessment: counting against closed forms, the sum against its parts, the same bytes after an interrupt."""

import math

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering._machine import threads
from quartering.motion.sea.march import NONE, ROLL
from quartering.motion.sea.synthesis import RECORDS, Record
from quartering.motion.transient.rk4 import alike
from quartering.study.seas.failure_rates.assessed import Wanted, _carried_down, counted
from quartering.study.seas.failure_rates.assessment_grid import Assessed, tasks_of
from quartering.study.seas.response import SeaStatus
from quartering.study.seas.simulated.blocks import BLOCK, Plan, Row
from quartering.study.seas.simulated.failures import weighted_rate
from quartering.view.stored import opened

pytestmark = pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
SHIP = qt.ship("series60-cb60").with_(openings="12 deg")
TABLE = xr.DataArray([[80.0], [20.0]], {"hs": [3.5, 4.5], "tz": [8.5]}, ("hs", "tz"))
GIVEN = {"speed": 7.5, "heading": [60.0, 120.0], "occurrence": TABLE, "spreading": None, "hours": 64, "seed": 2}


def test_a_sum_of_counts_alike_has_the_interval_of_one_count():
    """Gamma quantiles: theory_seas, reference table rates: k = 0, 1, 10, to 1e-6."""
    for parts, lower, upper in (
        ([0, 0, 0], 0.0, 3.68887945411),
        ([0, 1, 0], 0.0253178079843, 5.57164339094),
        ([3, 5, 2], 4.79538869613, 18.390356042),
    ):
        found = weighted_rate(np.full(3, 0.5), parts, np.full(3, 0.5))
        np.testing.assert_allclose(found, (sum(parts), lower, upper), rtol=1e-6)
    assert weighted_rate([], [], []) == (0.0, 0.0, 0.0)


def test_the_interval_of_a_weighted_sum_holds_the_truth_as_often_as_it_says():
    """Poisson counts of known rates, weights over two decades: 95 % at least, within three standard errors of 3,000 draws."""
    rng = np.random.default_rng(1)
    weight, exposure, rate = 10 ** rng.uniform(-2, 0, 12), 10 ** rng.uniform(3, 5, 12), 10 ** rng.uniform(-5, -3, 12)
    truth = float(weight @ rate)
    found = [weighted_rate(weight, rng.poisson(rate * exposure), exposure) for _ in range(3000)]
    inside = np.mean([one.lower <= truth <= one.upper for one in found])
    assert inside > 0.95 - 3 * math.sqrt(0.95 * 0.05 / 3000)
    values = np.array([one.rate for one in found])
    assert abs(values.mean() - truth) < 3 * values.std() / math.sqrt(3000)


def oscillator(c, d, limit):
    """The plan of x'' + c x' + x = w below a limit, w white noise of <w w'> = 2 D delta up to 8 times the frequency."""
    terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -c, "N_r": -1.0}
    equations = alike(qt.Model(np.eye(3), terms, 1.0, (0, 0, 0), (0, 0, 0)).system)
    step, first = 0.1, 1000
    samples = 2 * (first + round(BLOCK / step) + 2)
    spacing = 2 * np.pi / (samples * step / 2)
    roots = np.zeros((int(8.0 / spacing), 3, 3), dtype=np.complex64)
    roots[:, 1, 1] = np.sqrt(2 * d / np.pi * spacing)  # one-sided density 2 D/pi
    record = Record(samples, step / 2, roots, 0.0)
    return Plan(equations, record, step, first, 0.0, (0.0, 0.0), (limit, np.inf), 3, 7)


def test_failures_are_counted_at_the_rate_of_the_backward_equation_until_it_is_known():
    """theory_seas, reference table passage: c 0.1, D 0.1, three deviations: 1.81e-3 1/s to 2 %; first passages of a linear,
    lightly damped oscillator, where crossings counted as independent would give twice as many."""
    plan = oscillator(0.1, 0.1, 3.0)
    found = counted(plan, 512.0, Wanted(1.0, 0.1, 0.0))
    assert found.enough
    assert found.failures >= 384  # 1.96 standard deviations of a count within a tenth of it
    assert abs(found.rate.rate - 1.81e-3) < 3 * math.hypot(found.rate.rate / math.sqrt(found.failures), 0.02 * 1.81e-3)
    assert found.waiting_time_p > 0.01
    short = counted(plan, 32.0, Wanted(1.0, 0.01, 0.0))
    assert not short.enough
    assert short.failures < found.failures
    assert counted(plan, 512.0, Wanted(1e-6, 0.01, 1e-8)).failures == short.failures  # its contribution does not matter


class Exponential:
    """Blocks whose failures come at a known rate."""

    first, step = 0, 1.0

    def __init__(self, rate, seed):
        self.rate, self.seed = rate, seed

    def row(self, number):
        times = np.random.default_rng([self.seed, number]).exponential(1.0 / self.rate, RECORDS)
        failed = times < BLOCK
        return Row(
            np.zeros((16, RECORDS)),
            np.zeros((2, RECORDS)),
            np.where(failed, times, BLOCK),
            np.where(failed, ROLL, NONE),
        )


@pytest.mark.soak
def test_ending_a_count_where_it_is_known_well_enough_shifts_it_by_a_failure_at_most():
    """A rate of 1e-4 1/s: mean of 300 adaptive counts within three standard errors and one failure; its interval holds."""
    rate, wanted = 1e-4, Wanted(1.0, 0.3, 0.0)
    found = [counted(Exponential(rate, seed), 5000.0, wanted) for seed in range(300)]
    assert all(one.enough for one in found)
    values, k = np.array([one.rate.rate for one in found]), np.array([one.failures for one in found])
    assert 43 <= k.min() <= k.max() < 120  # half width 0.3 of the count: 43 failures
    assert abs(values.mean() - rate) < 3 * values.std() / math.sqrt(300) + rate / k.mean()
    inside = np.mean([one.rate.lower <= rate <= one.rate.upper for one in found])
    assert inside > 0.95 - 3 * math.sqrt(0.95 * 0.05 / 300)


def test_cells_are_left_out_from_the_least_as_long_as_all_together_cannot_matter():
    """By hand: upper ends times weights 1, 2, 3, 40 of a level of 100 and a share of 5 %: the first two, 3, are below 5."""
    upper = np.array([[[1.0, 4.0, 3.0, 80.0, 9.0, 9.0]]])
    weight = np.array([[1.0, 0.5, 1.0, 0.5, 0.0, 1.0]])
    status = np.full(upper.shape, int(SeaStatus.ANSWERED), dtype=np.int8)
    status[0, 0, 5] = SeaStatus.PAST_CAPSIZE_LIMIT  # never left out by its closure
    found = tasks_of(status, 0.01 * upper, upper, weight, 0.05, 100.0, 0.0)
    unknown = Assessed.NOT_KNOWN
    assert found.task[0, 0].tolist() == [
        Assessed.EXCLUDED,
        Assessed.EXCLUDED,
        unknown,
        unknown,
        Assessed.NEVER_MET,
        unknown,
    ]
    assert found.scale.tolist() == [100.0]
    status[0, 0, :2] = SeaStatus.SURF_RIDING, SeaStatus.BREAKS
    more = tasks_of(status, 10.0 * upper, upper, weight, 0.05, 100.0, 3.5)
    assert more.task[0, 0, :3].tolist() == [Assessed.SURF_RIDING, Assessed.BREAKS, Assessed.EXCLUDED]
    assert tasks_of(status, upper, upper, weight, 1e-9, 1.0, 3.5).task[0, 0, 2] == Assessed.TOO_RARE
    assert more.scale[0] == pytest.approx(10 + 20 + 30 + 400 + 90, rel=0.05)  # two digits


def test_rates_too_rare_to_count_are_carried_down_a_line_of_higher_seas():
    """ln r = a - b/Hs^2, exact for a linear ship: counts put on it, and the line's own value two heights below."""
    a, b = math.log(1e-2), 150.0
    line = [(hs, 400, 400 / math.exp(a - b / hs**2)) for hs in (8.0, 7.0, 6.0)]
    known = Wanted(1e-6, 0.2, 1e-9)
    found = _carried_down(5.0, line, 1.0, 100.0, known)
    assert found["status"] == Assessed.EXTRAPOLATED
    np.testing.assert_allclose(found["failure_rate"], math.exp(a - b / 25.0), rtol=1e-9)
    assert found["rate_lower"] < found["failure_rate"] < found["rate_upper"]
    assert _carried_down(5.0, line, 1.0, 1e4, known) is None  # 30 failures and more in the hours there are: counted
    assert _carried_down(5.0, line, 1.0, 100.0, Wanted(1.0, 1e-3, 0.0)) is None  # not known well enough
    assert _carried_down(5.0, line[:2], 1.0, 100.0, known) is None
    far = _carried_down(3.0, line, 1e-4, 100.0, known)  # more than two decades down
    assert (far["status"], far["rate_lower"], far["rate_upper"]) == (Assessed.BELOW_HIGHER_SEA, 0.0, 1e-4)


@pytest.fixture(scope="module")
def found():
    return qt.direct_assessment(SHIP, **GIVEN)


def test_a_cell_is_the_simulation_of_its_sea_and_the_sum_that_of_cells_by_their_weights(found, tmp_path):
    """Half of the time at each heading, 0.8 and 0.2 of it in the two seas; the same blocks as `irregular` with the seed."""
    np.testing.assert_allclose(found["weight"].sum(), 1.0, rtol=1e-12)
    np.testing.assert_allclose(found["weight"][:, 0, 0, 0], [0.4, 0.1], rtol=1e-12)
    cell = found.isel(loading=0, tz=0, speed=0).sel(hs=4.5, heading=60.0)
    sea = qt.Sea(hs=4.5, tz=8.5, spectrum="bretschneider", heading=60)
    alone = qt.irregular(SHIP, sea, 7.5, hours=32, seed=2)
    if float(cell["exposure"]) > float(alone["exposure"]) * (1 + 1e-9):
        alone = qt.irregular(SHIP, sea, 7.5, hours=64, seed=2)
    for name in ("failures", "exposure", "failure_rate", "rate_lower", "rate_upper"):
        np.testing.assert_allclose(cell[name], alone[name], rtol=1e-9)
    assert int(cell["failures"]) > 0
    own = (found["weight"] * found["failure_rate"]).sum(("hs", "tz", "speed", "heading"))
    np.testing.assert_allclose(found["long_term_rate"], own, rtol=1e-12)
    np.testing.assert_allclose(found["failures_a_year"], own * 365.25 * 86400, rtol=1e-12)
    assert float(found["long_term_lower"][0]) < float(own[0]) < float(found["long_term_upper"][0])
    np.testing.assert_allclose(found["hours_spent"], found["exposure"].sum(), rtol=1e-12)
    np.testing.assert_allclose(qt.long_term(found, TABLE)["failure_rate"], own, rtol=1e-12)
    found.to_netcdf(tmp_path / "a.nc")
    xr.testing.assert_equal(xr.load_dataset(tmp_path / "a.nc"), found)
    with pytest.raises(qt.InputError, match="run the same `quartering assess` again"):
        opened(str(tmp_path / "a.nc"))


def test_threads_an_interrupt_and_a_store_do_not_change_a_number(found, monkeypatch, tmp_path):
    monkeypatch.setattr(threads, "_WORKERS", 1)
    given = GIVEN | {"store": tmp_path / "s"}

    def stop(done, total):
        if done > total / 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        qt.direct_assessment(SHIP, **given, progress=stop)
    assert len(list((tmp_path / "s" / "simulation" / "blocks").glob("*.nc"))) < 2 == found["status"].size // 2
    again = qt.direct_assessment(SHIP, **given)
    assert set(found.data_vars) == set(again.data_vars)
    for name in found.data_vars:
        np.testing.assert_array_equal(again[name].values, found[name].values, err_msg=name)
    with pytest.raises(qt.InputError, match="another case"):
        qt.direct_assessment(SHIP, **given | {"hours": 96})


@pytest.mark.soak
def test_the_sum_is_that_of_a_count_apart():
    """Another seed and a fixed number of hours in every cell, by `irregular`: within three combined standard errors."""
    table = xr.DataArray([[60.0], [30.0], [10.0]], {"hs": [2.5, 3.5, 4.5], "tz": [8.5]}, ("hs", "tz"))
    given = {"speed": 7.5, "heading": [0.0, 60.0, 120.0, 180.0], "spreading": "cos2"}
    adaptive = qt.direct_assessment(SHIP, occurrence=table, **given, hours=512, precision=0.1)
    rate, variance = 0.0, 0.0
    for i, hs in enumerate(table["hs"].values):
        for j, heading in enumerate(given["heading"]):
            sea = qt.Sea(hs=hs, tz=8.5, spectrum="bretschneider", heading=heading, spreading="cos2")
            one = qt.irregular(SHIP, sea, 7.5, hours=512, seed=11)
            each = float(adaptive["weight"][i, 0, 0, j]) / (3600.0 * float(one["exposure"]))
            rate, variance = rate + each * int(one["failures"]), variance + each**2 * int(one["failures"])
    error = (adaptive["long_term_upper"] - adaptive["long_term_lower"])[0] / (2 * 1.96)
    assert abs(float(adaptive["long_term_rate"][0]) - rate) < 3 * math.hypot(float(error), math.sqrt(variance))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"hours": 0}, "hours = 0; it is above 0"),
        ({"precision": 0}, "precision = 0; it is above 0"),
        ({"precision": 2}, "precision = 2; it is above 0 and at most 1"),
        ({"share": 0.9}, "share = 0.9; it is from 0 to 0.5"),
        ({"seed": -1}, "seed = -1; it is a whole number"),
        ({"occurrence": [1, 2]}, "occurrence is no table"),
        ({"occurrence": -TABLE}, "occurrence has values below 0"),
        ({"heading_weight": [1.0]}, "heading_weight = .* give 2 numbers"),
        ({"spectrum": "torsethaugen"}, "tz of a spectrum of two peaks"),
        ({"spectrum": "foo"}, "spectrum = 'foo'; allowed in maps"),
        ({"speed": -1}, "speed"),
        ({"occurrence": TABLE.assign_coords(hs=[20.0, 25.0])}, "every sea asked for breaks"),
        ({"cluster": "cloud"}, "local:4"),
    ],
)
def test_what_cannot_be_is_refused(change, words):
    with pytest.raises(qt.InputError, match=words):
        qt.direct_assessment(SHIP, **GIVEN | change)


def test_a_folder_of_another_study_is_refused(tmp_path):
    (tmp_path / "s").mkdir()
    (tmp_path / "s" / "case.json").write_text("{}")
    with pytest.raises(qt.InputError, match="holds a sweep; give a new or empty folder"):
        qt.direct_assessment(SHIP, **GIVEN, store=tmp_path / "s")
