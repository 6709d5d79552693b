"""Parametric roll of the Duisburg Test Case in head seas of its own length, and the branch of motions behind one speed.

Left, over speed and wave height: the roll of two wave periods that settles, where small roll begins to grow, and where roll
alone would by its closed form. Right, at 5 m/s: every motion of two periods, its stability by Floquet multipliers.

Usage: python plot_parametric_roll.py [picture.png]
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt
from quartering.motion.steady_course.course import course
from quartering.motion.steady_course.doubled import doubled_motions
from quartering.stability.parametric import doubled_multipliers

SHIP, SPEED, STEEPEST = qt.ship("dtc"), 5.0, 0.03


def main(picture: str = "") -> None:
    length = SHIP.hull.length
    heights, speeds = np.linspace(0.1, 1.0, 10) * STEEPEST * length, np.linspace(0.0, 10.0, 11)
    ds = qt.parametric_map(SHIP, length, heights, speeds)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.4), layout="constrained")
    roll = ds["roll_settled"].values.T
    mesh = left.pcolormesh(speeds, heights, np.where(roll > 0, roll, np.nan), shading="nearest", vmin=0)
    figure.colorbar(mesh, ax=left, label="roll [deg]")
    left.contour(speeds, heights, ds["growth"].values.T, levels=[0.0], colors="k")
    left.contour(speeds, heights, ds["margin"].values.T, levels=[1.0], colors="0.4", linestyles="--")
    left.set(xlabel="speed [m/s]", ylabel="wave height [m]", title="growth 0 (line), closed form (dashes)")
    one = course(SHIP, 2 * np.pi / length, *(np.array([v]) for v in (heights[-1] / 2, SPEED, 180.0)))
    for branch in doubled_motions(one, heights[-1] / 2, heights[-1] / 2)[1]:
        found = [
            doubled_multipliers(one.at_amplitude([a]), branch.basis, x[None])[0]
            for a, x in zip(branch.amplitude, branch.x, strict=True)
        ]
        size = np.abs(found).max(axis=1)
        angle, height = np.degrees(branch.roll), 2 * branch.amplitude
        right.plot(height, angle, "C0-", lw=1)
        right.plot(height[size < 1], angle[size < 1], "ko", ms=4, label="stable")
        right.plot(height[size >= 1], angle[size >= 1], "ko", mfc="w", ms=4, label="unstable")
        stable = f"{np.sum(size < 1)} of {size.size} stable"
        print(f"begins at {height[0]:.3g} m; {angle[-1]:.3g} deg at {height[-1]:.3g} m; {stable}")
    right.set(xlabel="wave height [m]", ylabel="largest roll [deg]", title=f"motions of two periods at {SPEED:g} m/s")
    right.legend()
    figure.suptitle(f"{SHIP.name} in head seas of {length:g} m, {ds.attrs['loading']}")
    figure.savefig(picture, dpi=130) if picture else plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
