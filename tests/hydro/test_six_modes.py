"""Six-mode matrices: against the lateral ones, the published heave-pitch formulas, symmetries and 3-D panels."""

import csv
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from quartering.conventions import InputError
from quartering.hull.file.read import ship
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.quadrature import gauss
from quartering.hull.lines.stations import hull_from_offsets
from quartering.hull.lines.strips import Strips
from quartering.hull.ship import Loading, Ship
from quartering.hydro.added_mass import hydrodynamics, hydrodynamics6
from quartering.hydro.section.multipole import radiation
from quartering.hydro.strip.six_mode_matrices import seakeeping_axes, section_matrix, six_mode_matrices
from quartering.hydro.strip.six_modes import SIX_MODES
from quartering.hydro.strip.table import radiation_table
from tests.tiers import mostly_soak

HEAVE, PITCH = 2, 4
LATERAL = [1, 3, 5]
SQRT_G_OVER_L = np.sqrt(9.81 / 3.0)


def reference(name):
    lines = (Path(__file__).parent / name).read_text().splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def wigley_sections(x):
    """Breadth, draught and area of Journee's Wigley III at x."""
    u = (2 * x / 3.0) ** 2
    b = 0.15 * (1 - u) * (1 + 0.2 * u)
    one, blank = np.ones_like(x), np.zeros((x.size, 1))
    return Strips(x, one, blank, blank, blank, blank, b, 0.1875 * one, b * 0.1875 * 4 / 3)


def wigley_matrices(x, weight, omega):
    """Added mass and damping (6, 6) of Wigley III about the waterplane centre, from Lewis sections at x."""
    table = radiation_table(wigley_sections(x), [omega], 1000.0, method="lewis")
    heave = radiation(table.forms, [omega], "heave", density=1000.0)
    a = section_matrix(table.a, heave.added_mass[..., 0, 0])
    b = section_matrix(table.b, heave.damping[..., 0, 0])
    added, damping = six_mode_matrices(x, weight, a, b, 0.0, [omega])
    return {"A": added[0], "B": damping[0]}


@pytest.mark.parametrize(
    ("name", "low_frequency"),
    mostly_soak(
        [(name, low) for name in ("wigley", "series60-cb60", "box") for low in ("cap", "drop")],
        ("wigley", "cap"), ("box", "drop"), several=True,
    ),
)  # fmt: skip
def test_lateral_block_is_that_of_the_lateral_strip_theory(name, low_frequency):
    """Agreement with `hydrodynamics`, transom (box) included."""
    vessel, omega = ship(name), [0.05, 0.4, 0.9, 1.6]
    ours = hydrodynamics6(vessel, omega, 6.0, low_frequency=low_frequency)
    known = hydrodynamics(vessel, omega, 6.0, low_frequency=low_frequency)
    for variable in ("added_mass", "damping"):
        block = ours[variable].to_numpy()[:, LATERAL][:, :, LATERAL]
        np.testing.assert_allclose(block, known[variable], rtol=1e-10, atol=1e-10 * np.abs(known[variable]).max())


def published_heave_pitch(x, dx, a, b, U, w, x_aft, aft):
    """Salvesen, Tuck and Faltinsen (1970), table of heave-pitch coefficients; a, b per metre at x, aft = (a, b) at x_aft."""
    aA, bA = aft
    A33, B33 = dx @ a, dx @ b  # the zero-speed parts
    q = U / w**2
    return {
        "A33": A33 - q * bA,
        "B33": B33 + U * aA,
        "A35": -dx @ (x * a) - q * B33 + q * x_aft * bA - q * U * aA,
        "B35": -dx @ (x * b) + U * A33 - U * x_aft * aA - q * U * bA,
        "A53": -dx @ (x * a) + q * B33 + q * x_aft * bA,
        "B53": -dx @ (x * b) - U * A33 - U * x_aft * aA,
        "A55": dx @ (x**2 * a) + q * U * A33 - q * x_aft**2 * bA + q * U * x_aft * aA,
        "B55": dx @ (x**2 * b) + q * U * B33 + U * x_aft**2 * aA + q * x_aft * U * bA,
    }


@given(
    st.floats(0.0, 12.0), st.floats(0.2, 3.0), st.booleans(),
    st.lists(st.floats(0.1, 3.0), min_size=4, max_size=4),
)  # fmt: skip
@settings(max_examples=30, deadline=None)
def test_heave_and_pitch_meet_the_published_formulas_with_speed_and_transom(U, w, transom, shape):
    x, dx = gauss(12, -50.0, 40.0)
    a, b = 2e4 * shape[0] * (1 + shape[1] * x / 100), 1e4 * shape[2] * (1 - shape[3] * (x / 100) ** 2)
    zero = np.zeros((12, 3))
    matrices = section_matrix(zero, a)[None], section_matrix(zero, b)[None]
    added, damping = six_mode_matrices(x, dx, *matrices, U, [w], x_aft=x[0] if transom else None)
    added, damping = seakeeping_axes(added, damping, U, np.array([w]))
    printed = published_heave_pitch(x, dx, a, b, U, w, x[0], (a[0], b[0]) if transom else (0.0, 0.0))
    for key, value in printed.items():
        i, j = (HEAVE if k == "3" else PITCH for k in key[1:])
        found = (added if key[0] == "A" else damping)[0, i, j]
        size = 50.0 ** ((i == PITCH) + (j == PITCH)) * max(printed["A33" if key[0] == "A" else "B33"], 1e5)
        assert found == pytest.approx(value, rel=1e-9, abs=1e-10 * size), key


