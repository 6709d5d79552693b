"""A measured free decay of roll or pitch: read, checked, and its successive extremes."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.signal import find_peaks

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.lines.section import Floats
from quartering.hull.told import number, real
from quartering.option_checks import quoted
from quartering.options import OPTIONS
from quartering.table_text import UNITS, columns_of, is_number, read_table

AngleUnit = Literal["deg", "rad"]
FEWEST_EXTREMES: Final = 6
"""Successive extremes (three full swings) that a decay must show."""

SMALLEST_SWING: Final = 0.04
"""Swings below this share of the largest one are left to noise."""

IRREGULAR: Final = 0.3
"""Share by which a half period may differ from the median of the first six; the decay ends where one differs more."""


@dataclass(frozen=True, eq=False)
class DecayRecord:
    """A free decay as measured.

    Parameters
    ----------
    time : (t,) float     ascending [s]
    angle : (t,) float    [rad]
    source : str          where it comes from
    """

    time: Floats
    angle: Floats
    source: str = "given"


class Extremes(NamedTuple):
    """Successive extremes of a decay from its largest swing on, highs and lows in turn.

    Parameters
    ----------
    time : (k,) float     [s]
    angle : (k,) float    [rad]
    """

    time: Floats
    angle: Floats

    @property
    def swings(self) -> Floats:
        """Amplitudes: half the height from each extreme to the next, free of the mean angle [rad]."""
        return np.abs(np.diff(self.angle)) / 2

    @property
    def middles(self) -> Floats:
        """Mean angle about each inner extreme, free of the decay to second order [rad]."""
        a = self.angle
        return np.asarray((a[:-2] + 2 * a[1:-1] + a[2:]) / 4)


@takes(source="word")
def decay_record(time: ArrayLike, angle: ArrayLike, *, unit: AngleUnit = "deg", source: str = "given") -> DecayRecord:
    """A decay from two arrays, checked.

    Parameters
    ----------
    time : (t,) float     ascending [s]
    angle : (t,) float    roll or pitch, with or without a mean
    unit : str            of the angle, "deg" or "rad"
    source : str          where it comes from

    Returns
    -------
    DecayRecord

    Raises
    ------
    InputError    unequal lengths, NaN (with its row), time that does not ascend (with its row), unknown unit

    Notes
    -----
    Source: [Froude1874], the experiment.

    Examples
    --------
    >>> t = np.linspace(0.0, 60.0, 601)
    >>> decay_record(t, 10.0 * np.exp(-0.05 * t) * np.cos(t)).angle[0].round(4)
    np.float64(0.1745)
    """
    if unit not in ("deg", "rad"):
        raise InputError(f'angle unit "{unit}" is unknown; allowed are "deg" and "rad"')
    t, phi = real(time), real(angle)
    if t is None or phi is None:
        raise InputError(f"{source}: time and angle are lists of numbers; {quoted(time)} and {quoted(angle)} given")
    if t.ndim != 1 or t.shape != phi.shape:
        raise InputError(f"{source}: {t.size} times and {phi.size} angles are given; a decay has as many of each")
    if t.size < 20:
        raise InputError(f"{source}: {t.size} samples are given; a decay needs 20 or more, ten or more per swing")
    bad = np.flatnonzero(~(np.isfinite(t) & np.isfinite(phi)))
    if bad.size:
        raise InputError(f"{source}: sample {bad[0] + 1} is not a number; cut it out or fill the gap first")
    back = np.flatnonzero(np.diff(t) <= 0)
    if back.size:
        row = back[0] + 2
        raise InputError(
            f"{source}: time goes back at sample {row} ({t[row - 2]:g} s, then {t[row - 1]:g} s); sort the record by time"
        )
    if unit == "rad" and np.ptp(phi) > 2 * np.pi:
        raise InputError(f'{source}: angles span {np.ptp(phi):g} rad; if they are degrees, say unit="deg"')
    return DecayRecord(t, np.radians(phi) if unit == "deg" else phi, source)


@takes(path="file")
def read_decay(
    path: str | Path,
    *,
    unit: AngleUnit | None = None,
    columns: tuple[int, int] | None = None,
    time_factor: float = 1.0,
) -> DecayRecord:
    """A decay from a text file of time and angle.

    Parameters
    ----------
    path : str or Path         columns parted by comma, semicolon, tab or blanks; decimals with a point, or with a comma where
                               it does not part columns; ``#`` starts a comment; a line of column names may stand first, with
                               units, "time [ms]", or a line of units below it
    unit : str                 of the angle, "deg" or "rad"; left out, the name of its column must tell: roll_deg, phi [rad]
    columns : tuple of int     which columns hold time [s] and angle, counted from 0; left out, the file has two
    time_factor : float        from model to full scale, sqrt(scale); 1 keeps the time as it is [1]

    Returns
    -------
    DecayRecord

    Raises
    ------
    InputError    no such file, no unit of the angle, times that are no seconds (a period beyond 120 s), more than two columns
                  and no word on which, decimal commas between commas, a row that has not its numbers (with its line), and what
                  `decay_record` refuses

    Notes
    -----
    Source: [Froude1874], the experiment.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> file = pathlib.Path(tempfile.mkdtemp()) / "decay.csv"
    >>> _ = file.write_text("time_s,roll_deg\\n" + "".join(f"{0.1 * n},{np.cos(0.1 * n)}\\n" for n in range(100)))
    >>> read_decay(file).time[-1].round(1)
    np.float64(9.9)
    """
    time_factor = number(None, "time_factor", time_factor)
    names, lines = _cells(Path(path))
    chosen = _chosen(path, columns, names, len(lines[0][1]) if lines else len(names))
    seconds = _to_seconds(path, names[chosen[0]] if names else "")
    unit = unit or _unit_of(path, names[chosen[1]] if names else "")
    values = np.array([_numbers(path, number, fields, chosen) for number, fields in lines]).reshape(-1, 2)
    made = decay_record(values[:, 0] * seconds * time_factor, values[:, 1], unit=unit, source=str(path))
    _check_period(made)
    return made


def _cells(path: Path) -> tuple[list[str], list[tuple[int, list[str]]]]:
    """Column names with their units, if there are any, and the cells of each row with its line in the file."""
    table = read_table(path)
    if not table.rows:
        raise InputError(f"{path}: holds no samples; a decay is one line of time and angle per sample")
    rows = list(zip(table.lines, table.rows, strict=True))
    if any(is_number(cell) for cell in table.rows[0]):
        return [], rows
    columns = columns_of(table.rows)
    names, rows = columns.names, rows[columns.rows :]
    if rows and len(rows[0][1]) == 2 * len(names):
        raise InputError(
            f"{path}: line {rows[0][0]} has {len(rows[0][1])} numbers under {len(names)} names; are they decimal commas? "
            "Part the columns by a semicolon or a tab then, or write decimal points (0.5, not 0,5)"
        )
    return [f"{name} [{unit}]" if unit else name for name, unit in zip(names, columns.units, strict=True)], rows


def _chosen(path: str | Path, columns: tuple[int, int] | None, names: list[str], count: int) -> tuple[int, int]:
    """Columns of time and angle."""
    if columns is None and count != 2:
        said = f" ({', '.join(names)})" if names else ""
        raise InputError(f"{path}: has {count} columns{said}; say which two hold time and angle (columns)")
    first, second = (0, 1) if columns is None else columns
    if first == second or not (0 <= first < count and 0 <= second < count):
        raise InputError(
            f"{path}: columns {first + 1} and {second + 1} are asked for, and it has {count}; name two of them, time first"
        )
    return first, second


def _numbers(path: str | Path, line: int, fields: list[str], columns: tuple[int, int]) -> tuple[float, float]:
    try:
        return float(fields[columns[0]]), float(fields[columns[1]])
    except (ValueError, IndexError):
        raise InputError(
            f'{path}: line {line} is "{", ".join(fields)}"; columns {columns[0] + 1} and {columns[1] + 1} must hold two numbers'
        ) from None


def _words_of(name: str) -> set[str]:
    """Words of a column's name: "roll_deg" and "phi [rad]" tell their unit."""
    return set(re.findall(r"[a-z]+|°", name.lower()))


