"""Component methods of roll damping as the equations take them: K_p and K_p|p| fitted about one amplitude."""

from __future__ import annotations

from functools import lru_cache, partial
from typing import Final

import numpy as np

from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.damping.components import REFERENCES, Method
from quartering.hydro.damping.forms import LINEAR_OF_QUADRATIC
from quartering.hydro.damping.method import AMPLITUDE, LINEAR, MODULUS, AddedDamping, DampingMethod
from quartering.hydro.damping.natural_roll import FreeRoll, free_roll
from quartering.hydro.damping.roll import roll_damping


def _by_components(method: Method, ship: Ship, speed: Floats, roll: FreeRoll) -> AddedDamping:
    """At the natural frequency B1 p + B2 |p| p over 2.5 to 15 deg, less the wave damping at rest that K_p has already."""
    each, back = np.unique(speed, return_inverse=True)
    forms = np.array([_form(ship, float(u), method) for u in each])[back]
    rate = roll.frequency * np.radians(AMPLITUDE)
    equivalent = forms[:, 0] + LINEAR_OF_QUADRATIC * rate * forms[:, 1]
    return AddedDamping({LINEAR: forms[:, 0], MODULUS: forms[:, 1]}, equivalent)


@lru_cache(maxsize=4096)
def _form(ship: Ship, speed: float, method: Method) -> tuple[float, float]:
    """K_p and K_p|p| to add at one speed."""
    damping = roll_damping(ship, speed, free_roll(ship).frequency, AMPLITUDE, method=method)
    return damping.potential_wave - damping.quadratic.linear, -damping.quadratic.nonlinear


def _words(ship: Ship) -> str:
    said = ship.provenance.get("roll_damping", "given")
    return f"{said}; K_p and K_p|p| fitted about {AMPLITUDE:g} deg at the natural frequency and this speed"


def _method(name: Method) -> DampingMethod:
    return DampingMethod(partial(_by_components, name), "estimated", _words, REFERENCES[name], lift=True)


IKEDA: Final = _method("ikeda")
"""Ikeda's components from the lines.  Source: [Himeno81], [ITTC11]."""
IKEDA_SIMPLIFIED: Final = _method("simplified")
"""The regression on them.  Source: [Kawahara09]."""
