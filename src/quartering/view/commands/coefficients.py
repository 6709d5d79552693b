"""`quartering coefficients`: every number of the equations, with its source."""

from __future__ import annotations

from collections.abc import Mapping

from quartering.hydro.coefficients import coefficients
from quartering.hydro.decay.free_roll import damping_words
from quartering.hydro.terms import estimates
from quartering.loads.validity import warn_of_conditions
from quartering.view.commands.conditions import sizes, typed_ship, typed_value
from quartering.view.options import value
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import estimated_words, sentence, speed_words


def list_coefficients(name: str, speed: str, frequency: str | None, changes: Mapping[str, str], as_json: bool) -> None:
    """Print the table of coefficients at one speed and encounter frequency."""
    one = typed_ship(name, changes)
    u = typed_value("speed", speed, one.sizes)
    warn_of_conditions(one, u, [])
    w = coefficients(one, 0.0, u).roll_frequency
    if frequency is not None:
        w = value(frequency, "ratio", sizes(one), "--frequency")
    c = coefficients(one, w, u)
    entries = c.table()
    if as_json:
        rows = [entry._asdict() for entry in entries]
        show_json(
            {"ship": one.name, "speed": u, "frequency": w, "roll_frequency": c.roll_frequency, "coefficients": rows}
        )
        return
    shown = [(e.name, f"{e.value:.4g}", e.unit, e.kind, e.source) for e in entries if e.value != 0.0]
    title = f"{one.name} at {speed_words(u, one.hull.length)}, encounter frequency {w:.3g} rad/s; about G, SI"
    show(table(title, ("name", "value", "unit", "kind", "source"), shown, (1,)))
    show("Zeros are left out. Y_r is the hydrodynamic one; the equations also carry -m U.")
    show(sentence(damping_words(one, u)))
    show(estimated_words(estimates(entries), one.provenance))
    again = option_words(changes)
    show(next_steps(f"quartering forces {name}{again}", f"quartering polar {name}{again}"))