def _unit_of(path: str | Path, name: str) -> AngleUnit:
    words = _words_of(name)
    degrees, radians = words & {"deg", "degree", "degrees", "°"}, words & {"rad", "radian", "radians"}
    if bool(degrees) == bool(radians):
        said = f'its column "{name}" does not' if name else "it has no column names that"
        raise InputError(
            f"{path}: is the angle in deg or rad? {said} tell; name the column roll_deg or roll_rad, or say the unit (deg, rad)"
        )
    return "deg" if degrees else "rad"


def _to_seconds(path: str | Path, name: str) -> float:
    """Factor to seconds from the name of the time column."""
    units = {word: factor for word, (kind, factor) in UNITS.items() if kind == "time"}
    units |= {"milliseconds": 1e-3, "minutes": 60.0, "h": 3600.0, "hours": 3600.0}
    said = _words_of(name) & (units.keys() - {"s"}) or _words_of(name) & {"s"}
    if len(said) > 1:
        raise InputError(f'{path}: the time column is "{name}"; name one unit in it, such as "time [s]"')
    return units[said.pop()] if said else 1.0


def _check_period(record: DecayRecord) -> None:
    """Refuse times that are no seconds: the swings would take longer than a ship's."""
    phi = record.angle - np.median(record.angle)
    crossings = int(np.count_nonzero(np.diff(np.sign(phi[phi != 0.0]))))
    period = 2.0 * float(record.time[-1] - record.time[0]) / max(crossings, 1)
    shortest, longest = (float(bound) for bound in (OPTIONS["roll_period"].low, OPTIONS["roll_period"].high))  # type: ignore[arg-type]
    if crossings < 3 or period <= longest:
        return
    slip = (
        f'; is the time in ms? Name its column "time [ms]", or give a time factor of 0.001 (period {period / 1000:.3g} s)'
        if shortest <= period / 1000 <= longest
        else "; check the unit of the time"
    )
    raise InputError(
        f"{record.source}: its swings have a period of {period:.4g} s, and that of a ship is from {shortest:g} to {longest:g} s"
        f"{slip}"
    )


