"""The response to seas against limits, an independent program's three seas, and simulation of the same equations."""

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering.loads.sea.cells import Cells, pile_up_cosine
from quartering.loads.sea.encounter import wave_frequencies_met
from quartering.loads.waves import encounter_frequency
from quartering.study.seas.extremes import rice_largest
from tests.study.sea_cases import CASES, MODEL, TERMS, force, matrix
from tests.study.sea_simulation import frozen, simulated

SHIP = qt.ship("series60-cb60")
STEEP = pytest.mark.filterwarnings("ignore:sea of .* steepness:quartering.conventions.RangeWarning")


@STEEP
@pytest.mark.parametrize("name", CASES)
def test_three_seas_of_an_independent_program(name):
    """Covariances to 1e-3 of the deviations, the program's own bound; the simulated closure error is what its paper says."""
    sea, speed, linear, closed, (roll, error), period, (growth, frequency, *slow), largest = CASES[name]
    found = {
        how: qt.sea_response(MODEL, qt.Sea(**sea), speed, method=how, force=force) for how in ("linear", "closure")
    }
    for how, entries in (("linear", linear), ("closure", closed)):
        expected = matrix(entries)
        deviation = np.sqrt(np.diag(expected))
        np.testing.assert_array_less(
            np.abs(found[how]["covariance"].values - expected), 1e-3 * np.outer(deviation, deviation)
        )
    at = found["linear"]
    np.testing.assert_allclose(at["roll_period"], period, rtol=1e-4)
    ratios = [float(at[f"roll_mean_largest{kind}"] / at["roll_rms"]) for kind in ("", "_bound")]
    np.testing.assert_allclose(ratios, largest, rtol=2e-3)
    at = found["closure"]
    pair = at["exponent_frequency"].values > 0
    np.testing.assert_allclose(at["exponent"].values[pair], growth, rtol=1e-3)
    np.testing.assert_allclose(at["exponent_frequency"].values[pair], frequency, rtol=1e-4)
    np.testing.assert_allclose(
        np.sort(at["exponent"].values[at["exponent_frequency"].values == 0])[::-1], slow, rtol=1e-3
    )
    np.testing.assert_allclose(at["k2"] / 2 / at["n2"], growth, rtol=0.023)  # first order: its own measured error
    np.testing.assert_allclose(at["slow"], slow, rtol=0.011)
    np.testing.assert_allclose(at["roll_rms"], roll, rtol=0.03 + 3 * error / roll)


@pytest.mark.parametrize(
    ("tp", "speed", "heading"), [(10.0, 7.5, 60.0), (6.0, 15.0, 20.0), (9.0, 0.0, 90.0), (8.0, 8.0, 150.0)]
)
def test_a_narrow_low_sea_is_a_regular_wave(tp, speed, heading):
    """Linear response to a wave so low that nothing is nonlinear, by harmonic balance; one of the waves is overtaken."""
    sea = qt.Sea(hs=1e-3, tp=tp, gamma=20, cut=(0.9999, 1.0001), heading=heading)
    found = qt.sea_response(SHIP, sea, speed)
    wave = qt.Wave(period=f"{tp} s", height=1e-4)
    motion = qt.steady_motion(qt.equations(SHIP, wave, speed, heading))
    per_metre = np.degrees(motion.amplitude[1]) / wave.amplitude
    energy = sea.moment(0) * (1 - float(found["cut_off"]))
    np.testing.assert_allclose(found["roll_rms"], per_metre * np.sqrt(energy), rtol=1e-3)
    assert bool(found["overtaken"] == 1) == (tp == 6.0)


# name: mean largest |roll| over RMS in half an hour by Vanmarcke and by Rice, and of 1,920 records with its standard error
# (theory of seas, table largest_linear)
HALF_HOURS = {
    "long_quartering": (2.59014, 3.47597, 2.847, 0.0104),
    "short_quartering": (3.12055, 3.5274, 3.2577, 0.0095),
    "long_beam": (3.32568, 3.58669, 3.4266, 0.0084),
}


