"""Roll over heading: the wave's moment, what sway and yaw add to it, and the resonance that decides.

Series 60, CB 0.60, at Froude number 0.25. Left: roll per wave slope for several wave lengths. Right, for one of them: the
roll moment of the wave, the moment that is left when sway and yaw have been eliminated, and the dynamic factor, all per
their static values. Roll is the product of the last two. Prints the table behind the right-hand panel.

Usage: python plot_roll_over_heading.py [picture.png] [GM, such as "0.10 B"] [wave length over L] [Froude number]
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import quartering as qt

HEADINGS = np.arange(5.0, 180.0, 5.0)


def parts(ship: qt.Ship, ratio: float, froude: float, heading: float) -> tuple[float, ...]:
    """Frequency; moment, effective moment, dynamic factor; roll, and roll if sway and yaw were held, per wave slope."""
    length = ship.hull.length
    wave = qt.Wave(length=ratio * length, height=ratio * length / 200)
    model = qt.equations(ship, wave, froude * np.sqrt(9.81 * length), heading)
    w, stiffness = model.frequency, -model.terms["K_phi"]
    rates = np.array([[model.terms[f"{row}_{rate}"] for rate in "vpr"] for row in "YKN"])
    impedance = 1j * w * model.inertia - rates  # force per velocity, modes sway, roll, yaw
    impedance[1, 1] += stiffness / (1j * w)
    force = model.force_cos - 1j * model.force_sin
    from_others = impedance[1, [0, 2]] @ np.linalg.inv(impedance[np.ix_([0, 2], [0, 2])])
    effective = force[1] - from_others @ force[[0, 2]]
    dynamic = 1j * w * (impedance[1, 1] - from_others @ impedance[[0, 2], 1])
    slope = wave.wavenumber * wave.amplitude
    static = stiffness * slope
    alone = abs(force[1] / (w * impedance[1, 1])) / slope
    return (
        w, abs(force[1]) / static, abs(effective) / static, stiffness / abs(dynamic), abs(effective / dynamic) / slope, alone
    )  # fmt: skip


def main(picture: str = "", gm: str = "0.05 B", ratio: str = "1.0", froude: str = "0.25") -> None:
    ship, fn = (
        qt.ship("series60-cb60").with_(
            gm=gm, velocities="absolute", drag="cubic", ends="strips", righting="polynomial"
        ),
        float(froude),
    )
    print(f"GM {gm}, wave length {ratio} L, Fn {froude}\nheading  omega   |K|  |K_eff|  factor   roll  held")
    table = np.array([parts(ship, float(ratio), fn, heading) for heading in HEADINGS])
    for heading, row in zip(HEADINGS, table, strict=True):
        print(f"{heading:7.0f}  " + "  ".join(f"{value:5.3f}" for value in row))
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    for length in (0.5, 0.6, 0.75, 1.0, 1.5):
        left.semilogy(HEADINGS, [parts(ship, length, fn, h)[4] for h in HEADINGS], label=f"$\\lambda$ = {length:g} L")
    left.set(ylabel="roll amplitude / wave slope $kA$", title="roll", ylim=(0.02, 10))
    for column, label in (
        (1, "moment |K|"),
        (2, "moment with sway and yaw |K_eff|"),
        (3, "dynamic factor"),
        (4, "roll"),
    ):
        right.semilogy(HEADINGS, table[:, column], label=label, lw=2.5 if column == 4 else 1.5)
    right.semilogy(HEADINGS, table[:, 5], "k:", label="roll with sway and yaw held")
    right.set(ylabel="per static value $\\rho g V\\,GM\\,kA$, or $kA$", title=f"$\\lambda$ = {ratio} L", ylim=(0.1, 10))
    for axes in (left, right):
        axes.set(xlabel="heading [deg]: 0 following, 90 beam, 180 head", xlim=(0, 180), xticks=range(0, 181, 30))
        axes.grid(which="both", alpha=0.3)
        axes.legend(fontsize=8)
    figure.suptitle(f"{ship.name}, Fn {froude}, GM {gm}, k_xx 0.35 B, 5 % added roll damping (assumed)")
    figure.savefig(picture, dpi=130) if picture else plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:])
