"""Cures: the smallest change of each design or operating value that restores stability."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from quartering.conventions import InputError, in_unit, written
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import condition, number
from quartering.loads.forces import Form
from quartering.loads.strips.strip_forces import checked_form
from quartering.loads.waves import Wave
from quartering.motion.equations.system import Floats
from quartering.motion.modes import Modes, in_six
from quartering.names import term
from quartering.option_checks import quoted
from quartering.options import unknown
from quartering.stability.kind import Kind
from quartering.study.effects.nearest import INSIDE, Asked, Search, nearest, rounded
from quartering.study.effects.trials import Trials
from quartering.study.loadings import LOADING_AXES, user_value

CURES = ("roll_damping", "gm", "gyradius_roll", "speed", "wave_height", "K_ppp", "K_prr")
"""Values tried when none are named: loading, condition, and the coefficients the paper finds decisive (as multipliers)."""

_PIECE = 128
"""Conditions judged at once: of more the search pauses between."""


@dataclass(frozen=True)
class Cure:
    """The smallest change of one value that makes the motion stable.

    Parameters
    ----------
    parameter : str    loading value, condition, or coefficient
    now : float        its value; 1 for a coefficient, which is multiplied
    needed : float     the value at which the leading exponent is 1e-6 1/s below minus the margin
    unit : str
    """

    parameter: str
    now: float
    needed: float
    unit: str

    @property
    def change(self) -> float:
        """Relative change needed."""
        return self.needed / self.now - 1.0 if self.now else math.copysign(math.inf, self.needed)

    @property
    def rounded(self) -> float:
        """The value needed as the sentence gives it: three digits, a coefficient's factor to a hundredth, never short of it."""
        return rounded(self.needed, self.now, _decimals(self.parameter, self.needed))

    @property
    def _factor(self) -> bool:
        return _is_factor(self.parameter)

    @property
    def sentence(self) -> str:
        """The change in words."""
        more, told = "more" if self.change > 0 else "less", self.rounded
        if self._factor:
            if told <= 0:
                return f"{self.parameter} times {told:.2f}"
            return f"{abs(told - self.now):.0%} {more} {self.parameter}"
        unit, name = in_unit(self.unit), written(self.parameter)
        return f"{abs(told - self.now):.3g}{unit} {more} {name} ({self.now:.3g} -> {told:.3g}{unit})"


@takes(ship="Ship", wave="Wave")
def cures(
    ship: Ship,
    wave: Wave,
    speed: float | str,
    heading: float | str,
    *,
    parameters: Sequence[str] = CURES,
    margin: float = 0.0,
    harmonics: int = 1,
    form: Form = "stf",
    modes: Modes = "three",
) -> list[Cure]:
    """Smallest change of each parameter that makes the motion stable with a margin, the smallest relative change first.

    Parameters
    ----------
    ship : Ship
    wave : Wave
    speed : float              [m/s]
    heading : float            [deg]
    parameters : sequence      "gm", "gyradius_roll", "gyradius_yaw", "roll_damping", "speed", "wave_height", or coefficients
    margin : float             the leading exponent must be below minus this, >= 0 [1/s]
    harmonics : int            of the steady motion, as in `steady_motion`: those of the verdict that is to change
    form : str                 of the diffraction force
    modes : str                "three": sway, roll and yaw; "six": parametric roll, pure loss and growing forced roll with heave
                               and pitch, parameters being those of `cures_six`: keels and heading too

    Returns
    -------
    list of Cure               empty when the motion is stable with that margin already, when no change up to fivefold helps,
                               and when the ship is unstable on course without any wave: no matter of this condition

    Raises
    ------
    InputError                 a margin below zero, an unknown parameter or form, harmonics as `steady_motion`

    Notes
    -----
    Each parameter alone, over a fifth to five times its value, in steps of 5 %, then between two of them to 1e-6; coefficients
    that are zero cannot be multiplied.  At every cure the motion of the ship itself is stable with the margin.
    Source: [H71] Figs. 20-22 (what restores stability).

    Examples
    --------
    >>> from quartering.study.paper.model import paper_ship
    >>> restless = paper_ship().with_(factors={"K_prr": -60})
    >>> found = cures(restless, Wave(121.92, 4.0), 8.6, 30.0, parameters=["K_prr", "roll_damping"])
    >>> [one.parameter for one in found]
    ['K_prr', 'roll_damping']
    """
    if in_six(modes):
        from quartering.study.six_modes.cure import CURES as OF_SIX
        from quartering.study.six_modes.cure import cures_six

        if harmonics != 1 or form != "stf":
            raise InputError("modes = six has harmonics and diffraction of its own; leave harmonics and form out")
        U, mu = condition(ship, speed, heading)
        if not margin >= 0:
            raise InputError(f"margin = {margin:g} 1/s; it is 0 or above; try 0")
        return cures_six(ship, wave, U, mu, OF_SIX if parameters == CURES else parameters, margin)
    return list(seek(ship, wave, speed, heading, parameters=parameters, margin=margin, harmonics=harmonics, form=form))[
        -1
    ]