@STEEP
@pytest.mark.parametrize("name", CASES)
def test_largest_rolls_of_half_an_hour(name):
    """Both formulas to 2e-3; records of the linear ship within three combined standard errors of the program's own."""
    sea, speed = qt.Sea(**CASES[name][0]), CASES[name][1]
    groups, independent, records, error = HALF_HOURS[name]
    found = qt.sea_response(MODEL, sea, speed, force=force, hours=0.5)
    ratios = [float(found[f"roll_mean_largest{kind}"] / found["roll_rms"]) for kind in ("", "_bound")]
    np.testing.assert_allclose(ratios, [groups, independent], rtol=2e-3)
    linear = {key: value for key, value in TERMS.items() if len(key) == 3 or key in ("Y_phi", "K_phi", "N_phi")}
    drawn = qt.irregular(qt.Model(np.eye(3), linear, 1.0, (0, 0, 0), (0, 0, 0)), sea, speed, force=force, limit=1.5)
    largest, rms = drawn["roll_largest"].values, float(found["roll_rms"])
    own = np.std(largest) / np.sqrt(largest.size) / rms
    assert abs(np.mean(largest) / rms - records) < 3 * np.hypot(own, error)


@pytest.mark.parametrize(
    ("swings", "likeliest", "mean", "of_both_signs"),
    [(1800 / 13.5, 3.12821107294, 3.31273048402, 3.34245402033), (800.0, 3.65639487136, 3.81425956738, 3.84129116528)],
)
def test_largest_of_independent_swings(swings, likeliest, mean, of_both_signs):
    """Theory of seas, table extremes_gaussian, to 1e-9."""
    np.testing.assert_allclose(rice_largest(swings), (likeliest, mean), rtol=1e-9)
    np.testing.assert_allclose(rice_largest(2 * swings)[0], of_both_signs, rtol=1e-9)


def efth(hs, tp, heading, spreading=None, directions=120):
    """A long-crested or cos^2s sea as another program's energies by frequency and direction, of a ship that heads north."""
    freq, of = np.linspace(0.04, 0.4, 300), np.arange(0.0, 360.0, 360.0 / directions)
    apart = np.remainder(of + 180.0 - heading + 180.0, 360.0) - 180.0
    share = np.cos(np.radians(apart) / 2) ** (2 * spreading) if spreading else np.where(np.abs(apart) < 1e-9, 1.0, 0.0)
    density = 2 * np.pi * qt.Sea(hs=hs, tp=tp).density(2 * np.pi * freq)
    values = density[:, None] * share / share.sum() * directions / 360.0
    data = xr.DataArray(values, {"freq": freq, "dir": of}, ("freq", "dir"), name="efth")
    data["dir"].attrs["standard_name"] = "sea_surface_wave_from_direction"
    return data


@pytest.mark.parametrize("heading", [0.0, 60.0, -150.0])
def test_a_sea_by_its_energies_is_the_sea_itself(heading):
    """Two ways into one sea, by formula and by a table of 3 deg: 0.5 % of roll, of which straight lines make a part."""
    given = qt.Sea(hs=3, tp=9, heading=heading, spreading=10, cut=(0.36, 3.6))
    read = qt.Sea.from_spectrum(efth(3, 9, heading, 10), 0.0)
    one, other = (qt.sea_response(SHIP, sea, 7.5) for sea in (given, read))
    np.testing.assert_allclose(other["roll_rms"], one["roll_rms"], rtol=5e-3)
    np.testing.assert_allclose(other["cut_off"], 0.0, atol=1e-9)  # all the energy of the table, once


def test_energies_at_a_single_direction_are_a_long_crested_sea():
    """The limit of narrow directions: within 1 % of roll at 2 deg from one direction to the next."""
    read = qt.Sea.from_spectrum(efth(3, 9, 60.0, directions=180), 0.0)
    given = qt.Sea(hs=3, tp=9, heading=60.0, cut=(0.36, 3.6))
    one, other = (qt.sea_response(SHIP, sea, 7.5) for sea in (given, read))
    np.testing.assert_allclose(other["roll_rms"], one["roll_rms"], rtol=0.01)


@pytest.mark.parametrize("damping", [0.05, 0.2])
def test_wind_sea_and_swell_together_have_the_covariance_of_both(damping):
    """A linear ship's covariances add up: two independent seas, a short one and a long, narrow one, to 1e-3."""
    ship = qt.ship("box").with_(roll_damping=damping)
    wind, swell = qt.Sea(hs=0.5, tp=4, heading=60), qt.Sea(hs=2, tp=20, gamma=10, heading=80)
    one, other, both = (qt.sea_response(ship, sea, 5.0) for sea in (wind, swell, wind + swell))
    expected = one["covariance"].values + other["covariance"].values
    deviation = np.sqrt(np.diag(expected))
    np.testing.assert_allclose(
        both["covariance"] / np.outer(deviation, deviation), expected / np.outer(deviation, deviation), atol=1e-3
    )


