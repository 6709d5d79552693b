"""Causality of added mass and damping: closed form, published half circle, spoiled databases."""

import csv
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import trapezoid
from scipy.special import dawsn

from quartering.conventions import InputError
from quartering.hull.file.read import ship
from quartering.hydro.added_mass import hydrodynamics, hydrodynamics6
from quartering.hydro.strip.kramers_kronig import kramers_kronig, retardation
from quartering.hydro.strip.moments import section_table
from tests.tiers import mostly_soak

DATA = Path(__file__).parents[1] / "data" / "sections_reference.csv"
OMEGA = np.linspace(0.05, 3.2, 64)


def circle():
    """Reference half circle, sway and heave, as (frequency, a, b) in units of rho A and w sqrt(r/g)."""
    rows = csv.DictReader(line for line in DATA.read_text().splitlines() if not line.startswith("#"))
    table = [row for row in rows if row["section"] == "circle"]
    omega = np.sqrt([float(row["frequency_squared"]) for row in table])
    a, b = (np.array([[float(row[f"{letter}{mode}"]) for mode in ("22", "33")] for row in table]) for letter in "ab")
    return omega, a, b


def dataset(omega, a, b, limit=None):
    """A database of two uncoupled modes."""
    ds = hydrodynamics(ship("wigley").with_(ends="strips"), omega).isel(mode=[0, 1], mode_of_motion=[0, 1])
    full = [np.stack([np.diag(row) for row in values]) for values in (a, b)]
    ds = ds.assign(added_mass=(ds.added_mass.dims, full[0]), damping=(ds.damping.dims, full[1]))
    return ds if limit is None else ds.assign(added_mass_infinite=(("mode", "mode_of_motion"), np.diag(limit)))


def test_closed_pair_is_met():
    """b = u^2 exp(-u^2) has the transform (2/sqrt(pi)) (1/2 - w D(w)), D Dawson's integral."""
    w = np.linspace(0.02, 6.0, 400)
    b = w**2 * np.exp(-(w**2))
    a = 1.0 + 2 / np.sqrt(np.pi) * (0.5 - w * dawsn(w))
    found = kramers_kronig(dataset(w, np.stack([a, a], 1), np.stack([b, b], 1), [1.0, 1.0]))
    assert found.largest < 2e-5
    assert not found.fitted


# alpha = 0.5: passive K^(s) = s/(s^2 + 2 alpha s + 0.81), and s (s + alpha)/(((s + alpha)^2 + 0.81)(s + alpha + 0.9)), which is
# not passive at low frequency; b and a - a_inf at the frequencies below, K(t) at 0.5, 1, 2, 5, 10 (theory of seas, tables
# memory_pair_passive and memory_pair)
MEMORIES = [
    (lambda s: s / (s**2 + s + 0.81),
     (0.00381938145117, 0.0632011376205, 0.443577004968, 0.956794737629, 0.965157803301, 0.520399666944, 0.174368646007),
     (1.23366020873, 1.21662189919, 0.993612491128, 0.254148602183, -0.183379982627, -0.333055786844, -0.151770469484),
     (0.534728901774, 0.168738325817, -0.217877501957, -0.0367737300318, -0.00175549841308)),
    (lambda s: s * (s + 0.5) / (((s + 0.5) ** 2 + 0.81) * (s + 1.4)),
     (-0.000283292427721, -0.00329507589782, 0.0275907736453, 0.290053895149, 0.554086370149, 0.586178909144, 0.266577900898),
     (0.338766029189, 0.365975564606, 0.496633925615, 0.536501714846, 0.337299236263, -0.0962467898569, -0.111743877212),
     (0.278597161485, -0.0939503061111, -0.249922797391, 0.0592734151656, -0.00352336685589)),
]  # fmt: skip


@pytest.mark.parametrize(("memory", "damping", "added", "kernel"), MEMORIES, ids=["passive", "not passive"])
def test_memories_of_closed_form_are_met(memory, damping, added, kernel):
    """Kernel to 1e-6 from damping up to 400 rad/s; added mass from damping up to 20 rad/s to 5e-3."""
    omega = np.array([0.05, 0.2, 0.5, 0.8, 1.0, 1.5, 2.5])
    np.testing.assert_allclose(memory(1j * omega).real, damping, rtol=0, atol=1e-12)
    np.testing.assert_allclose(memory(1j * omega).imag / omega, added, rtol=0, atol=1e-11)
    fine = np.linspace(0.01, 400.0, 40_000)
    found = retardation(fine, memory(1j * fine).real, np.array([0.5, 1.0, 2.0, 5.0, 10.0]))
    np.testing.assert_allclose(found, kernel, rtol=0, atol=1e-6)
    w = np.linspace(0.02, 20.0, 1000)
    a, b = 1.0 + memory(1j * w).imag / w, memory(1j * w).real
    checked = kramers_kronig(dataset(w, np.stack([a, a], 1), np.stack([b, b], 1), [1.0, 1.0]))
    assert checked.largest < 5e-3


