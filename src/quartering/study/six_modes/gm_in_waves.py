"""Metacentric height and righting arm of a ship that floats on a frozen wave, crest by crest."""

from __future__ import annotations

import warnings
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import HEADING_CONVENTION, REFERENCE_POINT, InputError, RangeWarning
from quartering.doors import takes
from quartering.hull.lines.section import Floats
from quartering.hull.righting import arm as righting
from quartering.hull.ship import Ship
from quartering.hull.told import condition, count, number, numbers
from quartering.loads.waves import Wave, heading_components
from quartering.loads.wetted_hull.floating import (
    HEAVE,
    TRIM,
    Balance,
    FloatingHull,
    balanced,
    floating_hull,
    floating_tables,
)
from quartering.loads.wetted_hull.pressure import Pressure, Waves, immersion
from quartering.motion.six_modes import vertical_motion
from quartering.study.dataset import attributes, made_by

if TYPE_CHECKING:
    import xarray as xr

BalanceBy = Literal["heave-trim", "heave", "dynamic", "fixed"]

Integration = Literal["direct", "table"]

BALANCES: Final[dict[str, str]] = {
    "heave-trim": "heave and trim carry the weight without a pitching moment",
    "heave": "heave carries the weight, the trim is that of calm water",
    "dynamic": "heave and trim are those of the linear motion at speed at this moment",
    "fixed": "heave and trim are those of calm water",
}
"""How the ship lies on the wave -> in words."""
PRESSURES: Final[dict[str, str]] = {
    "hydrostatic": "pressure of the depth below the wave",
    "smith": "pressure of the depth below the wave, that of the wave itself decaying with depth",
}
LADDER: Final = 5.0
"""Largest step of heel between two balances [deg]."""
_SOLVED: Final = {"heave-trim": TRIM, "heave": HEAVE, "dynamic": 0, "fixed": 0}
_WITHIN, _ON_STRAIGHT_SIDES, _OVER_DECK = range(3)
_WATER: Final = ("within_the_lines", "on_straight_sides", "over_the_deck")
_MOST_POSITIONS: Final = 1000


@takes(ship="Ship", wave="Wave", balance="word")
def gm_in_waves(
    ship: Ship,
    wave: Wave,
    heading: float | str = 0.0,
    positions: int = 10,
    balance: BalanceBy = "heave-trim",
    pressure: Pressure = "hydrostatic",
    speed: float | str = 0.0,
    integration: Integration = "direct",
) -> xr.Dataset:
    """Metacentric height of a ship on a frozen wave, over the position of the crest.

    Parameters
    ----------
    ship : Ship
    wave : Wave
    heading : float     mu: 0 following, 90 beam, 180 head [deg]
    positions : int     of the crest, over one wave length; at midship first, then on the way the wave runs
    balance : str       "heave-trim", "heave", "dynamic" or "fixed": what the ship does on the wave
    pressure : str      "hydrostatic", or "smith" with the decay of the wave's pressure
    speed : float       U; only the dynamic balance depends on it [m/s]
    integration : str   "direct": of the pressure; "table": of tables of the sections, faster once they are made

    Returns
    -------
    Dataset    over ``position``: gm [m], the slope of GZ at heel 0; heave [m, + down] and trim [deg, + bow up] of the balance;
               water (int8 flags): within the lines, on straight sides assumed above them, or over the deck.  What has no
               balance is NaN

    Raises
    ------
    InputError    an option unknown, a number out of its range

    Warns
    -----
    RangeWarning  the wave passes over the deck, or the ship does not balance

    Notes
    -----
    GM = d GZ/d phi at phi = 0, heave and trim following; GZ = -K/W with the pressure over the instantaneous wetted hull. In a
    wave of no height it is the GM of the loading. In oblique waves GZ is not 0 at heel 0. The dynamic balance takes heave and
    pitch of `responses`. Against nonlinear motions its variation of GM was 2 to 19 % off in five cases, where the balance at
    rest was 17 to 38 % off; in one where heave resonates 36 %, the balance 20 %.
    Source: pressure of the linear wave stretched to its surface.  Valid: frozen deep-water wave, hull watertight to the top of
    the offsets.

    Examples
    --------
    Box, wave of its own length, crest amidships: GM + a^2/(4 T).

    >>> from quartering.hull.file.read import ship
    >>> ds = gm_in_waves(ship("box"), Wave(length=100.0, height=2.0))
    >>> round(float(ds.gm[0]), 4), ds.sizes["position"]
    (1.05, 10)
    """
    U, mu = condition(ship, speed, heading)
    share = np.arange(count("positions", positions, 1, 10, _MOST_POSITIONS)) / positions
    floats, smith = floating_hull(ship), _pressure(pressure) == "smith"
    waves = frozen_waves(floats, wave, mu, share)
    start = np.zeros((share.size, 2))
    if _balance(balance) == "dynamic":
        start = _moving(ship, wave, U, mu, waves.phase)
    if integration not in get_args(Integration):
        raise InputError(f"integration {integration!r} is unknown; allowed: {', '.join(get_args(Integration))}")
    tables = None
    if integration == "table":
        tables, volume = floating_tables(ship, wave.wavenumber if smith else 0.0)
        floats = floats._replace(volume=volume)
    found = balanced(floats, np.zeros(share.size), waves, _SOLVED[balance], start, smith, tables)
    water, over = _water(ship, floats, np.zeros(share.size), found, waves)
    _warn(ship, found, over, f"crest at position {share[int(np.argmax(over))]:.3g} of the wave")
    fields = {"gm": found.slope, "heave": found.heave, "trim": np.degrees(found.pitch), "water": water}
    made = _form(share.size).copy(data=fields)
    made.attrs = _heading(ship, wave, mu, U, balance, pressure)
    return made


