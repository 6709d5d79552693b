"""Spectra, spreading and directions of a sea against closed forms and tables of an independent quadrature."""

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import trapezoid

from quartering.conventions import InputError, RangeWarning
from quartering.loads.sea.sea import Sea
from quartering.loads.sea.shape import integral
from quartering.loads.sea.spreading import directional_density, spread_deviation
from quartering.loads.sea.torsethaugen import torsethaugen

# gamma: norm I, Tz/Tp, T1/Tp, Te/Tp, share of m0 and of m2 below four peak frequencies. Adaptive quadrature of the published
# form by an independent program (quoted to 1e-6).
JONSWAP = {
    1.0: (0.2, 0.710370680986, 0.771771436688, 0.857222537055, 0.99512908905, 0.921280254074),
    2.0: (0.249124893835, 0.746436099857, 0.806295593802, 0.883539070622, 0.99608958312, 0.930223084799),
    3.3: (0.304989721934, 0.777399207609, 0.83432796339, 0.903295867628, 0.996805852395, 0.938177493986),
    5.0: (0.371685127868, 0.805285786094, 0.858344077505, 0.919193249012, 0.997379012188, 0.945566218567),
    7.0: (0.44503384714, 0.828497656569, 0.877474964021, 0.931234407372, 0.997810993037, 0.951879165705),
}


@pytest.mark.parametrize("gamma", JONSWAP)
def test_jonswap_has_the_integrals_of_its_form(gamma):
    norm, tz, t1, te, m0_share, m2_share = JONSWAP[gamma]
    sea = Sea(hs=4.0, tp=10.0, gamma=gamma)
    assert (sea.hs, sea.tp) == (4.0, 10.0)
    m = {n: sea.moment(n) for n in (-1, 0, 1, 2)}
    found = (integral(5.0, gamma), sea.tz / 10.0, 2 * np.pi * m[0] / m[1] / 10.0, 2 * np.pi * m[-1] / m[0] / 10.0)
    np.testing.assert_allclose(found, (norm, tz, t1, te), rtol=1e-6)
    sigma = np.linspace(1e-3, 4 * 2 * np.pi / 10.0, 200_001)
    for n, share in ((0, m0_share), (2, m2_share)):
        below = trapezoid(sigma**n * sea.density(sigma), sigma)
        np.testing.assert_allclose(below / m[n], share, rtol=1e-6)


def test_bretschneider_has_closed_integrals_and_no_fourth_moment():
    """Closed forms: m0 exp(-1.25 x^-4) below x; moments m0 1.25^(n/4) sigma_p^n G(1 - n/4)."""
    sea = Sea(hs=6.0, tz=8.0, spectrum="bretschneider")
    peak = 2 * np.pi / sea.tp
    sigma = np.linspace(1e-3, 1.3 * peak, 100_001)
    np.testing.assert_allclose(trapezoid(sea.density(sigma), sigma), 2.25 * np.exp(-1.25 / 1.3**4), rtol=1e-7)
    np.testing.assert_allclose(sea.tz, 8.0, rtol=1e-12)
    np.testing.assert_allclose(sea.moment(2), 2.25 * np.sqrt(1.25 * np.pi) * peak**2, rtol=1e-12)
    with pytest.raises(InputError, match=r"moment 4 .* does not exist"):
        sea.moment(4)


# sigma: S of one system of Ochi and Hubble (Hs 6, Tp 11, lambda 2), and of Torsethaugen not scaled; two independent readers of
# the forms agree to 1e-15. Gravity of this table 9.80665 m/s2.
SIGMA = [0.4, 0.5, 0.6, 0.7, 0.9, 1.2]
OCHI_HUBBLE = [0.170253434899, 5.72611288117, 8.07091326152, 4.71832425765, 0.925081489896, 0.0891476664499]
TORSETHAUGEN = {
    (4.0, 8.0): ([0.327153094317, 0.627628495633, 0.904415195244, 1.39627262295, 1.18763827456, 0.458242028456], 1.02339269),
    (4.0, 14.0): ([1.56635509177, 2.06363516137, 1.18729898372, 1.05518524224, 0.617310767553, 0.240019465981], 1.01868207),
    (6.0, 11.0): ([0.940631543673, 4.02712792662, 6.58169288864, 3.26231910859, 1.5353480757, 0.541778953906], 1.02592469),
}  # fmt: skip


