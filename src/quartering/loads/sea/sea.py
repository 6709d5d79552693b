"""A sea: its spectrum, where it goes, how it spreads; a sum of wave systems."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import GRAVITY, InputError
from quartering.hull.told import number
from quartering.loads.sea.shape import mean_period_ratio
from quartering.loads.sea.spreading import Spreading, checked_spreading
from quartering.loads.sea.systems import JONSWAP_POWER, MeasuredSystem, WaveSystem, checked_cut, wrapped
from quartering.loads.sea.torsethaugen import torsethaugen
from quartering.option_checks import quoted

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]
Spectrum = Literal["jonswap", "bretschneider", "pierson-moskowitz", "torsethaugen"]
STEEPEST_SEA: Final = 0.1
"""Height over length of the mean period above which a sea breaks [1]: recalled from DNV-RP-C205, unverified."""
STEEP_SEA: Final = 0.05
"""Height over length of the mean period above which linear waves are doubted [1]."""


@dataclass(frozen=True, init=False)
class Sea:
    """An irregular sea: a frequency spectrum, the direction it goes to, and how it spreads about it.

    Parameters
    ----------
    hs : float or str        significant wave height 4 sqrt(m0), above 0 [m]; here and below numbers, or text with a unit
    tp, tz : float or str    period of the peak, or mean zero-crossing period: one of the two [s]; of "torsethaugen" tp. A
                             "pierson-moskowitz" sea needs none: fully grown, its period follows from its height
    spectrum : str           "jonswap", "bretschneider" (two parameters, the ITTC's), "pierson-moskowitz", "torsethaugen"
    gamma : float            peak enhancement of "jonswap", 1 to 20
    heading : float or str   direction it goes to from the bow, clockwise: 0 following, 90 from port, 180 head sea [deg]
    spreading : None, s or "cos2"    long-crested; cos^2s of half the angle; cos^2 over 90 deg to either side
    cut : (low, high)        part of the spectrum that acts on a ship, in peak frequencies; nothing is scaled to make up for it

    Raises
    ------
    InputError               a height or period that is not above 0, both or neither period, a sea so steep that it breaks, a
                             spectrum or spreading that is none

    Notes
    -----
    ``sea + swell`` is a sea of both. S(sigma) is one-sided, its integral hs^2/16.
    Source: [Hasselmann73] JONSWAP with its exact norm, [Bretschneider59], [PiersonMoskowitz64], `torsethaugen`.
    Valid: deep water, linear waves.

    Examples
    --------
    >>> sea = Sea(hs=6, tp=11, heading=45, spreading=10)
    >>> round(sea.tz, 3), round(sea.moment(0), 6), sea.density([0.4, 0.6]).shape
    (8.551, 2.25, (2,))
    >>> swell = Sea(hs="2 m", tp="16 s", spectrum="bretschneider", heading=120)
    >>> round((sea + swell).hs, 3)
    6.325
    """

    partitions: tuple[WaveSystem | MeasuredSystem, ...]
    spectrum: str

    def __init__(
        self,
        *,
        hs: float | str,
        tp: float | str | None = None,
        tz: float | str | None = None,
        spectrum: Spectrum = "jonswap",
        gamma: float = 3.3,
        heading: float | str = 0.0,
        spreading: Spreading = None,
        cut: tuple[float, float] = (0.45, 4.0),
    ) -> None:
        height = number(None, "hs", hs)
        period = _peak_period(height, tp, tz, spectrum, number(None, "gamma", gamma))
        towards: dict[str, Any] = {
            "heading": float(wrapped(number(None, "heading", heading))),
            "spreading": checked_spreading(spreading),
            "cut": checked_cut(cut),
        }
        if spectrum == "torsethaugen":
            systems = torsethaugen(height, period)[0]
        else:
            peaked = number(None, "gamma", gamma) if spectrum == "jonswap" else 1.0
            systems = (WaveSystem(height, period, JONSWAP_POWER, peaked),)
        self._hold(tuple(replace(one, **towards) for one in systems), spectrum)

    def _hold(self, partitions: tuple[WaveSystem | MeasuredSystem, ...], spectrum: str) -> None:
        object.__setattr__(self, "partitions", partitions)
        object.__setattr__(self, "spectrum", spectrum)
        if self.steepness > STEEPEST_SEA:
            raise InputError(
                f"a sea of Hs {self.hs:.4g} m and Tz {self.tz:.4g} s has the steepness {self.steepness:.3g}, height over length"
                f" g Tz^2/(2 pi); above {STEEPEST_SEA:g} it breaks: Hs is at most"
                f" {self.hs * STEEPEST_SEA / self.steepness:.3g} m"
            )

    @classmethod
    def _of(cls, partitions: tuple[WaveSystem | MeasuredSystem, ...], spectrum: str) -> Sea:
        sea = object.__new__(cls)
        sea._hold(partitions, spectrum)
        return sea

    @classmethod
    def ochi_hubble(
        cls,
        hs: Sequence[float],
        tp: Sequence[float],
        shape: Sequence[float],
        *,
        heading: float | str = 0.0,
        spreading: Spreading = None,
        cut: tuple[float, float] = (0.45, 4.0),
    ) -> Sea:
        """A sea of one or several systems of Ochi and Hubble's spectrum, each with its own sharpness.

        Parameters
        ----------
        hs, tp : sequences of float    of each system [m], [s]
        shape : sequence of float      lambda of each, above 0.5; 1 is Bretschneider
        heading, spreading, cut        as of `Sea`

        Returns
        -------
        Sea

        Raises
        ------
        InputError                     lists of different lengths, values out of range

        Notes
        -----
        S = (1/4) ((4 lambda + 1) sigma_p^4/4)^lambda/G(lambda) hs^2/sigma^(4 lambda + 1) exp(-(4 lambda + 1)/4 x^-4).
        Source: [OchiHubble76].

        Examples
        --------
        >>> sea = Sea.ochi_hubble([4.0, 3.0], [14.0, 8.0], [3.0, 1.0])
        >>> round(sea.hs, 6)
        5.0
        """
        if not len(hs) == len(tp) == len(shape) >= 1:
            raise InputError(
                f"hs {len(hs)}, tp {len(tp)} and shape {len(shape)} values: give one of each for every system"
            )
        towards = float(wrapped(number(None, "heading", heading)))
        systems = tuple(
            WaveSystem(
                number(None, "hs", height), number(None, "tp", period), 4.0 * number(None, "sharpness", one) + 1.0, 1.0,
                towards, checked_spreading(spreading), checked_cut(cut),
            )
            for height, period, one in zip(hs, tp, shape, strict=True)
        )  # fmt: skip
        return cls._of(systems, "ochi-hubble")

    @classmethod
    def from_spectrum(cls, dataset: xr.Dataset | xr.DataArray, course: float | str) -> Sea:
        """A sea from a spectrum over frequency and direction, as wavespectra and its readers give it.

        Parameters
        ----------
        dataset : Dataset or DataArray    "efth" (freq [Hz], dir [deg, coming from, clockwise from north]) [m2/Hz/deg]; further
                                          dims of length 1 only; directions in any order, evenly round the circle
        course : float                    of the ship, clockwise from north [deg]

        Returns
        -------
        Sea    headings from the bow

        Raises
        ------
        InputError       no such spectrum; directions whose sense is not said, or that go to; gaps; a height other than stated

        Warns
        -----
        RangeWarning     negative energy, which is set to 0 and the rest scaled to the same total

        Notes
        -----
        mu = dir + 180 - course, S(sigma, mu) = efth (180/pi)/(2 pi).

        Examples
        --------
        >>> import xarray as xr
        >>> freq, direction = np.linspace(0.05, 0.3, 26), np.arange(0.0, 360.0, 15.0)
        >>> values = np.exp(-(((freq - 0.1) / 0.02) ** 2))[:, None] * np.cos(np.radians(direction) / 2) ** 20
        >>> efth = xr.DataArray(values, {"freq": freq, "dir": direction}, ("freq", "dir"), name="efth")
        >>> efth["dir"].attrs["standard_name"] = "sea_surface_wave_from_direction"
        >>> round(Sea.from_spectrum(efth, course=300.0).heading, 6)  # from the north, on course 300
        -120.0
        """
        from quartering.loads.sea.measured import read_spectrum

        return cls._of((read_spectrum(dataset, number(None, "course", course)),), "measured")

    def __add__(self, other: Sea) -> Sea:
        if not isinstance(other, Sea):
            return NotImplemented
        return self._of((*self.partitions, *other.partitions), f"{self.spectrum} + {other.spectrum}")

    @property
    def hs(self) -> float:
        """Significant wave height 4 sqrt(m0) of the whole spectrum [m]."""
        if len(self.partitions) == 1:
            return self.partitions[0].hs
        return float(4.0 * np.sqrt(self.moment(0)))

    @property
    def tp(self) -> float:
        """Period of the largest peak [s]."""
        peaks = [one.peak for one in self.partitions]
        return float(2.0 * np.pi / peaks[int(np.argmax(self.density(peaks)))])

    @property
    def tz(self) -> float:
        """Mean zero-crossing period 2 pi sqrt(m0/m2) of the whole spectrum [s]."""
        return float(2.0 * np.pi * np.sqrt(self.moment(0) / self.moment(2)))

    @property
    def heading(self) -> float:
        """Direction the first system goes to, from the bow [deg]."""
        return self.partitions[0].heading

    @property
    def steepness(self) -> float:
        """Height over the length g Tz^2/(2 pi) of the mean period [1]."""
        return self.hs * 2.0 * np.pi / (GRAVITY * self.tz**2)

    def density(self, sigma: ArrayLike) -> Floats:
        """Spectrum over all directions, whole, at (...) frequencies [m2 s/rad].

        Examples
        --------
        >>> float(Sea(hs=4, tp=10).density(0.0))
        0.0
        """
        return np.asarray(sum(one.density(sigma) for one in self.partitions))

    def moment(self, n: float) -> float:
        """Integral of sigma^n times the whole spectrum [m2 (rad/s)^n]; n below 4, of Torsethaugen's below 3.

        Examples
        --------
        >>> round(Sea(hs=4, tp=10).moment(0), 12)
        1.0
        """
        return float(sum(one.moment(n) for one in self.partitions))

    def turned_to(self, heading: float | str) -> Sea:
        """The same sea with its first system at another heading, the others turned with it.

        Examples
        --------
        >>> Sea(hs=4, tp=10, heading=30).turned_to(90).heading
        90.0
        """
        by = number(None, "heading", heading) - self.heading
        return self._of(tuple(one.turned(by) for one in self.partitions), self.spectrum)

    @property
    def words(self) -> str:
        """Height, period, spectrum and spreading, for captions, and how sure the spectrum's formula is."""
        said = f"Hs {self.hs:.3g} m, Tp {self.tp:.3g} s, {spectrum_words(self.spectrum)}"
        first = self.partitions[0]
        if self.spectrum == "jonswap" and isinstance(first, WaveSystem):
            said += f" gamma {first.gamma:.3g}"
        ways = {
            "long-crested" if one.spreading is None else f"spreading s {one.spreading:g}"
            if isinstance(one.spreading, float) else str(one.spreading)
            for one in self.partitions
        }  # fmt: skip
        return f"{said}, {' and '.join(sorted(ways))}"

    def __repr__(self) -> str:
        return f"<Sea {self.words}, heading {self.heading:.4g} deg>"


def spectrum_words(spectrum: str) -> str:
    """Name of a spectrum, and its status where its text was not at hand."""
    return f"{spectrum} (recalled, unverified)" if spectrum == "torsethaugen" else spectrum


def _peak_period(hs: float, tp: Any, tz: Any, spectrum: str, gamma: float) -> float:
    """Period of the peak [s] of what was given."""
    if not isinstance(spectrum, str) or spectrum not in get_args(Spectrum):
        raise InputError(
            f"spectrum = {quoted(spectrum)}; allowed: {', '.join(get_args(Spectrum))}; try 'jonswap'. Ochi and Hubble's is"
            " Sea.ochi_hubble"
        )
    if tp is None and tz is None and spectrum == "pierson-moskowitz":
        return float(2.0 * np.pi / (0.4 * np.sqrt(GRAVITY / hs)))  # fully grown: 5/4 sigma_p^4 = 0.032 (g/Hs)^2
    if (tp is None) == (tz is None):
        both = "are both given; one follows from the other, leave one out" if tp is not None else "are missing"
        raise InputError(f"tp and tz {both}; give one of the two, such as tp=11")
    if tp is not None:
        return number(None, "tp", tp)
    mean = number(None, "tz", tz)
    if spectrum == "torsethaugen":
        raise InputError(
            f"tz = {mean:g} s of a spectrum of two peaks: several peak periods have the same mean; give tp, of the larger"
        )
    return mean / mean_period_ratio(JONSWAP_POWER, gamma if spectrum == "jonswap" else 1.0)
