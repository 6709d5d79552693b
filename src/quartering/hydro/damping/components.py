"""What roll damping consists of: the record that `rolldamping.roll_damping` returns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Literal, NamedTuple

from quartering.hydro.damping.forms import DampingForm

Method = Literal["ikeda", "simplified", "fraction"]

_SOURCES: Final[dict[Method, dict[str, str]]] = {
    "ikeda": {
        "friction": "[ITTC11] Kato, Tamiya",
        "eddy": "[Ikeda78a] Lewis sections",
        "lift": "[Ikeda78b]",
        "wave": "strips about G times the speed factor of [Ikeda78b]",
        "bilge_keel": "[Ikeda78c] midship section",
    },
    "simplified": {
        "friction": "[Kawahara09], speed as Tamiya",
        "eddy": "[Kawahara09], speed as [Ikeda78b]",
        "lift": "[Ikeda78b]",
        "wave": "[Kawahara09], speed as [Ikeda78b]",
        "bilge_keel": "[Kawahara09]",
    },
    "fraction": {"fraction": "fraction of critical at the natural frequency, assumed unless the ship says otherwise"},
}
REFERENCES: Final[dict[Method, tuple[str, ...]]] = {
    "ikeda": ("Ikeda78a", "Ikeda78b", "Ikeda78c", "Himeno81", "ITTC11", "Journee03"),
    "simplified": ("Kawahara09", "Ikeda78b", "ITTC11", "Journee03"),
    "fraction": ("Himeno81",),
}
"""Keys of the papers behind each method."""


class Row(NamedTuple):
    """One line of a table of roll damping: a component, its value and unit, and where it comes from."""

    name: str
    value: float
    unit: str
    source: str


@dataclass(frozen=True)
class RollDamping:
    """Equivalent linear roll damping of a ship about G at one speed, frequency and amplitude.

    Parameters
    ----------
    ship : str                                            name of the ship
    method : str                                          "ikeda", "simplified" or "fraction"
    speed, frequency, amplitude_deg : float               U [m/s], omega [rad/s], phi_a [deg]
    friction, eddy, lift, wave, bilge_keel : float        components at that amplitude [N m s]
    fraction : float                                      fraction of critical as damping, method "fraction" [N m s]
    potential_wave : float                                part of `wave` that strip theory has already: at rest [N m s]
    quadratic, cubic : DampingForm                        all of it as linear + quadratic and linear + cubic damping
    fitted_from_deg, fitted_to_deg : float                amplitudes over which those two were fitted [deg]
    references : tuple of str                             keys of the papers behind the numbers
    """

    ship: str
    method: Method
    speed: float
    frequency: float
    amplitude_deg: float
    friction: float
    eddy: float
    lift: float
    wave: float
    bilge_keel: float
    fraction: float
    potential_wave: float
    quadratic: DampingForm
    cubic: DampingForm
    fitted_from_deg: float
    fitted_to_deg: float
    references: tuple[str, ...]

    @property
    def equivalent(self) -> float:
        """Equivalent linear damping at the amplitude, all components [N m s]."""
        return self.friction + self.eddy + self.lift + self.wave + self.bilge_keel + self.fraction

    @property
    def added(self) -> float:
        """What is to be added to the wave damping of strip theory at rest [N m s]."""
        return self.equivalent - self.potential_wave

    def table(self) -> tuple[Row, ...]:
        """Every component and form, with unit and source.

        Returns components, sum, part to add to strip theory, the two forms

        Source: [Himeno81] for the components; each row names its own.
        """
        fitted = f"least squares, {self.fitted_from_deg:.3g} to {self.fitted_to_deg:.3g} deg, misfit "
        two, three = self.quadratic, self.cubic
        parts = [
            Row(name.replace("_", " "), getattr(self, name), "N m s", source)
            for name, source in _SOURCES[self.method].items()
        ]
        return (
            *parts,
            Row("equivalent linear", self.equivalent, "N m s", f"sum, at {self.amplitude_deg:g} deg"),
            Row("to add to strip theory", self.added, "N m s", "sum less the wave damping of the strips at rest"),
            Row("linear (with quadratic)", two.linear, "N m s", f"{fitted}{two.misfit:.1%}"),
            Row("quadratic", two.nonlinear, "N m s2", f"{fitted}{two.misfit:.1%}"),
            Row("linear (with cubic)", three.linear, "N m s", f"{fitted}{three.misfit:.1%}"),
            Row("cubic", three.nonlinear, "N m s3", f"{fitted}{three.misfit:.1%}"),
        )
