"""Motions of lower symmetry: biased (even harmonics) and subharmonic (two wave periods).

A motion of two wave periods has harmonics of half the wave's frequency, and the wave forces its second one. The balance
equations put the excitation on the first harmonic of the list they are given, so that list begins with the wave's own: (0, 2,
1, 3, 4, ..) at half the frequency.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from quartering.motion.equations.system import Floats, System


def orders_of(harmonics: int, periods: int) -> tuple[int, ...]:
    """Harmonics of a motion without symmetry that repeats after some wave periods, the wave's own in front.

    harmonics: highest harmonic of the wave's frequency
    periods: wave periods after which the motion repeats
    Returns multiples of the wave's frequency divided by `periods`; 0 is the mean

    Source: [Krack19] (subharmonic motions).

    >>> orders_of(3, 1), orders_of(2, 2)
    ((0, 1, 2, 3), (0, 2, 1, 3, 4))
    """
    rest = (h for h in range(1, harmonics * periods + 1) if h != periods)
    return (0, periods, *rest)


def slowed(system: System, periods: int) -> System:
    """The system written for a subharmonic period: base frequency w/n, excitation in harmonic n.

    system: n conditions, at the wave's frequency
    """
    return system if periods == 1 else replace(system, frequency=system.frequency / periods, periods=periods)


def columns(orders: tuple[int, ...]) -> dict[int, slice]:
    """Where each harmonic stands among the coefficients.

    orders: in the order of the columns
    Returns one column for the mean (0), cosine and sine for the others

    Source: the layout of coefficients of `harmonic_balance`.
    """
    found, at = {}, 0
    for h in orders:
        width = 1 if h == 0 else 2
        found[h] = slice(at, at + width)
        at += width
    return found


def rearranged(u: Floats, orders: tuple[int, ...], into: tuple[int, ...], factor: int = 1) -> Floats:
    """The same motions as coefficients of other harmonics; those absent from `into` are dropped, new ones are zero.

    u (n, 3, b): coefficients
    orders: their harmonics
    into: harmonics wanted
    factor: harmonic h becomes `factor` h
    Returns (n, 3, c)

    >>> rearranged(np.array([[[5.0, 6.0]]]), (1,), (0, 2, 1), factor=2).tolist()
    [[[0.0, 5.0, 6.0, 0.0, 0.0]]]
    """
    to = columns(into)
    out = np.zeros((*u.shape[:2], sum(1 if h == 0 else 2 for h in into)))
    for h, where in columns(orders).items():
        if factor * h in to:
            out[:, :, to[factor * h]] = u[:, :, where]
    return out


def ascending(u: Floats, orders: tuple[int, ...]) -> tuple[Floats, tuple[int, ...]]:
    """Coefficients by ascending harmonics, as every function but the balance equations takes them.

    u (n, 3, b)
    Returns (n, 3, b)
    """
    into = tuple(sorted(orders))
    return (np.ascontiguousarray(u), into) if into == tuple(orders) else (rearranged(u, orders, into), into)
