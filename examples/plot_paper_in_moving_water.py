"""What the motion of the water changes of the paper's conclusions.

The paper lets drag act on velocities over ground. In a wave the water moves along, and drag feels the rest. Left, the index
K2/(2 n2) over the heading: over ground (red, the paper's equations), through the water (blue, the default), and what the
paper's short index makes of the second with the amplitudes over ground (dotted) and through the water (dashed). Right, what
sway, roll and yaw each add to K2 in the two frames. Prints the tables of docs/moving_water.md.

Usage: python plot_paper_in_moving_water.py [picture.png]
"""

import sys
import warnings

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt
from quartering.motion.of_ship import ship_system
from quartering.motion.steady.motion import steady_motions
from quartering.stability.assessment import assess
from quartering.stability.short_index import roll_cubics, short_index, through_water

RED, BLUE, GREY = "#D55E00", "#0072B2", "#6b6b6b"
PAPER = {"velocities": "absolute", "drag": "cubic", "ends": "strips", "righting": "polynomial"}
HEADINGS = np.arange(10.0, 171.0, 2.0)
STEEPNESS, FROUDE = 1 / 30, 0.15
SHIPS = ("series60-cb60", "series60-cb70", "mariner", "s175", "dtmb5415", "dtc")
KINDS = ("roll", "fold", "symmetry_breaking", "combination", "period_doubling")


def judged(ship: qt.Ship, ratio: float, headings: np.ndarray):
    """Motions and stability at one wave length over ship length: system, displacement phasors, first order, Floquet."""
    length = ratio * ship.hull.length
    one = np.ones_like(headings)
    speed = FROUDE * np.sqrt(9.81 * ship.hull.length)
    at = ship_system(ship, 2 * np.pi / length * one, speed * one, headings)
    system = at.at_amplitude(0.5 * STEEPNESS * length * one[:, None])
    u, orders, *_ = steady_motions(system)
    found = assess(system, u, orders)
    return system, u[:, :, 0] - 1j * u[:, :, 1], found.first_order, found.floquet


def parts(ship: qt.Ship, ratio: float, headings: np.ndarray, *, moving: bool) -> np.ndarray:
    """What I1 P1^2, I2 P2^2, I3 P3^2 add to K2/(2 n2) (n, 3) [1/s]."""
    system, displacement, first, _ = judged(ship, ratio, headings)
    amplitude = np.abs(through_water(system, displacement) if moving else displacement)
    cubics = roll_cubics(system, displacement)
    added = short_index(cubics, amplitude, system.frequency, first.n2, first.rho[:, 0])
    return added / (2 * first.n2[:, None])


def verdicts(name: str, **options: object) -> tuple[int, int]:
    """How many cells of a map of steep waves have an unstable motion, and how many no motion below the capsize limit."""
    ship = qt.ship(name).with_(**options)
    speed = FROUDE * np.sqrt(9.81 * ship.hull.length)
    lengths = np.array([0.75, 1.0, 1.5, 2.0, 3.0]) * ship.hull.length
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", qt.RangeWarning)
        ds = qt.sweep(ship, speed, np.arange(10.0, 171.0, 10.0), lengths, steepness=[1 / 20])
    flags = ds["verdict"]
    kinds = dict(zip(flags.attrs["flag_values"].tolist(), flags.attrs["flag_meanings"].split(), strict=True))
    names = [kinds[int(one)] for one in flags.values.ravel()]
    return sum(name in KINDS for name in names), names.count("no_answer")


def main() -> None:
    ship, paper = qt.ship("series60-cb60"), qt.ship("series60-cb60").with_(**PAPER)
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5), layout="constrained")
    first = judged(ship, 1.5, HEADINGS)[2]
    over, through = first.k2_paper / (2 * first.n2), first.k2_rho / (2 * first.n2)
    ground = judged(paper, 1.5, HEADINGS)[2]
    left.plot(HEADINGS, ground.roll_rate, color=RED, label="equations over ground (the paper's)")
    left.plot(HEADINGS, first.roll_rate, color=BLUE, label="equations through the water (default)")
    left.plot(HEADINGS, over, ":", color=BLUE, label="default, short index, amplitudes over ground")
    left.plot(HEADINGS, through, "--", color=BLUE, label="default, short index, amplitudes through the water")
    left.set(xlabel="heading [deg] (0 following)", ylabel="K2/(2 n2) [1/s], below 0 is stable", xlim=(10, 170))
    left.legend(fontsize=8, frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=2)
    places = np.arange(3)
    for shift, (of, moving, colour, label) in zip(
        (-0.2, 0.2), ((paper, False, RED, "over ground"), (ship, True, BLUE, "through the water")), strict=True
    ):
        added = parts(of, 1.5, np.array([45.0]), moving=moving)[0]
        right.bar(places + shift, added, 0.38, color=colour, label=label)
        for place, value in zip(places, added, strict=True):
            right.annotate(f"{value:.1e}", (place + shift, value), ha="center", va="top", fontsize=8)
    right.set_xticks(places, ["sway: I1 P1²", "roll: I2 P2²", "yaw: I3 P3²"])
    right.set(ylabel="added to K2/(2 n2) [1/s]")
    right.axhline(0.0, color=GREY, lw=0.8)
    right.margins(y=0.15)
    right.legend(fontsize=8, frameon=False)
    left.set_title("Series 60, CB 0.60, Fn 0.15, waves 1.5 L, 1/30", fontsize=10)
    right.set_title("the same at 45 deg", fontsize=10)
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "moving-water.png", dpi=150)
    for heading in (30.0, 45.0, 60.0, 90.0, 120.0):
        at = np.array([heading])
        row = [
            f"{v:+.4f}" for of, moving in ((paper, False), (ship, True)) for v in parts(of, 1.5, at, moving=moving)[0]
        ]
        print(f"| {heading:g} | " + " | ".join(row) + " |")
    for name in SHIPS:
        counts = [verdicts(name, **options) for options in (PAPER, {})]
        print(f"| {name} | " + " | ".join(f"{bad} | {none}" for bad, none in counts) + " |")


if __name__ == "__main__":
    main()
