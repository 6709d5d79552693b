"""What an autopilot does for a ship that does not keep its course: the growth of a disturbance over the rate gain.

Series 60, CB 0.80, at 11 m/s, 10 deg to waves of its length and 2 m height. With the rudder amidships it leaves its course,
without any wave too. A gain of 0.1 on the heading alone does not hold it: the rudder must answer the rate of turn as well,
by an amount that Routh's criterion gives. A gain of 1 needs none. Rudder forces are estimated.

Usage: python plot_autopilot.py [picture.png]
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt


def main(picture: str = "") -> None:
    ship, wave = qt.ship("series60-cb80"), qt.Wave(length=121.92, height=2.0)
    condition = {"wave": wave, "speed": 11.0, "heading": 10.0}
    rate_gains = np.linspace(0.0, 30.0, 16)
    figure, ax = plt.subplots(figsize=(8, 4.5), layout="constrained")
    for gain, style in ((0.1, "C0o-"), (1.0, "C1s--")):
        growth = []
        for rate_gain in rate_gains:
            steered = ship.with_(autopilot=qt.Autopilot(gain, rate_gain, lag=2.0))
            model = qt.equations(steered, **condition)
            verdict = qt.stability(model, qt.steady_motion(model, harmonics=3, start="rest"))
            growth.append(verdict.exponents[0].real)
        print(f"gain {gain:g}, rate gain {rate_gain:g} s: {verdict.sentence}")
        ax.plot(rate_gains, growth, style, markersize=4, label=f"gain {gain:g}, lag 2 s")
    bare = qt.equations(ship, **condition)
    amidships = qt.stability(bare, qt.steady_motion(bare, harmonics=3, start="rest")).exponents[0].real
    ax.axhline(amidships, color="k", linestyle=":", label="rudder amidships")
    ax.axhline(0.0, color="0.5", linewidth=0.8)
    ax.annotate("grows: unstable", (0.99, 0.0003), xycoords=("axes fraction", "data"), ha="right", va="bottom")
    ax.annotate("dies out: stable", (0.99, -0.0003), xycoords=("axes fraction", "data"), ha="right", va="top")
    ax.set(
        xlabel="rate gain [s]",
        ylabel="leading Floquet exponent [1/s]",
        title=f"{ship.name}: 11 m/s, heading 10 deg, wave 122 x 2 m; rudder estimated",
    )
    ax.legend()
    figure.savefig(picture, dpi=110) if picture else plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
