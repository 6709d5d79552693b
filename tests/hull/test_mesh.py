"""Panel mesh: closed, outward, converging to the hydrostatics of the same lines."""

import numpy as np
import pytest

from quartering.conventions import InputError
from quartering.hull.file.read import ship
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.mesh import hull_panels

HULLS = ["wigley", "box", "series60-cb60", "series60-cb80", "s175", "dtc", "dtmb5415"]


@pytest.mark.parametrize("name", HULLS)
def test_panels_are_closed_and_point_outward(name):
    """Gauss: the area vectors along the ship cancel; x nx, y ny and z nz each integrate to half of the volume."""
    panels = hull_panels(ship(name).hull, 40, 10)
    centre, area = panels.vertices[panels.quads].mean(axis=1), panels.area_vectors
    assert abs(area[:, 0].sum()) < 1e-9 * np.abs(area[:, 0]).sum() + 1e-9
    volume = 2 * np.einsum("pi,pi->i", centre, area)
    assert (volume > 0).all()
    assert volume == pytest.approx([panels.volume] * 3, rel=2e-3)


@pytest.mark.parametrize("name", HULLS)
def test_volume_converges_to_hydrostatics(name):
    """Agreement with the integral over stations, whose ends and curves along the ship differ by up to 0.3 %."""
    hull = ship(name).hull
    coarse, fine = (hull_panels(hull, 24 * k, 6 * k).volume / hydrostatics(hull).volume - 1 for k in (1, 4))
    assert abs(fine) < 0.004
    assert abs(coarse) < 0.03


@pytest.mark.parametrize("name", HULLS)
def test_no_panel_is_above_water_or_across_the_centre_plane(name):
    vertices = hull_panels(ship(name).hull).vertices
    assert vertices[:, 1].min() >= 0
    assert vertices[:, 2].min() >= 0


def test_too_few_panels_are_refused():
    with pytest.raises(InputError, match="40 and 10"):
        hull_panels(ship("wigley").hull, 4, 10)
