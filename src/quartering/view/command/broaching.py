"""`quartering broaching`: does a ship that a wave carries along keep its course?"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, Picture, ShipName, Speed, WaveHeight, WaveLength
from quartering.view.console.files import PICTURES, picture_files, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import Typed

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from quartering.study.six_modes.broaching import Broaching
    from quartering.view.console.printed import Table

_NUMBERS = (
    ("revolutions of the propeller", "revolutions", "1/s"),
    ("place on the wave, from a trough", "place", "deg"),
    ("heading off the wave", "yaw", "deg"),
    ("heel", "heel", "deg"),
    ("rudder", "rudder", "deg"),
    ("GM there, heave and trim held", "gm", "m"),
    ("yaw moment by heading", "yaw_slope", "N m/rad"),
    ("growth of the fastest disturbance", "growth", "1/s"),
    ("time to grow tenfold", "tenfold", "s"),
    ("gain that holds it straight ahead", "critical_gain", "-"),
    ("stable up to a heading of", "stable_to", "deg"),
    ("held by the wave up to a heading of", "exists_to", "deg"),
)
"""What is printed: in words, the attribute of the record, its unit."""


def broaching(
    ship: ShipName,
    changes: Changes,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    heading: Annotated[str, typer.Option(help="Ordered, off the wave's direction: 0 following, up to 60.")] = "0",
    output: Picture = None,
) -> Answer:
    """Broaching out of surf-riding: equilibrium on the wave, its stability, the gain it takes; -o draws it over headings."""
    from quartering.stability.precompile import announce_compilation
    from quartering.study.six_modes.broaching import broaching as judged

    one, wave, u, mu = Typed(ship, heading, speed, wave_length, wave_height, changes).read()
    path = reserve_path(output, PICTURES)
    if path is not None and (one.autopilot is None or one.autopilot.gain == 0):
        raise InputError(
            "-o draws equilibria over the heading ordered, which takes an autopilot; try --autopilot 1,10s"
        )
    announce_compilation()
    found = judged(one, wave, u, mu)
    if path is not None and not math.isfinite(found.exists_to):
        raise InputError(f"-o: {found.status.advice}")

    def draw() -> Figure:
        from quartering.study.six_modes.broaching_branch import broaching_branch
        from quartering.view.plots.broaching import broaching_picture

        return broaching_picture(broaching_branch(one, wave, u))

    again = f"{ship}{option_words(changes)} --wave-length {wave_length} --wave-height {wave_height}"
    return Answer(
        _lines(found),
        lambda: _facts(found) | {"file": str(path) if path else None},
        picture_files(path, draw),
        next_steps=[f"quartering surf-riding {again} --speed {speed}"],
    )


def _lines(found: Broaching) -> Iterator[Table | str]:
    yield found.sentence
    rows = [(words, _shown(getattr(found, key)), unit) for words, key, unit in _NUMBERS]
    yield table("In numbers", ("quantity", "value", "unit"), rows, (1,))


def _shown(value: float) -> str:
    return "-" if math.isnan(value) else "never" if math.isinf(value) else f"{value:.4g}"


def _facts(found: Broaching) -> dict[str, object]:
    """Everything for programs."""
    facts: dict[str, object] = {
        key: getattr(found, key)
        for key in ("ship", "kind", "sentence", "source", "speed", "heading", "gain", "rate_gain", "lag")
    }
    facts |= {"wave_length": found.wave.length, "wave_height": found.wave.height}
    facts |= {"status": found.status.name, "advice": found.status.advice}
    facts["eigenvalues"] = [[float(one.real), float(one.imag)] for one in found.eigenvalues]
    return facts | {key: getattr(found, key) for _, key, _ in _NUMBERS}