@pytest.mark.parametrize("name", ["series60-cb60", "box"])
def test_matrices_are_symmetric_at_zero_speed_about_any_point(name):
    """Reciprocity of the section coefficients."""
    for point in ("G", "waterline", (12.0, -3.0)):
        ds = hydrodynamics6(ship(name), [0.5, 1.0], reference=point)
        for variable in (ds.added_mass.to_numpy(), ds.damping.to_numpy()):
            np.testing.assert_allclose(variable, variable.swapaxes(1, 2), rtol=0, atol=1e-12 * np.abs(variable).max())


def test_pointed_ends_obey_timman_and_newman():
    """In axes of the mean course A_ij(U) = A_ji(-U), B_ij(U) = B_ji(-U) when no transom is shed (Timman, Newman 1962)."""
    x, dx = gauss(16, -50.0, 50.0)
    taper = 1 - (x / 50) ** 2
    lateral = np.outer(taper, [3.0, -2.0, 8.0]) * 1e4
    a = section_matrix(lateral, 5e4 * taper * (1 + x / 200))[None]
    b = section_matrix(0.4 * lateral * (1 + x / 90)[:, None], 3e4 * taper)[None]
    w = np.array([0.8])
    ahead = seakeeping_axes(*six_mode_matrices(x, dx, a, b, 7.0, w, depth=1.5), 7.0, w)
    astern = seakeeping_axes(*six_mode_matrices(x, dx, a, b, -7.0, w, depth=1.5), -7.0, w)
    for forward, backward in zip(ahead, astern, strict=True):
        np.testing.assert_allclose(forward, backward.swapaxes(1, 2), rtol=0, atol=1e-12 * np.abs(forward).max())
        assert np.abs(forward - forward.swapaxes(1, 2)).max() > 1e-3 * np.abs(forward).max()  # speed does break it


def test_moving_the_reference_point_is_a_rigid_move():
    """F about another point and velocities there carry the same power: M' = T' M T (rigid-body kinematics)."""
    vessel = ship("series60-cb60")
    at_g = hydrodynamics6(vessel, [0.7], 6.0)
    lcb, z_g = hydrostatics(vessel).lcb, vessel.hull.draught - vessel.loading.kg  # G below the calm plane
    elsewhere = hydrodynamics6(vessel, [0.7], 6.0, reference=(lcb + 4.0, z_g + 1.5))
    rx, rz = 4.0, 1.5  # of the new point from G
    back = np.eye(6)  # velocities at G from those at the point: v_G = v_P - omega x (r_P - r_G)
    back[0, 4], back[1, 5], back[1, 3], back[2, 4] = -rz, -rx, rz, rx
    for variable in ("added_mass", "damping"):
        moved = back.T @ at_g[variable].to_numpy()[0] @ back
        np.testing.assert_allclose(elsewhere[variable][0], moved, rtol=0, atol=1e-12 * np.abs(moved).max())


def test_negative_frequencies_have_the_matrices_of_their_size():
    """c(-w) = conj c(w): added mass and damping are even in the frequency."""
    ds = hydrodynamics6(ship("series60-cb60"), [-0.3, 0.3], 9.0)
    assert ds.frequency.to_numpy().tolist() == [-0.3, 0.3]
    assert bool((ds.added_mass[0] == ds.added_mass[1]).all())


def test_limits_are_approached():
    """Low and high frequencies tend to the closed-form limits (Lewis sections); heave has none at zero."""
    ds = hydrodynamics6(ship("wigley"), [0.02], 5.0, low_frequency="drop")
    low = ds.added_mass.to_numpy()[0]
    zero, infinite = ds.added_mass_zero.to_numpy(), ds.added_mass_infinite.to_numpy()
    block = np.ix_(LATERAL, LATERAL)
    np.testing.assert_allclose(low[block], zero[block], atol=2e-3 * np.abs(zero[block]).max())
    far = [hydrodynamics6(ship("wigley"), [w]).added_mass.to_numpy()[0] - infinite for w in (6.0, 12.0)]
    off = [np.abs(np.diag(d) / np.diag(infinite)) for d in far]
    assert (off[0] < 0.1).all()
    assert (off[1] < 0.3 * off[0] + 1e-12).all()  # going with 1/omega^2
    assert np.isposinf(zero[HEAVE, HEAVE])
    assert np.isposinf(zero[PITCH, PITCH])
    assert zero[HEAVE, PITCH] == pytest.approx(0.0, abs=1.0)  # fore-aft symmetric hull
    assert not np.isnan(ds.to_array()).any()


