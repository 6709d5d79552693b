"""How large a roll in how many hours: counted, extrapolated with its interval, and by the likeliest sea that leads to it.

Left, the largest roll of three hours: what a simulation of 1,500 hours saw, generalised extreme values fitted to it with the
interval of their profile likelihood, and the closure, whose Gaussian tails a ship that is not linear does not keep. Right, how
often roll is above a level: counted in the simulation, by importance sampling about the likeliest sea (the design point), with
its error, and by the distance of that sea alone.

Usage: python plot_rare_rolls.py [picture.png]
"""

import sys
import warnings

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt
from quartering.view.plots.style import CONTRAST

SHIP, SEA, SPEED, HOURS = qt.ship("series60-cb60"), qt.Sea(hs=4, tp=11, heading=60, spreading=10), 7.5, 1536


def main(picture: str = "") -> None:
    warnings.simplefilter("ignore", qt.RangeWarning)
    found = qt.irregular(SHIP, SEA, SPEED, hours=HOURS)
    closed = qt.sea_response(SHIP, SEA, SPEED, method="closure")
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.6), layout="constrained")
    largest = np.sort(found["roll_largest"].values.reshape(-1, 6).max(axis=1))
    left.plot(
        HOURS / np.arange(largest.size, 0, -1), largest, ".", color="0.35", ms=4, label=f"simulated, {HOURS} h, seed 0"
    )
    hours = np.geomspace(6.0, 1e4, 9)
    levels = [qt.largest_roll(found, one) for one in hours]
    left.fill_between(hours, [one.lower for one in levels], [one.upper for one in levels], color=CONTRAST[0], alpha=0.25,
                      label="its 95 % interval")  # fmt: skip
    left.plot(hours, [one.value for one in levels], color=CONTRAST[0], label="extreme values (GEV)")
    gaussian = [qt.sea_response(SHIP, SEA, SPEED, method="closure", hours=one)["roll_most_probable"] for one in hours]
    left.plot(hours, [float(one) for one in gaussian], "--", color=CONTRAST[1], label="closure, Gaussian")
    left.set(xscale="log", xlabel="hours in which it is passed once, on average", ylabel="largest roll of 3 h [deg]")
    left.legend()
    levels_of = np.array([16.0, 20.0, 24.0, 28.0, 32.0])
    points = [qt.design_point(SHIP, SEA, SPEED, roll=level, windows=2048) for level in levels_of]
    value, error = (np.array([float(one[name]) for one in points]) for name in ("crossing_rate", "crossing_rate_error"))
    right.errorbar(
        levels_of, value, 1.96 * error, fmt="o", color=CONTRAST[0], capsize=3, label="sampled about the design point"
    )
    form = [np.exp(-0.5 * float(one["beta"]) ** 2) / float(closed["roll_period"]) for one in points]
    right.plot(levels_of, form, "--", color=CONTRAST[1], label="by its distance alone (FORM)")
    own = found["roll_largest"].values
    above = np.array([(own > level).sum() for level in levels_of])
    seen = above > 0
    right.plot(levels_of[seen], -0.5 * np.log1p(-above[seen] / own.size) / 1800.0, "s", mfc="w", color="0.35",
               label="first passages counted, half of both sides")  # fmt: skip
    right.set(yscale="log", xlabel="level of roll [deg]", ylabel="passages to one side [1/s]")
    right.legend()
    figure.suptitle(f"{SHIP.name}, {SPEED:g} m/s, {SEA.words}, heading {SEA.heading:g} deg; seed 0")
    for level, one in zip(levels_of, points, strict=True):
        print(f"{level:g} deg: beta {float(one['beta']):.3g}, {float(one['crossing_rate']):.2g} 1/s")
    figure.savefig(picture, dpi=130) if picture else plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
