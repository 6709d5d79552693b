"""What a call of the service may hold; pydantic refuses the rest with a reason."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from pydantic import BaseModel, ConfigDict, Field, create_model, model_validator

from quartering.hull.changes import check_twice
from quartering.hull.ship import Ship
from quartering.hull.told import number
from quartering.loads.forces import Form
from quartering.options import OPTIONS, line_of, loading_axes
from quartering.study.loadings import CHOICE_AXES, KEEL_AXES, coded, loaded
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.state import Value, check_keels, loading_fields

MOST_CELLS = 20_000
"""Largest map of one call."""


if TYPE_CHECKING:
    Loaded = BaseModel
else:
    Loaded = create_model("Loaded", **loading_fields((*loading_axes(), *CHOICE_AXES)))


class ShipCall(Loaded):
    """Ship and loading, which every call has."""

    model_config: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)

    ship: str = Field(max_length=200, description="a built-in ship by name, as `quartering ships` lists them")

    @model_validator(mode="after")
    def _one_roll_damping(self) -> Any:
        check_keels(*(getattr(self, name) for name in ("roll_damping", *KEEL_AXES)))
        return self

    def loaded(self, registry: ShipRegistry) -> Ship:
        """The ship of this call with its loading."""
        own = registry.known(self.ship).ship
        given = {name: value for name in loading_axes() if (value := getattr(self, name)) is not None}
        check_twice(given, "")
        words = {name: coded(name, value) for name in CHOICE_AXES if (value := getattr(self, name)) is not None}
        return loaded(own, {name: number(own, name, value) for name, value in given.items()} | words)


class Call(ShipCall):
    """Ship, loading and method of a call about regular waves."""

    harmonics: int = Field(default=1, ge=1, le=9, description="of the steady motion: 1 is the paper's method, else odd")
    form: Form = Field(default="stf", description="of the diffraction force")


class VerdictCall(Call):
    """One condition."""

    speed: Value = Field(description=line_of(OPTIONS["speed"]))
    heading: Value = Field(description=line_of(OPTIONS["heading"]))
    wave_length: Value | None = Field(default=None, description=line_of(OPTIONS["wave_length"]))
    wave_period: Value | None = Field(default=None, description=line_of(OPTIONS["wave_period"]))
    wave_height: Value = Field(description=f"{line_of(OPTIONS['wave_height'])}, at most a seventh of the length")


class PolarCall(Call):
    """Every combination of speeds, headings and wave lengths (or periods), at one wave height or one steepness."""

    speed: list[Value] = Field(min_length=1, max_length=MOST_CELLS, description=line_of(OPTIONS["speed"]))
    heading: list[Value] = Field(
        default=[5.0 * i for i in range(37)],
        min_length=1,
        max_length=MOST_CELLS,
        description="[deg]; by default 0, 5, .. 180",
    )
    wave_length: list[Value] | None = Field(
        default=None,
        min_length=1,
        max_length=MOST_CELLS,
        description=f"{line_of(OPTIONS['wave_length'])}, each once; or give wave_period",
    )
    wave_period: list[Value] | None = Field(
        default=None, min_length=1, max_length=MOST_CELLS, description=f"{line_of(OPTIONS['wave_period'])}, each once"
    )
    wave_height: Value | None = Field(default=None, description=f"{line_of(OPTIONS['wave_height'])}; or give steepness")
    steepness: Value | None = Field(default=None, description=f"{line_of(OPTIONS['steepness'])}; or give wave_height")

    extend: bool = Field(default=False, description=line_of(OPTIONS["extend"]).partition(":")[0])

    @property
    def cells(self) -> int:
        """Number of conditions."""
        return len(self.speed) * len(self.heading) * len(self.wave_length or self.wave_period or ())

    @model_validator(mode="after")
    def _possible(self) -> Any:
        if (self.wave_length is None) == (self.wave_period is None):
            raise ValueError("give wave_length or wave_period, one of the two")
        if (self.wave_height is None) == (self.steepness is None):
            raise ValueError("give wave_height or steepness, one of the two")
        if self.cells > MOST_CELLS:
            raise ValueError(
                f"{self.cells:,} cells; a call takes up to {MOST_CELLS:,}: make several calls, or use `quartering sweep`"
            )
        return self
