"""What makes coupled roll unstable: prints the tables of docs/the_mechanism.md.

Series 60, CB 0.60, as loaded in the library, Fn 0.25, waves of the ship's length. Table I of the paper enters as ratios.

Usage: python mechanism.py
"""

from __future__ import annotations

import warnings
from functools import cache

import numpy as np

import quartering as qt
from quartering.stability.kind import Kind
from quartering.study.paper.mechanism import onset, roll_alone, smallest_change
from quartering.study.paper.model import TABLE_I, modified_model, paper_ship, table_ratios

SHIP = paper_ship()
LENGTH = SHIP.hull.length
SPEED = 0.25 * np.sqrt(9.81 * LENGTH)
HEADINGS = np.arange(5.0, 180.0, 5.0)
QUARTERING = np.arange(10.0, 80.0, 2.5)
STEEP = 30
ALONE = ("K_prr", "K_pvv", "K_vrr", "K_ppp")


def wave(steepness: int) -> qt.Wave:
    return qt.Wave(LENGTH, LENGTH / steepness)


def stated(steepness: int) -> tuple[str, ...]:
    """Largest growth rate over all headings: roll alone, the ship, with half K_ppp, with Table I; onset of Table I."""
    at, rates = wave(steepness), []
    rates.append(float(roll_alone(SHIP, at, SPEED, HEADINGS, harmonics=5)["exponent"].max()))
    for one in (SHIP, SHIP.with_(factors={"K_ppp": 0.5}), modified_model()):
        ds = qt.sweep(one, SPEED, HEADINGS, at.length, at.height, harmonics=5)
        rates.append(float(ds["exponent"].max()))
    first = onset(SHIP, table_ratios(), at, SPEED, QUARTERING)
    words = f"{first.strength:.2f} times, at {first.heading:g} deg, roll {first.roll:.0f} deg"
    return (f"1/{steepness}", *(f"{rate:+.4f}" for rate in rates), words)


@cache
def needed(name: str, heading: float) -> str:
    """Factor on one coefficient, nearest to 1, from which on roll is unstable; "-" when there is none up to 150."""
    ds = qt.vary(SHIP, wave(STEEP), SPEED, heading, {name: np.linspace(-150.0, 150.0, 61)}, harmonics=5)
    sides = zip(ds["flip"].values, ds["verdict_below"].values, ds["verdict_above"].values, strict=True)
    flips = [float(v) for v, *kinds in sides if Kind.ROLL in kinds and Kind.STABLE in kinds]
    return f"{min(flips, key=lambda v: abs(v - 1)):.1f}" if flips else "-"


def search(heading: float) -> tuple[str, ...]:
    """Factors of the smallest change, its size, and how far Floquet multipliers put it from the edge."""
    found = smallest_change(SHIP, wave(STEEP), SPEED, heading)
    size = np.sqrt(sum((factor - 1) ** 2 for factor in found.values()))
    edge = onset(SHIP, found, wave(STEEP), SPEED, [heading], most=3.0)
    four = ", ".join(f"{name} {factor:.1f}" for name, factor in list(found.items())[:4])
    return f"{heading:g}", four, f"{size:.1f}", f"{edge.strength:.3f}", edge.kind


def prime(ship: qt.Ship, name: str, speed: float) -> float:
    """A cubic roll coefficient over rho/2 L^(3 + n)/U, n the number of p and r in it."""
    length, value = (
        ship.hull.length,
        qt.equations(ship, qt.Wave(ship.hull.length, 1.0), speed, 30.0).terms.get(name, 0.0),
    )
    return value * speed / (0.5 * ship.loading.density * length ** (3 + sum(letter in "pr" for letter in name[2:])))


def measured() -> qt.Ship:
    return paper_ship("s175").with_(measured="son-nomoto-1982", draught=8.5, gm=0.3)


def measured_verdicts() -> tuple[int, int, float]:
    """Conditions of the measured ship, those unstable in roll, and the largest K2/(2 n2) [1/s]."""
    ship = measured()
    length = ship.hull.length
    count, rolls, largest = 0, 0, -np.inf
    for froude in (0.15, 0.2, 0.25, 0.3):
        ds = qt.sweep(
            ship,
            froude * np.sqrt(9.81 * length),
            HEADINGS,
            [0.75 * length, length, 1.5 * length],
            length / 50,
            harmonics=3,
        )
        count += ds["verdict"].size
        rolls += int(ds["verdict"].isin([Kind.ROLL, Kind.COMBINATION]).sum())
        largest = max(largest, float(-ds["index"].min()))
    return count, rolls, largest


def main() -> None:
    warnings.simplefilter("ignore", qt.RangeWarning)
    print("steepness | roll alone | ship | half K_ppp | Table I | onset")
    for steepness in (50, 30, 20):
        print(" | ".join(stated(steepness)))
    print("\nheading | " + " | ".join(ALONE))
    for heading in (15.0, 30.0, 45.0, 60.0):
        print(f"{heading:g} | " + " | ".join(needed(name, heading) for name in ALONE))
    print("\nheading | smallest change | size | Floquet's edge | kind")
    for heading in (15.0, 30.0, 45.0):
        print(" | ".join(search(heading)))
    print("\nSeries 60 and S-175 as measured, prime")
    for name in ("K_prr", "K_vrr"):
        print(f"{name} | {prime(SHIP, name, SPEED):+.2e} | {prime(measured(), name, 10.29):+.2e}")
    terms = qt.equations(SHIP, wave(STEEP), SPEED, 30.0).terms
    for above, below in (("K_vpp", "K_vrr"), ("Y_vpp", "Y_vrr"), ("K_vrr", "Y_prr"), ("K_vpp", "Y_ppp")):
        print(
            f"{above}/{below}: printed {TABLE_I[above][0] / TABLE_I[below][0]:.4g}, ours {terms[above] / terms[below]:.4g}"
        )
    model = qt.equations(SHIP, wave(STEEP), SPEED, 30.0)
    inverse = np.linalg.inv(model.inertia)
    rho = inverse[0, 1] / inverse[1, 1]
    print(
        f"rho_1 = {rho:.4f} m; I3 = {rho * terms['K_vrr'] + terms['K_prr']:+.2e}, by Table I {3 * rho * terms['K_vrr']:+.2e}"
    )
    print("measured S-175: conditions, unstable in roll, largest K2/(2 n2):", measured_verdicts())


if __name__ == "__main__":
    main()
