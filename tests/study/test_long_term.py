"""The long-term sum against a closed form summed apart, and its refusals."""

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering.study.criteria.sea_states import scatter

TABLE = scatter()


def rates(hs, tz, heading=(0.0, 90.0, 180.0), speed=(5.0,), by=lambda mu, u: 1.0 + 0.0 * mu * u):
    """A map whose rate is exp(-2 - (0.02 (tz - 9)^2 + 1) 60/hs^2) times a factor of heading and speed."""
    h, t, mu, u = np.meshgrid(hs, tz, heading, speed, indexing="ij")
    rate = np.exp(-2.0 - (0.02 * (t - 9.0) ** 2 + 1.0) * 60.0 / h**2) * by(mu, u)
    dims = ("hs", "tz", "heading", "speed")
    data = {
        name: (dims, factor * rate)
        for name, factor in (("failure_rate", 1.0), ("rate_lower", 0.5), ("rate_upper", 2.0))
    }
    return xr.Dataset(data, dict(zip(dims, (hs, tz, list(heading), list(speed)), strict=True)))


def test_the_table_of_the_north_atlantic_is_summed():
    """theory, reference table long_term_sum: 0.00639509731801 1/s, to 1e-9; a year of 365.25 days."""
    life = qt.long_term(rates(TABLE.hs, TABLE.tz))
    np.testing.assert_allclose(life["failure_rate"], 0.00639509731801, rtol=1e-9)
    np.testing.assert_allclose(life["failures_a_year"], 201813.923123, rtol=1e-9)
    np.testing.assert_allclose(life["rate_lower"], 0.5 * life["failure_rate"], rtol=1e-12)
    np.testing.assert_allclose(life["rate_upper"], 2.0 * life["failure_rate"], rtol=1e-12)
    np.testing.assert_allclose(life["contribution"].sum(), life["failure_rate"], rtol=1e-12)
    assert float(life["not_covered"]) == 0.0
    assert "unverified" in life.attrs["table"]


def test_headings_round_the_ship_and_speeds_are_weighted():
    """Mean of sin mu over all headings is 2/pi; of 0, 90, 180 by trapezia 1/2. Speeds 1 and 3 with weights 3 and 1: 1.5."""
    plain = float(qt.long_term(rates(TABLE.hs, TABLE.tz))["failure_rate"])
    fine = rates(TABLE.hs, TABLE.tz, np.linspace(0, 180, 181), by=lambda mu, _: np.sin(np.radians(mu)))
    np.testing.assert_allclose(qt.long_term(fine)["failure_rate"], plain * 2 / np.pi, rtol=1e-4)
    coarse = rates(TABLE.hs, TABLE.tz, by=lambda mu, _: np.sin(np.radians(mu)))
    np.testing.assert_allclose(qt.long_term(coarse)["failure_rate"], plain / 2, rtol=1e-12)
    fast = rates(TABLE.hs, TABLE.tz, speed=(1.0, 3.0), by=lambda _, u: u)
    np.testing.assert_allclose(qt.long_term(fast, speed_weight=[3, 1])["failure_rate"], 1.5 * plain, rtol=1e-12)


def test_seas_beyond_the_map_are_not_counted_and_said():
    """Of Hs up to 9.5 m and all periods the table has 1 - 0.0033 or so of its weight: summed here from its counts."""
    low = TABLE.hs < 9.0
    with pytest.warns(qt.RangeWarning, match="of the time is spent in seas that the map does not hold"):
        life = qt.long_term(rates(TABLE.hs[low], TABLE.tz))
    beyond = TABLE.weight[TABLE.hs > 9.0].sum()
    np.testing.assert_allclose(life["not_covered"], beyond, rtol=1e-9)
    np.testing.assert_allclose(life["weight"].sum(), 1.0 - beyond, rtol=1e-9)


def test_conditions_without_an_answer_are_not_counted_and_said():
    some = rates([3.0, 4.0], [8.0, 9.0])
    some["failure_rate"][0, 0, 0, 0] = np.nan
    table = xr.DataArray(np.ones((2, 2)), {"hs": [3.0, 4.0], "tz": [8.0, 9.0]}, ("hs", "tz"))
    with pytest.warns(qt.RangeWarning, match="6.25% of the time"):  # a quarter of the seas, a quarter of the headings
        life = qt.long_term(some, table)
    np.testing.assert_allclose(life["not_covered"], 1 / 16, rtol=1e-12)
    assert np.isfinite(life["failure_rate"])


def test_a_map_over_peak_periods_takes_the_mean_period_of_each_height():
    """Two heights whose seas of one peak period have other mean periods: 8 and 9 s at 3 m, 9 and 10 s at 4 m."""
    tz = xr.DataArray([[8.0, 9.0], [9.0, 10.0]], dims=("hs", "tp"))
    one = rates([3.0, 4.0], [11.0, 12.0]).rename(tz="tp").assign_coords(tz=tz)
    table = xr.DataArray([[4.0, 0, 0], [0, 1, 3]], {"hs": [3.0, 4.0], "tz": [8.0, 9.0, 10.0]}, ("hs", "tz"))
    life = qt.long_term(one, table)
    np.testing.assert_allclose(life["weight"], [[0.5, 0.0], [0.125, 0.375]], rtol=1e-12)
    mean = one["failure_rate"].isel(heading=0, speed=0).values
    np.testing.assert_allclose(life["failure_rate"], (life["weight"].values * mean).sum(), rtol=1e-12)


def test_headings_all_round_count_alike():
    """Mean of 1 + sin mu over 0, 90, 180, 270 deg is 1: both ends of an axis that goes round count as the others."""
    plain = float(qt.long_term(rates(TABLE.hs, TABLE.tz))["failure_rate"])
    way = rates(TABLE.hs, TABLE.tz, (0.0, 90.0, 180.0, 270.0), by=lambda mu, _: 1.0 + np.sin(np.radians(mu)))
    np.testing.assert_allclose(qt.long_term(way)["failure_rate"], plain, rtol=1e-12)


SOME = rates([3.0, 4.0], [8.0, 9.0])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: qt.long_term(3.0), "found is no map over seas"),
        (lambda: qt.long_term(SOME, np.ones((2, 2))), "occurrence is no table"),
        (
            lambda: qt.long_term(SOME, xr.DataArray([[-1.0]], {"hs": [3], "tz": [8]}, ("hs", "tz"))),
            "below 0 or none above",
        ),
        (lambda: qt.long_term(SOME, speed_weight=[1, 2]), "speed_weight = .* give 1 numbers"),
        (lambda: qt.long_term(SOME, heading_weight=[1, -2, 1]), "heading_weight = .* none below 0"),
    ],
)
def test_what_cannot_be_is_refused(call, words):
    with pytest.raises(qt.InputError, match=words):
        call()
