"""Results over many conditions as one labelled dataset: units, meanings and provenance on everything."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import HEADING_CONVENTION, MODES, REFERENCE_POINT, SYMBOLS
from quartering.hull.ship import Ship
from quartering.hydro.calm_water import calm_water_exponents
from quartering.hydro.coefficients import coefficients
from quartering.hydro.decay.free_roll import damping_words
from quartering.hydro.terms import estimates
from quartering.loads.forces import Form, form_words
from quartering.names import unit
from quartering.options import OPTIONS
from quartering.stability.first_order import RESONANCES
from quartering.study.conditions import FLAGS, RESULTS
from quartering.study.loadings import CHOICE_AXES, VALUE

if TYPE_CHECKING:
    import xarray as xr

EXTRA_DIMS = {
    "q": ("resonance",),
    "q_paper": ("resonance",),
    "slow": ("slow_mode",),
    "multiplier_modulus": ("multiplier",),
    "other_roll_peak": ("other_motion",),
}


def labelled(
    ship: Ship,
    results: Mapping[str, NDArray[np.generic]],
    coordinates: Mapping[str, tuple[tuple[str, ...], NDArray[np.float64]]],
    dims: Sequence[str],
    wave_dims: Sequence[str],
    *,
    form: Form,
    harmonics: int,
) -> xr.Dataset:
    """Dataset of the results of `evaluate`.

    results: shaped as the dims, and for encounter_frequency as the wave dims
    dims: of every condition
    wave_dims: those the encounter frequency depends on
    as computed, for the record
    Returns opens with plain ``xr.open_dataset`` after ``to_netcdf``

    See `polar` and `sweep`, which call this.
    """
    return described(heading_of(ship, form=form, harmonics=harmonics), results, coordinates, dims, wave_dims)


def described(
    heading: Mapping[str, object],
    results: Mapping[str, Any],
    coordinates: Mapping[str, tuple[tuple[str, ...], NDArray[np.float64]]],
    dims: Sequence[str],
    wave_dims: Sequence[str],
) -> xr.Dataset:
    """Dataset of results with a heading that is known already.

    heading: attributes of the whole, see `heading_of`
    as in `labelled`; the arrays may be ones xarray reads when they are used
    """
    import xarray as xr

    variables = {
        name: xr.Variable((*dims, *EXTRA_DIMS.get(name, ())), results[name], attributes(name)) for name in RESULTS
    }
    variables["encounter_frequency"] = xr.Variable(
        tuple(wave_dims), results["encounter_frequency"], attributes("encounter_frequency")
    )
    coords = {name: (where, values, attributes(name)) for name, (where, values) in coordinates.items()}
    coords["resonance"] = (("resonance",), np.array(RESONANCES), {"long_name": "m in n2 = m omega/2", "units": "1"})
    return amplitudes_named(xr.Dataset(variables, coords, dict(heading)))


def amplitudes_named(ds: xr.Dataset) -> xr.Dataset:
    """A dataset with the amplitudes of sway, roll and yaw under names that no method of xarray has, ``roll_amplitude``."""
    named = {f"{mode}_amplitude": ds[mode].variable for mode in MODES}
    return ds.assign({name: (v.dims, v._data, attributes(name)) for name, v in named.items()})


def attributes(name: str) -> dict[str, object]:
    """Units, meaning and letter of a variable, and the meaning of its flags.

    name: of a variable or coordinate
    Returns CF attributes; a coefficient's multiplier has units "1"
    """
    symbol = SYMBOLS.get(name)
    one = OPTIONS.get(name)
    if symbol is None and one is not None:
        return {"units": one.unit or "1", "long_name": one.text, "symbol": one.symbol}
    if symbol is None and name.endswith(VALUE):
        own = name.removesuffix(VALUE)
        return {"units": unit(own), "long_name": f"value of {own}", "symbol": own}
    if symbol is None:
        return {"units": "1", "long_name": f"multiplier of {name}", "symbol": name}
    known: dict[str, object] = {"units": symbol.unit, "long_name": symbol.meaning, "symbol": symbol.symbol}
    if name in CHOICE_AXES:
        known["flag_values"] = np.arange(len(CHOICE_AXES[name]), dtype=np.int8)
        known["flag_meanings"] = " ".join(CHOICE_AXES[name])
    flags = FLAGS.get(name)
    if flags is not None:
        known["flag_values"] = np.array([int(flag) for flag in flags], dtype=np.int8)
        known["flag_meanings"] = " ".join(flag.name.lower() for flag in flags)
    return known


@lru_cache(maxsize=1)
def made_by() -> str:
    """Name and version of this library, for the attribute ``source``."""
    return f"quartering {version('quartering')}"


def plain_attributes(values: Mapping[str, object]) -> dict[str, object]:
    """Attributes in types JSON knows, floats unchanged.

    values: of numbers, texts and lists of numbers

    >>> plain_attributes({"n": np.float64(0.5), "two": [np.float64(1.0), 2.0]})
    {'n': 0.5, 'two': [1.0, 2.0]}
    """
    plain: dict[str, object] = {}
    for key, value in values.items():
        numbers = np.asarray(value)
        plain[key] = value if isinstance(value, str) else numbers.tolist()
    return plain


def heading_of(ship: Ship, *, form: Form, harmonics: int) -> dict[str, object]:
    """Attributes of a dataset: what a reader needs to know where the numbers come from.

    as computed

    >>> from quartering.hull.file.read import ship
    >>> heading_of(ship("wigley"), form="stf", harmonics=1)["steady_motion"]
    'modified Struble method'
    """
    return dict(_heading(ship, form, harmonics))


@lru_cache(maxsize=16)  # the blocks of one map say the same
def _heading(ship: Ship, form: Form, harmonics: int) -> Mapping[str, object]:
    c = coefficients(ship, 0.5, 0.0)
    entries = c.table()
    hull, loading = ship.hull, ship.loading
    return {
        "title": f"Roll response and stability of {ship.name} in regular oblique waves",
        "ship": ship.name,
        "ship_length": hull.length,
        "ship_beam": hull.beam,
        "ship_draught": hull.draught,
        "loading": f"GM {loading.gm:.4g} m, KG {loading.kg:.4g} m, k_xx {loading.gyradius_roll:.4g} m,"
        f" k_zz {loading.gyradius_yaw:.4g} m, added roll damping {ship.roll_damping_words}",
        "roll_damping": damping_words(ship),
        "autopilot": "none" if ship.autopilot is None else ship.autopilot.words,
        "righting_curve": ship.righting,
        "natural_roll_frequency": c.roll_frequency,
        "provenance": "; ".join(f"{key}: {text}" for key, text in ship.provenance.items()),
        "coefficient_sources": "; ".join(f"{e.name}: {e.source}" for e in entries),
        "estimated_coefficients": ", ".join(e.name for e in entries if e.estimated),
        "estimated_by": "; ".join(f"{method}: {', '.join(names)}" for method, names in estimates(entries).items()),
        "calm_water_exponents_at_zero_speed": [float(z.real) for z in calm_water_exponents(ship, 0.0)],
        "axes": "body axes: x to the bow, y to starboard, z down, origin at G",
        "heading_convention": HEADING_CONVENTION,
        "reference_point": REFERENCE_POINT,
        "velocities": ship.velocities,
        "diffraction": form_words(ship, form),
        "diffraction_form": form,
        "steady_motion": "modified Struble method" if harmonics == 1 else f"harmonic balance to order {harmonics}",
        "references": ", ".join(dict.fromkeys(("H71", "STF70", *c.references))),
        "Conventions": "CF-1.8",
        "source": made_by(),
    }
