"""Torsethaugen's two-peaked spectrum, simplified: wind sea and swell from the height and the peak period alone."""

from __future__ import annotations

import numpy as np

from quartering.conventions import GRAVITY
from quartering.loads.sea.shape import integral
from quartering.loads.sea.systems import WaveSystem

_POWER, _PRINTED = 4.0, 3.26


def torsethaugen(hs: float, tp: float, gravity: float = GRAVITY) -> tuple[tuple[WaveSystem, ...], float]:
    """The wave systems of the simplified spectrum of Torsethaugen, scaled to the height exactly.

    hs: of both together [m]
    tp: period of the larger peak [s]
    gravity: [m/s2]
    Returns systems: the larger peak first; one alone where Tp is that of a fully grown sea; scale: 16 m0/hs^2 of the
        printed formulas, which the systems are divided by

    Tf = 6.6 hs^(1/3) divides wind sea from swell. The peak enhancement is at least 1: below, the printed factor is a root of a
    negative logarithm. Source: [TorsethaugenHaver04] as DNV-RP-C205 reads it, from memory: UNVERIFIED.
    Valid: fetch-limited seas of the Norwegian shelf.
    """
    grown = 6.6 * hs ** (1.0 / 3.0)
    if tp <= grown:
        away = np.clip((grown - tp) / (grown - 2.0 * np.sqrt(hs)), 0.0, 1.0) if grown > 2.0 * np.sqrt(hs) else 1.0
        share = 0.7 + 0.3 * np.exp(-((away / 0.5) ** 2))
        first, second = share * hs, np.sqrt(1.0 - share**2) * hs
        gamma = 35.0 * (2 * np.pi * first / (gravity * tp**2)) ** (6.0 / 7.0)
        other = grown + 2.0
    else:
        away = np.clip((tp - grown) / (25.0 - grown), 0.0, 1.0)
        share = 0.6 + 0.4 * np.exp(-((away / 0.3) ** 2))
        first, second = share * hs, np.sqrt(1.0 - share**2) * hs
        gamma = 35.0 * (2 * np.pi * hs / (gravity * grown**2)) ** (6.0 / 7.0) * (1.0 + 6.0 * away)
        other = 6.6 * second ** (1.0 / 3.0)
    gamma = float(max(gamma, 1.0))
    # energies of the printed formulas over hs^2/16: their norms are rounded, so they are not first^2 and second^2
    enhanced = (1.0 + 1.1 * np.log(gamma) ** 1.19) / gamma
    parts = [
        (first, tp, gamma, _PRINTED * enhanced * integral(_POWER, gamma)),
        (second, other, 1.0, _PRINTED * integral(_POWER)),
    ]
    energies = [(height / hs) ** 2 * norm for height, _, _, norm in parts]
    scale = float(sum(energies))
    systems = tuple(
        WaveSystem(float(hs * np.sqrt(energy / scale)), float(period), _POWER, peaked)
        for (_, period, peaked, _), energy in zip(parts, energies, strict=True)
        if energy > 1e-12
    )
    return systems, scale