@takes(ship="Ship", wave="Wave, None", balance="word")
def righting_arm(
    ship: Ship,
    heel: ArrayLike,
    wave: Wave | None = None,
    heading: float | str = 0.0,
    position: float = 0.0,
    balance: BalanceBy = "heave-trim",
    pressure: Pressure = "hydrostatic",
) -> Floats:
    """Righting arm of a heeled ship, in calm water or on a frozen wave.

    Parameters
    ----------
    ship : Ship
    heel : (...) float    positive starboard side down, between -90 and 90 [deg]
    wave : Wave           None: calm water, without trim
    heading : float       mu: 0 following, 90 beam, 180 head [deg]
    position : float      of the crest: 0 at midship, 0.5 the trough; the share of a wave length it has run from there
    balance : str         "heave-trim", "heave" or "fixed"; "dynamic" is for `gm_in_waves`
    pressure : str        "hydrostatic" or "smith"

    Returns
    -------
    (...) float    GZ [m], positive when it rights the ship; NaN where the ship does not balance

    Raises
    ------
    InputError    an angle that is not a number or beyond 90 deg, an option unknown

    Warns
    -----
    RangeWarning  the deck goes under, or the ship does not balance

    Notes
    -----
    Constant displacement.  In calm water there is no trim, as usual for GZ; on a wave of no height ``balance="heave"`` gives
    the same, and "heave-trim" lets a heeled ship trim.
    Source: [Lewis88] ch. 2; pressure as `gm_in_waves`.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> [round(float(gz), 3) for gz in righting_arm(ship("box"), [0, 10])]
    [0.0, 0.192]
    >>> crest = righting_arm(ship("s175"), [10.0], Wave(length=175.0, height=5.0))
    >>> trough = righting_arm(ship("s175"), [10.0], Wave(length=175.0, height=5.0), position=0.5)
    >>> bool(crest[0] < trough[0])
    True
    """
    if wave is None:
        return righting.righting_arm(ship, heel)
    angles, mu = numbers(ship, "heel", heel), number(ship, "heading", heading)
    if (np.abs(angles) >= 90).any():
        raise InputError("heel = 90 deg; it is less than 90 deg to either side; try 40 deg")
    share, floats = number(ship, "position", position), floating_hull(ship)
    smith, by = _pressure(pressure) == "smith", _balance(balance)
    if by == "dynamic":
        raise InputError("balance 'dynamic' needs a speed, and is for gm_in_waves; try 'heave-trim'")
    arms = np.full(angles.size, np.nan)
    flat = angles.ravel()
    for side in (flat[flat >= 0], flat[flat < 0]):
        if side.size == 0:
            continue
        steps = np.arange(0.0, np.abs(side).max(), LADDER) * np.sign(side.sum() or 1.0)
        ladder = np.unique(np.concatenate([steps, side]))
        ladder = ladder[np.argsort(np.abs(ladder), kind="stable")]
        waves = frozen_waves(floats, wave, mu, np.full(ladder.size, share))
        found = balanced(floats, np.radians(ladder), waves, _SOLVED[by], np.zeros((ladder.size, 2)), smith)
        _, over = _water(ship, floats, np.radians(ladder), found, waves)
        _warn(ship, found, over, f"heel of {ladder[int(np.argmax(over))]:.3g} deg")
        wanted = (flat >= 0) if side[0] >= 0 else (flat < 0)
        arms[wanted] = found.arm[[int(np.argmin(np.abs(ladder - one))) for one in side]]
    return arms.reshape(angles.shape)


def frozen_waves(floats: FloatingHull, wave: Wave, heading: float, share: Floats) -> Waves:
    """Waves whose crest has run a share of their length from midship.

    heading: mu [deg]
    share (n,): of a wave length

    >>> from quartering.hull.file.read import ship
    >>> waves = frozen_waves(floating_hull(ship("box")), Wave(100.0, 2.0), 180.0, np.array([0.25]))
    >>> round(float(waves.phase[0] / waves.along[0]), 3)    # a head sea runs aft
    -25.0
    """
    ahead, across = heading_components(heading)
    along = -wave.wavenumber * float(ahead)
    ones = np.ones(share.size)
    phase = 2.0 * np.pi * share - along * floats.x_g
    return Waves(wave.amplitude * ones, along * ones, wave.wavenumber * float(across) * ones, phase)


