"""The keys a case file may have."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from quartering.hull.choices import Velocities
from quartering.loads.forces import Form
from quartering.motion.harmonic import MOST_HARMONICS


def _no_switch(given: Any) -> Any:
    """What was given, refused where YAML reads a word such as yes or off as a switch."""
    if any(isinstance(item, bool) for item in (given if isinstance(given, list) else [given])):
        raise ValueError("a number or a text with a unit is wanted, no switch")
    return given


Values = Annotated[
    float | str | list[float | str],
    BeforeValidator(_no_switch),
    Field(description='a value "8 kn", a list [0, 4, 8], or a range "0..18 kn step 1" or "0.4..2.3 L count 20"'),
]


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class LoadingAxes(_Strict):
    """Values of the loading; every combination is computed."""

    gm: Values | None = Field(default=None, description="metacentric height [m, B]; gm or kg, not both")
    kg: Values | None = Field(default=None, description="height of G over the keel [m, B]")
    gyradius_roll: Values | None = Field(default=None, description="k_xx [m, B]")
    gyradius_yaw: Values | None = Field(default=None, description="k_zz [m, L]")
    roll_damping: Values | None = Field(default=None, description="added roll damping, fraction of critical [1, %]")
    draught: Values | None = Field(default=None, description="[m, T]")
    bilge_keel_length: Values | None = Field(
        default=None,
        description="of one of the pair [m, L]; in place of roll_damping: with keels it is by Ikeda's components",
    )
    bilge_keel_breadth: Values | None = Field(default=None, description="of one of the pair [m, B]; 0 is no keel")
    velocities: Velocities | list[Velocities] | None = Field(
        default=None, description="velocity that lift acts on: relative to the water, or absolute, as in the paper"
    )


class Case(_Strict):
    """A study: a ship and every combination of conditions and loadings."""

    ship: str = Field(description="name of a built-in ship, or path of a ship file beside this one")
    speed: Values = Field(description="forward speed [m/s, kn, Fn], from 0")
    heading: Values = Field(description="0 following, 90 beam, 180 head sea [deg]")
    wave_length: Values = Field(description="[m, L]")
    wave_height: Values | None = Field(
        default=None, description="crest to trough [m]; at most a seventh of the wave length; or give steepness"
    )
    steepness: Values | None = Field(
        default=None,
        description="wave height over wave length, 0.02, 2 % or 1/50, for all lengths alike; or give wave_height",
    )
    loading: LoadingAxes = Field(default=LoadingAxes(), description="values of the loading to vary")
    coefficients: dict[str, Values] = Field(
        default={}, description="multipliers of coefficients by name, such as K_ppp"
    )
    harmonics: int = Field(
        default=1, ge=1, description=f"of the steady motion: 1 is the paper's method; 3, 5, 7, .. {MOST_HARMONICS}"
    )
    form: Form = Field(default="stf", description="of the diffraction force")
