"""Roll at speed: what it is to let lift act on the velocity relative to the water.

A ship in a long beam wave rides with the water, and its linear roll over the slope of the wave tends to 1 at any speed. Strip
theory without lift (grey) keeps that limit. Lift on velocities over ground (red, the paper's equations) does not: the drift
that the ship shares with the water then heels it. Lift on the velocity relative to the water (blue, the default) comes back to
the limit in long waves, lies on strip theory in short ones, and damps roll at resonance, which strips cannot. Prints the table
of docs/how_good_is_it.md.

Usage: python plot_moving_water.py [picture.png]
"""

import sys
import warnings

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt

GREY, RED, BLUE = "#6b6b6b", "#D55E00", "#0072B2"
SPEED, STEEPNESS = 10.0, 1e-5
SHIPS = {"s175": "S-175", "series60-cb60": "Series 60, CB 0.60"}
HEADINGS = (90.0, 60.0, 30.0)
TABLE = np.array([1.0, 2.0, 5.0, 8.0, 30.0, 300.0])


def roll_over_slope(ship: qt.Ship, ratios: np.ndarray, heading: float) -> np.ndarray:
    """Linear roll over the wave slope k A sin(mu) at wave lengths over ship length."""
    length = ratios * ship.hull.length
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", qt.RangeWarning)
        found = qt.sweep(ship, SPEED, heading, length, steepness=[STEEPNESS])
    return np.radians(found["roll"].values.ravel()) / (np.pi * STEEPNESS * np.sin(np.radians(heading)))


def variants(name: str) -> dict[str, tuple[qt.Ship, str, str]]:
    """The ship without lift, with lift over ground, and with lift relative to the water: colour and line."""
    ship = qt.ship(name)
    return {
        "strip theory, no lift": (ship.with_(linear="strip"), GREY, "--"),
        "lift over ground (absolute)": (ship.with_(velocities="absolute"), RED, "-."),
        "lift relative to the water (default)": (ship, BLUE, "-"),
    }


def main() -> None:
    ratios = np.geomspace(0.5, 60.0, 220)
    figure, axes = plt.subplots(2, 3, figsize=(11, 6.4), sharex=True, layout="constrained")
    for row, (name, title) in zip(axes, SHIPS.items(), strict=True):
        for ax, heading in zip(row, HEADINGS, strict=True):
            for label, (ship, colour, line) in variants(name).items():
                ax.plot(ratios, roll_over_slope(ship, ratios, heading), line, color=colour, label=label, lw=1.6)
                values = ", ".join(f"{v:.2f}" for v in roll_over_slope(ship, TABLE, heading))
                print(f"{title}, heading {heading:g} deg, {label}: {values}")
            ax.axhline(1.0, color="#b0b0b0", lw=0.8, zorder=0)
            ax.set(xscale="log", yscale="log", ylim=(0.1, 20), title=f"{title}, heading {heading:g}°")
            ax.set_xticks([0.5, 1, 2, 5, 10, 20, 50], ["0.5", "1", "2", "5", "10", "20", "50"], minor=False)
            ax.set_yticks([0.1, 1, 10], ["0.1", "1", "10"])
            ax.minorticks_off()
    for ax in axes[:, 0]:
        ax.set_ylabel("roll / wave slope [1]")
    for ax in axes[1]:
        ax.set_xlabel("wave length / ship length [1]")
    axes[0, 0].legend(fontsize=8, loc="lower right", frameon=False)
    figure.suptitle(f"Linear roll at {SPEED:g} m/s (small waves, no drag)", fontsize=11)
    if len(sys.argv) > 1:
        figure.savefig(sys.argv[1], dpi=130)


if __name__ == "__main__":
    main()