def test_surge_is_a_spheroid_and_can_be_left_out():
    """Lamb art. 114: about 2 % of the mass for a ship five times longer than the equal spheroid is broad."""
    vessel = ship("series60-cb60")
    share = hydrodynamics6(vessel, [0.5]).added_mass[0, 0, 0].item() / hydrostatics(vessel).mass
    assert 0.01 < share < 0.04
    without = hydrodynamics6(vessel, [0.5], surge="zero")
    assert not without.added_mass[0, 0].any()
    assert list(without.mode.to_numpy()) == list(SIX_MODES)


def test_strip_integrals_meet_an_independent_strip_program_on_wigley_iii():
    """The other program's stations are not given; sums of 21 to 41 of them without the stem lines bracket its numbers.

    The two stem lines are deep plates with added mass but no area; a program that ends in empty sections loses half a
    station of them at each end, 1 to 5 % of A22 and (the lever squared) 5 to 15 % of A66. 6 % is left for the rest.
    """
    mode = {"2": 1, "4": 3, "6": 5}
    for row in reference("wigley3_strip_over_3d.csv"):
        omega, name = float(row["omega_sqrt_L_over_g"]) * SQRT_G_OVER_L, row["coefficient"]
        found = []
        for stations in (21, 41):
            x, step = np.linspace(-1.5, 1.5, stations, retstep=True)
            matrices = wigley_matrices(x[1:-1], np.full(stations - 2, step), omega)
            found.append(abs(matrices[name[0]][mode[name[1]], mode[name[2]]]))
        assert 0.94 * min(found) < float(row["strip_Lewis"]) < 1.06 * max(found), row


def wigley_iii():
    x = np.linspace(-1.5, 1.5, 33)
    t = np.linspace(1.0, 0.0, 25)
    contours = tuple(
        (np.append(b * (1 - t**2), b), 0.1875 * np.append(1 - t, 1.3))
        for b in 0.15 * (1 - (x / 1.5) ** 2) * (1 + 0.2 * (x / 1.5) ** 2)
    )
    hull = hull_from_offsets("Wigley III", length=3.0, beam=0.3, draught=0.1875, x=x, contours=contours)
    return Ship("Wigley III", hull, Loading(gm=0.05, kg=0.1875, gyradius_roll=0.1, gyradius_yaw=0.75, density=1000.0))


# Smallest and largest ratio to 3-D panels at omega sqrt(L/g) from 3 to 5; the other strip program has A22 0.89 .. 1.01.
STRIP_OVER_3D = {
    ("A", "heave"): (0.9, 1.05),
    ("B", "heave"): (0.95, 1.05),
    ("A", "sway"): (0.85, 1.1),
    ("B", "sway"): (1.0, 1.3),
}


@pytest.mark.parametrize(("quantity", "mode"), list(STRIP_OVER_3D))
def test_wigley_iii_against_three_dimensional_panels(quantity, mode):
    """Capytaine 3.0.0. Strip theory is a theory of short waves: from omega sqrt(L/g) = 3 on it holds as given above."""
    rows = [
        r
        for r in reference("wigley3_radiation_3d.csv")
        if (r["quantity"], r["force"], r["motion"]) == (quantity, mode, mode)
    ]
    rows = [r for r in rows if float(r["omega"]) > 2.99 * SQRT_G_OVER_L]
    ds = hydrodynamics6(wigley_iii(), [float(r["omega"]) for r in rows], reference="waterline")
    ours = ds["added_mass" if quantity == "A" else "damping"].sel(mode=mode, mode_of_motion=mode)
    ratio = ours.to_numpy() / [float(r["value"]) for r in rows]
    low, high = STRIP_OVER_3D[quantity, mode]
    assert low < ratio.min()
    assert ratio.max() < high


def test_heave_of_sections_that_are_no_lewis_forms_is_solved_on_their_own_contour():
    """Box of B/T 4: a33 at infinite frequency is 2.142064 rho B T by the Schwarz-Christoffel map; its Lewis form misses it."""
    vessel = ship("box").with_(draught=5.0)
    assert vessel.hull.beam / vessel.hull.draught == 4.0
    exact = 2.142064 * vessel.loading.density * vessel.hull.beam * vessel.hull.draught * vessel.hull.length
    heave = {"mode": "heave", "mode_of_motion": "heave"}
    own, lewis = (
        float(hydrodynamics6(v, [0.8]).added_mass_infinite.sel(heave)) for v in (vessel, vessel.with_(sections="lewis"))
    )
    assert own == pytest.approx(exact, rel=1e-3)
    assert lewis != pytest.approx(exact, rel=1e-2)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"frequency": [0.0, 1.0]}, "limits"),
        ({"frequency": [np.nan]}, "no finite number"),
        ({"frequency": [1.0], "speed": -1.0}, "heading tells"),
        ({"frequency": [1.0], "axes": "earth"}, "body, seakeeping"),
        ({"frequency": [1.0], "low_frequency": "manoeuvring"}, "cap, drop"),
        ({"frequency": [1.0], "reference": "keel"}, "waterline"),
    ],
)
def test_bad_input_is_answered_with_what_is_allowed(arguments, said):
    with pytest.raises(InputError, match=said):
        hydrodynamics6(ship("wigley"), **arguments)
