"""Results of a free-decay fit: damping with confidence intervals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple, get_args

import numpy as np

from quartering.conventions import InputError
from quartering.hydro.damping.forms import LINEAR_OF_CUBIC, LINEAR_OF_QUADRATIC

Form = Literal["quadratic", "cubic"]
Restoring = Literal["linear", "cubic"]
Method = Literal["equation", "energy"]


class Estimate(NamedTuple):
    """A number with its confidence interval.

    Parameters
    ----------
    value, low, high : float
    """

    value: float
    low: float
    high: float


class Row(NamedTuple):
    """One line of a table of decay results: a value with its confidence interval."""

    name: str
    value: float
    low: float
    high: float
    unit: str


@dataclass(frozen=True)
class DecayFit:
    """Damping found from a decay.

    Parameters
    ----------
    source : str                   the record
    method : str                   "equation" (least squares of the equation of motion) or "energy" (Froude)
    form : str                     "quadratic" or "cubic": the nonlinear damping term
    frequency : Estimate           w0 [rad/s]
    damping_ratio : Estimate       zeta, linear part [1]
    nonlinear : Estimate           d [1/rad] or c [s/rad2]
    restoring_cubic : Estimate     k3 [1/(s rad)2]; 0 when the restoring is taken as linear
    offset : Estimate              mean angle, removed [rad]
    largest, smallest : float      amplitudes of the swings used [rad]
    swings : int                   how many
    misfit : float                 root mean square of what is left: angle over the largest amplitude ("equation"), or
                                   equivalent damping ratio over its mean ("energy") [1]
    confidence : float             of the intervals [1]
    references : tuple of str      keys of the papers
    """

    source: str
    method: Method
    form: Form
    frequency: Estimate
    damping_ratio: Estimate
    nonlinear: Estimate
    restoring_cubic: Estimate
    offset: Estimate
    largest: float
    smallest: float
    swings: int
    misfit: float
    confidence: float
    references: tuple[str, ...] = ("Froude1874", "Himeno81")

    @property
    def period(self) -> float:
        """Natural period of small swings, 2 pi/w0 [s]."""
        return 2 * np.pi / self.frequency.value

    def equivalent(self, amplitude: float) -> float:
        """Equivalent linear damping ratio at an amplitude.

        amplitude: [rad]
        Returns zeta + (4/(3 pi)) d A, or zeta + (3/8) c w0 A^2 [1]

        Source: [Himeno81] ch. 2, equal dissipation.
        """
        w0 = self.frequency.value
        rate = w0 * amplitude
        factor = LINEAR_OF_QUADRATIC * rate if self.form == "quadratic" else LINEAR_OF_CUBIC * rate**2
        return self.damping_ratio.value + self.nonlinear.value * factor / (2 * w0)

    def moment(self, inertia: float) -> tuple[float, float]:
        """Linear and nonlinear damping moment.

        inertia: I + added inertia > 0 [kg m2]
        Returns B1 [N m s], and B2 [N m s2] or B3 [N m s3]

        Source: [Himeno81] ch. 2.
        """
        if not (np.isfinite(inertia) and inertia > 0):
            raise InputError(f"inertia {inertia:g} kg m2 must be a number above 0, added inertia included")
        linear = 2 * self.damping_ratio.value * self.frequency.value * inertia
        return linear, self.nonlinear.value * inertia

    def table(self) -> tuple[Row, ...]:
        """Every result with its interval and unit.

        Source: [Himeno81] for the terms.
        """
        mean = Estimate(*(float(np.degrees(value)) for value in self.offset))
        symbol, unit = ("quadratic d", "1/rad") if self.form == "quadratic" else ("cubic c", "s/rad2")
        return (
            Row("natural frequency", *self.frequency, "rad/s"),
            Row("damping ratio", *self.damping_ratio, "1"),
            Row(symbol, *self.nonlinear, unit),
            Row("restoring k3", *self.restoring_cubic, "1/(s rad)2"),
            Row("offset", *mean, "deg"),
        )


@dataclass(frozen=True)
class DecayAnalysis:
    """Both methods, both forms, of one decay.

    Parameters
    ----------
    fits : tuple of DecayFit    equation quadratic, equation cubic, energy quadratic, energy cubic
    """

    fits: tuple[DecayFit, ...]

    def fit(self, method: Method, form: Form) -> DecayFit:
        """One of the four.

        method: "equation" or "energy"
        form: "quadratic" or "cubic"

        Source: [Froude1874], [Himeno81].
        """
        return next(fit for fit in self.fits if (fit.method, fit.form) == (method, form))

    def table(self) -> tuple[tuple[str, str, Row], ...]:
        """Method, form and row of every result.

        Source: [Froude1874], [Himeno81].
        """
        return tuple((fit.method, fit.form, row) for fit in self.fits for row in fit.table())


def check_choices(form: str, restoring: str, confidence: float) -> None:
    """Refuse an unknown form of damping or restoring, and a confidence that is none."""
    if form not in get_args(Form):
        raise InputError(f'damping form "{form}" is unknown; allowed are "quadratic" and "cubic"')
    if restoring not in get_args(Restoring):
        raise InputError(f'restoring "{restoring}" is unknown; allowed are "linear" and "cubic"')
    if not 0 < confidence < 1:
        raise InputError(f"confidence {confidence:g} must lie between 0 and 1; try 0.95")
