import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from quartering.conventions import GRAVITY, InputError
from quartering.loads.waves import Wave, encounter_frequency, folded, heading_components, least_encounter_frequency

pytestmark = pytest.mark.quick

headings = st.floats(-720, 720)


def test_wave_closed_form_of_deep_water_dispersion():
    wave = Wave(length=100.0, height=5.0)
    assert wave.amplitude == 2.5
    assert wave.steepness == 0.05
    assert wave.frequency == pytest.approx(np.sqrt(2 * np.pi * GRAVITY / 100.0), rel=1e-15)
    assert wave.frequency**2 == pytest.approx(GRAVITY * wave.wavenumber, rel=1e-15)


@pytest.mark.parametrize(
    ("length", "height", "words"),
    [
        (0.0, 1.0, ("length", "0 m", "above 0")),
        (-150.0, 1.0, ("-150", "above 0")),
        (float("nan"), 1.0, ("length", "nan")),
        (float("inf"), 1.0, ("length", "inf")),
        (100.0, -1.0, ("height", "-1")),
        (100.0, float("nan"), ("height", "nan")),
        (100.0, 20.0, ("steepness 0.2", "1/7", "14.3 m")),
    ],
)
def test_a_wave_that_cannot_be_is_refused_with_what_is_allowed(length, height, words):
    with pytest.raises(InputError) as caught:
        Wave(length=length, height=height)
    for word in words:
        assert word in str(caught.value)


def test_the_steepest_wave_itself_is_allowed():
    assert Wave(length=70.0, height=10.0).steepness == pytest.approx(1 / 7)


def test_encounter_frequency_in_head_following_and_beam_seas_closed_form():
    sigma, U = 0.6, 7.5
    shift = sigma**2 / GRAVITY * U
    np.testing.assert_allclose(
        encounter_frequency(sigma, U, [0.0, 90.0, 180.0, -90.0]),
        [sigma - shift, sigma, sigma + shift, sigma],
        rtol=1e-15,
    )


def test_encounter_frequency_of_the_printed_convention_omega_is_sigma_plus_k_u_cos_delta():
    mu = np.linspace(-180, 180, 73)
    printed = 0.7 + 0.7**2 / GRAVITY * 9.0 * np.cos(np.pi - np.deg2rad(mu))
    np.testing.assert_allclose(encounter_frequency(0.7, 9.0, mu), printed, rtol=1e-14)


def test_a_ship_faster_than_the_wave_meets_it_at_a_negative_frequency_and_one_as_fast_at_zero():
    sigma = 0.8
    assert encounter_frequency(sigma, 1.2 * GRAVITY / sigma, 0.0) < 0
    assert abs(float(encounter_frequency(sigma, GRAVITY / sigma, 0.0))) < 1e-15


@pytest.mark.parametrize(
    ("sigma", "speed", "heading", "word"),
    [
        (0.0, 1.0, 0.0, "frequency = 0 rad/s; it is above 0"),
        (-1.0, 1.0, 0.0, "-1"),
        (0.5, -2.0, 0.0, "speed = -2 m/s"),
        (0.5, 1.0, np.nan, "heading = nan deg"),
        (np.nan, 1.0, 0.0, "nan"),
    ],
)
def test_encounter_frequency_refuses_what_is_not_a_condition(sigma, speed, heading, word):
    with pytest.raises(InputError, match=word):
        encounter_frequency(sigma, [0.0, speed], heading)


@given(headings)
def test_heading_components_lie_on_the_unit_circle_and_mirror(heading):
    along, across = heading_components(heading)
    assert along**2 + across**2 == pytest.approx(1.0, abs=1e-14)
    mirrored = heading_components(-heading)
    assert mirrored[0] == pytest.approx(along, abs=1e-12)
    assert mirrored[1] == pytest.approx(-across, abs=1e-12)


@pytest.mark.parametrize(
    ("heading", "expected"), [(0, (-1, 0)), (90, (0, 1)), (180, (1, 0)), (-180, (1, 0)), (270, (0, -1)), (360, (-1, 0))]
)
def test_heading_components_are_exact_at_the_quadrants(heading, expected):
    along, across = heading_components(heading)
    assert (float(along), float(across)) == expected


@given(st.floats(-3, 3), st.complex_numbers(max_magnitude=1e6), st.floats(0, 50))
def test_folding_keeps_the_real_signal(omega, phasor, time):
    frequency, turned = folded(omega, phasor)
    assert frequency >= 0
    signal = (phasor * np.exp(1j * omega * time)).real
    assert (turned * np.exp(1j * frequency * time)).real == pytest.approx(signal, abs=1e-9 * max(1, abs(phasor)))


def test_folding_many_conditions_conjugates_only_those_that_overtake():
    frequency, phasors = folded([-1.0, 0.0, 2.0], np.full((3, 3), 1.0 + 2.0j))
    np.testing.assert_array_equal(frequency, [1.0, 0.0, 2.0])
    np.testing.assert_array_equal(phasors[:, 0], [1 - 2j, 1 + 2j, 1 + 2j])


def test_least_encounter_frequency_closed_form():
    assert float(least_encounter_frequency(GRAVITY)) == pytest.approx(1e-3, rel=1e-15)
    with pytest.raises(InputError, match="ship length"):
        least_encounter_frequency(0.0)