def test_low_seas_are_linear_and_sides_are_alike():
    sea = qt.Sea(hs=0.002, tp=9, spreading=8)
    both = qt.Sea(hs=3, tp=9, spreading="cos2") + qt.Sea(hs=1, tp=13, heading=40)
    linear, closed = (qt.sea_response(SHIP, sea, 7.5, [60.0], how) for how in ("linear", "closure"))
    np.testing.assert_allclose(closed["covariance"], linear["covariance"], rtol=2e-3, atol=1e-12)
    right, left = (
        qt.sea_response(SHIP, one, 7.5, method="closure") for one in (both.turned_to(30), mirrored(both.turned_to(30)))
    )
    np.testing.assert_allclose(right["covariance"], left["covariance"], rtol=1e-9, atol=1e-15)


def mirrored(sea):
    """The sea on the other side of the ship."""
    first, second = sea.partitions
    return qt.Sea(hs=3, tp=9, spreading="cos2", heading=-first.heading) + qt.Sea(hs=1, tp=13, heading=-second.heading)


# encounter frequency: all wave frequencies that give it, by an independent program; speed 7.5 m/s and 30 deg but for the last
# three: 45 deg; 10 m/s following; 120 deg
MET = [
    (7.5, 30.0, 0.3, [0.412853383317, 1.09749492088, 1.76680278518]),
    (7.5, 30.0, 0.36, [0.592193753009, 0.918154551191, 1.8106424792]),
    (7.5, 45.0, 0.465, [2.23469907981]),
    (10.0, 0.0, 0.2, [0.279810061939, 0.701189938061, 1.15140108942]),
    (7.5, 120.0, 0.9, [0.708249984501]),
]
# wave energy [m2] by |encounter frequency| of a Bretschneider sea of 6 m, 11 s at 7.5 m/s, 45 deg: closed form by the
# cumulative spectrum at the roots
EDGES = [0.0, 0.1, 0.2, 0.3, 0.35, 0.4, 0.44, 0.46, 0.48, 0.5, 0.6, 0.8, 1.2, 2.4, 5.0]
ENERGY = [
    0.011325938728, 0.0140551703745, 0.0253701186982, 0.159332980152, 0.613383109366, 0.716864311342, 0.49563598528,
    0.202282137827,
    0.000286531067748, 0.00127247000892, 0.00193817280822, 0.00244404537801, 0.00304632348938, 0.00170719112428,
]  # fmt: skip


def test_waves_are_met_three_to_a_frequency():
    for speed, heading, omega, expected in MET:
        found = wave_frequencies_met([omega], speed, heading)[0]
        np.testing.assert_allclose(found[np.isfinite(found)], expected, rtol=1e-9)
    assert wave_frequencies_met([0.5], 0.0, 30.0)[0, 0] == 0.5
    sea = qt.Sea(hs=6, tp=11, spectrum="bretschneider", heading=45, cut=(0.1, 20))
    sigma, step = np.linspace(0.0, 11.0, 2_000_001, retstep=True)
    cells = Cells(sigma[:-1] + step / 2, step, np.array([45.0]), 0.0, 7.5)
    found = np.histogram(np.abs(cells.omega), EDGES, weights=cells.energy(sea))[0]
    np.testing.assert_allclose(
        found, ENERGY, rtol=1e-3, atol=2e-5
    )  # a cell of 5.5e-6 rad/s lies across an edge; near the
    # largest frequency met, where d omega/d sigma is 0, it holds more
    np.testing.assert_allclose(found.sum(), sum(ENERGY), rtol=1e-6)
    np.testing.assert_allclose(cells.energy(sea).sum(), sea.moment(0), rtol=1e-5)  # but for what is beyond 11 rad/s
    star = 7.5 * pile_up_cosine(7.5, 0.465, 4.0)
    met = encounter_frequency(9.81 / (2 * star), star, 0.0)
    np.testing.assert_allclose(met, 0.465, rtol=1e-12)  # the largest frequency of waves that overtake


