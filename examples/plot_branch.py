"""Roll over frequency for a softening ship: two folds, three motions between them, the middle one unstable.

A model straight from numbers (roll restoring that softens, light damping, dimensionless with n2 = 1), as a student meets
it. The line is followed through its folds; every motion found at some frequencies is then judged by Floquet multipliers,
which know nothing of the line: filled dots are stable, open ones unstable.

Usage: python plot_branch.py [picture.png]
"""

import itertools
import sys
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt

TERMS = {"Y_v": -0.4, "N_r": -0.6, "K_v": 0.02, "K_p": -0.06, "K_ppp": -0.05, "K_phi": -1.0, "K_phiphiphi": 0.5}
HARMONICS = 5


def main(picture: str = "") -> None:
    model = qt.Model(np.eye(3), TERMS, 0.9, force_cos=(0.02, 0.055, 0.0), force_sin=(0.0, 0.0, 0.005))
    line = qt.branch(model, "frequency", limits=(0.6, 1.2), harmonics=HARMONICS)
    frequency, roll = line["frequency"].values, line["roll"].values
    folds = np.flatnonzero(line["fold"])
    print("folds at", ", ".join(f"{frequency[i]:.4f}" for i in folds))
    edges = [0, *folds, len(roll) - 1]
    figure, axes = plt.subplots(figsize=(7.5, 4.8), layout="constrained")
    for i, (first, last) in enumerate(itertools.pairwise(edges)):
        # The parameter runs backwards between a fold and the next: those motions are saddles.
        axes.plot(frequency[first : last + 1], roll[first : last + 1], "C0--" if i % 2 else "C0-", zorder=1)
    axes.plot(frequency[folds], roll[folds], "C3s", label="fold", zorder=3)
    for w in [*np.arange(0.65, 1.2, 0.05).round(3).tolist(), 0.875, 0.885, 0.895]:
        at = replace(model, frequency=w)
        for motion in qt.all_motions(at, HARMONICS):
            verdict = qt.stability(at, motion)
            angle = np.degrees(motion.amplitude[1])
            print(f"frequency {w:.3f}, roll {angle:6.2f} deg: {verdict.kind} ({verdict.exponents[0].real:+.4f})")
            axes.plot(w, angle, "ko", mfc="k" if verdict.stable else "w", ms=6, zorder=2)
    axes.plot([], [], "ko", mfc="k", label="stable by Floquet")
    axes.plot([], [], "ko", mfc="w", label="unstable by Floquet")
    axes.set(xlabel="encounter frequency / natural roll frequency", ylabel="roll amplitude [deg]", ylim=(0, None))
    axes.set_title("Roll of a softening ship, harmonic balance to order 5")
    axes.legend()
    figure.savefig(picture, dpi=130) if picture else plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