def seek(
    ship: Ship,
    wave: Wave,
    speed: float | str,
    heading: float | str,
    *,
    parameters: Sequence[str] = CURES,
    margin: float = 0.0,
    harmonics: int = 1,
    form: Form = "stf",
) -> Iterator[list[Cure]]:
    """The search of `cures` in small steps, for whoever has others to serve meanwhile.

    as in `cures`
    Yields found so far, after each step of the search

    Source: [H71] Figs. 20-22 (what restores stability).

    >>> from quartering.hull.file.read import ship
    >>> list(seek(ship("wigley"), Wave(100.0, 0.5), 3.0, 90.0))
    [[]]
    """
    speed, heading = condition(ship, speed, heading)
    margin, form, parameters = number(ship, "margin", margin), checked_form(form), _names(parameters)

    trials = Trials(ship, wave, float(speed), float(heading), harmonics, form)
    yield []
    exponent, kind = trials.as_it_is()
    if exponent < -margin or kind == Kind.COURSE_IN_CALM_WATER:
        return
    present = {name: _present(ship, wave, float(speed), name) for name in parameters}
    # nothing to multiply: roll damping by a component method is no fraction of critical
    tried = {name: now for name, (now, _) in present.items() if now != 0.0}
    searches = {name: _search(trials, name, now, exponent, -margin - INSIDE) for name, now in tried.items()}
    for factors in _side_by_side(trials, searches):
        found = [Cure(name, tried[name], tried[name] * factor, present[name][1]) for name, factor in factors.items()]
        yield sorted(found, key=_size)


def _search(trials: Trials, name: str, now: float, present: float, target: float) -> Search:
    """The search for a cure by one parameter."""

    def told(factor: float, units: int) -> float:
        return rounded(now * factor, now, _decimals(name, now * factor), units) / now

    return nearest(lambda low, high: trials.span(name, low, high), trials.reach(name), present, target, told)


def _side_by_side(trials: Trials, searches: Mapping[str, Search]) -> Iterator[dict[str, float]]:
    """Factors found so far, while the searches go on together: what all of them ask is judged at once, in pieces."""
    found: dict[str, float] = {}
    answers: dict[str, Floats | None] = dict.fromkeys(searches)
    while answers:
        asked: dict[str, Asked] = {}
        for name, answer in answers.items():
            try:
                asked[name] = next(searches[name]) if answer is None else searches[name].send(answer)
            except StopIteration as end:
                if end.value is not None:
                    found[name] = end.value
        yield found
        answers = {}
        for settled in (False, True):
            for wanted in _pieces({name: one.factors for name, one in asked.items() if one.settled is settled}):
                answers |= trials.exponents(wanted, settled)
                yield found


def _pieces(wanted: Mapping[str, Floats]) -> Iterator[dict[str, Floats]]:
    """What is asked of several parameters in turn, parted where it is more than is judged at once."""
    piece: dict[str, Floats] = {}
    for name, factors in wanted.items():
        if piece and sum(map(len, piece.values())) + len(factors) > _PIECE:
            yield piece
            piece = {}
        piece[name] = factors
    if piece:
        yield piece


def _names(parameters: Sequence[str]) -> tuple[str, ...]:
    """Parameters to try, refused when they are no list, or one is none that can be changed by a factor."""
    if isinstance(parameters, str) or not isinstance(parameters, (Sequence, np.ndarray)):
        raise InputError(f"parameters = {quoted(parameters)}; they are a list of names; try {list(CURES[:2])}")
    known = ("speed", "wave_height", *LOADING_AXES)
    for name in parameters:
        try:
            if name not in known:
                term(str(name))
        except InputError:
            message = unknown(str(name), (*known, *CURES)).words
            raise InputError(
                f"parameters: {message}; a coefficient by its name, such as K_ppp, may stand too"
            ) from None
    return tuple(map(str, parameters))


def _is_factor(name: str) -> bool:
    return "_" in name and name[0] in "YKN"


def _decimals(name: str, value: float) -> int:
    """Decimals a value is told with: a coefficient's factor to a hundredth, others to three digits."""
    return 2 if _is_factor(name) else 2 - math.floor(math.log10(abs(value)))


def _size(cure: Cure) -> float:
    return float(abs(np.log(abs(cure.needed / cure.now))))


def _present(ship: Ship, wave: Wave, speed: float, name: str) -> tuple[float, str]:
    """Present value of a parameter, and its unit."""
    if name == "speed":
        return speed, "m/s"
    if name == "wave_height":
        return wave.height, "m"
    return user_value(ship, name), "m" if name in LOADING_AXES and name != "roll_damping" else "1"
