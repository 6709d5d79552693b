"""The whole state of a page, and the link that carries it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal
from urllib.parse import urlencode

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationError,
    WithJsonSchema,
    create_model,
    model_validator,
)

from quartering.arguments import ARGUMENTS
from quartering.conventions import InputError
from quartering.hull.file.refusals import allowed, user_words
from quartering.loads.sea.sea import Spectrum
from quartering.option_checks import checked
from quartering.options import OPTIONS, line_of, ship_options, unknown
from quartering.study.loadings import KEEL_AXES
from quartering.units import Sizes
from quartering.view.explorer.sea.sea_state import LONG_CRESTED, Mode, checked_sea

Panel = Literal["motion", "stability", "curve", "causes", "response", "hull", "criteria", "compare"]
"""What the right side of the page shows."""

OF_WAVE, OF_SEA = ("motion", "stability", "curve", "causes", "compare"), ("response",)
"""Panels of a regular wave alone, and of an irregular sea alone, the usual one of each first."""

Over = Literal["wave_height", "wave_length", "speed", "frequency"]
"""What the response curve is drawn over."""

DIALS = tuple(one for one in ship_options() if one.axis and one.dial != ())
"""Options a page has a dial for."""

LOADING = tuple(one.name for one in DIALS)
"""Loading values a page can change; None keeps the ship's own."""


def plain_number(value: Any) -> Any:
    """A value, as a number where it is text that is one: numbers of a link come as text."""
    try:
        return float(value) if isinstance(value, str) else value
    except ValueError:
        return value


Value = Annotated[
    Any, BeforeValidator(plain_number), WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "string"}]})
]
"""A number, or text with a unit; it is looked at, and refused in the words of the table, where the ship is known."""

_LARGEST = Sizes(1000.0, 300.0, 100.0)
"""A ship larger than any, which limits in sizes of the ship are taken of before it is known [m]."""


def loading_fields(names: Iterable[str] = LOADING) -> dict[str, Any]:
    """Fields of a record that changes values of a ship: numbers or text with a unit, None for the ship's own.

    Limits and words are those of the table; they are looked at where the ship they are measured by is known.
    """
    return {name: (Value | None, Field(default=None, description=line_of(OPTIONS[name]))) for name in names}


def checked_loading(given: Any) -> Any:
    """Refuse values no ship has: what does not need the ship to be known."""
    if isinstance(given, Mapping):
        for one in DIALS:
            if given.get(one.name) is not None:
                checked(one, given[one.name], sizes=_LARGEST)
    return given


if TYPE_CHECKING:
    Loaded = BaseModel
else:
    Loaded = create_model("Loaded", **loading_fields())


def check_keels(roll_damping: float | None, length: float | None, breadth: float | None) -> None:
    """Refuse one size of the keels without the other, and keels beside a fraction of critical, which stands for them."""
    if (length is None) != (breadth is None):
        raise ValueError("bilge_keel_length and bilge_keel_breadth go together; give both, or leave both out")
    if length is not None and roll_damping is not None:
        raise ValueError("roll_damping stands for the bilge keels too; give it or the two sizes of the keels, not both")


