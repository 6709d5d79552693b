"""`quartering coefficients`: every number of the equations, with its source."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import typer

from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, ShipName, Speed, TableFile
from quartering.view.console.files import TABLES, reserve_path
from quartering.view.console.printed import Table, table
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import typed_ship, typed_value
from quartering.view.console.typed_values import value


def coefficients(
    ship: ShipName,
    changes: Changes,
    speed: Speed = "0.2Fn",
    frequency: Annotated[str | None, typer.Option(help="Encounter frequency [rad/s]; by default that of roll.")] = None,
    output: TableFile = None,
) -> Answer:
    """Every coefficient of the equations with value, unit and source."""
    from quartering.hydro.coefficients import coefficients as coefficients_of
    from quartering.hydro.decay.free_roll import damping_words
    from quartering.hydro.terms import estimates
    from quartering.loads.validity import warn_of_conditions
    from quartering.view.wording import estimated_words, sentence, speed_words

    one = typed_ship(ship, changes)
    path = reserve_path(output, TABLES)
    u = typed_value("speed", speed, one.sizes)
    warn_of_conditions(one, u, [])
    w = coefficients_of(one, 0.0, u).roll_frequency
    if frequency is not None:
        w = value(frequency, "ratio", one.sizes, "--frequency")
    c = coefficients_of(one, w, u)
    entries = c.table()

    def lines() -> Iterator[Table | str]:
        shown = [(e.name, f"{e.value:.4g}", e.unit, e.kind, e.source) for e in entries if e.value != 0.0]
        title = f"{one.name} at {speed_words(u, one.hull.length)}, encounter frequency {w:.3g} rad/s; about G, SI"
        yield table(title, ("name", "value", "unit", "kind", "source"), shown, (1,))
        yield "Zeros are left out. Y_r is the hydrodynamic one; the equations also carry -m U."
        yield sentence(damping_words(one, u))
        yield estimated_words(estimates(entries), one.provenance)

    def facts() -> dict[str, object]:
        rows = [entry._asdict() for entry in entries]
        return {"ship": one.name, "speed": u, "frequency": w, "roll_frequency": c.roll_frequency, "coefficients": rows}

    again = f"{ship}{option_words(changes)}"
    return Answer(
        lines(),
        facts,
        next_steps=[f"quartering forces {again}", f"quartering polar {again}"],
        output=path,
        data=lambda: [Table(f"{one.name}: coefficients", entries[0]._fields, entries)],
    )
