"""A shape that a close-fit solution does not resolve is told, by section and frequency, and numbers of ships are not."""

import warnings

import numpy as np
import pytest

import quartering as qt
from quartering.conventions import RangeWarning
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.stations import hull_from_offsets
from quartering.hydro.strip.table import radiation_table

OMEGA = np.linspace(0.3, 6.0, 20)
# Keel up: wings just below the surface. Energy is missed by more than half on 25 and on 50 panels.
WINGS = qt.Section(y=[0.0, 3.0, 0.05, 0.05], z=[1.0, 0.2, 0.19, 0.0])


def test_a_section_that_is_not_resolved_is_told_with_its_frequency():
    with pytest.warns(RangeWarning, match=r"the section: damping by pressure and by radiated waves differ by .* rad/s"):
        qt.section_coefficients(WINGS, OMEGA, "close-fit")


def test_a_section_of_a_hull_is_told_by_place_from_disk_as_well():
    side, wing = ([0.0, 3.0, 3.0], [0.0, 0.0, 2.0]), ([0.0, 3.0, 0.05, 0.05], [0.0, 0.8, 0.81, 2.0])
    contours = tuple((np.array(y), np.array(h)) for y, h in [side] * 3 + [wing] + [side] * 3)
    hull = hull_from_offsets(
        "winged", length=60.0, beam=6.0, draught=1.0, x=np.linspace(-30, 30, 7), contours=contours, outline="straight"
    )
    for _ in range(2):  # solved, then read
        with pytest.warns(RangeWarning, match=r"section 4 \(x = 0 m\): damping by pressure"):
            radiation_table(strips(hull), OMEGA, 1025.0)


@pytest.mark.parametrize("name", ["dtc", "s175"])
def test_ships_are_resolved(name):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        radiation_table(strips(qt.ship(name).hull), np.linspace(0.2, 2.5, 20), 1025.0, method="close-fit")
