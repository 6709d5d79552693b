"""Results over many conditions as one labelled dataset: units, meanings and provenance on everything."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.metadata import version

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.conventions import HEADING_CONVENTION, REFERENCE_POINT, SYMBOLS
from quartering.hull.ship import Ship
from quartering.hydro.calm_water import calm_water_exponents
from quartering.hydro.coefficients import coefficients
from quartering.loads.forces import FORMS, Form
from quartering.motion.status import Status
from quartering.stability.first_order import RESONANCES
from quartering.stability.kind import Kind
from quartering.study.conditions import RESULTS

_EXTRA_DIMS = {
    "q": ("resonance",),
    "q_paper": ("resonance",),
    "slow": ("slow_mode",),
    "multiplier_modulus": ("multiplier",),
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

    Parameters
    ----------
    ship : Ship
    results : mapping of name to array     shaped as the dims, and for encounter_frequency as the wave dims
    coordinates : mapping of name to (dims, values)
    dims : sequence of str                 of every condition
    wave_dims : sequence of str            those the encounter frequency depends on
    form, harmonics                        as computed, for the record

    Returns
    -------
    xarray.Dataset    opens with plain ``xr.open_dataset`` after ``to_netcdf``

    Examples
    --------
    See `polar` and `sweep`, which call this.
    """
    variables = {name: ((*dims, *_EXTRA_DIMS.get(name, ())), results[name], attributes(name)) for name in RESULTS}
    variables["encounter_frequency"] = (
        tuple(wave_dims),
        results["encounter_frequency"],
        attributes("encounter_frequency"),
    )
    coords = {name: (where, values, attributes(name)) for name, (where, values) in coordinates.items()}
    coords["resonance"] = (("resonance",), np.array(RESONANCES), {"long_name": "m in n2 = m omega/2", "units": "1"})
    return xr.Dataset(variables, coords, _provenance(ship, form, harmonics))


def attributes(name: str) -> dict[str, object]:
    """Units, meaning and letter of a variable, and the meaning of its flags.

    Parameters
    ----------
    name : str    of a variable or coordinate

    Returns
    -------
    dict          CF attributes; a coefficient's multiplier has units "1"

    Examples
    --------
    >>> attributes("roll")["units"], attributes("verdict")["flag_meanings"].split()[1]
    ('deg', 'stable')
    """
    symbol = SYMBOLS.get(name)
    if symbol is None:
        return {"units": "1", "long_name": f"multiplier of {name}", "symbol": name}
    known: dict[str, object] = {"units": symbol.unit, "long_name": symbol.meaning, "symbol": symbol.symbol}
    flags = {"verdict": Kind, "status": Status}.get(name)
    if flags is not None:
        known["flag_values"] = np.array([int(flag) for flag in flags], dtype=np.int8)
        known["flag_meanings"] = " ".join(flag.name.lower() for flag in flags)
    return known


def _provenance(ship: Ship, form: Form, harmonics: int) -> dict[str, object]:
    """What a reader needs to know where the numbers come from."""
    c = coefficients(ship, 0.5, 0.0)
    estimated = [entry.name for entry in c.table() if entry.kind in ("regression", "cross-flow")]
    hull, loading = ship.hull, ship.loading
    return {
        "title": f"Roll response and stability of {ship.name} in regular oblique waves",
        "ship": ship.name,
        "ship_length": hull.length,
        "ship_beam": hull.beam,
        "ship_draught": hull.draught,
        "loading": f"GM {loading.gm:.4g} m, KG {loading.kg:.4g} m, k_xx {loading.gyradius_roll:.4g} m,"
        f" k_zz {loading.gyradius_yaw:.4g} m, added roll damping {loading.roll_damping:.3g} of critical",
        "natural_roll_frequency": c.roll_frequency,
        "provenance": "; ".join(f"{key}: {text}" for key, text in ship.provenance.items()),
        "coefficient_sources": "; ".join(f"{e.name}: {e.source}" for e in c.table()),
        "estimated_coefficients": ", ".join(estimated),
        "calm_water_exponents_at_zero_speed": [float(z.real) for z in calm_water_exponents(ship, 0.0)],
        "axes": "body axes: x to the bow, y to starboard, z down, origin at G",
        "heading_convention": HEADING_CONVENTION,
        "reference_point": REFERENCE_POINT,
        "diffraction": FORMS[form],
        "steady_motion": "modified Struble method" if harmonics == 1 else f"harmonic balance to order {harmonics}",
        "references": ", ".join(dict.fromkeys(("H71", "STF70", *c.references))),
        "Conventions": "CF-1.8",
        "source": f"quartering {version('quartering')}",
    }
