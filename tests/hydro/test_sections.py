import warnings

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from quartering.conventions import GRAVITY, InputError, RangeWarning
from quartering.hull.lines.section import Section
from quartering.hydro.section.dataset import immersed_area, section_coefficients
from quartering.hydro.section.multipole import radiation
from quartering.hydro.strip.table import default_frequencies, radiation_table
from tests.hydro.section_cases import bare_strips

DENSITY = 1025.0
SHIP_SECTIONS = bare_strips(
    half_breadth=np.array([0.05, 0.3, 1.0, 4.0, 8.0, 8.75, 8.75, 8.0, 4.0, 8.0]),
    draught=np.array([7.0, 7.0, 7.0, 7.0, 7.0, 7.0, 7.0, 4.0, 1.0, 0.2]),
    area=np.array([0.35, 2.5, 9.0, 45.0, 100.0, 118.0, 121.0, 40.0, 5.0, 2.0]),
)


def test_pressure_on_the_table_contour_gives_the_table_coefficients():
    w = np.array([0.2, 0.5, 0.9, 1.5, 2.2])
    t = radiation_table(SHIP_SECTIONS, w, DENSITY, method="lewis")
    n = np.stack([t.ny, t.y * t.nz - t.z * t.ny], axis=-1)
    integral = -2.0 * DENSITY * np.einsum("fsni,snj->fsij", t.psi, n)
    for i, j, column in ((0, 0, 0), (0, 1, 1), (1, 0, 1), (1, 1, 2)):
        expected = t.a[..., column] + t.b[..., column] / (1j * w[:, None])
        scale = np.sqrt(np.abs(t.a_zero[:, 2 * i] * t.a_zero[:, 2 * j]))
        assert (np.abs(integral[..., i, j] - expected) / scale).max() < 2e-5


def test_table_contour_is_closed_and_its_normals_point_into_the_water():
    t = radiation_table(SHIP_SECTIONS, [1.0], DENSITY, method="lewis")
    assert np.allclose(t.ny.sum(axis=1), t.forms.draught)  # int n_y ds over the starboard half
    assert np.allclose(t.nz.sum(axis=1), t.forms.half_breadth)
    assert np.allclose(2.0 * (t.z * t.nz).sum(axis=1), t.forms.area)
    assert np.allclose((t.y * t.ny).sum(axis=1), (t.z * t.nz).sum(axis=1))


def test_haskind_relation_between_damping_and_total_force_in_a_beam_sea():
    """b_jj = w |X_j|^2/(rho g^2 A^2): X from Froude-Krylov plus diffraction pressures, b from radiated waves."""
    w = np.array([0.3, 0.6, 0.9, 1.3, 1.8])
    t = radiation_table(SHIP_SECTIONS, w, DENSITY, method="lewis")
    k = (w**2 / GRAVITY)[:, None, None]
    decay, sine, cosine = np.exp(-k * t.z), np.sin(k * t.y), np.cos(k * t.y)
    n = np.stack([t.ny, t.y * t.nz - t.z * t.ny], axis=-1)
    froude_krylov = -2.0 * np.einsum("fsn,snj->fsj", 1j * DENSITY * GRAVITY * decay * (-1j * sine), n)
    sigma = w[:, None, None]
    through = 1j * sigma * decay * cosine * t.ny + sigma * decay * (-1j * sine) * t.nz  # u_I . n ds
    scatter = 2.0 * DENSITY * np.einsum("fsnj,fsn->fsj", t.psi, through)
    total = froude_krylov - 1j * sigma * scatter
    damping = t.b[..., [0, 2]]
    by_force = sigma * np.abs(total) ** 2 / (DENSITY * GRAVITY**2)
    assert np.allclose(by_force, damping, rtol=1e-3, atol=1e-5 * damping.max(axis=0))


