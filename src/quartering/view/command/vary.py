"""`quartering vary`: what one or two values do, or by how much each value matters."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError, headed, in_unit, written
from quartering.options import OPTIONS
from quartering.view.command._over_map import MAP_AXES, whole_map_varied
from quartering.view.command._tornado import each_value_changed
from quartering.view.command._varied import is_range, option, unvaried_words
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, FormName, Harmonics, PictureOrData, ShipName
from quartering.view.console.files import PICTURES, TABLES, dataset_or_picture, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.progress import bar
from quartering.view.console.ship_options import option_words
from quartering.view.console.tables import data_table
from quartering.view.console.typed_ship import Typed, typed_ship
from quartering.view.console.typed_values import value, values

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.hull.ship import Ship
    from quartering.loads.forces import Form
    from quartering.view.console.printed import Table

MEASURES = ("roll", "sway", "yaw", "roll_peak", "k2", "index", "n2", "exponent", "verdict")
_COUNTS, _COUNTS_OF_MAPS = {1: 41, 2: 25}, {1: 11, 2: 7}
_ROWS = 9
_RANGE = "from:to or from:to:count"


def vary(
    ship: ShipName,
    ranges: Changes,
    heading: Annotated[str, typer.Option(help=f"Heading [deg], or {_RANGE}.")] = "45",
    speed: Annotated[str, typer.Option(help=f"Speed: 7.5 [m/s], 15kn, 0.25Fn, or {_RANGE}.")] = "0.2Fn",
    wave_length: Annotated[str, typer.Option(help=f"Wave length: 150 [m], 1L, or {_RANGE}.")] = "1L",
    wave_height: Annotated[str, typer.Option(help=f"Wave height: 4 [m], 0.02L, or {_RANGE}.")] = "0.02L",
    coefficient: Annotated[
        list[str] | None, typer.Option(help="K_p=0.2:2: factors on a coefficient; repeatable.")
    ] = None,
    tornado: Annotated[
        str | None, typer.Option(help="10%: change every value by so much, one at a time, instead of a range.")
    ] = None,
    whole_map: Annotated[
        bool,
        typer.Option(
            "--over-map", help="Share of the whole map that is unstable, and its largest roll, over the values."
        ),
    ] = False,
    harmonics: Harmonics = 1,
    form: FormName = "stf",
    output: PictureOrData = None,
) -> Answer:
    """What one or two values do to roll and stability, and where the verdict flips."""
    import numpy as np

    from quartering.loads.waves import Wave
    from quartering.stability.precompile import announce_compilation
    from quartering.study.effects.vary import vary as variation
    from quartering.study.loadings import KEEL_AXES

    typed = Typed(ship, heading, speed, wave_length, wave_height, ranges)
    chosen: Form = form  # type: ignore[assignment]  # vary and tornado refuse an unknown one
    if tornado is not None and whole_map:
        raise InputError("--tornado and --over-map are two questions; leave one out")
    if tornado is not None:
        return each_value_changed(typed, coefficient or [], tornado, harmonics, chosen, output)
    told = {
        key: text for key, text in ranges.items() if key not in KEEL_AXES and not (OPTIONS[key].axis and is_range(text))
    }
    as_is = typed_ship(ship, told)
    path = reserve_path(output, (*PICTURES, ".nc", *TABLES))
    one, left = _keeled(as_is, {key: text for key, text in ranges.items() if key not in told})
    of_map = MAP_AXES if whole_map else ()
    fixed, parameters = _parameters(one, typed.condition, left, coefficient or [], of_map)
    user_keels = one.bilge_keels is not None and one.bilge_keels == as_is.bilge_keels
    # What is varied of the condition, or of keels fitted for the question, has no present value.
    unfitted = [key for key in parameters if key in typed.condition or (key in KEEL_AXES and not user_keels)]
    if whole_map:
        return whole_map_varied(typed, one, told, parameters, unfitted, harmonics, chosen, path)
    announce_compilation()
    wave = Wave(fixed["wave_length"], fixed["wave_height"])
    with bar("conditions", int(np.prod([len(v) for v in parameters.values()]))) as progress:
        ds = variation(
            one, wave, fixed["speed"], fixed["heading"], parameters,
            harmonics=harmonics, form=chosen, progress=progress,
        )  # fmt: skip
    for key in unfitted:
        del ds[key].attrs["user_value"]

    words = unvaried_words(typed) + option_words(told)
    return _answer(ds, path, [
        f"quartering vary {ship}{words} --tornado 10% -o tornado.png",
        *_over_map_words(ship, told, left),
        f"quartering polar {ship}{option_words(told)}",
    ])  # fmt: skip


def _answer(ds: xr.Dataset, path: Path | None, next_steps: list[str]) -> Answer:
    """What one or two varied values do, as the command gives it."""
    from quartering.view.wording import condition_words, notes

    dims = list(map(str, ds["verdict"].dims))

    def draw() -> Figure:
        from quartering.view.plots.vary import vary_picture

        return vary_picture(ds)

    def lines() -> Iterator[Table | str]:
        yield f"{condition_words(ds)}."
        yield from _lines(ds) if len(dims) == 1 else _map_lines(ds)
        yield from notes(ds)

    return Answer(
        lines(),
        lambda: _facts(ds) | {"written": None if path is None else str(path)},
        dataset_or_picture(path, ds, draw),
        output=path,
        data=lambda: [data_table(ds, str(ds.attrs["title"]), MEASURES, dims)],
        next_steps=next_steps,
    )


def _over_map_words(ship: str, told: Mapping[str, str], ranges: Mapping[str, str]) -> list[str]:
    """The same ranges over the whole map, to type next; nothing where a coefficient or the condition is varied alone."""
    words = "".join(f" {option(key)} {text}" for key, text in ranges.items())
    return [f"quartering vary {ship}{words}{option_words(told)} --over-map -o over-map.png"] if words else []


def _keeled(one: Ship, ranges: Mapping[str, str]) -> tuple[Ship, dict[str, str]]:
    """The ship with the keels of which one size, or both, are given as one value, and what is left to vary."""
    from quartering.study.loadings import KEEL_AXES, loaded

    keels = {key: values([ranges[key]], OPTIONS[key], one.sizes, option(key), 2) for key in KEEL_AXES if key in ranges}
    alone = [key for key in keels if not is_range(ranges[key])]
    if alone:
        one = loaded(one, {key: found[-1] for key, found in keels.items()})
    return one, {key: text for key, text in ranges.items() if key not in alone}


def _parameters(
    one: Ship,
    typed: Mapping[str, str],
    ranges: Mapping[str, str],
    coefficients: Sequence[str],
    of_map: Collection[str] = (),
) -> tuple[dict[str, float], dict[str, list[float]]]:
    """Condition, and values of what is varied; a condition that is varied stands at its first value.

    of_map: what of the condition a map is over, which is not varied
    """
    typed = {key: text for key, text in typed.items() if key not in of_map}
    factors = dict(_factor(text) for text in coefficients)
    texts = {key: text for key, text in typed.items() if is_range(text)} | dict(ranges) | factors
    if not texts:
        raise InputError(
            "nothing to vary: give one or two ranges, such as --gm 0.4:1.2 or --coefficient K_p=0.2:2, or --tornado 10%"
        )
    count = (_COUNTS_OF_MAPS if of_map else _COUNTS).get(len(texts), 2)
    units = one.sizes
    parameters = {
        key: values([text], OPTIONS.get(key, "ratio"), units, option(key), count) for key, text in texts.items()
    }
    fixed = {
        key: parameters[key][0] if key in parameters else value(text, OPTIONS[key], units, option(key))
        for key, text in typed.items()
    }
    return fixed, parameters


def _factor(text: str) -> tuple[str, str]:
    key, equals, span = text.partition("=")
    if not equals:
        raise InputError(f'--coefficient "{text}": give a name and a range of factors, such as K_p=0.2:2')
    return key, span


def _lines(ds: xr.Dataset) -> list[Table | str]:
    """Table of a few values, and where the verdict flips."""
    import numpy as np

    from quartering.stability.kind import Kind
    from quartering.study.effects.vary import varied

    (name,) = varied(ds)
    shown = np.unique(np.linspace(0, ds.sizes[name] - 1, _ROWS).round().astype(int))
    rows = [
        (
            f"{float(ds[name][i]):.4g}",
            *(f"{float(ds[key][i]):.3g}" for key in ("roll", "yaw", "k2", "index", "exponent")),
            Kind(int(ds["verdict"][i])).label,
        )
        for i in shown
    ]
    unit = str(ds[name].attrs["units"])
    columns = (headed(name, unit), "roll [deg]", "yaw [deg]", "K2 [1/s2]", "S [1/s]", "Floquet [1/s]", "verdict")
    return [table(str(ds.attrs["title"]), columns, rows, right=range(6)), _flip_sentence(ds, name, unit)]


def _flip_sentence(ds: xr.Dataset, name: str, unit: str) -> str:
    from quartering.stability.kind import Kind

    flips = [
        f"{written(name)} = {float(v):.4g}{in_unit(unit)} ({Kind(int(a)).label} below, {Kind(int(b)).label} above)"
        for v, a, b in zip(ds["flip"], ds["verdict_below"], ds["verdict_above"], strict=True)
    ]
    if flips:
        return f"The verdict flips at {'; '.join(flips)}."
    return f"The verdict does not flip: {Kind(int(ds['verdict'][0])).label} throughout."


def _map_lines(ds: xr.Dataset) -> list[Table | str]:
    """Counts of the verdicts, and where roll is largest and the motion least stable."""
    import numpy as np

    from quartering.stability.kind import Kind
    from quartering.study.effects.vary import varied

    kinds, counts = np.unique(ds["verdict"].values, return_counts=True)
    said = ", ".join(f"{n} {Kind(int(k)).label}" for k, n in zip(kinds, counts, strict=True))
    rows = []
    for key, words in (("roll", "largest roll [deg]"), ("exponent", "least stable, Floquet [1/s]")):
        if np.isfinite(ds[key]).any():
            i = np.unravel_index(int(np.nanargmax(ds[key].values)), ds[key].shape)
            cell = ds[key][i]
            rows.append((words, f"{float(cell):.3g}", *(f"{float(cell[name]):.4g}" for name in varied(ds))))
    columns = ("", "value", *(headed(name, str(ds[name].attrs["units"])) for name in varied(ds)))
    return [table(str(ds.attrs["title"]), columns, rows, right=(1, 2, 3)), f"Cells: {said}."]


def _facts(ds: xr.Dataset) -> dict[str, object]:
    import numpy as np

    from quartering.stability.kind import Kind
    from quartering.study.effects.vary import varied
    from quartering.study.grid import CONDITION_AXES
    from quartering.view.wording import estimated_names

    names = varied(ds)
    kinds = np.vectorize(lambda kind: Kind(int(kind)).label, otypes=[object])(ds["verdict"].values)
    facts: dict[str, object] = {key: ds.attrs[key] for key in ("ship", "loading", "steady_motion", "diffraction")}
    facts["condition"] = {key: float(ds[key]) for key in CONDITION_AXES if not ds[key].ndim}
    facts["parameters"] = {
        name: {"now": ds[name].attrs.get("user_value"), "unit": ds[name].attrs["units"], "values": ds[name].values}
        for name in names
    }
    facts |= {key: ds[key].values for key in MEASURES[:-1]} | {"verdict": kinds, "estimated": estimated_names(ds)}
    if len(names) == 1:
        facts["flips"] = [
            {"value": float(v), "below": Kind(int(a)).label, "above": Kind(int(b)).label}
            for v, a, b in zip(ds["flip"], ds["verdict_below"], ds["verdict_above"], strict=True)
        ]
    return facts
