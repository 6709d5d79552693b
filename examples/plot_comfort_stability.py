"""Comfort against stability: what less roll costs.

The paper's fourth conclusion: changes of the loading that make a ship roll less may make its motion less stable. Each line is
one heading; along it GM (left) or the roll gyradius (right) grows from the open mark to the filled one. A line that climbs to
the right is the conflict: the calmer ship is the one whose disturbances die out more slowly.

For Series 60, CB 0.60, the conflict is there on one side of resonance. More GM and less k_xx always raise the stability index;
where the encounter is slower than the natural roll (30 and 45 deg here) they lower roll as well, so nothing is paid; where it
is faster (75 and 90 deg) they bring the ship nearer to resonance, and stability is bought with roll. The Floquet rate, below,
is that of the slowest mode; in quartering seas that may be the course and not roll, of which the index says nothing.

Usage: python plot_comfort_stability.py [picture.png]
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt
from quartering.view.plots import style
from quartering.view.plots.comfort import comfort_picture

HEADINGS = [30.0, 45.0, 60.0, 75.0, 90.0]


def main(picture: str = "") -> None:
    ship = qt.ship("series60-cb60")
    length, beam = ship.hull.length, ship.hull.beam
    wave, speed = qt.Wave(length, length / 50), 0.25 * np.sqrt(9.81 * length)
    changes = {"gm": np.linspace(0.04, 0.07, 25) * beam, "gyradius_roll": np.linspace(0.32, 0.42, 25) * beam}
    studies = [qt.vary(ship, wave, speed, 0.0, {name: values, "heading": HEADINGS}) for name, values in changes.items()]
    for name, ds in zip(changes, studies, strict=True):
        print(f"{name} from {float(ds[name][0]):.3g} to {float(ds[name][-1]):.3g} m")
        for heading in HEADINGS:
            roll, index = (ds[key].sel(heading=heading).values for key in ("roll", "index"))
            print(
                f"  {heading:3.0f} deg: roll {roll[0]:5.2f} -> {roll[-1]:5.2f} deg, S {index[0]:.4f} -> {index[-1]:.4f} 1/s"
            )
    drawn = comfort_picture(studies)
    if picture:
        style.save(drawn, Path(picture))
        return
    style.shown(drawn)
    plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
