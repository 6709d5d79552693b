"""Direct assessment: which seas and headings the failures of a ship's life come from.

Each cell of sea, speed and heading adds its rate of failures times its share of the time. Cells that cannot matter are left
out by the closure's upper ends; the others are simulated until their exact interval is small enough beside what they add, or
their hours are spent. The table of seas is that of a coast, made up for this page, and openings flood at 20 deg.

Usage: python plot_direct_assessment.py [picture.png]
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import xarray as xr

import quartering as qt
from quartering.view.plots import style
from quartering.view.plots.assessment import assessment_picture, sum_words


def main(picture: str = "") -> None:
    ship = qt.ship("series60-cb60").with_(openings="20 deg")
    table = xr.DataArray(
        [[300, 250, 60], [120, 200, 90], [25, 80, 60], [4, 20, 25], [0, 4, 8]],
        {"hs": [1.5, 2.5, 3.5, 4.5, 5.5], "tz": [6.5, 7.5, 8.5]},
        ("hs", "tz"),
    )
    life = qt.direct_assessment(ship, 7.5, [0, 45, 90, 135, 180], table, spreading=None, hours=128)
    print(sum_words(life.isel(loading=0)))
    drawn = assessment_picture(life)
    if picture:
        style.save(drawn, Path(picture))
        return
    style.shown(drawn)
    plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
