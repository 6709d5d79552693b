"""Surf-riding and broaching of the S-175 in following waves of its own length.

Left, over the nominal Froude number and the wave's steepness: the wave passes the ship, may hold it, or catches it from any
start, by the force on the ship's own hull; resistance is estimated from the lines. Right, for a ship that a wave 6 m high
carries along: the headings its autopilot holds, where it begins to swing, and where the wave lets it go.

Usage: python plot_surf_riding.py [picture.png]
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt

SHIP, STEEPEST = qt.ship("s175").with_(autopilot="1,10s"), 0.08


def main(picture: str = "") -> None:
    length = SHIP.hull.length
    steepness = np.linspace(0.005, STEEPEST, 16)
    ds = qt.surf_riding_map(SHIP, length, steepness).isel(wave_length=0)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.4), layout="constrained")
    first, second, celerity = (ds[name].values for name in ("first", "second", "celerity"))
    left.fill_betweenx(steepness, first, second, color="#d3e3f0", label="some starts are caught")
    left.fill_betweenx(steepness, second, celerity, color="#6f9fc8", label="every start is caught")
    left.plot(second, steepness, "k-", lw=2)
    left.plot(ds["second_melnikov"], steepness, "k--", lw=1, label="the same by Melnikov's method")
    left.plot(celerity, steepness, "k:", label="celerity of the wave")
    left.set(
        xlabel="nominal Froude number [-]", ylabel="wave height over length [-]", xlim=(0.1, 0.45), title="surf-riding"
    )
    left.legend(loc="lower left")
    branch = qt.broaching_branch(SHIP, qt.Wave(length, 6.0), "0.35 Fn")
    stable = branch["growth"].values <= 0
    for name, colour in (("yaw", "#0072B2"), ("rudder", "#D55E00"), ("heel", "#009E73")):
        right.plot(branch["heading"], branch[name], color=colour, lw=1, ls="--")
        right.plot(branch["heading"], np.where(stable, branch[name], np.nan), color=colour, lw=2.5, label=name)
    for code, marker, words in ((1, "s", "fold"), (2, "o", "Hopf")):
        at = branch["event"].values == code
        right.plot(
            branch["heading"].values[at], branch["yaw"].values[at], marker, color="#c2185b", mfc="w", label=words
        )
    right.set(
        xlabel="heading ordered, off the wave [deg]", ylabel="[deg]", title="carried along at Fn 0.35, thick: stable"
    )
    right.legend()
    print(f"every start is caught from Fn {second[-1]:.3g} on at H/lambda {STEEPEST:g}")
    print(f"the wave holds the ship up to {float(branch['heading'].max()):.3g} deg")
    figure.suptitle(f"{SHIP.name} in waves of {length:g} m")
    figure.savefig(picture, dpi=130) if picture else plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
