"""Three-dimensional ends: limits, causality, the way they are chosen and refused."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

import quartering as qt
from quartering.conventions import InputError
from quartering.hull.lines.hull import scaled
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.mesh import hull_grid
from quartering.hull.lines.stations import hull_from_offsets
from quartering.hydro.strip.double_body import double_body
from quartering.hydro.strip.ends import PANELS, _effect, end_effect
from quartering.hydro.strip.ends import with_ends as add_ends
from quartering.hydro.strip.hull_table import hull_table
from quartering.hydro.strip.integrals import moment_matrix, section_moments
from quartering.hydro.strip.kramers_kronig import kramers_kronig
from quartering.hydro.strip.moments import hull_moments, section_table
from quartering.hydro.strip.table import radiation_table
from tests.tiers import mostly_soak

SHIPS = ["series60-cb60", "series60-cb80", "wigley", "s175", "mariner", "dtc", "dtmb5415", "box"]


def with_ends(name):
    return qt.ship(name).with_(ends="three-dimensional")


@lru_cache
def integrals(hull, part="a_zero"):
    """Sway, roll and yaw added mass by strips and with three-dimensional ends (2, 3, 3) over density."""
    immersed = strips(hull)
    found = [
        getattr(hull_table(replace(hull, ends=ends), [0.0], 1.0), part) for ends in ("strips", "three-dimensional")
    ]
    return np.array([moment_matrix(section_moments(immersed.x, immersed.weight, part)) for part in found])


def test_the_bytes_do_not_depend_on_the_threads_of_the_linear_algebra():
    """Panels of a hull are one large system, which a library shares out among as many threads as it may have."""
    grid, found = hull_grid(qt.ship("wigley").hull, *PANELS), []
    for threads in (1, 2, 3):
        with threadpool_limits(limits=threads, user_api="blas"):
            found.append([part.tobytes() for part in _effect(grid)])
    assert found[0] == found[1] == found[2]


@pytest.mark.parametrize("name", mostly_soak(SHIPS, "wigley", "dtmb5415"))
def test_sections_add_up_to_the_hull_in_three_dimensions(name):
    """At zero frequency the integrals over the sections change by what panels change against the same panels by strips.

    Over the geometric mean of the diagonal terms; stations and columns of panels see stem and bilge differently by 2 %, a
    sonar dome by 3 %.
    """
    hull = qt.ship(name).hull
    body = double_body(hull_grid(hull, *PANELS))
    found = np.einsum("nmi,nmj->ij", body.hull[0], body.velocity) - np.einsum(
        "nmi,nmj->ij", body.sections[0], body.along
    )
    by_strips, whole = integrals(hull)
    scale = np.sqrt(np.outer(by_strips.diagonal()[:2], by_strips.diagonal()[:2]))
    off = (whole - by_strips)[:2, :2] + (found + found.T)
    assert (np.abs(off / scale) < (0.03 if name == "dtmb5415" else 0.02)).all(), off / scale


@pytest.mark.parametrize("name", mostly_soak(["series60-cb60", "wigley"], "wigley"))
def test_long_ships_go_to_strips(name):
    """Stations set twice and four times as far apart: the share of the ends falls like 1/L, for an end has one size."""
    hull = qt.ship(name).hull
    share = []
    for times in (1.0, 2.0, 4.0):
        by_strips, whole = integrals(scaled(hull, times, 1.0, 1.0))
        share.append(1 - whole.diagonal()[:2] / by_strips.diagonal()[:2])
    ratio = np.array(share)[1:] / np.array(share)[:-1]
    assert (np.abs(ratio - 0.5) < 0.1).all(), ratio  # the longer hull has the same number of panels


@pytest.mark.parametrize("name", mostly_soak(SHIPS, "wigley", "dtmb5415", "box"))
def test_the_ship_is_never_pushed_by_the_waves_she_makes(name):
    """Damping and added mass are positive definite at every frequency, as energy demands, and damping is below the strips'."""
    ship = with_ends(name)
    frequency = section_table(ship.hull, 1025.0).frequency
    ours, strip = (
        hull_moments(hull, 1025.0).at(frequency) for hull in (ship.hull, qt.ship(name).with_(ends="strips").hull)
    )
    for matrix in (moment_matrix(ours.b), moment_matrix(ours.a)):
        size = np.sqrt(np.einsum("fii->fi", matrix).max(axis=0))
        assert np.linalg.eigvalsh(matrix / size / size[:, None]).min() > -1e-9
    own, before = (np.einsum("fii->fi", moment_matrix(m.b)) for m in (ours, strip))
    assert (own <= before * (1 + 1e-9) + 1e-9 * before.max(axis=0)).all()