def extremes(record: DecayRecord, *, skip: int = 0) -> Extremes:
    """Successive highs and lows of a decay, from its largest swing on.

    skip: extremes left out after the release, >= 0
    Returns refined by a parabola through the samples about each; swings below 4 % of the largest are left out

    What stands before the largest swing (the ship held, or pushed) is passed over, and so is what comes after the first
    half period that differs by 30 % from the first six: noise rules there.
    Source: [Froude1874], curve of extinction.
    """
    if skip < 0:
        raise InputError(f"skip = {skip} must be 0 or more extremes after the release")
    t, phi = record.time, record.angle
    threshold = SMALLEST_SWING * np.ptp(phi)
    if not threshold > 0:
        raise InputError(f"{record.source}: the angle is constant; a decay swings")
    highs, lows = (find_peaks(side * phi, prominence=threshold)[0] for side in (1, -1))
    index = _alternating(highs, lows, phi)
    swing = np.abs(np.diff(phi[index]))
    start = (int(np.argmax(swing)) if swing.size else 0) + skip
    if swing.size and start > swing.size - FEWEST_EXTREMES + 1 and swing[0] < 0.5 * swing.max():
        raise InputError(
            f"{record.source}: the swings grow, from {np.degrees(swing[0]) / 2:.3g} deg to {np.degrees(swing.max()) / 2:.3g} "
            f"deg at {t[index[int(np.argmax(swing))]]:.4g} s, near the end of the record; a free decay becomes smaller"
        )
    index = _regular(t, index[start:])
    if index.size < FEWEST_EXTREMES:
        raise InputError(
            f"{record.source}: {index.size} extremes at regular intervals after the release; a free decay keeps its "
            f"period, and {FEWEST_EXTREMES} or more are needed (three full swings): give a longer record, skip fewer, "
            "or filter noise"
        )
    time, angle = _refined(t, phi, index)
    _check_decays(record.source, np.abs(np.diff(angle)))
    return Extremes(time, angle)


def _regular(t: Floats, index: NDArray[np.intp]) -> NDArray[np.intp]:
    """Extremes up to the first half period that is not like the first ones: from there noise rules."""
    half = np.diff(t[index])
    if half.size == 0:
        return index
    usual = float(np.median(half[:FEWEST_EXTREMES]))
    odd = np.flatnonzero(np.abs(half - usual) > IRREGULAR * usual)
    return index[: odd[0] + 1] if odd.size else index


def _alternating(highs: NDArray[np.intp], lows: NDArray[np.intp], phi: Floats) -> NDArray[np.intp]:
    """Highs and lows in turn: of neighbours on one side the farther one."""
    kept: list[tuple[int, int]] = []
    for n, side in sorted([(int(n), 1) for n in highs] + [(int(n), -1) for n in lows]):
        if not kept or kept[-1][1] != side:
            kept.append((n, side))
        elif side * phi[n] > side * phi[kept[-1][0]]:
            kept[-1] = (n, side)
    return np.array([n for n, _ in kept], dtype=np.intp)


def _refined(t: Floats, phi: Floats, index: NDArray[np.intp]) -> tuple[Floats, Floats]:
    """Extremes by least-squares parabolas over a sixth of the half period to each side."""
    reach = float(np.median(np.diff(t[index]))) / 6
    times, angles = [], []
    for n in index:
        near = np.abs(t - t[n]) <= reach
        if near.sum() < 3:
            near = np.zeros(t.size, dtype=bool)
            near[max(n - 1, 0) : n + 2] = True
        a, b, c = np.polyfit(t[near] - t[n], phi[near], 2)
        shift = float(np.clip(-b / (2 * a), -reach, reach)) if a != 0 else 0.0
        times.append(t[n] + shift)
        angles.append(c + b * shift + a * shift**2)
    return np.array(times), np.array(angles)


def _check_decays(source: str, swing: Floats) -> None:
    half = swing.size // 2
    slope = np.polyfit(np.arange(swing.size), np.log(swing), 1)[0]
    if slope >= 0 or swing[-half:].mean() > 0.98 * swing[:half].mean():
        raise InputError(
            f"{source}: the swings do not become smaller ({np.degrees(swing[0]):.3g} deg at first, "
            f"{np.degrees(swing[-1]):.3g} deg at last); this is no free decay"
        )
