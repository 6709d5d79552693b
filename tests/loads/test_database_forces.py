"""Forces of a database of another size, or whose phases have another sign, are told, wherever the file's origin lies.

Authority: the files are made from strips, so that right files have their phases, and a changed sign is known.
"""

import warnings
from dataclasses import replace

import numpy as np
import pytest

import quartering as qt
from quartering.conventions import MODES, RangeWarning
from quartering.hull.user_database import database_of
from quartering.hydro.database.capytaine import read_capytaine_file, write_capytaine_file
from quartering.hydro.database.dataset import write_capytaine
from tests.loads.own_file import S60, of_strips

OMEGA, HEADINGS = np.linspace(0.2, 0.9, 15), np.arange(0.0, 181.0, 30.0)
LONG = qt.Wave(S60.hull.length, 1.0)


@pytest.fixture(scope="module", params=[0.0, 0.5], ids=["amidships", "aft"])
def file(request, tmp_path_factory):
    """A sound file, its origin amidships or at the aft perpendicular, and x of midship in it."""
    path, midship = tmp_path_factory.mktemp("own") / "own.nc", request.param * S60.hull.length
    write_capytaine(of_strips(S60, OMEGA, HEADINGS), path, S60, midship=midship)
    return path, midship


def told(file, change, folder):
    """What is said of the file with its forces changed, but of the reader's own look at sway."""
    path, midship = file
    raw = read_capytaine_file(path)
    forces = {part: change(part, force.copy()) for part, force in raw.forces.items()}
    write_capytaine_file(folder / "changed.nc", replace(raw, forces=forces))
    ship = S60.with_(database=database_of(folder / "changed.nc", "test", midship=midship))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        for _ in range(2):
            qt.wave_forces(ship.with_(gm=0.7), LONG, 3.0, 60.0)
    assert all(issubclass(one.category, RangeWarning) for one in said)
    return [str(one.message) for one in said if "strip theory" in str(one.message)]


def test_a_right_file_is_not_doubted(file, tmp_path):
    assert told(file, lambda _, force: force, tmp_path) == []


@pytest.mark.parametrize("mode", MODES)
def test_imaginary_parts_of_the_other_sign_in_one_mode_are_told_once(file, tmp_path, mode):
    def change(_, force):
        force[..., MODES.index(mode)] = np.conj(force[..., MODES.index(mode)])
        return force

    (said,) = told(file, change, tmp_path)
    assert f"{mode} (diffraction" in said
    assert "agree with the other sign of their imaginary parts" in said
    assert not any(f"{other} (" in said for other in MODES if other != mode)


def test_a_moment_of_the_other_sign_is_told(file, tmp_path):
    (said,) = told(file, lambda _, force: force * [1.0, -1.0, 1.0], tmp_path)
    assert "roll (Froude-Krylov, 180 deg), roll (diffraction, 180 deg)" in said
    assert "agree with the other sign of these forces" in said


def test_one_part_of_the_other_time_factor_is_told(file, tmp_path):
    said = told(file, lambda part, force: np.conj(force) if part == "diffraction" else force, tmp_path)
    assert len(said) == 1
    assert all(f"{mode} (diffraction" in said[0] for mode in MODES)
    assert "Froude-Krylov" not in said[0]


@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_forces_of_another_amplitude_are_told(file, tmp_path, factor):
    """By definition: forces per metre of height, or per two metres of amplitude."""
    (said,) = told(file, lambda _, force: factor * force, tmp_path)
    assert (
        f"its sway force is {factor:g} times (Froude-Krylov) and {factor:g} times (diffraction) that of strip" in said
    )
    assert "phases" not in said
