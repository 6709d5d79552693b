"""What each method of an irregular sea gets wrong: roll and its largest of three hours over those simulated.

Six seas on Series 60, CB 0.60. The linear response errs where roll is large enough for the righting arm to bend; the closure
(statistical linearisation) does not, at the cost of a few passes more. Its largest roll counts swings in groups; the bar goes
from there to the bound that counts every swing. Bars of the simulation are 1.96 standard errors.

Usage: python plot_error_of_each_method.py [picture.png]
"""

import sys
import warnings

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt
from quartering.view.plots.style import CONTRAST

SHIP, SPEED, HOURS = qt.ship("series60-cb60"), 7.5, 192
SEAS = [(45, None, 6, 11), (60, None, 6, 11), (60, 10, 6, 11), (90, 10, 6, 11), (90, None, 4, 9), (135, 5, 6, 12)]


def main(picture: str = "") -> None:
    warnings.simplefilter("ignore", qt.RangeWarning)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.4), layout="constrained", sharey=True)
    names = []
    for i, (heading, spreading, hs, tp) in enumerate(SEAS):
        sea = qt.Sea(hs=hs, tp=tp, heading=heading, spreading=spreading)
        found = qt.irregular(SHIP, sea, SPEED, hours=HOURS)
        linear, closed = (qt.sea_response(SHIP, sea, SPEED, method=how) for how in ("linear", "closure"))
        for ax, rms in ((left, "roll_rms"), (right, "roll_mean_largest")):
            true = float(found[rms])
            ax.errorbar(1.0, i, xerr=1.96 * float(found[f"{rms}_error"]) / true, fmt="|", color="0.35", capsize=4,
                        label="simulation" if i == 0 else None)  # fmt: skip
            ax.plot(float(linear[rms]) / true, i, "s", color=CONTRAST[1], label="linear response" if i == 0 else None)
            ax.plot(float(closed[rms]) / true, i, "o", color=CONTRAST[0], label="closure" if i == 0 else None)
        ends = np.array([float(closed[f"roll_mean_largest{end}"]) for end in ("", "_bound")]) / float(
            found["roll_mean_largest"]
        )
        right.plot(ends, [i, i], color=CONTRAST[0], lw=1)
        names.append(f"{heading}°, {'long-crested' if spreading is None else f's {spreading}'}, {hs} m, {tp} s")
        print(f"{names[-1]}: roll {float(found['roll_rms']):.3g} deg, linear {float(linear['roll_rms']):.3g},"
              f" closure {float(closed['roll_rms']):.3g}")  # fmt: skip
    left.set_yticks(range(len(SEAS)), names)
    left.invert_yaxis()
    left.set_xlabel("root mean square roll over that simulated")
    right.set_xlabel("mean largest roll of 3 h over that simulated")
    left.legend()
    figure.suptitle(f"{SHIP.name}, {SPEED:g} m/s, JONSWAP gamma 3.3; {HOURS} h of each sea, seed 0")
    figure.savefig(picture, dpi=130) if picture else plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
