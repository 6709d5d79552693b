"""Uncertainty of a verdict: probability of instability over random coefficients and loadings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.special import ndtri
from scipy.stats import qmc

from quartering.conventions import InputError
from quartering.stability.kind import Kind
from quartering.study.dataset import attributes, heading_of, plain_attributes
from quartering.study.grid import Grid
from quartering.study.loadings import user_value
from quartering.study.maps.executor import computed, reached
from quartering.study.maps.result import coordinates_of
from quartering.units import quantity

REPEATS = 8
"""Independent sets of draws, whose scatter is the sampling error."""
_LARGEST = 1.0


def uncertain(
    grid: Grid,
    spread: Mapping[str, float | str],
    *,
    draws: int = 256,
    seed: int = 1,
    cluster: str | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Probability that each condition is unstable when coefficients and loading are known only so well.

    spread: relative standard deviation by name: {"K_ppp": "20%", "gm": 0.05}
    draws: in all; a multiple of 8, best 8 times a power of two
    seed: of the draws: the same seed gives the same result
    cluster: as in `sweep`
    Returns dims of the grid: probability_unstable, its sampling error probability_error, and probability_no_answer
        (shares of all draws, so that stable is what is left) [1]

    Each value is multiplied by exp(s z), z standard normal, s^2 = ln(1 + spread^2): a lognormal factor with median 1 that
    cannot change a sign.  The z are scrambled Sobol points in 8 independent scramblings; the error is the standard error of
    their mean, and not below 1/(draws + 2), what a count of none or all leaves open.
    Source: [Owen97] randomised quasi-Monte Carlo.  Valid: independent errors; loading values as in `sweep`.
    """
    names, sigma = _checked(spread)
    if draws < 2 * REPEATS or draws % REPEATS:
        raise InputError(f"draws = {draws}; take a multiple of {REPEATS} from {2 * REPEATS}, such as 256")
    factors = _factors(len(names), draws, seed, sigma)
    drawn = _drawn(grid, names, factors)
    shape = (grid.loading_count, REPEATS, grid.point_count, grid.sea_count)
    unstable, unknown = np.zeros(shape), np.zeros(shape)
    repeat = np.arange(draws) // (draws // REPEATS)

    def keep(index: int, found: dict[str, NDArray[np.generic]]) -> dict[str, int]:
        block = drawn.blocks[index]
        loading, draw = np.divmod(np.arange(block.loadings.start, block.loadings.stop), draws)
        verdict = found["verdict"].astype(int)
        cells = (loading, repeat[draw], block.points)
        part_unstable, part_unknown = np.zeros(shape[:2] + verdict.shape[1:]), np.zeros(shape[:2] + verdict.shape[1:])
        np.add.at(part_unstable, cells[:2], verdict > int(Kind.STABLE))
        np.add.at(part_unknown, cells[:2], verdict == int(Kind.NO_ANSWER))
        results.append((block.points, part_unstable, part_unknown))
        return {"status 0": int(verdict.size)}

    results: list[tuple[slice, Any, Any]] = []
    done = 0
    with reached(cluster) as client:
        for _, counts in computed(drawn, range(len(drawn.blocks)), keep, client):
            while results:
                points, some_unstable, some_unknown = results.pop()
                unstable[:, :, points] += some_unstable
                unknown[:, :, points] += some_unknown
            done += counts["status 0"]
            if progress is not None:
                progress(done, drawn.count)
    return _dataset(grid, unstable, unknown, draws, dict(zip(names, sigma, strict=True)), seed)


def _checked(spread: Mapping[str, float | str]) -> tuple[list[str], list[float]]:
    """Names and spreads."""
    if not spread:
        raise InputError('nothing is uncertain; name what is, such as {"K_ppp": "20%", "gm": "5%"}')
    sigma = [quantity(value, "ratio", what=f"uncertainty of {name}") for name, value in spread.items()]
    for name, value in zip(spread, sigma, strict=True):
        if not 0 < value <= _LARGEST:
            raise InputError(
                f"uncertainty of {name} is {value:g}; give a relative standard deviation above 0 and up to 100 %"
            )
    if "gm" in spread and "kg" in spread:
        raise InputError("gm and kg are both uncertain; one follows from the other, leave one out")
    return list(spread), sigma


def _factors(names: int, draws: int, seed: int, sigma: list[float]) -> NDArray[np.float64]:
    """Lognormal factors (draws, names), the independent sets after each other."""
    each = draws // REPEATS
    power = int(np.ceil(np.log2(each)))
    children = np.random.SeedSequence(seed).spawn(REPEATS)
    sets = [qmc.Sobol(names, rng=np.random.default_rng(child)).random_base2(power)[:each] for child in children]
    points = np.clip(np.concatenate(sets), 1e-12, 1 - 1e-12)
    return np.asarray(np.exp(ndtri(points) * np.sqrt(np.log1p(np.array(sigma) ** 2))))


def _drawn(grid: Grid, names: list[str], factors: NDArray[np.float64]) -> Grid:
    """The grid with every loading in every draw, the draws of one loading beside each other."""
    loadings, count = grid.loading_count, factors.shape[0]
    columns = {name: np.repeat(column, count) for name, column in grid.loadings.items()}
    if ("kg" in columns and "gm" in names) or ("gm" in columns and "kg" in names):
        raise InputError("gm and kg cannot both be set; draw the one that is an axis")
    for i, name in enumerate(names):
        own = user_value(grid.ship, name)
        if own == 0.0:
            raise InputError(
                f"{name} is 0 for {grid.ship.name}, so a relative error means nothing; name the coefficient instead"
            )
        columns[name] = columns.get(name, np.full(loadings * count, own)) * np.tile(factors[:, i], loadings)
    drawn = replace(grid, loadings=columns)
    for i in range(drawn.loading_count):  # told before the work, not in the middle of it
        try:
            drawn.loaded(i)
        except InputError as error:
            raise InputError(
                f"draw {i % count + 1} of {count} is no ship: {error}; or take a smaller uncertainty"
            ) from None
    return drawn


def _dataset(
    grid: Grid,
    unstable: NDArray[np.float64],
    unknown: NDArray[np.float64],
    draws: int,
    spread: dict[str, float],
    seed: int,
) -> xr.Dataset:
    """Shares and their error, labelled."""
    share = unstable.sum(axis=1) / draws
    scatter = (unstable * REPEATS / draws).std(axis=1, ddof=1) / np.sqrt(REPEATS)
    coordinates, dims = coordinates_of(grid.axes, grid.loadings)
    columns = {
        "probability_unstable": (share, "share of draws in which the condition is unstable"),
        "probability_error": (np.maximum(scatter, 1 / (draws + 2)), "standard error of that share from sampling"),
        "probability_no_answer": (unknown.sum(axis=1) / draws, "share of draws without a periodic motion"),
    }
    said = {
        "draws": draws,
        "seed": seed,
        "uncertainty": ", ".join(f"{name} {100 * value:g} %" for name, value in spread.items()),
        "distribution": "independent lognormal factors, median 1",
    }
    heading = plain_attributes(heading_of(grid.ship, form=grid.form, harmonics=grid.harmonics))
    return xr.Dataset(
        {
            name: (dims, values.reshape(grid.shape), {"units": "1", "long_name": meaning, "symbol": ""})
            for name, (values, meaning) in columns.items()
        },
        {name: (where, values, attributes(name)) for name, (where, values) in coordinates.items()},
        heading | said,
    )
