"""Every dataset of coefficients or forces says about which point and in which axes it is."""

import numpy as np
import pytest

import quartering as qt
from quartering.hydro.added_mass import hydrodynamics6
from quartering.hydro.database.dataset import read_capytaine, write_capytaine
from quartering.loads.comparison import compare_forces

BOX = qt.ship("box")


def from_file(folder):
    write_capytaine(qt.hydrodynamics(BOX, [0.5, 0.8]), folder / "box.nc", BOX)
    return read_capytaine(folder / "box.nc", BOX)


DATASETS = {
    "section_coefficients": lambda _: qt.section_coefficients(qt.Section([0.0, 1.0, 1.0], [1.0, 1.0, 0.0]), [1.0]),
    "hydrodynamics": lambda _: qt.hydrodynamics(BOX, [0.5]),
    "hydrodynamics6": lambda _: hydrodynamics6(BOX, [0.5]),
    "wave_forces": lambda _: qt.wave_forces(BOX, qt.Wave(100.0, 1.0)),
    "compare_forces": lambda _: compare_forces(BOX, [100.0], [60.0, 90.0]),
    "read_capytaine": from_file,
    "sweep": lambda _: qt.sweep(BOX, 5.0, [60.0], 100.0, 1.0),
}


@pytest.mark.parametrize("name", DATASETS)
def test_reference_point_axes_and_units_are_stored(name, tmp_path):
    dataset = DATASETS[name](tmp_path)
    assert "y to starboard" in dataset.attrs["axes"]
    assert "z down" in dataset.attrs["axes"]
    point = dataset.attrs["reference_point"]
    assert ("waterline" if name == "section_coefficients" else "centre of gravity") in point
    assert all("units" in dataset[v].attrs for v in dataset.data_vars if np.issubdtype(dataset[v].dtype, np.floating))
