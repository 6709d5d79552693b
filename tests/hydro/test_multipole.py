import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import exp1

from quartering.conventions import GRAVITY, InputError
from quartering.hydro.section.lewis import area_coefficient_limits, lewis_forms
from quartering.hydro.section.multipole import radiation
from quartering.hydro.section.wavemaker import POWERS, wavemaker
from tests.hydro.section_cases import read_table

# nu r: a22, b22, a33, b33 over rho pi r^2/2 (b also over w); semi-analytic, good to 1e-7 (theory reference, semicircle)
SEMICIRCLE = {
    0.1: (1.15681864039769, 0.0639718505562474, 1.4095049331799034, 1.7350762833022577),
    0.25: (1.3040288045335653, 0.3738865916516014, 0.8779899296918, 1.244740235988929),
    0.5: (0.9932860944084845, 0.8512277067246575, 0.6446308746716317, 0.811491884138951),
    1.0: (0.38178020438550037, 0.7472072783034501, 0.60497688487708, 0.3963432850507398),
    1.5: (0.22568444844709676, 0.5264686200932802, 0.6649245974864405, 0.21162400897428177),
    2.0: (0.18854079077724437, 0.3842206594698089, 0.726582723816828, 0.12075909767970296),
}
RANGE_OF_SHAPES = [(H, share) for H in (0.02, 0.1, 0.5, 1.0, 2.0, 5.0, 20.0, 50.0) for share in (0.02, 0.2, 0.6, 0.95)]


def shapes(pairs):
    """Forms of unit size (the larger of half breadth and draught), by breadth ratio and place in the area range."""
    H, share = np.array(pairs).T
    lower, upper = area_coefficient_limits(H)
    size = np.maximum(H, 1.0)
    return lewis_forms(H / size, 1.0 / size, 2.0 * H * (lower + share * (upper - lower)) / size**2)


def test_semicircle_of_the_theory_reference():
    expected = np.array(list(SEMICIRCLE.values()))
    w = np.sqrt(GRAVITY * np.array(list(SEMICIRCLE)))
    circle = lewis_forms(1.0, 1.0, np.pi / 2.0)
    lateral, heave = (radiation(circle, w, modes, density=1.0) for modes in ("lateral", "heave"))
    got = np.stack(
        [
            lateral.added_mass[:, 0, 0, 0],
            lateral.damping[:, 0, 0, 0] / w,
            heave.added_mass[:, 0, 0, 0],
            heave.damping[:, 0, 0, 0] / w,
        ],
        axis=-1,
    ) / (np.pi / 2.0)
    assert np.allclose(got, expected, rtol=1e-6, atol=0)
    roll = [lateral.added_mass[..., 1], lateral.damping[..., 1], lateral.wave[..., 1:]]
    assert max(np.abs(part).max() for part in roll) < 1e-12  # a circle rolls without moving water


@pytest.mark.parametrize("name", ["circle", "lewis-2.0-0.90", "lewis-2.4-0.95", "lewis-2.5-0.70"])
def test_independent_multipole_solution_with_forces_by_haskind(name):
    rows = [row for row in read_table("sections_reference.csv") if row["section"] == name]
    table = {key: np.array([float(row[key]) for row in rows]) for key in rows[0] if key != "section"}
    B = table["breadth_to_draught"][0]
    A = B * table["area_coefficient"][0]
    nu = 2.0 * table["frequency_squared"] / B
    forms, w, unit = lewis_forms(B / 2.0, 1.0, A), np.sqrt(GRAVITY * nu), np.sqrt(B / 2.0 / GRAVITY)
    lateral, heave = (radiation(forms, w, modes, density=1.0) for modes in ("lateral", "heave"))
    a, b = lateral.added_mass[:, 0], lateral.damping[:, 0] * unit
    got = {
        "a22": a[:, 0, 0] / A,
        "b22": b[:, 0, 0] / A,
        "a24": a[:, 0, 1] / (A * B),
        "b24": b[:, 0, 1] / (A * B),
        "a44": a[:, 1, 1] / (A * B**2),
        "b44": b[:, 1, 1] / (A * B**2),
        "a33": heave.added_mass[:, 0, 0, 0] / A,
        "b33": heave.damping[:, 0, 0, 0] * unit / A,
        "f2": np.abs(lateral.wave[:, 0, 0]) / (nu * A),  # |F| = rho g |D|, Haskind
        "f3": np.abs(heave.wave[:, 0, 0]) / B,
        "f4": 12.0 * np.abs(lateral.wave[:, 0, 1]) / (nu * B**3),
    }
    for key, values in got.items():
        assert np.allclose(values, table[key], rtol=0, atol=2e-5), key  # the table's stated error


