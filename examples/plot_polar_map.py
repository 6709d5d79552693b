"""The polar map: roll over heading and wave length at one speed, unstable cells hatched, resonance lines drawn.

Series 60, CB 0.60, Froude number 0.25, waves of steepness 1/50. Writes nothing but the picture; `quartering polar` makes
the same map for three speeds and keeps the dataset.

Usage: python plot_polar_map.py [picture.png]
"""

import sys
import warnings

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

import quartering as qt
from quartering.view.plots.polar_map import polar_map


def main(picture: str = "") -> None:
    ship = qt.ship("series60-cb60")
    length = ship.hull.length
    waves = [qt.Wave(length=ratio * length, height=ratio * length / 50) for ratio in np.linspace(0.4, 2.3, 20)]
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always", qt.RangeWarning)
        ds = qt.polar(ship, waves, speeds=[0.25 * np.sqrt(9.81 * length)])
    for message in {str(warning.message) for warning in told}:
        print(message)
    kinds = dict(zip(ds["verdict"].attrs["flag_values"], ds["verdict"].attrs["flag_meanings"].split(), strict=True))
    for value, count in zip(*np.unique(ds["verdict"], return_counts=True), strict=True):
        print(f"{count:4d} cells: {kinds[value].replace('_', '-')}")
    made = polar_map(ds)
    if picture:
        made.savefig(picture, dpi=130)
        return
    made.set_dpi(150)
    canvas = FigureCanvasAgg(made)
    canvas.draw()
    plt.figure(figsize=made.get_size_inches(), dpi=150).add_axes((0, 0, 1, 1)).set_axis_off()
    plt.imshow(np.asarray(canvas.buffer_rgba()))
    plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