def test_spectra_of_two_peaks_are_those_of_two_other_readers():
    np.testing.assert_allclose(Sea.ochi_hubble([6.0], [11.0], [2.0]).density(SIGMA), OCHI_HUBBLE, rtol=1e-10)
    for (hs, tp), (density, ratio) in TORSETHAUGEN.items():
        systems, scale = torsethaugen(hs, tp, gravity=9.80665)
        found = sum(one.density(SIGMA) for one in systems) * scale
        np.testing.assert_allclose(found, density, rtol=1e-9)
        np.testing.assert_allclose(scale, ratio, rtol=2e-6)  # the table's integral ends where the tail still holds 2e-6
        sea = Sea(hs=hs, tp=tp, spectrum="torsethaugen")
        np.testing.assert_allclose(sea.moment(0), hs**2 / 16, rtol=1e-12)
    assert len(torsethaugen(4.0, 6.6 * 4.0 ** (1 / 3))[0]) == 1  # fully grown: no second system
    assert torsethaugen(1.0, 6.5)[0][0].gamma == 1.0  # 0.96 by its formula, whose logarithm is negative


# s: density at the middle, circular standard deviation [deg]; independent quadrature, to 1e-9
COS2S = {1: (0.318309886184, 57.2957795131), 2: (0.424413181578, 46.781808074), 5: (0.646724848119, 33.0797337253),
         10: (0.903278126867, 24.4310024727), 25: (1.41754351672, 15.8909900694), 75: (2.44708761186, 9.29460277741)}  # fmt: skip


def test_spreading_is_normalised_once():
    angle = np.radians(np.arange(-180.0, 180.0, 0.5))
    for s, (norm, deviation) in COS2S.items():
        np.testing.assert_allclose(directional_density(0.0, s), norm, rtol=1e-9)
        np.testing.assert_allclose(np.degrees(spread_deviation(s)), deviation, rtol=1e-9)
    for spreading in (*COS2S, 400.0, "cos2"):
        np.testing.assert_allclose(directional_density(angle, spreading).sum() * np.radians(0.5), 1.0, rtol=1e-6)
    np.testing.assert_allclose(directional_density(0.0, "cos2"), 0.636619772368, rtol=1e-9)


def spectrum(directions, sense="sea_surface_wave_from_direction"):
    """Energy at one direction of many, 1 m2/Hz/deg between 0.08 and 0.12 Hz."""
    freq = np.arange(0.05, 0.155, 0.005)
    values = np.where((freq > 0.0799) & (freq < 0.1201), 1.0, 0.0)[:, None] * np.eye(len(directions))[0]
    efth = xr.DataArray(values, {"freq": freq, "dir": directions}, ("freq", "dir"), name="efth")
    efth["dir"].attrs["standard_name"] = sense
    return efth


# direction waves come from, course, heading they go to from the bow [deg]: by hand
DIRECTIONS = [(270, 0, 90), (90, 0, -90), (0, 0, 180), (180, 0, 0), (225, 300, 105), (10, 350, -160)]


@pytest.mark.parametrize(("comes_from", "course", "heading"), DIRECTIONS)
def test_a_direction_from_becomes_a_heading_to(comes_from, course, heading):
    around = np.remainder(comes_from + np.roll(np.arange(0, 360, 15), 5), 360.0)  # in no order
    around = np.concatenate([[comes_from % 360], around[around != comes_from % 360]])
    sea = Sea.from_spectrum(spectrum(around), course)
    assert abs(np.remainder(sea.heading - heading + 180, 360) - 180) < 1e-9
    # 9 frequencies of 1 m2/Hz/deg, 15 deg wide: 0.04 Hz between the outer ones, half a step beyond on either side
    np.testing.assert_allclose(sea.moment(0), 15.0 * 0.045, rtol=1e-9)
    np.testing.assert_allclose(sea.partitions[0].values.max(), 9.11890652781, rtol=1e-11)


def test_cells_of_a_measured_spectrum_hold_its_energy():
    sea = Sea.from_spectrum(spectrum(np.arange(0.0, 360.0, 15.0)), 40.0)
    one = sea.partitions[0]
    step = (one.band[1] - one.band[0]) / 77
    sigma = one.band[0] + step * (np.arange(77) + 0.5)
    energy = one.energy(sigma, step, np.arange(-175.0, 181.0, 5.0), 5.0)
    np.testing.assert_allclose(energy.sum(), sea.moment(0), rtol=1e-12)


