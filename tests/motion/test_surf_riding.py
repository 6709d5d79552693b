"""Thresholds of surf-riding: Melnikov's closed form and the heteroclinic connection.

Authority: reference of the theory (two invented ships; connections by an adaptive integrator of order 8 at 1e-11, Melnikov's
by quadrature of the energy balance), and limits.
"""

import math

import numpy as np
import pytest

import quartering as qt

FISHING = {
    "ship": {"mass": 450e3, "added_mass": 45e3, "length": 34.5},
    "propulsion": qt.Propulsion((0, 0, 2500, -600, 75, 0), 2.6, 0.142, 0.156, (0.36, -0.28, -0.12)),
}
FRIGATE = {
    "ship": {"mass": 4e6, "added_mass": 320e3, "length": 120.0},
    "propulsion": qt.Propulsion((0, 2000, 1500, -60, 6, 0), 4.5, 0.1, 0.05, (0.55, -0.35, -0.2)),
}
# ship, wave length [m], force [N]; revolutions [1/s] by Melnikov and exact, Froude numbers by Melnikov and exact
ROWS = [
    (FISHING, 34.5, 462285.35897573805, 2.4206335777340473, 2.434400286239792, 0.2601090276535242, 0.26144956446434675),
    (FISHING, 51.75, 554742.4307708857, 3.0020977094384795, 3.0714355703633105, 0.3125035984437696, 0.3182155699429574),
    (FISHING, 34.5, 277371.21538544283, 2.7278457077053844, 2.7535204311235466, 0.28883805888227543, 0.2911296974623749),
    (FRIGATE, 120.0, 4109203.1908954494, 2.0242328288708777, 2.0326083516553273, 0.24938913571442076, 0.2504127428895226),
    (FRIGATE, 180.0, 4931043.829074539, 2.368285404277086, 2.3899036118818313, 0.29108252869328116, 0.29367647392625246),
    (FRIGATE, 120.0, 2465521.9145372696, 2.286931283164604, 2.3009012052327145, 0.2812924338054592, 0.2829767256653485),
]  # fmt: skip


@pytest.mark.parametrize(
    "row", ROWS, ids=[f"{'fishing' if r[0] is FISHING else 'frigate'}-{r[1]:g}-{r[2]:.0f}" for r in ROWS]
)
def test_both_thresholds_are_those_of_the_reference(row):
    one, wave_length, force, n, n_exact, froude, froude_exact = row
    found = qt.surf_riding_thresholds(**one["ship"], propulsion=one["propulsion"], wave_length=wave_length, force=force)
    np.testing.assert_allclose([found.revolutions, found.froude], [n, froude], rtol=1e-8)
    np.testing.assert_allclose([found.revolutions_exact, found.froude_exact], [n_exact, froude_exact], rtol=1e-6)


def test_melnikov_and_exact_meet_where_damping_and_thrust_are_small():
    """Limit: Melnikov's method is exact to the first order in what is not the wave; a thousandth of it leaves 1e-5."""
    gaps = []
    for share in (1.0, 1e-2):
        resistance = np.array(FRIGATE["propulsion"].resistance) * share
        small = qt.Propulsion(resistance, 4.5, 0.1, 0.05, np.array((0.55, -0.35, -0.2)) * share)
        found = qt.surf_riding_thresholds(**FRIGATE["ship"], propulsion=small, wave_length=120.0, force=4.1e6)
        gaps.append(abs(found.revolutions_exact / found.revolutions - 1))
    assert gaps[1] < 0.03 * gaps[0]


def test_the_first_threshold_is_where_the_wave_just_makes_up_for_the_thrust_that_is_missing():
    """Closed form: T(c; n) - R(c) = -f."""
    one, wave_length, force = FISHING, 34.5, 1.5e5
    found = qt.surf_riding_thresholds(**one["ship"], propulsion=one["propulsion"], wave_length=wave_length, force=force)
    c = math.sqrt(9.81 * wave_length / (2 * math.pi))
    tau0, tau1, tau2 = one["propulsion"].thrust_terms()
    n = found.first_revolutions
    assert tau0 * n**2 + tau1 * n * c + tau2 * c**2 - one["propulsion"].drag(c) == pytest.approx(-force, rel=1e-9)
    assert n <= found.revolutions_exact


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"force": 0.0}, "force = 0.0"),
        ({"mass": float("nan")}, "mass = nan"),
        ({"added_mass": -1.0}, "added_mass = -1.0"),
    ],
)
def test_numbers_without_sense_are_refused(change, words):
    given = {**FISHING["ship"], "propulsion": FISHING["propulsion"], "wave_length": 34.5, "force": 4e5} | change
    with pytest.raises(qt.InputError, match=words):
        qt.surf_riding_thresholds(**given)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"resistance": [1.0] * 7}, "up to six"), ({"diameter": 0.0}, "diameter = 0.0 m"), ({"wake": 1.0}, "wake = 1.0"),
        ({"thrust": (0.0, 1.0, 1.0)}, "k0 above 0"), ({"propellers": 0}, "propellers = 0"),
    ],
)  # fmt: skip
def test_propulsion_without_sense_is_refused(given, words):
    usual = {"resistance": [0, 0, 100.0], "diameter": 3.0, "thrust": (0.4, -0.3, -0.1)}
    with pytest.raises(qt.InputError, match=words):
        qt.Propulsion(**(usual | given))
