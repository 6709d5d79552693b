"""Conditions of equations put into one batch, and taken out again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from quartering.motion.equations import PER_CONDITION, System


def joined(systems: Sequence[System]) -> System:
    """Systems as one batch, their products brought into one order of columns.

    Parameters
    ----------
    systems : sequence of System    of any numbers of conditions; a product one of them lacks is zero there

    Returns
    -------
    System

    Notes
    -----
    Source: none needed; a change of order in memory.

    Examples
    --------
    >>> from quartering.motion.equations import Model
    >>> one, other = ({"Y_v": -1.0, "K_phi": -1.0, "N_r": -1.0, name: 0.1} for name in ("K_ppp", "K_phiphiphi"))
    >>> joined([Model(np.eye(3), terms, 0.8, (0, 1, 0), (0, 0, 0)).system for terms in (one, other)]).coefficients[:, 1]
    array([[0.1, 0. ],
           [0. , 0.1]])
    """
    first = systems[0]
    stacked = {
        name: np.concatenate([getattr(s, name) for s in systems]) for name in PER_CONDITION if name != "coefficients"
    }
    products = [list(zip(map(tuple, s.powers.tolist()), s.modulus.tolist(), strict=True)) for s in systems]
    if all(one == products[0] for one in products):
        return replace(first, coefficients=np.concatenate([s.coefficients for s in systems]), **stacked)
    where = {key: i for i, key in enumerate(dict.fromkeys(key for one in products for key in one))}
    blocks = []
    for s, keys in zip(systems, products, strict=True):
        block = np.zeros((s.count, 3, len(where)))
        block[:, :, [where[key] for key in keys]] = s.coefficients
        blocks.append(block)
    return System(
        coefficients=np.concatenate(blocks),
        powers=np.array([powers for powers, _ in where], dtype=np.int64).reshape(-1, 4),
        modulus=np.array([modulus for _, modulus in where], dtype=np.int64),
        **stacked,
    )


def rows(system: System, which: slice | NDArray[np.intp]) -> System:
    """Some of the conditions of a batch.

    Parameters
    ----------
    system : System            n conditions
    which : slice or (k,) int  of them, in any order; a number may repeat

    Returns
    -------
    System

    Notes
    -----
    Source: none needed; a change of order in memory.

    Examples
    --------
    >>> from quartering.motion.equations import Model
    >>> one = Model(np.eye(3), {"K_phi": -1.0}, 0.8, (0, 1, 0), (0, 0, 0)).system
    >>> rows(one, np.array([0, 0])).frequency.tolist()
    [0.8, 0.8]
    """
    return system.each(lambda array: array[which])


def apart(systems: System) -> list[System]:
    """The conditions of a batch one by one: the inverse of `joined`.

    Parameters
    ----------
    systems : System         n conditions

    Returns
    -------
    list of n System

    Notes
    -----
    Source: none needed; a change of order in memory.

    Examples
    --------
    >>> from quartering.motion.equations import Model
    >>> one = Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "N_r": -1.0}, 0.8, (0, 1, 0), (0, 0, 0)).system
    >>> [s.count for s in apart(joined([one, one]))]
    [1, 1]
    """
    return [rows(systems, slice(i, i + 1)) for i in range(systems.count)]


def copies(system: System, count: int) -> System:
    """One condition as a batch of equal ones.

    Parameters
    ----------
    system : System    one condition
    count : int

    Returns
    -------
    System

    Notes
    -----
    Source: none needed; a change of order in memory.

    Examples
    --------
    >>> from quartering.motion.equations import Model
    >>> copies(Model(np.eye(3), {"K_phi": -1.0}, 0.8, (0, 1, 0), (0, 0, 0)).system, 3).count
    3
    """
    return rows(system, np.zeros(count, dtype=np.intp))
