"""`quartering forces`: the wave force over heading, the forms of the diffraction force side by side."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr

from quartering.hull.ship import Ship, ship
from quartering.loads.forces import FORMS, Form, wave_forces
from quartering.loads.waves import Wave
from quartering.view.commands.conditions import sizes
from quartering.view.options import value, values
from quartering.view.output import PICTURES, claim, write
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import metric_prefix, speed_words

_HEADINGS = np.arange(0.0, 181.0, 5.0)
_PRINTED = (30.0, 60.0, 90.0, 120.0, 150.0)
_SMALL_HEIGHT = 2.0
MODES = (("sway", "|Y| / A", "N/m"), ("roll", "|K| / A", "N m/m"), ("yaw", "|N| / A", "N m/m"))


def compare_forms(
    name: str, speed: str, wave_lengths: str, forms: Sequence[str], output: str | None, as_json: bool
) -> None:
    """Print and draw force amplitudes per metre of wave amplitude."""
    one = ship(name)
    path = claim(output, PICTURES) if output else None
    u = value(speed, "speed", sizes(one), "--speed")
    lengths = values([wave_lengths], "length", sizes(one), "--wave-lengths", 5)
    fields = {form: _amplitudes(one, lengths, u, form) for form in forms}
    if path is not None:
        from quartering.view.plots import style
        from quartering.view.plots.forces import forces_picture

        title = f"{one.name}: wave forces per metre of wave amplitude, {speed_words(u, one.hull.length)}"
        note = "About G. " + "; ".join(f"{form}: {FORMS[form]}" for form in fields) + "."
        write((path, lambda part: style.save(forces_picture(fields, title, note), part)))
    if as_json:
        show_json(
            {"ship": one.name, "speed": u, "heading": _HEADINGS, "forms": {f: _plain(a) for f, a in fields.items()}}
        )
        return
    for mode, words, unit in MODES:
        scale, prefix = metric_prefix(max(float(field.sel(mode=mode).max()) for field in fields.values()))
        rows = [
            (f"{float(r):.3g}", form, *(f"{float(a.sel(heading=h, mode=mode)) / scale:.4g}" for h in _PRINTED))
            for form, field in fields.items()
            for r, a in zip(field["ratio"].values, field, strict=True)
        ]
        columns = ("lambda/L", "form", *(f"{h:g} deg" for h in _PRINTED))
        show(table(f"{one.name}: {mode}, {words} [{prefix}{unit}] over heading", columns, rows, (0, 2, 3, 4, 5, 6)))
    if path is not None:
        show(f"Wrote {path}")
    show(next_steps(f"quartering verdict {name} --heading 60 --speed {speed} --wave-length 1L --wave-height 2"))


def _amplitudes(one: Ship, lengths: Sequence[float], speed: float, form: str) -> xr.DataArray:
    """Amplitudes (wave_length, heading, mode) per metre of wave amplitude."""
    parts: list[xr.DataArray] = []
    for length in lengths:
        wave = Wave(length, min(_SMALL_HEIGHT, length / 20))
        chosen: Form = form  # type: ignore[assignment]  # wave_forces refuses an unknown one
        total = wave_forces(one, wave, speed, _HEADINGS, form=chosen)["total"]
        parts.append((total**2).sum("part") ** 0.5 / wave.amplitude)
    field = xr.concat(parts, xr.DataArray(list(lengths), dims="wave_length", name="wave_length"))
    return field.assign_coords(ratio=("wave_length", np.array(lengths) / one.hull.length))


def _plain(field: xr.DataArray) -> dict[str, object]:
    return {"wave_length": field["wave_length"].values} | {m: field.sel(mode=m).values for m, _, _ in MODES}
