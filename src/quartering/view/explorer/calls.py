"""What a call of the service may hold; pydantic refuses the rest with a reason."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, model_validator

from quartering.hull.ship import Ship
from quartering.loads.forces import Form
from quartering.study.loadings import loaded
from quartering.view.explorer.fleet import Fleet
from quartering.view.explorer.state import LOADING, check_keels

MOST_CELLS = 20_000
"""Largest map of one call."""

Finite = Annotated[float, Field(allow_inf_nan=False)]
Speed = Annotated[Finite, Field(ge=0, le=100)]
Heading = Annotated[Finite, Field(ge=-360, le=360)]
Length = Annotated[Finite, Field(gt=0, le=1e5)]


class Call(BaseModel):
    """Ship, loading and method, which every call has."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    ship: str = Field(max_length=200, description="a built-in ship by name, as `quartering ships` lists them")
    gm: float | None = Field(default=None, gt=0, description="metacentric height [m]; the ship's own when left out")
    gyradius_roll: float | None = Field(default=None, gt=0, description="radius of gyration in roll [m]")
    gyradius_yaw: float | None = Field(default=None, gt=0, description="radius of gyration in yaw [m]")
    roll_damping: float | None = Field(default=None, ge=0, le=1, description="added roll damping, fraction of critical")
    bilge_keel_length: float | None = Field(
        default=None, gt=0, description="of one of the pair [m]; goes with bilge_keel_breadth, in place of roll_damping"
    )
    bilge_keel_breadth: float | None = Field(
        default=None, ge=0, description="[m]; roll damping then is by Ikeda's components; 0 is the hull without keels"
    )
    harmonics: int = Field(default=1, ge=1, le=9, description="of the steady motion: 1 is the paper's method, else odd")
    form: Form = Field(default="stf", description="of the diffraction force")

    @model_validator(mode="after")
    def _one_roll_damping(self) -> Any:
        check_keels(self.roll_damping, self.bilge_keel_length, self.bilge_keel_breadth)
        return self

    def loaded(self, fleet: Fleet) -> Ship:
        """The ship of this call with its loading."""
        changes = {name: value for name in LOADING if (value := getattr(self, name)) is not None}
        return loaded(fleet.known(self.ship).ship, changes)


class VerdictCall(Call):
    """One condition."""

    speed: Speed = Field(description="[m/s]")
    heading: Heading = Field(description="0 following, 90 beam, 180 head sea [deg]")
    wave_length: Length = Field(description="[m]")
    wave_height: float = Field(ge=0, le=1e4, description="crest to trough [m], at most a seventh of the length")


class PolarCall(Call):
    """Every combination of speeds, headings and wave lengths, at one wave height or one steepness."""

    speed: list[Speed] = Field(min_length=1, max_length=MOST_CELLS, description="[m/s]")
    heading: list[Heading] = Field(
        default=[5.0 * i for i in range(37)],
        min_length=1,
        max_length=MOST_CELLS,
        description="[deg]; by default 0, 5, .. 180",
    )
    wave_length: list[Length] = Field(min_length=1, max_length=MOST_CELLS, description="[m], each once")
    wave_height: float | None = Field(default=None, ge=0, le=1e4, description="crest to trough [m]; or give steepness")
    steepness: float | None = Field(default=None, ge=0, le=1 / 7, description="height over length; or give wave_height")

    @property
    def cells(self) -> int:
        """Number of conditions."""
        return len(self.speed) * len(self.heading) * len(self.wave_length)

    @model_validator(mode="after")
    def _possible(self) -> Any:
        if (self.wave_height is None) == (self.steepness is None):
            raise ValueError("give wave_height or steepness, one of the two")
        if self.cells > MOST_CELLS:
            raise ValueError(
                f"{self.cells:,} cells; a call takes up to {MOST_CELLS:,}: make several calls, or use `quartering sweep`"
            )
        return self