def test_a_steady_moment_heels_and_a_cubic_stiffens():
    """One mode: 0 = F - k m - k3 (m^3 + 3 m s^2), s^2 that of the slope k + 3 k3 (m^2 + s^2)."""
    terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.2, "K_phiphiphi": -2.0, "N_r": -1.0}
    model = qt.Model(np.eye(3), terms, 1.0, (0, 0, 0), (0, 0, 0), force_mean=(0, 0.3, 0))
    sea = qt.Sea(hs=1, tp=6, heading=90)

    def push(sigma, _heading):
        return np.stack([0 * sigma, 0.3 + 0 * sigma, 0 * sigma], axis=1)

    found = qt.sea_response(model, sea, 0.0, method="closure", force=push)
    m, s2 = np.radians(float(found["roll_mean"])), float(found["covariance"][1, 1])
    np.testing.assert_allclose(0.3 - m - 2.0 * (m**3 + 3 * m * s2), 0.0, atol=1e-6)
    np.testing.assert_allclose(found["gains"][1, 1], -1.0 - 6.0 * (m**2 + s2), rtol=1e-5)
    stiffer = qt.Model(
        np.eye(3), terms | {"K_phi": float(found["gains"][1, 1]), "K_phiphiphi": 0.0}, 1.0, (0, 0, 0), (0, 0, 0)
    )
    again = qt.sea_response(stiffer, sea, 0.0, force=push)
    np.testing.assert_allclose(again["roll_rms"], found["roll_rms"], rtol=1e-3)
    np.testing.assert_allclose(qt.sea_response(model, sea, 0.0, force=push)["roll_mean"], np.degrees(0.3), rtol=1e-12)


@STEEP
def test_answers_have_a_status():
    with pytest.warns(qt.RangeWarning, match="energy near encounter frequency 0"):
        riding = qt.sea_response(SHIP, qt.Sea(hs=3, tp=7.0), 11.0, [0.0, 60.0])  # the ship as fast as the waves
    assert riding["status"].values.tolist()[0] == 3
    assert riding["status"].attrs["flag_meanings"].split()[3] == "surf_riding"
    assert float(riding["roll_rms"][0]) == 0.0
    unstable = qt.Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_p": 0.1, "N_r": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))
    assert int(qt.sea_response(unstable, qt.Sea(hs=1, tp=6, heading=90), 0.0, force=force)["status"]) == 1


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: qt.sea_response(SHIP, None, 5.0), "is no Sea and no list of them"),
        (lambda: qt.sea_response(SHIP, [], 5.0), "is no Sea and no list of them"),
        (lambda: qt.sea_response(SHIP, qt.Sea(hs=2, tp=9), -5.0), "speed = -5 m/s"),
        (lambda: qt.sea_response(SHIP, qt.Sea(hs=2, tp=9), 5.0, 400.0), "heading = 400 deg"),
        (lambda: qt.sea_response(SHIP, qt.Sea(hs=2, tp=9), 5.0, method="guess"), "allowed: linear, closure"),
        (lambda: qt.sea_response(SHIP, qt.Sea(hs=2, tp=9), 5.0, force=force), "force is given beside a ship"),
        (lambda: qt.sea_response(MODEL, qt.Sea(hs=2, tp=9), 5.0), "force is missing"),
        (
            lambda: qt.sea_response(MODEL, qt.Sea(hs=2, tp=9), 5.0, force=3.0),
            "force = 3.0; of a model it is a function",
        ),
        (lambda: qt.sea_response(MODEL, qt.Sea(hs=2, tp=9), 5.0, force=lambda *_: np.ones(3)), r"force gives \(3,\)"),
        (lambda: qt.sea_response(3, qt.Sea(hs=2, tp=9), 5.0), "is no Ship or Model"),
    ],
)
def test_what_cannot_be_is_refused(call, words):
    with pytest.raises(qt.InputError, match=words):
        call()


# heading, spreading, Hs, Tp: simulated with 32 hours each, strips of drag on the velocity through the water
SEAS = [
    (60, None, 6, 11), (45, None, 6, 11), (30, None, 6, 11), (90, None, 4, 9), (90, 10, 6, 11), (120, None, 5, 11),
    (60, 10, 6, 11), (45, 10, 4, 10), (75, "cos2", 5, 9), (60, None, 3, 9), (135, 5, 6, 12), (75, 25, 6, 12),
]  # fmt: skip


@pytest.mark.soak
@pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
def test_the_closure_is_near_simulation_of_the_same_equations():
    """Deviations within 5 % in every sea, beyond three standard errors of the simulation."""
    model, own = frozen(SHIP, 7.5)
    for k, (heading, spreading, hs, tp) in enumerate(SEAS):
        sea = qt.Sea(hs=hs, tp=tp, heading=heading, spreading=spreading)
        c, error, _ = simulated(model, own, sea, 7.5, records=64, seed=k)
        found = qt.sea_response(model, sea, 7.5, method="closure", force=own)["covariance"].values
        for i in range(4):
            assert abs(np.sqrt(found[i, i] / c[i, i]) - 1) < 0.05 + 1.5 * error[i, i] / c[i, i], (heading, hs, i)
