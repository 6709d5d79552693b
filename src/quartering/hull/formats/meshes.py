"""Meshes in files of other programs: WAMIT's GDF, and STL."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from quartering.conventions import GRAVITY, InputError
from quartering.hull.formats.offset_tables import Lines
from quartering.hull.formats.surface import Surface, check_surface, joined_surface
from quartering.hull.formats.surface_sections import surface_lines, surface_profile
from quartering.hull.lines.datum import Datum, datum_of
from quartering.hull.lines.section import Floats
from quartering.units import LENGTHS


def read_gdf(
    path: str | Path, draught: float | None = None, datum: str | None = None, unit: str | None = None
) -> Lines:
    """Read a WAMIT low-order panel file.

    Parameters
    ----------
    path : str or Path    GDF: heading, ULEN and GRAV, ISX and ISY, number of panels, four corners each; z = 0 is the
                          calm plane
    draught : float       compared with that of the panels [m]; None: not compared
    datum : str           "keel" where the heights count from the baseline all the same
    unit : str            of the corners, "mm"; None: feet where gravity is 32.2, else metres

    Returns
    -------
    Lines    of the immersed hull: they end at the calm plane

    Raises
    ------
    InputError    a file cut short, holes, panels inside out

    Notes
    -----
    The corners are in the unit of GRAV, metres where that is 9.81: ULEN only scales the results of a run. Panels in the calm
    plane (a lid) are left out.  Source: [WAMIT] geometric data file.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "empty.gdf"
    ...     _ = file.write_text("a hull\\n1.0 9.81\\n0 1\\n5\\n0 0 0")
    ...     read_gdf(file)
    Traceback (most recent call last):
    ...
    quartering.conventions.InputError: ...empty.gdf: 3 numbers for 5 panels of 4 corners (60 are needed); ...
    """
    try:
        lines = Path(path).read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}; give a file you may read") from None
    try:
        gravity = [float(word) for word in lines[1].split()[:2]][-1]
        isx, isy = (int(word) for word in lines[2].split()[:2])
        count = int(lines[3].split()[0])
        numbers = np.array([float(word) for line in lines[4:] for word in line.replace(",", " ").split()])
    except (IndexError, ValueError):
        raise InputError(
            f"{path}: not a low-order GDF file; its lines are a heading, ULEN GRAV, ISX ISY, the number of panels, corners"
        ) from None
    if numbers.size < 12 * count or count < 1:
        raise InputError(
            f"{path}: {numbers.size} numbers for {count} panels of 4 corners ({12 * count} are needed); the file is cut short"
        )
    if isx not in (0, 1) or isy not in (0, 1):
        raise InputError(f"{path}: ISX {isx} and ISY {isy}; each is 0 or 1 here")
    if unit is None and abs(gravity * LENGTHS["ft"] / GRAVITY - 1.0) < 0.01:
        unit = "ft"
    panels = numbers[: 12 * count].reshape(-1, 4, 3) * LENGTHS[unit or "m"]
    panels = panels[~(np.abs(panels[:, :, 2]) < 1e-6 * np.ptp(panels[:, :, 2])).all(axis=1)]
    if isx:
        panels = np.concatenate([panels, panels[:, ::-1] * [-1.0, 1.0, 1.0]])
    corners = np.concatenate([panels[:, [0, 1, 2]], panels[:, [0, 2, 3]]])
    surface = joined_surface(str(path), corners, half=bool(isy), waterline=0.0)
    return _said(_lines(surface, draught, datum, usual="waterline"), unit)


def read_stl(
    path: str | Path, draught: float | None = None, datum: str | None = None, unit: str | None = None
) -> Lines:
    """Read an STL surface, text or binary.

    Parameters
    ----------
    path : str or Path    x to the bow, z up; whole, or the half on one side, with or without a deck
    draught : float       of the lines: tells where z is counted from, and from where on the surface may be open [m]
    datum : str           "keel" or "waterline", where z is counted from; None: decided from the surface
    unit : str            of the corners, "mm"; None: metres

    Returns
    -------
    Lines

    Raises
    ------
    InputError    a file cut short, holes below the waterline, panels inside out, port and starboard different

    Notes
    -----
    Source: the published STL layout (80 bytes, count, 50 bytes a triangle; or `vertex x y z` lines).

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "box.stl"
    ...     corners = box_triangles(60.0, 10.0, 6.0)
    ...     vertex = (f"vertex {x} {y} {z}" for x, y, z in corners.reshape(-1, 3))
    ...     _ = file.write_text("solid box\\n" + "\\n".join(vertex) + "\\nendsolid")
    ...     len(read_stl(file).x)
    61
    """
    try:
        data = Path(path).read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}; give a file you may read") from None
    text = data[:5].lower() == b"solid" and b"vertex" in data
    corners = (_text_triangles(path, data) if text else _binary_triangles(path, data)) * LENGTHS[unit or "m"]
    y = corners[..., 1]
    near = 1e-4 * float(np.abs(y).max()) if corners.size else 0.0
    half = bool(corners.size) and (float(y.min()) >= -near or float(y.max()) <= near)
    return _said(
        _lines(joined_surface(str(path), corners, half=half, waterline=None), draught, datum, usual=None), unit
    )


def _said(lines: Lines, unit: str | None) -> Lines:
    """Lines with a word on the unit they were given in."""
    return lines if unit in (None, "m") else lines._replace(remarks=(*lines.remarks, f"given in {unit}"), own_unit=True)


def _lines(surface: Surface, draught: float | None, datum: str | None, usual: Datum | None) -> Lines:
    """Sections of a surface, its datum found and the surface checked as far as it lies in the water."""
    found, calm = usual, 0.0 if usual == "waterline" else None
    if draught is not None:
        found = datum_of(surface.name, surface_profile(surface), draught, datum, usual=usual)
        calm = 0.0 if found == "waterline" else draught
    elif usual is None:  # as far as a surface without a draught tells it
        keel, top = surface_profile(surface).middle
        calm = 0.0 if keel < -0.25 * (top - keel) else None
    if surface.half:  # a face on the centreplane is no part of the hull
        flat = np.abs(surface.points[surface.triangles][:, :, 1]) < 1e-6 * np.ptp(surface.points[:, 1])
        surface = replace(surface, triangles=surface.triangles[~flat.all(axis=1)])
    surface = replace(surface, waterline=calm)
    remark = check_surface(surface)
    return surface_lines(surface, datum=found, calm=calm, remarks=(remark,) if remark else ())


def _text_triangles(path: str | Path, data: bytes) -> Floats:
    try:
        rows = [
            line.split()[1:4] for line in data.decode("utf-8", "replace").splitlines() if line.split()[:1] == ["vertex"]
        ]
        corners = np.array(rows, dtype=float)
    except ValueError:
        raise InputError(f"{path}: a vertex is not three numbers; the file is cut short or damaged") from None
    if len(rows) % 3 or b"endsolid" not in data:
        raise InputError(f"{path}: {len(rows)} vertices and no end; the file is cut short")
    return corners.reshape(-1, 3, 3)


def _binary_triangles(path: str | Path, data: bytes) -> Floats:
    count = int.from_bytes(data[80:84], "little") if len(data) >= 84 else 0
    if count == 0 or len(data) < 84 + 50 * count:
        raise InputError(
            f"{path}: {len(data)} bytes for {count} triangles ({84 + 50 * count} are needed); the file is cut short or no STL"
        )
    records = np.frombuffer(data, dtype=np.uint8, count=50 * count, offset=84).reshape(count, 50)
    corners = np.ascontiguousarray(records[:, 12:48]).view("<f4").reshape(count, 3, 3)
    return corners.astype(float)


def box_triangles(length: float, beam: float, depth: float, keel: float = 0.0) -> Floats:
    """Triangles of a closed box, corners anticlockwise as seen from outside.

    length, beam, depth: [m]
    keel: z of the bottom [m]
    Returns (12, 3, 3): x from -L/2, y from -B/2
    """
    ends = np.array([[-length / 2, length / 2], [-beam / 2, beam / 2], [keel, keel + depth]])
    found = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in range(2):
            quad = np.zeros((4, 3))
            quad[:, axis] = ends[axis, side]
            turn = [(0, 0), (1, 0), (1, 1), (0, 1)] if side else [(0, 0), (0, 1), (1, 1), (1, 0)]
            for k, (a, b) in enumerate(turn):
                quad[k, u], quad[k, v] = ends[u, a], ends[v, b]
            found += [quad[[0, 1, 2]], quad[[0, 2, 3]]]
    return np.array(found)