def test_limits_of_the_table_enclose_its_frequencies():
    t = radiation_table(SHIP_SECTIONS, default_frequencies(17.5, 7.0), DENSITY, method="lewis")
    scale = np.sqrt(t.a_zero[:, [0]] * t.a_zero[:, [2]])
    assert np.allclose(t.a[0, :, 0], t.a_zero[:, 0], rtol=2e-3)
    assert (np.abs(t.a[0, :, 1] - t.a_zero[:, 1])[:, None] < 2e-3 * scale).all()
    assert np.allclose(t.a[0, :, 2], t.a_zero[:, 2], rtol=2e-3)
    assert (t.a_infinite[:, 0] < t.a_zero[:, 0]).all()


def lagrange(x, values, at):
    first = np.clip(np.searchsorted(x, at) - 2, 0, x.size - 4)
    near = x[first[:, None] + np.arange(4)]
    total = 0.0
    for i in range(4):
        others = [j for j in range(4) if j != i]
        weight = np.prod([(at - near[:, j]) / (near[:, i] - near[:, j]) for j in others], axis=0)
        total = total + weight.reshape(-1, *[1] * (values.ndim - 1)) * values[first + i]
    return total


def test_standard_frequencies_carry_cubic_interpolation_to_a_ten_thousandth():
    w = default_frequencies(17.5, 7.0)
    between = 0.5 * (w[1:] + w[:-1])
    table, exact = (radiation_table(SHIP_SECTIONS, f, DENSITY, method="lewis") for f in (w, between))
    peak_a, peak_b = (np.abs(v[..., [0, 2]]).max(axis=0) for v in (exact.a, exact.b))
    for known, wanted, peak in ((table.a, exact.a, peak_a), (table.b, exact.b, peak_b)):
        scale = np.stack([peak[:, 0], np.sqrt(peak[:, 0] * peak[:, 1]), peak[:, 1]], axis=-1)
        assert (np.abs(lagrange(w, known, between) - wanted) / scale).max() < 1e-4
        assert (np.abs(CubicSpline(w, known)(between) - wanted) / scale).max() < 3e-5
    scale = np.abs(exact.psi).max(axis=(0, 2))
    assert (np.abs(lagrange(w, table.psi, between) - exact.psi) / scale[:, None]).max() < 1e-4


@pytest.mark.parametrize(
    ("frequency", "density", "word"),
    [
        ([1.0, 0.5], DENSITY, "ascending"),
        ([np.nan], DENSITY, "frequency"),
        ([1.0], 0.0, "density"),
        ([-1.0], 1e3, ">= 0"),
    ],
)
def test_impossible_tables_are_refused(frequency, density, word):
    with pytest.raises(InputError, match=word):
        radiation_table(SHIP_SECTIONS, frequency, density, method="lewis")


@pytest.mark.parametrize(("beam", "draught", "count"), [(0.0, 1.0, 60), (1.0, np.nan, 60), (1.0, 1.0, 3)])
def test_impossible_frequency_grids_are_refused(beam, draught, count):
    with pytest.raises(InputError):
        default_frequencies(beam, draught, count)


def circle_section(radius=3.0):
    t = np.linspace(0.0, np.pi / 2.0, 2001)
    return Section(y=radius * np.sin(t), z=radius * np.cos(t))


def test_dataset_of_a_half_circle_with_units_and_axes():
    r = 3.0
    ds = section_coefficients(circle_section(r), np.sqrt(GRAVITY / r * np.array([0.5, 1.0])))
    unit = 1025.0 * np.pi * r**2 / 2.0
    # theory reference, semicircle: a22, a33 at nu r = 0.5, 1; the polygon's area is short by 1e-7
    assert np.allclose(ds.a22 / unit, [0.9932860944, 0.3817802044], rtol=1e-5)
    assert np.allclose(ds.a33 / unit, [0.6446308747, 0.6049768849], rtol=1e-5)
    assert np.abs(ds.a24).max() < 1e-5 * unit * r
    assert ds.attrs["method"] == "close-fit"
    assert "z down" in ds.attrs["axes"]
    assert ds.attrs["reference_point"].startswith("centre of the waterline")
    assert ds.attrs["water_density"] == 1025.0
    assert ds.attrs["remark"] == ""
    for name in ("a22", "b22", "a24", "b24", "a44", "b44", "a33", "b33"):
        assert ds[name].dims == ("frequency",)
        assert set(ds[name].attrs) == {"units", "long_name", "symbol"}


