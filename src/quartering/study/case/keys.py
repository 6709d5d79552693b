"""The keys a case file may have."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, create_model

from quartering.loads.forces import Form
from quartering.loads.sea.sea import Spectrum
from quartering.motion.modes import Modes
from quartering.motion.steady.harmonic import MOST_HARMONICS
from quartering.options import OPTIONS, choice_axes, line_of, loading_axes
from quartering.study.seas.over_seas.settings import Judge


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
    model_config: ClassVar[ConfigDict] = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


if TYPE_CHECKING:
    LoadingAxes = _Strict
else:  # the axes are those of the table of options
    LoadingAxes = create_model(
        "LoadingAxes",
        __base__=_Strict,
        __doc__="Values of the loading; every combination is computed.",
        **{
            name: (Values | None, Field(default=None, description=line_of(OPTIONS[name])))
            for name in (*loading_axes(), *choice_axes())
        },
    )


class SwellKeys(_Strict):
    """A swell beside each sea of a study."""

    hs: float | str = Field(description="significant wave height [m]")
    tp: float | str | None = Field(default=None, description="period of the peak [s]; or give tz")
    tz: float | str | None = Field(default=None, description="mean zero-crossing period [s]; or give tp")
    heading: float | str = Field(default=0.0, description="angle off the sea it stands beside [deg]")
    spectrum: Spectrum = Field(default="jonswap", description="of the swell")
    gamma: float = Field(default=3.3, description="peak enhancement of jonswap, 1 to 20")
    spreading: float | str = Field(default="none", description="as of the sea")


class SeaAxes(_Strict):
    """Irregular seas, in place of regular waves; every combination of height and period is computed."""

    hs: Values = Field(description="significant wave heights [m]")
    tp: Values | None = Field(default=None, description="periods of the peak [s]; or give tz")
    tz: Values | None = Field(default=None, description="mean zero-crossing periods [s]; or give tp")
    spectrum: Spectrum = Field(default="jonswap", description="of the seas")
    gamma: float = Field(default=3.3, description="peak enhancement of jonswap, 1 to 20")
    spreading: float | str = Field(
        default="none", description="s of cos^2s of half the angle, cos2, or none for long-crested seas"
    )
    swell: SwellKeys | None = Field(default=None, description="beside each of the seas")
    judge: Judge = Field(default="largest", description="guidance by the largest motion of three hours, or by failures")
    threshold: float | None = Field(
        default=None, description="factor on that motion, by default 2, or rate of failures, 1e-6 [1/s]"
    )
    hours: float = Field(default=0.0, description="to simulate at most where the closure does not decide [h]")
    seed: int = Field(default=0, description="of simulations")


class Case(_Strict):
    """A study: a ship and every combination of conditions and loadings."""

    model_config: ClassVar[ConfigDict] = ConfigDict(
        extra="forbid", frozen=True, allow_inf_nan=False, populate_by_name=True
    )

    ship: str = Field(description="name of a built-in ship, or path of a ship file beside this one")
    changes: dict[str, Any] = Field(
        default={}, alias="with", description="other options of the ship, as ship.with_ takes them: {linear: strip}"
    )
    speed: Values = Field(description="forward speed [m/s, kn, Fn], from 0")
    heading: Values = Field(description="0 following, 90 beam, 180 head sea [deg]")
    wave_length: Values | None = Field(default=None, description="[m, L], or a period [s]; or give wave_period")
    wave_period: Values | None = Field(default=None, description="of the wave seen from a fixed point [s]")
    wave_height: Values | None = Field(
        default=None, description="crest to trough [m]; at most a seventh of the wave length; or give steepness"
    )
    steepness: Values | None = Field(
        default=None,
        description="wave height over wave length, 0.02, 2 % or 1/50, for all lengths alike; or give wave_height",
    )
    sea: SeaAxes | None = Field(default=None, description="irregular seas, in place of wave_length and wave_height")
    loading: LoadingAxes = Field(default=LoadingAxes(), description="values of the loading to vary")
    factors: dict[str, Values] = Field(default={}, description="factors on coefficients by name, such as K_p")
    values: dict[str, Values] = Field(default={}, description="values of coefficients by name, in SI about G")
    harmonics: int = Field(
        default=1, ge=1, description=f"of the steady motion: 1 is the paper's method; 3, 5, 7, .. {MOST_HARMONICS}"
    )
    form: Form = Field(default="stf", description="of the diffraction force")
    modes: Modes = Field(default="three", description="three: sway, roll and yaw; six: heave and pitch too")
