"""A roll decay: the record between its envelopes, and its damping over the amplitude, part by part."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from quartering.hydro.decay.free_roll import QUADRATIC
from quartering.hydro.decay.of_ship import RollDecay, swings
from quartering.view.plots import style


def decay_picture(decay: RollDecay) -> Figure:
    """Draw a decay and what is made of it."""
    made = style.figure(11.0, 6.4)
    left, right = made.subplots(1, 2, width_ratios=(1.5, 1.0))
    _draw_record(left, decay)
    _draw_damping(right, decay)
    style.title(made, f"Roll decay {Path(decay.record.source).name} and {decay.ship.name}")
    style.footnote(made, _note(decay))
    return made


def _draw_record(ax: Axes, decay: RollDecay) -> None:
    """The angle over time with the envelopes of fit and ship."""
    record, fit = decay.record, decay.fit
    time, _ = swings(decay.record, decay.skip)
    mean = fit.offset.value
    ax.plot(
        record.time, np.degrees(record.angle - mean), color=style.QUIET, linewidth=0.8, label="record, mean taken off"
    )
    after = np.linspace(0.0, record.time[-1] - time[0], 400)
    curves = (
        ("fit", None, style.CONTRAST[0], "-"),
        ("ship with nothing added", decay.bare, style.CONTRAST[1], ":"),
        ("ship with what is added", decay.damped, style.CONTRAST[2], "--"),
    )
    for words, damping, colour, dash in curves:
        high = np.degrees(decay.envelope(after, damping))
        ax.plot(time[0] + after, high, color=colour, linestyle=dash, linewidth=1.4, label=words)
        ax.plot(time[0] + after, -high, color=colour, linestyle=dash, linewidth=1.4)
    ax.set_xlabel("time [s]")
    ax.set_ylabel("roll [deg]")
    ax.set_xlim(record.time[0], record.time[-1])
    ax.legend(loc="upper right", frameon=True, framealpha=0.9, edgecolor="none")


def _draw_damping(ax: Axes, decay: RollDecay) -> None:
    """Equivalent damping over the amplitude: each swing, the fit, and the parts of the ship one over the other."""
    _, amplitude = swings(decay.record, decay.skip)
    loss = np.log(amplitude[:-1] / amplitude[1:]) / np.pi
    middle = (amplitude[:-1] + amplitude[1:]) / 2
    reach = np.linspace(0.0, float(amplitude[0]), 50)
    fit, bare, damped = decay.fit, decay.bare, decay.damped
    linear = np.full_like(reach, bare.ratio)
    drag = np.array([bare.equivalent(a) for a in reach])
    whole = np.array([damped.equivalent(a) for a in reach])
    layers = (
        ("waves and lift of the ship" if decay.speed else "waves of the ship", 0 * reach, linear, style.CONTRAST[0]),
        ("drag of the sections", linear, drag, style.CONTRAST[1]),
        (f"added: roll_damping and {QUADRATIC}", drag, whole, style.CONTRAST[2]),
    )
    for words, low, high, colour in layers:
        ax.fill_between(np.degrees(reach), 100 * low, 100 * high, color=colour, alpha=0.3, linewidth=0, label=words)
    fitted = [100 * fit.equivalent(a) for a in reach]
    ax.plot(np.degrees(reach), fitted, color=style.INK, linewidth=1.4, label="fit of the record")
    ax.plot(np.degrees(middle), 100 * loss, "o", color=style.INK, markersize=3, label="record, swing by swing")
    top = 1.3 * max(max(fitted), float(100 * whole.max()), 1e-3)
    ax.set(xlim=(0.0, np.degrees(reach[-1])), ylim=(0.0, top))
    ax.set_xlabel("amplitude [deg]")
    ax.set_ylabel("equivalent damping [% of critical]")
    ax.legend(loc="upper left", frameon=True, framealpha=0.9, edgecolor="none")


def _note(decay: RollDecay) -> str:
    fit = decay.fit
    parts = (
        f"Fit: {100 * fit.damping_ratio.value:.3g} % of critical and d = {fit.nonlinear.value:.3g} 1/rad. Added: "
        f"roll_damping {decay.roll_damping:.4g}, {QUADRATIC} {decay.quadratic:.4g} kg m2.",
        *decay.notes,
    )
    return " ".join(part.rstrip(".") + "." for part in parts)
