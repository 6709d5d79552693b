"""The forms side by side say what each says alone."""

import numpy as np
import pytest

import quartering as qt
from quartering.conventions import InputError
from quartering.loads.comparison import compare_forces

LENGTHS, HEADINGS = [90.0, 180.0], [0.0, 30.0, 90.0, 150.0]


@pytest.fixture(scope="module")
def found():
    return compare_forces(qt.ship("series60-cb60"), LENGTHS, HEADINGS, 5.0)


@pytest.mark.parametrize("form", ["paper", "paper-corrected", "relative-motion", "stf"])
def test_every_form_is_that_of_wave_forces(found, form):
    """Agreement with the single wave."""
    for length in LENGTHS:
        alone = qt.wave_forces(qt.ship("series60-cb60"), qt.Wave(length, 2.0), 5.0, HEADINGS, form=form)
        here = found.force.sel(form=form, wave_length=length)
        np.testing.assert_allclose(here, alone.total, rtol=1e-12, atol=1e-9)
        pressure = found.force.sel(form="froude-krylov", wave_length=length)
        np.testing.assert_allclose(pressure, alone.froude_krylov, rtol=1e-12, atol=1e-9)


def test_differences_are_measured_by_the_largest_force(found):
    """Recomputed by hand: modulus of the difference over the largest of stf over heading, by wave and mode."""
    phasor = found.force.sel(part="cos") - 1j * found.force.sel(part="sin")
    size = np.abs(phasor.sel(form="stf")).max("heading")
    by_hand = np.abs(phasor - phasor.sel(form="stf")) / size
    np.testing.assert_allclose(found.difference, by_hand.transpose(*found.difference.dims), rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(
        found.largest_difference, by_hand.max("heading").transpose("form", ...), rtol=1e-12, atol=1e-15
    )
    assert not found.largest_difference.sel(form="stf").any()
    apart = found.largest_difference
    assert bool((apart.sel(form="relative-motion") < apart.sel(form="paper")).all())


def test_panels_stand_beside_the_others_at_zero_speed():
    """What is given as panels comes back as the form `bem`."""
    ship = qt.ship("series60-cb60")
    panels = compare_forces(ship, LENGTHS, HEADINGS).force.sel(form="stf").to_dataset(name="total") * 1.1
    panels = panels.assign_attrs(method="made up")
    both = compare_forces(ship, LENGTHS, HEADINGS, bem=panels)
    assert both.form.to_numpy().tolist()[-1] == "bem"
    assert both.largest_difference.sel(form="bem").to_numpy() == pytest.approx(np.full((2, 3), 0.1))
    assert both.panels == "made up"
    with pytest.raises(InputError, match="zero speed"):
        compare_forces(ship, LENGTHS, HEADINGS, 5.0, bem=panels)
    with pytest.raises(InputError, match="give bem_forces the same"):
        compare_forces(ship, [100.0, 180.0], HEADINGS, bem=panels)


@pytest.mark.parametrize(("lengths", "headings", "said"), [([-1.0], [90.0], "above 0"), ([90.0], [[90.0]], "one list")])
def test_bad_input_is_refused(lengths, headings, said):
    with pytest.raises(InputError, match=said):
        compare_forces(qt.ship("wigley"), lengths, headings)
