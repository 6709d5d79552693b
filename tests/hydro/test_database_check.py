"""What is found in databases that are not sound or not of the ship: properties of the exact matrices, broken on purpose."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

import quartering as qt
from quartering.conventions import RangeWarning
from quartering.hull.user_database import database_of
from quartering.hydro.database.check import soundness, strip_agreement
from quartering.hydro.database.dataset import write_capytaine, write_wamit
from tests.tiers import mostly_soak

S60 = qt.ship("series60-cb60")


def matrices(omega):
    ds = qt.hydrodynamics(S60, omega)
    return omega, ds.added_mass.to_numpy(), ds.damping.to_numpy()


@pytest.mark.parametrize("count", mostly_soak([5, 8, 12, 40], 5, 12))
@pytest.mark.parametrize("name", ["wigley", "dtc"])
def test_nothing_is_found_in_strip_theory_however_few_its_frequencies(name, count):
    omega = np.linspace(0.15, 2.0, count)
    ds = qt.hydrodynamics(qt.ship(name), omega)
    assert soundness(omega, ds.added_mass.to_numpy(), ds.damping.to_numpy()) == []


def test_a_negative_damping_is_told_with_its_mode_and_frequency():
    omega, a, b = matrices(np.linspace(0.2, 2.0, 19))
    b[7, 1, 1] = -0.1 * b[:, 1, 1].max()
    (found,) = soundness(omega, a, b)
    assert "negative at 0.9 rad/s, mostly in roll" in found


def test_a_wrong_sign_of_one_coupling_is_told():
    omega, a, b = matrices(np.linspace(0.2, 2.0, 19))
    a[:, 0, 1] *= -1
    (found,) = soundness(omega, a, b)
    assert "sway by roll and of roll by sway" in found or "roll by sway and of sway by roll" in found
    assert "not about one point" in found


@pytest.mark.parametrize("size", [0.3, -0.5])
def test_a_spike_is_told_with_its_mode_and_frequency(size):
    omega, a, b = matrices(np.linspace(0.2, 2.0, 37))
    a[20, 0, 0] += size * a[:, 0, 0].max()
    (found,) = soundness(omega, a, b)
    assert "in sway leaves its neighbours" in found
    assert "at 1.2 rad/s" in found
    assert "lid" in found


def test_a_database_of_another_point_or_scale_is_told():
    """Rigid kinematics: with the moments taken 3 m higher than they are, the force seems 3 m deeper."""
    own = qt.hydrodynamics(S60, [0.6]).added_mass[0].to_numpy()
    moved = own.copy()
    moved[0, 1] -= 3.0 * own[0, 0]
    (found,) = strip_agreement(moved, own, S60.hull.draught)
    ours = -own[0, 1] / own[0, 0]
    assert f"{ours + 3.0:.3g} m below the calm plane, by strip theory {ours:.3g} m" in found
    assert "half a hull" in strip_agreement(own / 2, own, S60.hull.draught)[0]
    shifted = own.copy()
    shifted[0, 2] += S60.hull.length / 2 * own[0, 0]
    assert "forward of midship" in strip_agreement(shifted, own, S60.hull.draught)[0]


def test_a_ship_warns_once_of_a_database_about_another_point(tmp_path):
    write_capytaine(qt.hydrodynamics(S60, np.linspace(0.1, 2.0, 20)), tmp_path / "own.nc", S60)
    wrong = S60.with_(database=database_of(tmp_path / "own.nc", "test", moments_about=(S60.hull.length / 2, 0.0)))
    with pytest.warns(RangeWarning, match=r"database own.nc \(Capytaine\): the place of its sway force"):
        qt.coefficients(wrong, 0.5, 5.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        qt.coefficients(wrong.with_(gm=0.7), 0.6, 5.0)
        qt.coefficients(S60.with_(database=tmp_path / "own.nc"), 0.5, 5.0)


def test_a_wrong_length_of_a_wamit_run_is_told(tmp_path):
    write_wamit(qt.hydrodynamics(S60, np.linspace(0.1, 2.0, 20)), tmp_path / "own", S60, length=S60.hull.length)
    right = database_of(tmp_path / "own.1", "test", length=S60.hull.length)
    qt.coefficients(S60.with_(database=right), 0.5, 5.0)
    with pytest.warns(RangeWarning, match="is `length` its ULEN"):
        qt.coefficients(S60.with_(database=replace(right, length=1.2 * S60.hull.length)), 0.5, 5.0)