class State(Loaded):
    """What a page shows: ship, loading, sea, condition, panel.

    Parameters
    ----------
    ship : str                              name the server knows it by
    gm, gyradius_roll, roll_damping, .. : float    the options of `DIALS`, in SI; None: the ship's own
    speed : float                           [m/s]; None: Fn 0.25
    heading : float                         0 following, 180 head [deg]
    wave_length : float                     [m]; None: the ship's length
    wave_height, steepness : float          one of the two: the same height [m], or the same H/lambda, for all waves of the map
    harmonics : int                         of the steady motion
    panel, over : str                       what the right side shows
    mode : str                              a regular wave, or an irregular sea
    hs, tp, tz, spectrum, spreading         of the sea, as of `quartering.Sea`; None: chosen for the ship
    beside : str                            link of the ship and loading to compare with; None: nothing

    Examples
    --------
    >>> State(heading=30.0).query()
    'ship=series60-cb60&heading=30'
    >>> State.of_query({"heading": "30", "gm": "0.9"}).gm
    0.9
    """

    model_config: ClassVar[ConfigDict] = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    ship: str = Field(default="series60-cb60", max_length=1000)
    speed: float | None = Field(default=None, ge=0, le=100)
    heading: float = Field(default=60.0, ge=0, le=180)
    wave_length: float | None = Field(default=None, gt=0, le=1e4)
    wave_height: float | None = Field(default=None, ge=0, le=1e3)
    steepness: float | None = Field(default=None, gt=0, le=1 / 7)
    harmonics: Literal[1, 3, 5, 7, 9] = 1
    panel: Panel = "motion"
    over: Over = "wave_height"
    mode: Mode = "wave"
    hs: Value | None = Field(default=None, description=line_of(ARGUMENTS["hs"]))
    tp: Value | None = Field(default=None, description=line_of(ARGUMENTS["tp"]))
    tz: Value | None = Field(default=None, description=line_of(ARGUMENTS["tz"]))
    spectrum: Spectrum = "jonswap"
    spreading: str = Field(default=LONG_CRESTED, max_length=20)
    beside: str | None = Field(default=None, max_length=2000)

    @model_validator(mode="before")
    @classmethod
    def _one_sea(cls, given: Any) -> Any:
        """A height or a steepness; 1/30 when neither is given."""
        if not isinstance(given, dict):
            return given
        height, steepness = given.get("wave_height"), given.get("steepness")
        if height is not None and steepness is not None:
            raise ValueError("wave_height and steepness are both given; leave one out")
        return given if height is not None or steepness is not None else {**given, "steepness": 1 / 30}

    @model_validator(mode="before")
    @classmethod
    def _in_range(cls, given: Any) -> Any:
        """Every value in the range of its option."""
        return checked_sea(checked_loading(given))

    @model_validator(mode="before")
    @classmethod
    def _panel_of_mode(cls, given: Any) -> Any:
        """A panel of the other mode gives way to the first of this one."""
        if not isinstance(given, dict):
            return given
        here, there = (OF_SEA, OF_WAVE) if given.get("mode") == "sea" else (OF_WAVE, OF_SEA)
        return {**given, "panel": here[0]} if given.get("panel", "motion") in there else given

    @model_validator(mode="after")
    def _one_roll_damping(self) -> State:
        """A fraction of critical or a pair of keels."""
        check_keels(*(getattr(self, name) for name in ("roll_damping", *KEEL_AXES)))
        return self

    @model_validator(mode="before")
    @classmethod
    def _numbers(cls, given: Any) -> Any:
        """Whole numbers of a link come as text."""
        words = given.get("harmonics") if isinstance(given, dict) else None
        return {**given, "harmonics": int(words)} if isinstance(words, str) and words.isdecimal() else given

    @classmethod
    def of_query(cls, query: Mapping[str, str]) -> State:
        """The state a link describes; `STARTING` for a link that says nothing."""
        if not query:
            return STARTING
        try:
            return cls.model_validate(dict(query))
        except ValidationError as error:
            raise InputError(f"this link cannot be read: {sentence(error)}") from None

    def query(self) -> str:
        """The part of a link after the question mark: the ship, and everything that is not as it would be anyway."""
        usual = State()
        changed = {"ship": self.ship} | {n: v for n, v in self if v is not None and v != getattr(usual, n)}
        return urlencode({name: f"{v:.10g}" if isinstance(v, float) else v for name, v in changed.items()})

    def changed(self, **values: Any) -> State:
        """The state with some values changed."""
        try:
            return State.model_validate(self.model_dump() | values)
        except ValidationError as error:
            raise InputError(sentence(error)) from None


def read_link(query: Mapping[str, str]) -> tuple[State, str]:
    """The state a link describes, and what of the link is not known here; "" where all is.

    Raises
    ------
    InputError    a known part that cannot be
    """
    strange = [name for name in query if name not in State.model_fields]
    state = State.of_query({name: value for name, value in query.items() if name not in strange})
    if not strange:
        return state, ""
    known = tuple(State.model_fields)
    said = "; ".join(unknown(name[:40], known).words for name in strange[:5])
    return state, f"part of this link is of another version, or a slip, and is left out: {said}"


STARTING = State(ship="dtmb5415", speed=11.2, heading=50.0, wave_length=242.0)
"""What a page opens with: a fast ship in quartering waves, inside the range of the theory."""


def sentence(error: ValidationError) -> str:
    """The first thing that is wrong, in words."""
    problem = error.errors()[0]
    key = ", ".join(str(part) for part in problem["loc"])
    given = str(problem["input"])[:80]
    if problem["type"] == "extra_forbidden":
        return f"{key} is unknown; known are {', '.join(State.model_fields)}"
    own = user_words(problem)
    if own is not None:
        return f"{key} = {given}: {own}" if key else own
    return f"{key} = {given}: allowed is {allowed(problem)}"