def test_published_half_circle_belongs_together():
    """Half circle, multipole reference good to 2e-5 with its limits 4/pi^2 (sway) and 1 (heave) of rho A."""
    omega, a, b = circle()
    found = kramers_kronig(dataset(omega, a, b, [4 / np.pi**2, 1.0]))
    assert found.consistent
    sway, heave = np.abs(found.difference[:, [0, 1], [0, 1]]).T
    assert sway.max() < 0.015  # at the end of the table, where the rest of the damping is a guess
    assert heave.max() < 0.035  # at its beginning, where heave grows like ln(1/w) and the table is coarse
    assert np.median(heave) < 1e-3
    fitted = kramers_kronig(dataset(omega, a, b))
    assert np.median(np.abs(fitted.difference[:, [0, 1], [0, 1]])) < 1e-3
    assert fitted.fitted
    assert np.diag(fitted.added_mass_infinite) == pytest.approx([4 / np.pi**2, 1.0], abs=0.02)


@pytest.mark.parametrize("name", mostly_soak(["wigley", "series60-cb60", "box", "s175"], "wigley", "box"))
def test_sections_and_whole_ships_of_the_library_belong_together(name):
    """Property: the added mass comes from pressures, the damping from radiated waves; causality ties them."""
    vessel = ship(name).with_(ends="strips")
    sections = kramers_kronig(section_table(vessel.hull, 1025.0))
    assert sections.consistent, sections.sentence
    whole = kramers_kronig(hydrodynamics6(vessel, OMEGA))
    assert whole.consistent, whole.sentence
    assert np.median(np.abs(whole.difference)) < 1e-3


def spoiled(how):
    ds = hydrodynamics6(ship("series60-cb60").with_(ends="strips"), OMEGA)
    a, b = ds.added_mass.to_numpy().copy(), ds.damping.to_numpy().copy()
    if how == "irregular frequency":
        a[30:32, 1, 1] *= np.array([1.35, 0.7])
    elif how == "damping of half the size":
        b[:, 1, 1] *= 0.5
    elif how == "sign of the coupling":
        b[:, 1, 3] *= -1.0
        b[:, 3, 1] *= -1.0
    elif how == "another reference point":
        b[:] = hydrodynamics6(ship("series60-cb60").with_(ends="strips"), OMEGA, reference=(0.0, -6.0)).damping
    return ds.assign(added_mass=(ds.added_mass.dims, a), damping=(ds.damping.dims, b))


@pytest.mark.parametrize(
    ("how", "entry"),
    [
        ("irregular frequency", ("sway", "sway")),
        ("damping of half the size", ("sway", "sway")),
        ("sign of the coupling", None),
        ("another reference point", None),
    ],
)
def test_a_spoiled_database_is_found_out(how, entry):
    """Faults put in by hand; the sound database passes, see above."""
    found = kramers_kronig(spoiled(how))
    assert not found.consistent
    assert "do not belong together" in found.sentence
    if entry:
        assert found.worst[0] == entry
    if how == "irregular frequency":
        assert found.worst[1] in OMEGA[30:32]


def test_retardation_gives_the_added_mass_back():
    """a(w) - a(inf) = -(1/w) int K sin(w t) dt (Cummins 1962), against the transform of the damping itself."""
    ds = hydrodynamics6(ship("box").with_(ends="strips"), OMEGA)
    time = np.linspace(0.0, 60.0, 3001)
    memory = retardation(OMEGA, ds.damping.to_numpy()[:, 1, 1], time)
    infinite = ds.added_mass_infinite.to_numpy()[1, 1]
    a = ds.added_mass.to_numpy()[:, 1, 1]
    for k in range(5, 50, 6):
        wave = np.sin(OMEGA[k] * time)
        back = infinite - trapezoid(memory * wave, time) / OMEGA[k]
        assert back == pytest.approx(a[k], abs=0.01 * np.abs(a - infinite).max())


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda ds: ds.isel(frequency=slice(5)), "at least 8"),
        (lambda ds: ds.isel(frequency=slice(None, None, -1)), "ascending"),
        (lambda ds: ds.drop_vars("damping"), "neither"),
        (lambda ds: ds.assign_attrs(speed=5.0), "speed 0"),
        (lambda ds: ds.assign(damping=ds.damping * np.nan), "finite"),
    ],
)
def test_bad_input_is_answered_with_what_is_needed(change, said):
    with pytest.raises(InputError, match=said):
        kramers_kronig(change(hydrodynamics(ship("wigley").with_(ends="strips"), OMEGA)))
