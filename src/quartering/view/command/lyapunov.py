"""`quartering lyapunov`: do small disturbances of the motion in a sea grow?"""

from __future__ import annotations

from collections.abc import Iterator
from time import process_time
from typing import TYPE_CHECKING, Any

from quartering.arguments import ARGUMENTS
from quartering.conventions import NORMAL_95
from quartering.units import NO_SHIP
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, DataOrTables, FormName, Heading, ShipName, Speed
from quartering.view.console.files import TABLES, dataset_files, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.progress import working
from quartering.view.console.sea_options import (
    Gamma,
    Hours,
    Hs,
    Seed,
    SpectrumName,
    SpreadingWords,
    SwellWords,
    Tp,
    TypedSea,
    Tz,
)
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import typed_ship, typed_value
from quartering.view.console.typed_values import value

if TYPE_CHECKING:
    import xarray as xr

    from quartering.view.console.printed import Table


def lyapunov(
    ship: ShipName,
    hs: Hs,
    heading: Heading,
    speed: Speed,
    changes: Changes,
    tp: Tp = None,
    tz: Tz = None,
    spectrum: SpectrumName = "jonswap",
    gamma: Gamma = "3.3",
    spreading: SpreadingWords = "none",
    swell: SwellWords = None,
    hours: Hours = "32",
    seed: Seed = 0,
    form: FormName = "stf",
    output: DataOrTables = None,
) -> Answer:
    """Growth rate of small disturbances of the motion in a sea, in almost every record and in the mean square."""
    from quartering.study.seas.lyapunov import lyapunov as exponents

    one, typed = typed_ship(ship, changes), TypedSea(heading, hs, tp, tz, spectrum, gamma, spreading, swell)
    path = reserve_path(output, (".nc", *TABLES))
    sea, u = typed.read(one.sizes), typed_value("speed", speed, one.sizes)
    long = value(hours, ARGUMENTS["simulated_hours"], NO_SHIP, "--hours")
    begun = process_time()
    with working("simulating"):
        ds = exponents(one, sea, u, hours=long, seed=seed, form=form)  # type: ignore[arg-type]  # refuses an unknown form
    took = process_time() - begun
    return Answer(
        _lines(ds, took),
        lambda: _facts(ds) | {"processor_time": took, "file": str(path) if path else None},
        dataset_files(path, ds),
        output=path,
        next_steps=[f"quartering sea {ship} --speed {speed}{typed.words} --hours {hours}{option_words(changes)}"],
    )


def _intervals(ds: xr.Dataset) -> dict[str, tuple[float, float]]:
    """Value and error of both rates, by what they are of."""
    names = {"almost every record": "lyapunov", "their mean square, halved": "mean_square"}
    return {words: (float(ds[name]), float(ds[f"{name}_error"])) for words, name in names.items()}


def _lines(ds: xr.Dataset, took: float) -> Iterator[Table | str]:
    rows = [
        (words, f"{rate:+.4g}", f"{error:.2g}", f"{rate - NORMAL_95 * error:+.4g} to {rate + NORMAL_95 * error:+.4g}")
        for words, (rate, error) in _intervals(ds).items()
    ]
    heads = ("growth of disturbances in", "rate [1/s]", "standard error", "95 % interval")
    yield table(f"{ds.attrs['ship']}, {ds.attrs['speed']:.4g} m/s, {ds.attrs['seas']}", heads, rows, (1, 2, 3))
    yield _sentence(ds)
    failed = int(ds["failed"])
    lost = f"; {failed} more ended with a failure and do not count" if failed else ""
    yield (
        f"From {int(ds['blocks'])} half hours{lost}, seed {ds.attrs['seed']}; {took:.3g} s of processor time, compiling"
        " included."
    )


def _sentence(ds: xr.Dataset) -> str:
    """What both rates say together."""
    (surely, error), (square, square_error) = _intervals(ds).values()
    if surely - NORMAL_95 * error > 0:
        return "Disturbances grow in almost every record: the motion is unstable."
    if surely + NORMAL_95 * error > 0:
        return "Not decided: the interval holds 0; simulate more hours."
    if square - NORMAL_95 * square_error > 0:
        return "Disturbances die out in almost every record, but rare ones grow large: their mean square does."
    if square + NORMAL_95 * square_error > 0:
        return "Disturbances die out in almost every record; of their mean square that is not decided: more hours."
    return "Disturbances die out, in almost every record and in the mean square: the motion is stable."


def _facts(ds: xr.Dataset) -> dict[str, Any]:
    names = ("lyapunov", "lyapunov_error", "mean_square", "mean_square_error", "blocks", "failed")
    about = ("ship", "seas", "speed", "seed", "hours")
    return {**{name: ds.attrs[name] for name in about}, **{name: ds[name].values.item() for name in names}}
