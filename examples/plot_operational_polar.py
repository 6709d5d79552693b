"""Operational polar diagrams: at which speeds and headings a ship may go in a sea, and where nobody can say yet.

Radius is speed, angle is heading, bow up; one diagram for each height and period. Colour is the mean largest roll of three
hours. Hatched cells are not recommended, dotted ones undecided: the interval of their largest roll straddles the limit. The
white lines do not move with the sea: on them the ship meets a broad band of waves at its roll frequency (solid), or at twice
that (dashes).

Usage: python plot_operational_polar.py [picture.png]
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt
from quartering.study.seas.over_seas.advice import Advice
from quartering.view.plots import style
from quartering.view.plots.sea_polar import sea_polar


def main(picture: str = "") -> None:
    ship = qt.ship("series60-cb60")
    found = qt.guidance(
        ship, hs=[4, 6], tp=[9, 11, 13], speed=np.linspace(0.0, 9.0, 13), heading=np.arange(0, 181, 5), spreading=10
    )
    for kind in Advice:
        print(
            f"{kind.label}: {int((found['recommended'] == int(kind)).sum())} of {found['recommended'].size} conditions"
        )
    drawn = sea_polar(found)
    if picture:
        style.save(drawn, Path(picture))
        return
    style.shown(drawn)
    plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
