"""The worst conditions of a result, each judged again by itself: its sentence, what cures it, what it depends on."""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np
import xarray as xr

from quartering.conventions import SYMBOLS, InputError, RangeWarning, in_unit, written
from quartering.loads.waves import Wave
from quartering.study.condition.examine import Examined, examine, helps
from quartering.study.effects.sensitivity import sensitivity
from quartering.study.loadings import loaded
from quartering.study.maps.query import OF_CONDITIONS, Measure, worst
from quartering.view.report.source import Source
from quartering.view.wording import speed_words, value_words, verdict_words

_COUNT, _PARAMETERS = 8, 12


class Condition(NamedTuple):
    """One condition of a result, with the numbers the result holds.

    Parameters
    ----------
    where : str          heading, speed, wave and, where there are several, loading in words
    roll_peak : float    largest roll angle over a cycle [deg]
    exponent : float     largest Floquet exponent [1/s]
    kind : str           verdict
    place : mapping      of coordinate to value
    """

    where: str
    roll_peak: float
    exponent: float
    kind: str
    place: dict[str, float]


class Judged(NamedTuple):
    """A condition judged by itself: why it is shown, the sentence of its verdict, and what alone would make it stable."""

    why: str
    sentence: str
    cures: list[str]


class Sensitivities(NamedTuple):
    """What a condition depends on most: parameter, value, and changes of roll [deg] and exponent [1/s] per 10 % of it."""

    where: str
    rows: list[tuple[str, str, float, float]]


def worst_conditions(source: Source, by: Measure) -> list[Condition]:
    """The worst conditions of a result by roll or by margin, the worst first."""
    found = worst(source.result, by, _COUNT)
    made = []
    for i in range(found.sizes["rank"]):
        one = found.isel(rank=i)
        place = {str(name): float(one[name]) for name in one.coords if name not in ("rank", "resonance")}
        made.append(
            Condition(
                _where(source, place),
                float(one["roll_peak"]),
                float(one["exponent"]),
                verdict_words(one),
                place,
            )
        )
    return made


def judged(source: Source, why: str, condition: Condition) -> Judged:
    """One condition judged by itself."""
    found = _examined(source, condition)
    return Judged(
        why, " ".join([found.verdict.sentence, *found.beside.sentences]), [cure.sentence for cure in helps(found)]
    )


def sensitivities(source: Source, condition: Condition) -> Sensitivities | None:
    """What roll and stability of a condition depend on most; None where its motion cannot be followed."""
    found = _examined(source, condition)
    harmonics = max(3, source.harmonics)
    try:
        ds = sensitivity(found.ship, found.wave, found.speed, found.heading, harmonics=harmonics)
    except InputError:
        return None
    per_tenth = ds[["roll", "exponent"]] * 0.1
    if not np.isfinite(per_tenth["exponent"]).any():
        return None
    order = np.argsort(-sum(_share(per_tenth[name].values) for name in ("roll", "exponent")))
    dials = [int(i) for i in order if str(ds["parameter"].values[i]) != "kg"]  # GM and KG are one dial
    return Sensitivities(condition.where, [_line(ds, per_tenth, i) for i in dials[:_PARAMETERS]])


def _share(change: np.ndarray) -> np.ndarray:
    """Sizes of changes over the largest; all 0 where nothing changes."""
    size = np.abs(np.nan_to_num(change))
    return size / size.max() if size.max() > 0 else size


def _line(ds: xr.Dataset, per_tenth: xr.Dataset, i: int) -> tuple[str, str, float, float]:
    unit = str(ds["unit"].values[i])
    value = f"{float(ds['value'][i]):.4g}{in_unit(unit)}"
    return written(str(ds["parameter"].values[i])), value, float(per_tenth["roll"][i]), float(per_tenth["exponent"][i])


def _examined(source: Source, condition: Condition) -> Examined:
    place = condition.place
    one = loaded(source.ship, {name: value for name, value in place.items() if name not in OF_CONDITIONS})
    wave = Wave(place["wave_length"], place["wave_height"])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)  # the page counts what is out of range by itself
        return examine(one, wave, place["speed"], place["heading"], source.harmonics, source.form)


def _where(source: Source, place: dict[str, float]) -> str:
    length = source.ship.hull.length
    words = (
        f"heading {place['heading']:g} deg, {speed_words(place['speed'], length)}, "
        f"wave {place['wave_length']:.4g} x {place['wave_height']:.3g} m (λ/L {place['wave_length'] / length:.3g})"
    )
    units = {name: SYMBOLS[name].unit if name in SYMBOLS else "1" for name in place}
    own = [f"{written(k)} {value_words(k, value, units[k])}" for k, value in place.items() if k not in OF_CONDITIONS]
    return ", ".join([words, *own])