@pytest.mark.parametrize("quantity", ["a22", "b22", "a33", "b33", "f2", "f3"])
def test_measurements_of_vugts_on_a_half_circle(quantity):
    rows = [row for row in read_table("vugts_circle.csv") if row["quantity"] == quantity]
    frequency, measured = (np.array([float(row[key]) for row in rows]) for key in ("frequency", "measured"))
    circle, A = lewis_forms(1.0, 1.0, np.pi / 2.0), np.pi / 2.0
    modes = "heave" if "3" in quantity else "lateral"
    w = frequency * np.sqrt(GRAVITY)
    solved = radiation(circle, w, modes, density=1.0)
    computed = {
        "a": solved.added_mass[:, 0, 0, 0] / A,
        "b": solved.damping[:, 0, 0, 0] / A / np.sqrt(GRAVITY),
        "f": np.abs(solved.wave[:, 0, 0]) / (2.0 if modes == "heave" else frequency**2 * A),
    }[quantity[0]]
    assert np.abs(computed - measured).max() < 0.15 * measured.max()  # the data's stated agreement with theory


@pytest.mark.parametrize("symmetry", ["even", "odd"])
def test_wavemaker_of_a_circle_is_the_exponential_integral(symmetry):
    """int_z^inf e^{-iKs} s^-p ds = z^{1-p} E_p(iKz), by recursion from E1; residue (-iK)^{p-1}/(p-1)!."""
    theta = np.linspace(0.05, np.pi / 2 - 0.02, 9)
    xi = np.exp(1j * theta)
    for K in (0.01, 0.5, 3.0):
        z = 1j * K * xi
        integrals = [np.exp(z) * exp1(z)]  # e^z E_p(z)
        for p in range(1, 8):
            integrals.append((1.0 - z * integrals[-1]) / p)
        powers = POWERS[symmetry].astype(int)
        factorial = np.cumprod(np.concatenate([[1.0], np.arange(1.0, 8.0)]))
        residue = np.array([(-1j * K) ** (p - 1) / factorial[p - 1] for p in powers])
        c = residue.real if symmetry == "even" else residue.imag
        weight = c / np.linalg.norm(c)
        strength = weight @ c
        F = sum(w * xi ** (1.0 - p) * integrals[p - 1] for w, p in zip(weight, powers, strict=True))
        wave = np.exp(z)
        if symmetry == "even":
            expected = (F + 1j * np.pi * strength * wave).real - 1j * np.pi * strength * wave.real
        else:
            expected = (F - np.pi * strength * wave).real + 1j * np.pi * strength * wave.imag
        made = wavemaker(np.array([[K]]), np.zeros(1), np.zeros(1), theta, symmetry)
        assert np.allclose(made.potential[0, 0], expected, rtol=0, atol=1e-7 * np.abs(expected).max())


@pytest.mark.parametrize("modes", ["lateral", "heave"])
def test_damping_by_far_waves_equals_damping_by_pressure(modes):
    forms = shapes(RANGE_OF_SHAPES)
    w = np.sqrt(GRAVITY * np.array([0.05, 0.3, 1.0, 3.0, 8.0]))
    solved = radiation(forms, w, modes, density=1.0)
    if modes == "heave":
        velocity = solved.normal.imag[..., None]
    else:
        velocity = np.stack([solved.normal.real, (solved.point.conj() * solved.normal).imag], axis=-1)
    force = -2.0 * np.einsum("fsni,snj->fsij", solved.potential, velocity)
    by_pressure = -w[:, None, None, None] * force.imag
    own = np.sqrt(np.einsum("fsii->fsi", solved.damping).max(axis=0))
    scale = own[..., :, None] * own[..., None, :] + 1e-12
    assert (np.abs(by_pressure - solved.damping) / scale).max() < 1e-4
    assert (
        np.abs(force - force.swapaxes(-1, -2)) * w[:, None, None, None] / scale
    ).max() < 1e-3  # a24 = a42, b24 = b42


def test_one_wave_rule():
    forms = shapes([(0.3, 0.3), (1.0, 0.5), (1.5, 0.6), (4.0, 0.3)])
    b = radiation(forms, np.linspace(0.5, 8.0, 12), density=1.0).damping
    assert np.allclose(b[..., 0, 0] * b[..., 1, 1], b[..., 0, 1] ** 2, rtol=1e-5, atol=0)
    assert (b[..., 0, 0] >= 0).all()


