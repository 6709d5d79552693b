"""A stable and an unstable motion, by three verdicts: first-order theory, Floquet multipliers, direct integration.

Series 60, CB 0.60, in stern quartering seas (heading 30 deg, Froude number 0.25, wave length L, height L/30). As estimated
the ship is stable. With the coefficient K_prr turned round and sixty times as large, an invented value, yaw feeds roll:
the mechanism of the paper. The pictures show roll of the motion itself, and how a disturbance of 0.0006 deg dies out or
grows beside the rate that Floquet's theory gives for the roll pair.

Usage: python plot_unstable_motion.py [picture.png]
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt

PERIODS = 12


def disturbance(model: qt.Model, motion: qt.Motion, n2: float) -> tuple[np.ndarray, ...]:
    """Time [s], roll of the motion, and size of the disturbance of roll [deg], by two integrations."""
    period = 2 * np.pi / model.frequency
    start = motion.state(0.0)
    one, other = (
        qt.simulate(model, PERIODS * period, start + push, step=period / 50, tolerance=1e-12)
        for push in (np.zeros(4), np.array([0.0, 1e-5, 0.0, 0.0]))
    )
    angle, rate = other["roll"] - one["roll"], other["roll_rate"] - one["roll_rate"]
    return one["time"].values, one["roll"].values, np.hypot(angle, rate / n2).values


def main(picture: str = "") -> None:
    ship = qt.ship("series60-cb60").with_(velocities="absolute", drag="cubic", ends="strips", righting="polynomial")
    length = ship.hull.length
    wave, speed = qt.Wave(length=length, height=length / 30), 0.25 * np.sqrt(9.81 * length)
    figure, panels = plt.subplots(2, 2, figsize=(11, 6), sharex=True, layout="constrained")
    for column, factor in enumerate((1.0, -60.0)):
        model = qt.equations(ship.with_(factors={"K_prr": factor}), wave, speed, heading=30.0)
        motion = qt.steady_motion(model, harmonics=9, start="rest")
        verdict = qt.stability(model, motion)
        time, roll, size = disturbance(model, motion, verdict.n2)
        pair = verdict.exponents[np.abs(verdict.exponents.imag) > 1e-6][0].real
        late = (time > 3 * 2 * np.pi / model.frequency) & (size < 1.0)  # while it is small, before the ship capsizes
        measured = np.polyfit(time[late], np.log(size[late]), 1)[0]
        print(f"K_prr x {factor:g}: {verdict.sentence}")
        print(f"   roll pair [1/s]: K2/(2 n2) {-verdict.index:+.4f}, Floquet {pair:+.4f}, integration {measured:+.4f}")
        top, bottom = panels[:, column]
        top.plot(time, roll, "C0")
        top.set(ylabel="roll of the motion [deg]", title=f"K_prr times {factor:g}: {verdict.kind}")
        bottom.semilogy(time, size, "C1", label="disturbance, integrated")
        bottom.semilogy(time, size[0] * np.exp(pair * time), "k--", label=f"Floquet, roll pair: {pair:+.4f} 1/s")
        bottom.semilogy(
            time, size[0] * np.exp(-verdict.index * time), "k:", label=f"K2/(2 n2): {-verdict.index:+.4f} 1/s"
        )
        bottom.set(ylabel="disturbance of roll [deg]", xlabel="time [s]")
        bottom.legend()
    figure.suptitle(
        f"{ship.name}: heading 30 deg, Fn 0.25, wave {wave.length:.0f} x {wave.height:.1f} m; coefficients estimated"
    )
    figure.savefig(picture, dpi=130) if picture else plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
