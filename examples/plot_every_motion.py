"""Every motion of a ship that can capsize: folds, leaning motions, period doubling, and the basin that waves eat away.

A roll equation whose righting moment vanishes at one radian, phi'' + 0.1 phi' + phi - phi^3 = F sin(0.8 t), lightly damped:
dimensionless, the textbook model of capsize. Left: every motion over the force of the wave, stable ones solid; the
upper curve first leans to one side, then takes two wave periods, then four. Middle: the Floquet multipliers of
these motions and the circle they must stay inside. Right: the share of starts that survive sixteen waves. Erosion sets in
above Melnikov's force, the least at which the boundary of the safe basin can be fractal, and while a stable motion exists.

Usage: python plot_every_motion.py [picture.png]
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt
from quartering.motion.transient.basin import safe_shares
from quartering.view.plots.branch import MARKS, curves_on, multipliers_on

DAMPING, FREQUENCY = 0.1, 0.8
TERMS = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": 1.0, "K_p": -DAMPING}


def ship(force: float) -> qt.Model:
    """The roll equation in waves of one force."""
    return qt.Model(np.eye(3), TERMS, FREQUENCY, force_cos=(0, 0, 0), force_sin=(0, force, 0))


def melnikov_force() -> float:
    """Closed form 2 c sinh(pi w/sqrt 2)/(3 pi w) for damping c, restoring x - x^3."""
    return 2 * DAMPING * np.sinh(np.pi * FREQUENCY / np.sqrt(2)) / (3 * np.pi * FREQUENCY)


def main(picture: str = "") -> None:
    figure, (response, circle, integrity) = plt.subplots(
        1, 3, figsize=(13.5, 4.6), width_ratios=(1.5, 1.0, 1.1), layout="constrained"
    )
    ds = qt.branch(ship(1.0), "excitation", limits=(0.01, 0.28), harmonics=7)
    curves_on(response, ds, "excitation")
    multipliers_on(circle, ds)
    response.set(xlabel="force F of the wave", title="Largest roll: stable solid, unstable dashed")
    for event, mark in MARKS.items():
        at = np.flatnonzero(ds["event"] == event)
        if at.size:
            response.plot([], [], mark, color="k", mfc="w", label=event)
            print(event, "at F =", ", ".join(f"{force:.4f}" for force in ds["excitation"].values[at]))
    response.legend(loc="lower right")
    angles, rates = np.meshgrid(np.linspace(-1.0, 1.0, 41), np.linspace(-0.7, 0.7, 31))
    starts = np.zeros((angles.size, 4))
    starts[:, 1], starts[:, 2] = angles.ravel(), rates.ravel()
    forces = np.linspace(0.0, 0.25, 16)
    share = safe_shares([ship(force) for force in forces], starts, periods=16, limit=1.5)
    integrity.plot(forces, 100 * share / share[0], "o-", ms=4)
    integrity.axvline(melnikov_force(), color="k", ls=":", label=f"Melnikov's force, {melnikov_force():.3f}")
    integrity.set(
        xlabel="force F of the wave", ylabel="safe basin left [%]", ylim=(0, 105), title="Integrity of the safe basin"
    )
    integrity.legend(loc="upper right")
    figure.savefig(picture, dpi=130) if picture else plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