def _moving(ship: Ship, wave: Wave, speed: float, heading: float, phase: Floats) -> Floats:
    """Heave and pitch (n, 2) of the linear motion when the phase of the wave at G is this."""
    kyy = float(ship.value("gyradius_pitch"))
    k, U, mu = (np.array([value]) for value in (wave.wavenumber, speed, heading))
    motion = vertical_motion(ship, k, U, mu, kyy)[0]
    if not np.isfinite(motion).all():
        raise InputError(
            f"speed {speed:.4g} m/s, heading {heading:g} deg: the ship keeps pace with the wave, and has no periodic motion; "
            'take another speed, or balance="heave-trim"'
        )
    turned = wave.amplitude * motion[None, 1:] * np.exp(1j * phase)[:, None]
    return np.ascontiguousarray(turned.real)


def _water(
    ship: Ship, floats: FloatingHull, roll: Floats, found: Balance, waves: Waves
) -> tuple[NDArray[np.int8], Floats]:
    """Where the water stands at its highest, as flags, and how far over the deck [m]."""
    deck = immersion(floats.hull, roll, found.heave, found.pitch, waves)
    water = np.where(deck > 0.0, _OVER_DECK, _WITHIN)
    if ship.hull.lines_end is not None:
        end = ship.hull.draught - ship.hull.lines_end + floats.hull.z0
        lines = immersion(floats.hull, roll, found.heave, found.pitch, waves, end)
        water = np.where((lines > 0.0) & (water == _WITHIN), _ON_STRAIGHT_SIDES, water)
    return water.astype(np.int8), np.nan_to_num(deck, nan=-np.inf)


def _warn(ship: Ship, found: Balance, over: Floats, where: str) -> None:
    """Say once what leaves the range of the method."""
    if (over > 0.0).any():
        warnings.warn(
            f"{ship.name}: the water stands up to {over.max():.3g} m over the top of the offsets ({where}); beyond the deck "
            f"edge the hull is closed by a watertight deck there; carry the sides up with depth, such as "
            f"depth={1.2 * ship.hull.depth:.3g}, where the ship has them",
            RangeWarning,
            stacklevel=4,
        )
    if not found.found.all():
        warnings.warn(
            f"{ship.name}: {int((~found.found).sum())} of {found.found.size} positions have no balance of heave and trim, and "
            'are NaN; a lower wave, less heel, or balance="heave" may have one',
            RangeWarning,
            stacklevel=4,
        )


@lru_cache(maxsize=16)
def _form(positions: int) -> xr.Dataset:
    """Dataset of a number of positions with their names and units, to be copied with values: to build it anew takes longer."""
    import xarray as xr

    share = np.arange(positions) / positions
    nothing = np.zeros(positions)
    flags = {"flag_values": np.arange(3, dtype=np.int8), "flag_meanings": " ".join(_WATER)}
    water = {"units": "1", "long_name": "where the water stands on the sides", **flags}
    return xr.Dataset(
        {name: ("position", nothing, attributes(name)) for name in ("gm", "heave", "trim")}
        | {"water": ("position", nothing.astype(np.int8), water)},
        coords={"position": ("position", share, attributes("position"))},
    )


def _balance(balance: str) -> str:
    if balance not in BALANCES:
        raise InputError(f"balance {balance!r} is unknown; allowed: {', '.join(BALANCES)}; try 'heave-trim'")
    return balance


def _pressure(pressure: str) -> str:
    if pressure not in get_args(Pressure):
        raise InputError(f"pressure {pressure!r} is unknown; allowed: {', '.join(PRESSURES)}; try 'hydrostatic'")
    return pressure


def _heading(ship: Ship, wave: Wave, mu: float, U: float, balance: str, pressure: str) -> dict[str, Any]:
    """What a reader needs to know where the numbers come from."""
    return {
        "title": f"Metacentric height of {ship.name} on a frozen wave",
        "ship": ship.name,
        "gm_calm": ship.loading.gm,
        "wave_length": wave.length,
        "wave_height": wave.height,
        "heading": mu,
        "speed": U,
        "heading_convention": HEADING_CONVENTION,
        "balance": f"{balance}: {BALANCES[balance]}",
        "pressure": f"{pressure}: {PRESSURES[pressure]}",
        "sides": sides_words(ship),
        "reference_point": REFERENCE_POINT,
        "source": made_by(),
    }


def sides_words(ship: Ship) -> str:
    """How high the lines of a ship go.

    >>> from quartering.hull.file.read import ship
    >>> sides_words(ship("s175"))
    'the lines end 11 m over the baseline; straight sides are assumed from there up to the deck at 15.4 m'
    """
    hull = ship.hull
    if hull.lines_end is None:
        return f"the lines end at the deck, {hull.depth:.4g} m over the baseline at its lowest"
    return (
        f"the lines end {hull.lines_end:.4g} m over the baseline; straight sides are assumed from there up to the deck at "
        f"{hull.depth:.4g} m"
    )