def test_narrow_section_is_pushed_below_the_waterline():
    narrow = Section(y=[0.0, 0.4, 0.5, 0.5], z=[2.0, 1.8, 1.0, 0.0])
    ds = section_coefficients(narrow, [0.5])
    assert float(ds.a24[0]) < 0.0  # a force to port below the waterline has a negative moment about it, z down


@pytest.mark.parametrize(
    ("section", "word"),
    [
        (Section(y=[0.0, 1.0, 0.0], z=[3.0, 2.0, 1.0]), "half breadth"),  # submerged bulb
        (Section(y=[0.0, 0.0], z=[3.0, 0.0]), "half breadth"),  # bare centre plane
        (Section(y=[0.0, 0.2, 2.0], z=[1.0, 0.5, 0.0]), "area coefficient"),  # hollow
    ],
)
def test_section_unlike_any_form_warns_once_and_gives_numbers(section, word):
    with pytest.warns(RangeWarning, match=word) as caught:
        ds = section_coefficients(section, np.linspace(0.1, 3.0, 20), "lewis")
    assert len(caught) == 1
    assert word in ds.attrs["remark"]
    assert all(np.isfinite(ds[name]).all() for name in ds.data_vars)


def test_submerged_bulb_keeps_its_area_where_the_forms_allow():
    t = np.linspace(0.0, np.pi, 400)
    bulb = Section(y=0.4 * np.sin(t), z=3.0 + 0.4 * np.cos(t))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)
        ds = section_coefficients(bulb, [1.0], "lewis")
    area = 2.0 * ds.attrs["lewis_half_breadth"] * ds.attrs["lewis_draught"] * ds.attrs["lewis_area_coefficient"]
    assert area == pytest.approx(np.pi * 0.4**2, rel=1e-3)


def test_zero_frequency_has_added_mass_and_no_damping():
    ds = section_coefficients(circle_section(1.0), [0.0])
    assert float(ds.a22[0]) == pytest.approx(1025.0 * np.pi / 2.0, rel=1e-5)
    assert np.isposinf(ds.a33[0])
    assert float(ds.b22[0]) == float(ds.b33[0]) == 0.0


def test_bad_input_to_section_coefficients_is_refused():
    with pytest.raises(InputError, match="allowed: auto, lewis"):
        section_coefficients(circle_section(), [1.0], method="panel")
    with pytest.raises(InputError, match="density"):
        section_coefficients(circle_section(), [1.0], density=-1.0)
    with pytest.raises(InputError, match="it is from 0 rad/s to 10000 rad/s"):
        section_coefficients(circle_section(), [-1.0])


def test_immersed_area_cuts_the_contour_at_the_calm_plane():
    # trapezium: bottom 2 wide, 4 wide at z = 0 and on to 6 above the water: area = (2 + 4)/2 * 1
    assert immersed_area(Section(y=[0.0, 1.0, 3.0], z=[1.0, 1.0, -1.0])) == pytest.approx(3.0)
    assert immersed_area(Section(y=[0.0, 2.0, 2.0], z=[1.5, 1.5, 0.0])) == pytest.approx(6.0)


def test_table_and_dataset_agree():
    w = [0.4, 1.1]
    table = radiation_table(bare_strips(3.0, 3.0, 9.0 * np.pi / 2.0), w, DENSITY, method="lewis")
    ds = section_coefficients(circle_section(), w, "lewis")
    assert np.allclose(table.a[:, 0, 0], ds.a22, rtol=1e-6)
    assert np.allclose(table.b[:, 0, 0], ds.b22, rtol=1e-5)


def test_density_scales_forces_only():
    one, two = (radiation_table(SHIP_SECTIONS, [0.8], rho, method="lewis") for rho in (1000.0, 2000.0))
    assert np.allclose(2.0 * one.a, two.a)
    assert np.allclose(2.0 * one.b, two.b)
    assert np.allclose(one.psi, two.psi)
    assert np.allclose(one.psi, radiation(one.forms, [0.8]).potential)