def test_each_side_of_a_measured_spectrum_has_its_own_energy():
    """By hand: all of it at 60 deg, in a triangle 15 deg to either side; half of that triangle lies on one side of a ship."""
    for heading, share in ((60.0, (1.0, 0.0)), (0.0, (0.5, 0.5)), (-5.0, (2 / 9, 7 / 9))):
        sea = Sea.from_spectrum(spectrum(np.arange(0.0, 360.0, 15.0)), 180.0 - heading)
        one = sea.partitions[0]
        sigma, step = np.array([sum(one.band) / 2]), one.band[1] - one.band[0]
        sides = [one.energy(sigma, step, side * np.arange(0.5, 180.0, 1.0), 1.0).sum() for side in (1.0, -1.0)]
        np.testing.assert_allclose(sides, np.array(share) * sea.moment(0), rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(one.deviation, np.radians(15.0 / np.sqrt(6.0)), rtol=1e-6)  # of a triangle


def test_bad_spectra_are_refused():
    good = spectrum(np.arange(0.0, 360.0, 15.0))
    half, gap, hole, one = (
        good.isel(dir=slice(0, 12)),
        good.isel(freq=[0, 1, 2, 10, 11, 12]),
        good.copy(),
        good.isel(freq=[4]),
    )
    hole[3, 4] = np.nan
    for given, words in (
        (spectrum(np.arange(0.0, 360.0, 15.0), ""), "the sense of the directions is not said"),
        (spectrum(np.arange(0.0, 360.0, 15.0), "sea_surface_wave_to_direction"), "go to"),
        (half, "evenly round the circle"),
        (gap, "gap between 0.06 and 0.1 Hz"),
        (hole, "1 of 504 values are no numbers"),
        (one, "1 frequencies and 24 directions is no sea"),
        (good * 0.0, "holds no energy"),
        (good.to_dataset().assign(hs=9.0), "states hs 9 m"),
        (good.expand_dims(time=[0, 1]), "2 values of time"),
        (3.0, "no spectrum found"),
    ):
        if isinstance(given, xr.DataArray):
            given["dir"].attrs = (
                dict(given["dir"].attrs or good["dir"].attrs)
                if words != "the sense of the directions is not said"
                else {}
            )
        with pytest.raises(InputError, match=words):
            Sea.from_spectrum(given, 0.0)
    negative = good.copy()
    negative[3, 4] = -0.1
    with pytest.warns(RangeWarning, match="negative energy"):
        sea = Sea.from_spectrum(negative, 0.0)
    np.testing.assert_allclose(sea.moment(0), 15.0 * 0.045 - 15.0 * 0.005 * 0.1, rtol=1e-12)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"hs": 0, "tp": 11}, "hs = 0 m; it is above 0 m"),
        ({"hs": 6}, "tp and tz are missing"),
        ({"hs": 6, "tp": 11, "tz": 8}, "both given"),
        ({"hs": 6, "tz": 8, "spectrum": "torsethaugen"}, "several peak periods have the same mean"),
        ({"hs": 12, "tp": 8}, "above 0.1 it breaks"),
        ({"hs": 6, "tp": 11, "spectrum": "jonswop"}, "allowed: jonswap, bretschneider"),
        ({"hs": 6, "tp": 11, "spreading": 0}, "spreading = 0"),
        ({"hs": 6, "tp": 11, "cut": (2, 1)}, "cut = "),
        ({"hs": 6, "tp": 11, "gamma": 0.5}, "gamma = 0.5; it is from 1 to 20"),
    ],
)
def test_a_sea_that_cannot_be_is_refused(given, words):
    with pytest.raises(InputError, match=words):
        Sea(**given)


def test_units_sums_and_turns():
    sea = Sea(hs="600 cm", tp="11 s", heading="45 deg", spreading=10)
    assert sea == Sea(hs=6, tp=11, heading=45, spreading=10.0)
    both = sea + Sea(hs=2, tp=16, heading=-150, spectrum="bretschneider")
    assert [one.heading for one in both.turned_to(90).partitions] == [90.0, -105.0]
    np.testing.assert_allclose(both.hs, np.sqrt(40.0), rtol=1e-12)
    fully_grown = Sea(hs=6, spectrum="pierson-moskowitz")
    np.testing.assert_allclose(fully_grown.tp, 2 * np.pi / (0.4 * np.sqrt(9.81 / 6)), rtol=1e-12)  # its own definition
