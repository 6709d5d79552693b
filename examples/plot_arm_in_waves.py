"""Righting arm on the crest and in the trough of a wave of the ship's length: what pure loss and parametric roll live on.

The ship is balanced in heave and trim on a frozen wave; the pressure acts on the hull that is wetted there. Left the arm over
heel, right GM over the place of the crest, for a container ship with flared ends and for a combatant. At large heel the arm
rests on a watertight deck at the top of the lines.

Usage: python plot_arm_in_waves.py [picture.png]
"""

import sys
import warnings

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt

SHIPS, STEEPNESS = ("s175", "dtmb5415"), 0.0334
PLACES = ((None, "calm water", "k"), (0.0, "crest amidships", "#D55E00"), (0.5, "trough amidships", "#0072B2"))


def main(picture: str = "") -> None:
    warnings.simplefilter("ignore", qt.RangeWarning)  # the deck, which the head of this file tells of
    figure, axes = plt.subplots(2, 2, figsize=(10.5, 7.0), layout="constrained")
    heel = np.arange(0.0, 61.0, 2.5)
    for (left, right), name in zip(axes, SHIPS, strict=True):
        ship = qt.ship(name)
        wave = qt.Wave(ship.hull.length, STEEPNESS * ship.hull.length)
        for place, words, colour in PLACES:
            arm = (
                qt.righting_arm(ship, heel) if place is None else qt.righting_arm(ship, heel, wave=wave, position=place)
            )
            left.plot(heel, arm, color=colour, label=words)
        left.axhline(0.0, color="0.6", lw=0.8)
        left.set(xlabel="heel [deg]", ylabel="GZ [m]", title=f"{ship.name}, GM {ship.loading.gm:.2g} m in calm water")
        left.legend()
        ds = qt.gm_in_waves(ship, wave, positions=24)
        right.plot(ds["position"], ds["gm"], color="k")
        right.axhline(ship.loading.gm, color="0.6", ls="--", label="calm water")
        right.set(
            xlabel="crest, share of a wave length from midship",
            ylabel="GM [m]",
            title=f"waves {wave.height:.3g} m high",
        )
        right.legend()
        print(f"{ship.name}: GM {float(ds['gm'].min()):.3g} to {float(ds['gm'].max()):.3g} m on the wave")
    figure.suptitle(f"Waves of the ship's length, {STEEPNESS:g} of it high, balanced in heave and trim")
    figure.savefig(picture, dpi=130) if picture else plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