@pytest.mark.parametrize("name", ["series60-cb60", "wigley"])
def test_added_mass_and_damping_belong_together(name):
    """Kramers and Kronig hold for the scaled memory of every section as they do without the ends.

    (Not for the part that fades into short waves, which is real; so the change at zero frequency is left out here.)
    """
    hull = with_ends(name).hull
    effect = end_effect(hull)
    remembered = effect._replace(change=0.0 * effect.change)
    frequency = np.append(0.0, section_table(hull, 1025.0).frequency)
    table = radiation_table(strips(hull), frequency, 1025.0)
    found = add_ends(table, strips(hull), remembered, hull.draught)
    kept = slice(1, None)
    found = replace(found, frequency=frequency[kept], a=found.a[kept], b=found.b[kept], psi=found.psi[kept])
    assert kramers_kronig(found).consistent


@pytest.mark.parametrize("name", mostly_soak(["series60-cb60", "wigley", "s175"], "wigley"))
def test_memory_in_sway_is_that_of_panels(name):
    """Both limits of the frequency are solved: their difference, over that of the strips, is the panels' within 2 %."""
    hull = qt.ship(name).hull
    body = double_body(hull_grid(hull, *PANELS))
    ours, theirs = (
        ((potential[0] - potential[1]) * flux)[..., 0].sum()
        for potential, flux in ((body.hull, body.velocity), (body.sections, body.along))
    )
    still, fast = integrals(hull)[0], integrals(hull, "a_infinite")
    memory = still[0, 0] - fast[:, 0, 0]
    assert memory[1] / memory[0] == pytest.approx(ours / theirs, abs=0.02)


def test_the_correction_fades_into_short_waves():
    """Closed form: (1 + 2 K T) e^{-2 K T} of the change at zero frequency is left, K = w^2/g."""
    hull = with_ends("wigley").hull
    frequency = np.array([0.0, 0.4, 0.8, 1.6])
    ours = hull_table(hull, frequency, 1025.0)
    theirs = hull_table(replace(hull, ends="strips"), frequency, 1025.0)
    m = np.interp(strips(hull).x, end_effect(hull).x, end_effect(hull).memory)[:, None, None]
    left = ours.psi - theirs.psi[0] - m * (theirs.psi - theirs.psi[0])
    short = 2.0 * hull.draught * frequency**2 / 9.81
    fading = (1.0 + short) * np.exp(-short)
    np.testing.assert_allclose(left, fading[:, None, None, None] * left[0], rtol=0, atol=1e-9 * np.abs(left[0]).max())


def test_strips_alone_are_had_by_name():
    ship = qt.ship("wigley").with_(ends="strips")
    assert ship.hull.ends == "strips"
    plain = qt.hydrodynamics(ship, [0.5], 5.0)
    back = qt.hydrodynamics(ship.with_(ends="three-dimensional").with_(ends="strips"), [0.5], 5.0)
    assert plain.identical(back)