@pytest.mark.parametrize("modes", ["lateral", "heave"])
def test_error_falls_geometrically_with_the_number_of_multipoles(modes):
    forms = shapes([(2.0, 0.02), (0.5, 0.02), (1.0, 0.9), (4.0, 0.7)])  # near the limits of the family: the slowest
    w = np.sqrt(GRAVITY * np.array([0.2, 1.0, 4.0, 10.0]))
    best = radiation(forms, w, modes, density=1.0, points=72, multipoles=26).added_mass
    error = [
        (np.abs(radiation(forms, w, modes, density=1.0, points=40, multipoles=m).added_mass - best)).max()
        for m in (4, 8, 12)
    ]
    assert error[1] < 0.2 * error[0]
    assert error[2] < 0.2 * error[1]
    assert error[2] < 1e-5


def test_default_resolution_is_converged_over_the_range_of_shapes():
    forms = shapes([pair for pair in RANGE_OF_SHAPES if 0.1 <= pair[0] <= 10.0])
    w = np.sqrt(GRAVITY * np.array([1e-3, 0.1, 0.5, 1.0, 3.0, 6.0, 12.0]))
    for modes in ("lateral", "heave"):
        coarse, fine = (
            radiation(forms, w, modes, density=1.0, points=n, multipoles=m) for n, m in ((24, 14), (72, 26))
        )
        size = np.sqrt(np.einsum("fsii->fsi", np.abs(fine.added_mass)).max(axis=0))
        scale = size[:, :, None] * size[:, None, :] + 1e-12
        assert (np.abs(coarse.added_mass - fine.added_mass) / scale).max() < 1e-4
        assert (np.abs(coarse.damping - fine.damping) / (scale * w[:, None, None, None])).max() < 1e-4


def test_any_shape_at_any_frequency_gives_numbers():
    forms = lewis_forms(
        np.array([0.0, 1e-4, 0.01, 0.3, 5.0, 10.0, 10.0, 0.0, 1.0]),
        np.array([7.0, 7.0, 7.0, 7.0, 7.0, 0.05, 1e-3, 0.0, 7.0]),
        np.array([2.0, 0.0, 0.1, 1.0, 69.0, 0.2, 0.0, 0.0, 40.0]),
    )
    w = np.concatenate([[0.0, 1e-9, 1e-4], np.geomspace(0.01, 30.0, 40)])
    for modes in ("lateral", "heave"):
        solved = radiation(forms, w, modes)
        assert np.isfinite(solved.added_mass[1:]).all()
        assert np.isfinite(solved.damping).all()
        assert np.isfinite(solved.potential).all()
    assert np.isposinf(solved.added_mass[0]).all()  # heave at zero frequency has no finite added mass


@settings(max_examples=20, deadline=None)
@given(H=st.floats(0.1, 8.0), share=st.floats(0.05, 0.8), size=st.floats(0.1, 50.0), nu=st.floats(0.05, 8.0))
def test_froude_scaling(H, share, size, nu):
    lower, upper = area_coefficient_limits(H)
    b, T, A = H, 1.0, 2.0 * H * (lower + share * (upper - lower))
    w = np.sqrt(GRAVITY * nu / max(H, 1.0))
    one = radiation(lewis_forms(b, T, A), [w], density=1.0)
    other = radiation(lewis_forms(b * size, T * size, A * size**2), [w / np.sqrt(size)], density=2.0)
    powers = size ** np.array([[2.0, 3.0], [3.0, 4.0]])
    largest = np.abs(one.added_mass).max()
    assert np.allclose(other.added_mass / (2.0 * powers), one.added_mass, rtol=1e-7, atol=1e-8 * largest)
    assert np.allclose(other.damping * np.sqrt(size) / (2.0 * powers), one.damping, rtol=1e-6, atol=1e-8 * largest)


@pytest.mark.parametrize("frequency", [[-1.0], [np.nan], [np.inf], [[1.0, 2.0]]])
def test_impossible_frequencies_are_refused(frequency):
    with pytest.raises(InputError, match="frequency"):
        radiation(lewis_forms(1.0, 1.0, 1.5), frequency)


def test_more_multipoles_than_points_can_carry_are_refused():
    with pytest.raises(InputError, match="at most 8 multipoles"):
        radiation(lewis_forms(1.0, 1.0, 1.5), [1.0], points=12, multipoles=10)
