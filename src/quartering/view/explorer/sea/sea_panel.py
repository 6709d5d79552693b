"""The chosen condition in an irregular sea: the sentence on top, and the numbers at the right."""

from __future__ import annotations

import html
import math
from typing import Final

import numpy as np
import xarray as xr

from quartering.hydro.coefficients import coefficients
from quartering.hydro.terms import estimates
from quartering.loads.sea.encounter import wave_frequencies_met
from quartering.study.seas.over_seas.advice import Advice
from quartering.view.explorer import charts
from quartering.view.explorer.cell_panel import Part, hull_parts
from quartering.view.explorer.sea.sea_scene import SeaScene
from quartering.view.sea_words import METHODS, danger_lines, sea_sentence, several_motions

_VANMARCKE: Final = "Vanmarcke: swings in groups count once"
_RICE: Final = "Rice: every swing counts"
_SAMPLES: Final = 240


def sea_headline(of: SeaScene, found: xr.Dataset, said: Advice) -> str:
    """The sentence of the sea: the condition quiet, what becomes of the ship, and what guidance says of it bold."""
    where, _, words = sea_sentence(of.ship, of.sea, of.speed, found).partition(": ")
    look = {Advice.RECOMMENDED: "stable", Advice.UNDECIDED: "undecided"}.get(said, "unstable")
    told = html.escape(words.removesuffix("."))
    return f"<h1><span class='when'>{html.escape(where)}:</span> {told}; <b class='{look}'>{said.label}</b>.</h1>"


def sea_notes() -> list[str]:
    """What the numbers of a sea are, said below the sentence."""
    return [
        f"By statistical linearisation, with sway, roll and yaw: roll RMS {METHODS['closure'][1]} of that simulated in twelve"
        " seas of one ship."
    ]


def sea_parts(panel: str, of: SeaScene, found: xr.Dataset) -> list[Part]:
    """What the tab of a page shows of a sea."""
    if panel == "hull":
        return hull_parts(
            of.ship, estimates(list(coefficients(of.ship, float(found["n2"].fillna(0.0)), of.speed).table()))
        )
    remarks = "".join(
        f"<p class='hint'>{html.escape(line)}</p>" for line in (*danger_lines(found), *several_motions(found))
    )
    return [
        _table(found),
        "<h2>The sea</h2>",
        _spectrum(of, found),
        f"{remarks}<p class='hint'>The waves that act: {html.escape(found.attrs['cut'])}, without {float(found['cut_off']):.2%}"
        f" of the energy. Lateral acceleration at {html.escape(found.attrs['place'])}, gravity of the heeled deck in it.</p>",
    ]


def _table(found: xr.Dataset) -> str:
    """Numbers of the response, each with what it is."""
    hours = f"{float(found.attrs['hours']):g} h"
    rows = [
        ("roll, root mean square", "roll_rms", "°", "about its mean"),
        ("mean period of roll", "roll_period", "s", "between upward crossings"),
        (f"largest roll of {hours}, most probable", "roll_most_probable", "°", _VANMARCKE),
        ("", "roll_most_probable_bound", "°", f"at most; {_RICE}"),
        (f"<b>largest roll of {hours}, mean</b>", "roll_mean_largest", "°", _VANMARCKE),
        ("", "roll_mean_largest_bound", "°", f"at most; {_RICE}"),
        ("lateral acceleration, root mean square", "lateral_acceleration_rms", "m/s²", ""),
        (f"largest of {hours}, mean", "lateral_acceleration_mean_largest", "m/s²", _VANMARCKE),
        ("roll frequency n₂ about the motion", "n2", "rad/s", ""),
        ("K₂ of the sea", "k2", "1/s²", "below 0 is stable"),
    ]
    body = "".join(
        f"<tr><td>{what}</td><td>{_number(float(found[name]), unit)}</td><td class='hint'>{remark}</td></tr>"
        for what, name, unit, remark in rows
    )
    slow = ", ".join(_number(float(rate), "") for rate in found["slow"].values)
    said = "<td class='hint'>averaged over the sea; below 0 is stable</td>"
    body += f"<tr><td>slow sway-yaw modes</td><td>{slow} 1/s</td>{said}</tr>"
    body += "".join(
        f"<tr><td>{what}</td><td>{100 * float(found[name]):.3g} %</td><td class='hint'>{remark}</td></tr>"
        for what, name, remark in (
            ("energy overtaken by the ship", "overtaken", "encounter frequency below 0"),
            ("energy near encounter frequency 0", "near_zero", "above 20 % not valid: surf-riding, broaching"),
        )
    )
    return f"<table class='judges told'><tr><th>quantity</th><th>value</th><th>remark</th></tr>{body}</table>"


def _number(value: float, unit: str) -> str:
    if not math.isfinite(value):
        return "none"
    return f"{value:.3g}{'' if unit in ('', '°') else ' '}{unit}"


def _spectrum(of: SeaScene, found: xr.Dataset) -> charts.Chart:
    """Density of the sea over wave frequency, and the waves that meet the ship at its roll frequency."""
    bands = [one.band for one in of.sea.partitions]
    high = max(band[1] for band in bands)
    sigma = np.linspace(1e-3, high, _SAMPLES)
    n2 = float(found["n2"]) if math.isfinite(float(found["n2"])) else float(found.attrs["roll_frequency"])
    met = wave_frequencies_met(n2, of.speed, of.heading)[0]
    return charts.spectrum(sigma, of.sea.density(sigma), [float(s) for s in met if np.isfinite(s) and s < high])