def test_zero_frequency_may_be_asked_for_alone():
    """One call at w = 0 alone, and one from 0 on, give the same."""
    hull = with_ends("wigley").hull
    one, more = hull_table(hull, [0.0], 1025.0), hull_table(hull, [0.0, 0.5], 1025.0)
    assert one.frequency.tolist() == [0.0]
    assert one.a[0] == pytest.approx(more.a[0], rel=1e-6)
    assert np.allclose(one.a[0], one.a_zero, rtol=2e-3, atol=2e-3 * one.a_zero.max())


@pytest.mark.parametrize("name", SHIPS)
def test_effect_is_small_amidships(name):
    """Slender bodies: amidships a section is nearly the infinitely long one strips take it for."""
    effect = end_effect(qt.ship(name).hull)
    assert ((effect.memory >= 0) & (effect.memory <= 1)).all()
    middle = np.abs(effect.x) < 0.1 * qt.ship(name).hull.length
    assert (effect.memory[middle] > 0.85).all()
    assert np.isfinite(effect.change).all()
    assert (np.diff(effect.x) > 0).all()


def test_bare_skeg_is_as_one_of_finite_thickness():
    """Two sides of a skeg in the centre plane are opposite one another; one of 2 % of the half breadth is an ordinary body."""

    def hull(thickness):
        x, height = np.linspace(-50.0, 50.0, 21), np.linspace(0.0, 9.0, 31)
        rise = np.clip(height / 6, 0, 1) ** 0.4
        cut = np.maximum(np.clip(height / 3 - 1, 0, 1) ** 0.4, thickness)
        contours = tuple((8 * (1 - (s / 50) ** 2) * (cut if s < -20 else rise), height) for s in x)
        return hull_from_offsets("skeg", length=100.0, beam=16.0, draught=6.0, x=x, contours=contours)

    bare, thick = (integrals(hull(thickness)) for thickness in (0.0, 0.02))
    for mode in (0, 1):
        ratio = [whole[mode, mode] / by_strips[mode, mode] for by_strips, whole in (bare, thick)]
        assert ratio[0] == pytest.approx(ratio[1], abs=0.01)
        assert ratio[0] < 0.93


def test_a_change_of_loading_does_not_solve_the_hull_again():
    ship = with_ends("wigley")
    assert ship.with_(gm=1.0).hull is ship.hull


def test_ship_file_names_the_choice(tmp_path):
    file = tmp_path / "mine.yaml"
    file.write_text("base: wigley\nends: three-dimensional\n")
    ship = qt.ship(file)
    assert ship.hull.ends == "three-dimensional"
    entries = {entry.name: entry for entry in qt.coefficients(ship, 0.5, 5.0).table()}
    assert "three-dimensional ends" in entries["Y_vdot"].source
    assert "three-dimensional ends" in entries["N_r"].source
    assert "three-dimensional ends" in qt.hydrodynamics(ship, [0.5]).attrs["method"]
    forces = qt.wave_forces(ship, qt.Wave(100.0, 2.0))
    assert "three-dimensional ends" in forces.attrs["form_meaning"]
    assert "Morino" in qt.cite(forces)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("base: wigley\nends: round\n", "ends = 'round'; allowed are"),
        ("base: wigley\nends: three-dimensional\ndatabase: my.nc\n", "corrects the strips, and database my.nc"),
    ],
)
def test_ship_file_is_refused_in_one_sentence(tmp_path, text, said):
    (tmp_path / "my.nc").write_bytes(b"not read yet")
    file = tmp_path / "mine.yaml"
    file.write_text(text)
    with pytest.raises(InputError, match=said):
        qt.ship(file)


def test_words_and_databases_are_refused_in_python_too(tmp_path):
    with pytest.raises(InputError, match="ends = 'round'; allowed are"):
        qt.ship("wigley").with_(ends="round")
    (tmp_path / "my.nc").write_bytes(b"not read yet")
    ship = with_ends("wigley")
    with pytest.raises(InputError, match="leave one of the two out"):
        ship.with_(database=tmp_path / "my.nc", ends="three-dimensional")
    assert ship.with_(database=tmp_path / "my.nc").hull.ends == "strips"  # the database has the ends in it
