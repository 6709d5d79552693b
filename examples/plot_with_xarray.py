"""Results plotted by xarray alone: roll over heading at several speeds, and the same over wave length as panels.

Every result is an `xarray.Dataset` whose variables carry unit and meaning, so its own plots are labelled; what the package
draws itself is `ds.quartering.map()`. Series 60, CB 0.60, waves of steepness 1/50.

Usage: python plot_with_xarray.py [picture.png]
"""

import sys
import warnings

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt


def main(picture: str = "") -> None:
    ship = qt.ship("series60-cb60")
    lengths = np.linspace(0.6, 2.2, 17) * ship.hull.length
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always", qt.RangeWarning)
        ds = qt.polar(ship, [qt.Wave(one, one / 50) for one in lengths], speeds=[3.0, 6.0, 9.0])
    for message in {str(warning.message) for warning in told}:
        print(message)
    roll = ds["roll_peak"].assign_coords(heading=ds["heading"].assign_attrs(long_name="heading, 180 head"))
    figure, (left, *panels) = plt.subplots(1, 4, figsize=(13, 3.6), layout="constrained", width_ratios=(1.3, 1, 1, 1))
    roll.sel(wave_length=1.2 * ship.hull.length, method="nearest").plot.line(x="heading", hue="speed", ax=left)
    left.set_title(f"waves of {1.2 * ship.hull.length:.0f} m")
    for panel, speed in zip(panels, roll["speed"].values, strict=True):
        drawn = roll.sel(speed=speed).plot(x="heading", ax=panel, vmin=0, vmax=float(roll.max()), add_colorbar=False)
        panel.set_title(f"{speed:g} m/s")
    figure.colorbar(drawn, ax=panels, label="largest roll over a cycle [deg]")
    if picture:
        figure.savefig(picture, dpi=110)
        return
    plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
