"""WAMIT's .1 and .3 files: ITTC mode numbers and nondimensional values, translated at the border."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY, WATER_DENSITY, InputError
from quartering.hull.lines.section import Floats
from quartering.hydro.database.raw import RawDatabase, needed_rows

MODES = (2, 4, 6)
"""ITTC numbers of sway, roll, yaw."""

_POWER = np.array([[3, 4, 4], [4, 5, 5], [4, 5, 5]])


def read_wamit_files(
    stem: str | Path, *, length: float = 1.0, density: float = WATER_DENSITY, gravity: float = GRAVITY
) -> RawDatabase:
    """What the .1 and .3 files of a WAMIT run hold, in SI.

    stem: path without its ending; the .3 may be absent
    length: ULEN of the run [m]
    density: [kg/m3]
    gravity: [m/s2]
    Returns with limits where the periods 0 (infinite frequency) and -1 (zero frequency) are given

    A = rho L^k Abar, B = rho L^k omega Bbar, k = 3, 4, 5; X = rho g L^m Xbar, m = 2, 3; e^{+i omega t}.
    Coupling terms a file leaves out are zero.  Source: [WAMIT] definition of quantities and output files.
    """
    first, third = Path(f"{stem}.1"), Path(f"{stem}.3")
    if not first.is_file():
        raise InputError(f"{first} is not there; give the path of the .1 file without its ending")
    if not (length > 0 and density > 0 and gravity > 0):
        raise InputError(f"length {length:g} m, density {density:g} kg/m3, gravity {gravity:g} m/s2 must be positive")
    radiation, limits = _radiation(first, density * length ** _POWER.astype(float))
    frequency = np.array(sorted(radiation))
    added, damping = (np.array([radiation[w][k] for w in frequency]).reshape(-1, 3, 3) for k in (0, 1))
    direction, forces = np.zeros(0), {}
    if third.is_file():
        direction, total = _excitation(third, frequency, density * gravity * length ** np.array([2.0, 3.0, 3.0]))
        forces = {"total": total}
    return needed_rows(first, RawDatabase(
        frequency, direction, added, damping * frequency[:, None, None], forces, density, gravity, limits=limits,
    ))  # fmt: skip


def _rows(path: Path, lengths: tuple[int, ...]) -> Iterator[tuple[int, list[float]]]:
    """Lines of numbers; a heading in words at the top is passed over."""
    for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), start=1):
        words = line.split()
        if not words:
            continue
        try:
            values = [float(word.replace("D", "E")) for word in words]
        except ValueError:
            if number == 1 and not any(_is_number(word) for word in words):
                continue
            raise InputError(f"{path}, line {number}: {line.strip()!r} is not a row of numbers") from None
        if len(values) not in lengths:
            raise InputError(
                f"{path}, line {number}: {len(values)} numbers, {' or '.join(map(str, lengths))} are expected; "
                "the file is cut short or of another kind"
            )
        yield number, values


def _mode(path: Path, line: int, value: float) -> int:
    """Number of a mode; others than those of one body, up to 6, are passed over as generalised ones."""
    if not (np.isfinite(value) and value == round(value) and 1 <= value < 1e6):
        raise InputError(
            f"{path}, line {line}: {value:g} is no mode; modes are 1 surge to 6 yaw, and further whole numbers"
        )
    return int(value)


def _period(path: Path, line: int, value: float) -> float:
    """A period [s], or one of the two that stand for a limit: 0 and -1."""
    if not np.isfinite(value) or (value < 0 and value != -1):
        raise InputError(
            f"{path}, line {line}: period {value:g} s; it is above 0, or 0 or -1 for infinite and zero frequency"
        )
    return value


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _radiation(path: Path, scale: Floats) -> tuple[dict[float, tuple[Floats, Floats]], dict[str, Floats]]:
    """Matrices by frequency, and the limits; damping still to be multiplied by omega."""
    found: dict[float, tuple[Floats, Floats]] = {}
    limits: dict[str, Floats] = {}
    diagonal: dict[float, set[int]] = {}
    for number, values in _rows(path, (4, 5)):
        period, i, j = _period(path, number, values[0]), _mode(path, number, values[1]), _mode(path, number, values[2])
        diagonal.setdefault(period, set())
        if i not in MODES or j not in MODES:
            continue
        at = MODES.index(i), MODES.index(j)
        if i == j:
            diagonal[period].add(i)
        if period <= 0:
            limit = limits.setdefault("infinite" if period == 0 else "zero", np.zeros((3, 3)))
            limit[at] = values[3] * scale[at]
            continue
        if len(values) < 5:
            raise InputError(f"{path}, line {number}: no damping at period {period:g} s; the line is cut short")
        added, damping = found.setdefault(2 * np.pi / period, (np.zeros((3, 3)), np.zeros((3, 3))))
        added[at], damping[at] = values[3] * scale[at], values[4] * scale[at]
    for period, modes in diagonal.items():
        if missing := sorted(set(MODES) - modes):
            raise InputError(
                f"{path}: period {period:g} s lacks mode {', '.join(map(str, missing))} (2 sway, 4 roll, 6 yaw); "
                "the file is cut short, or those modes were left out of the run"
            )
    return found, limits


def _excitation(path: Path, frequency: Floats, scale: Floats) -> tuple[Floats, NDArray[np.complex128]]:
    """Directions, and forces (f, h, 3) at the frequencies of the .1 file; nan is never left."""
    rows = [
        values
        for number, values in _rows(path, (7,))
        if _mode(path, number, values[2]) in MODES and _period(path, number, values[0]) > 0
    ]
    direction = np.unique([values[1] for values in rows])
    total = np.full((frequency.size, direction.size, 3), np.nan, dtype=complex)
    for period, beta, mode, _, _, real, imaginary in rows:
        near = np.flatnonzero(np.isclose(frequency, 2 * np.pi / period, rtol=1e-6))
        if near.size == 0:
            raise InputError(f"{path}: period {period:g} s is not in the .1 file; the two files are not of one run")
        k = MODES.index(int(mode))
        total[near[0], np.searchsorted(direction, beta), k] = complex(real, imaginary) * scale[k]
    missing = np.argwhere(np.isnan(total))
    if rows and missing.size:
        w, h, k = missing[0]
        raise InputError(
            f"{path}: {len(missing)} forces are missing, the first at period {2 * np.pi / frequency[w]:.4g} s, direction "
            f"{direction[h]:g} deg, mode {MODES[k]}; every period of the .1 file is needed at every direction"
        )
    if not rows:
        raise InputError(f"{path}: no forces in sway, roll or yaw; the file is empty or cut short")
    return direction, total


def write_wamit_files(stem: str | Path, raw: RawDatabase, *, length: float = 1.0) -> None:
    """Write a database as the .1 and .3 files of a WAMIT run.

    stem: path without ending
    raw: file axes
    length: ULEN [m]

    Froude-Krylov and diffraction are added up: the .3 holds the total.
    Source: [WAMIT] definition of quantities and output files.
    """
    scale = raw.density * length ** _POWER.astype(float)
    lines = []
    for name, period in (("zero", -1.0), ("infinite", 0.0)):
        if name in raw.limits:
            lines += [
                f"{period:14.6E}{_pair(i, j)}{raw.limits[name][i, j] / scale[i, j]:17.9E}" for i, j in np.ndindex(3, 3)
            ]
    for w, added, damping in zip(raw.frequency, raw.added_mass / scale, raw.damping / scale, strict=True):
        lines += [
            f"{2 * np.pi / w:17.9E}{_pair(i, j)}{added[i, j]:17.9E}{damping[i, j] / w:17.9E}"
            for i, j in np.ndindex(3, 3)
        ]
    Path(f"{stem}.1").write_text("\n".join(lines) + "\n", encoding="utf-8")
    if not raw.forces:
        return
    total = sum(raw.forces.values()) / (raw.density * raw.gravity * length ** np.array([2.0, 3.0, 3.0]))
    lines = [
        f"{2 * np.pi / raw.frequency[f]:17.9E}{raw.direction[h]:17.9E}{MODES[k]:6d}{abs(x):17.9E}"
        f"{np.degrees(np.angle(x)):17.9E}{x.real:17.9E}{x.imag:17.9E}"
        for (f, h, k), x in np.ndenumerate(total)
    ]
    Path(f"{stem}.3").write_text("\n".join(lines) + "\n", encoding="utf-8")


def _pair(i: int, j: int) -> str:
    return f"{MODES[i]:6d}{MODES[j]:6d}"
