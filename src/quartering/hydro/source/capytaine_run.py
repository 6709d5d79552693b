"""Wave forces by three-dimensional panels: Capytaine at zero speed, on a mesh made from the same hull.

Capytaine has x to the bow, y to port, z up, phasors of e^{-i w t} and the elevation 1 at its origin; the direction the
wave runs towards is counted from x to y. Here its origin stands at the calm plane over G, or for a bare hull amidships. Half a
turn about x changes the sign of sway and yaw and makes the direction -mu; the conjugate belongs to e^{+i w t}; the factor i
moves time zero to where the surface at the origin passes its mean level on the way down.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import GRAVITY, HEADING_CONVENTION, MODES, REFERENCE_POINT, InputError
from quartering.doors import takes
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.mesh import Panels, hull_panels
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hull.told import count, numbers
from quartering.option_checks import quoted

if TYPE_CHECKING:
    import xarray as xr

PANELS: Final = (40, 12)
"""Panels along the ship and from keel to waterline on each side, unless given."""

_DOFS: Final = ("Sway", "Roll", "Yaw")
_HALF_TURN: Final = np.array([-1.0, 1.0, -1.0])
_UNITS: Final = "SI: kg, kg m, kg m2 (over s for damping) between forces [N, N m] and velocities [m/s, rad/s]"
_SIGNAL: Final = "cos cos(omega t) + sin sin(omega t); at t = 0 the surface at G passes its mean level going down"
_PANELS_PER_WAVE: Final = 6.0
_TABULATION: Final = {"tabulation_nr": 400, "tabulation_nz": 200, "tabulation_grid_shape": "scaled_nemoh3"}


@takes(ship="Ship")
def bem_forces(
    ship: Ship,
    wave_lengths: ArrayLike,
    headings: ArrayLike = 90.0,
    *,
    panels: tuple[int, int] = PANELS,
    lid: bool = True,
) -> xr.Dataset:
    """Wave forces on a ship at zero speed by three-dimensional panels, per metre of wave amplitude.

    Parameters
    ----------
    ship : Ship
    wave_lengths : (n,) float    lambda > 0 [m]
    headings : (h,) float        mu: 0 following, 90 beam (wave from port to starboard), 180 head [deg]
    panels : (int, int)          along the ship and from keel to waterline, on each side
    lid : bool                   a lid on the calm plane inside the hull removes irregular frequencies

    Returns
    -------
    Dataset    froude_krylov, diffraction, total (wave_length, heading, part, mode) [N/m; N m/m about G]: the force is
               cos cos(w t) + sin sin(w t), as `wave_forces`; added_mass, damping (wave_length, mode, mode_of_motion)

    Raises
    ------
    InputError    Capytaine is not there, a wave length not positive or shorter than six panels, headings not finite

    Notes
    -----
    Use these forces with the added mass and damping that come with them: with those of strips, errors of the roll moment no
    longer cancel and roll in beam seas is up to 38 % off.
    Source: [Ancellin19], linear potential flow.  Valid: zero speed, deep water, panels small against the wave.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> forces = bem_forces(ship("wigley"), [150.0], [90.0])                                   # doctest: +SKIP
    >>> forces.total.dims                                                                      # doctest: +SKIP
    ('wave_length', 'heading', 'part', 'mode')
    """
    wave_lengths, headings = numbers(ship, "wave_length", wave_lengths), numbers(ship, "heading", headings)
    length, mu = np.atleast_1d(wave_lengths), np.atleast_1d(headings)
    if length.ndim != 1 or mu.ndim != 1:
        raise InputError(
            f"wave_lengths {wave_lengths!r}, headings {headings!r}: each is one list; {HEADING_CONVENTION}"
        )
    omega = np.sqrt(2 * np.pi * GRAVITY / length)
    solved = _solved(ship, omega, mu, panels, lid)
    dataset = _radiation(solved).assign(_forces(solved))
    dataset = dataset.assign_coords(
        heading=("heading", mu, {"units": "deg", "symbol": "mu", "long_name": "heading to the waves"}),
        wave_length=("frequency", length, {"units": "m", "symbol": "lambda", "long_name": "wave length"}),
        part=["cos", "sin"], unit=("mode", ["N", "N m", "N m"]),
    ).swap_dims(frequency="wave_length")  # fmt: skip
    return dataset.assign_attrs(_attributes(ship, panels, lid), heading_convention=HEADING_CONVENTION, signal=_SIGNAL)


@takes(ship="Ship")
def bem_hydrodynamics(
    ship: Ship, frequency: ArrayLike, *, panels: tuple[int, int] = PANELS, lid: bool = True
) -> xr.Dataset:
    """Added mass and damping of a ship in sway, roll and yaw at zero speed by three-dimensional panels, about G.

    Parameters
    ----------
    ship : Ship
    frequency : (f,) float    omega > 0 [rad/s]
    panels : (int, int)       along the ship and from keel to waterline, on each side
    lid : bool                a lid on the calm plane inside the hull removes irregular frequencies

    Returns
    -------
    Dataset    added_mass, damping (frequency, mode, mode_of_motion), as `hydrodynamics`

    Raises
    ------
    InputError    Capytaine is not there, a frequency not positive or its wave shorter than six panels

    Notes
    -----
    Source: [Ancellin19], linear potential flow.  Valid: zero speed, deep water, panels small against the wave.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> bem_hydrodynamics(ship("wigley"), [0.6]).added_mass.dims                               # doctest: +SKIP
    ('frequency', 'mode', 'mode_of_motion')
    """
    omega = np.atleast_1d(numbers(ship, "wave_frequency", frequency))
    if omega.ndim != 1:
        raise InputError(f"frequency of shape {omega.shape}; it is one list [rad/s]")
    solved = _solved(ship, omega, np.zeros(0), panels, lid)
    return _radiation(solved).assign_attrs(_attributes(ship, panels, lid))


def _capytaine() -> Any:
    """The package, or what to do without it."""
    try:
        import capytaine
    except ImportError as error:
        raise InputError(
            f"three-dimensional panels need Capytaine, which cannot be imported ({error}); install it with "
            "`pip install 'quartering[bem]'`, or take form 'stf'"
        ) from None
    return capytaine


@contextmanager
def _quiet() -> Iterator[None]:
    """Without Capytaine's remarks on warped panels and tabulations, and with the level it had afterwards."""
    logger = logging.getLogger("capytaine")
    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(level)


class _Body(NamedTuple):
    """A hull as it is solved: water, the origin, and how far the point of the moments is over it.

    Parameters
    ----------
    name : str
    half : Panels        of the starboard half
    x, height : float    origin, forward of midship at the calm plane; point of the moments over it [m]
    density : float      of the water [kg/m3]
    """

    name: str
    half: Panels
    x: float
    height: float
    density: float


def shortest_wave(half: Panels) -> float:
    """Length of the shortest wave that panels resolve, six times the widest of them [m]."""
    return _PANELS_PER_WAVE * float(np.sqrt(np.linalg.norm(half.area_vectors, axis=1).max()))


def hull_solution(hull: Hull, half: Panels, omega: Floats, mu: Floats, density: float) -> dict[str, NDArray[Any]]:
    """Radiation and wave forces of a hull at zero speed, about midship at the calm plane, in body axes.

    half: of it, from `hull_panels`
    omega (f,): ascending, 0 among them or not; forces are those of the ones above 0 [rad/s]
    mu (h,): ascending [deg]
    density: of the water [kg/m3]
    Returns "added_mass", "damping" (f, 3, 3); "froude_krylov", "diffraction" (waves, h, 3): phasors of e^{+i omega t}
        per metre of amplitude, the surface amidships passing its mean level on the way down at t = 0

    Source: [Ancellin19], linear potential flow.  Valid: as `bem_forces`.
    """
    body = _Body(hull.name, half, 0.0, 0.0, density)
    still = omega[omega == 0.0]
    parts = [_run(body, w, direction, True) for w, direction in ((still, mu[:0]), (omega[still.size :], mu)) if w.size]
    found = {name: np.concatenate([_matrix(one, theirs) for one in parts]) for name, theirs, _ in _RADIATION}
    return found | {name: _phasors(parts[-1], theirs) for name, theirs in _FORCES.items()}


def _solved(ship: Ship, omega: Floats, mu: Floats, panels: tuple[int, int], lid: bool) -> xr.Dataset:
    """Capytaine's own dataset of a ship about G: radiation, and diffraction for every heading."""
    if not isinstance(panels, (tuple, list)) or len(panels) != 2:
        raise InputError(
            f"panels = {quoted(panels)}; they are two numbers, along the ship and down its side; try (40, 12)"
        )
    panels = (
        count("panels along the ship", panels[0], 2, 40, 1000),
        count("panels down its side", panels[1], 2, 12, 1000),
    )
    _capytaine()
    half = hull_panels(ship.hull, *panels)
    shortest = 2 * np.pi * GRAVITY / float(omega.max()) ** 2
    if shortest < shortest_wave(half):
        raise InputError(
            f"a wave of {shortest:.3g} m is too short for panels of {shortest_wave(half) / _PANELS_PER_WAVE:.3g} m; it must be "
            f"{_PANELS_PER_WAVE:.0f} times as long; give more panels than {panels[0]} x {panels[1]}, or longer waves"
        )
    height = ship.loading.kg - ship.hull.draught
    return _run(_Body(ship.name, half, hydrostatics(ship).lcb, height, ship.loading.density), omega, mu, lid)


def _run(of: _Body, omega: Floats, mu: Floats, lid: bool) -> xr.Dataset:
    """Capytaine's own dataset: radiation, and diffraction for every heading."""
    import xarray as xr

    capytaine = _capytaine()
    points = (of.half.vertices - np.array([of.x, 0.0, 0.0])) * np.array([1.0, -1.0, -1.0])
    with _quiet():
        starboard = capytaine.Mesh(vertices=points, faces=of.half.quads)
        mesh = capytaine.ReflectionSymmetricMesh(starboard, plane="xOz")
        body = capytaine.FloatingBody(
            mesh=mesh, lid_mesh=mesh.generate_lid() if lid else None,
            dofs=capytaine.rigid_body_dofs(only=list(_DOFS), rotation_center=(0.0, 0.0, of.height)),
        )  # fmt: skip
        ascending, back = np.unique(omega, return_inverse=True)
        coords: dict[str, Any] = {
            "omega": ascending, "radiating_dof": list(_DOFS), "rho": of.density, "g": GRAVITY, "water_depth": np.inf
        }  # fmt: skip
        direction, order = np.unique(np.radians(-mu), return_inverse=True)
        if mu.size:
            coords["wave_direction"] = direction
        solver = capytaine.BEMSolver(green_function=capytaine.Delhommeau(**_TABULATION))
        solved: xr.Dataset = solver.fill_dataset(
            xr.Dataset(coords=coords), body, progress_bar=False, hydrostatics=False
        )
    names = [name for name in ("added_mass", "diffraction_force") if name in solved]
    if not names or any(bool(np.isnan(solved[name].to_numpy()).any()) for name in names):
        raise InputError(f"{of.name}: Capytaine could not solve every wave; its log says why, try other panels")
    wanted = {"omega": back} | ({"wave_direction": order} if mu.size else {})
    for name in wanted:  # the solver sorts, and a single value may have lost its dimension
        if name not in solved.dims:
            solved = solved.expand_dims(name)
    return solved.isel(wanted)


_RADIATION: Final = (("added_mass", "added_mass", "A"), ("damping", "radiation_damping", "B"))
_FORCES: Final = {"froude_krylov": "Froude_Krylov_force", "diffraction": "diffraction_force"}


def _matrix(solved: xr.Dataset, theirs: str) -> Floats:
    """Added mass or damping (f, 3, 3) in body axes."""
    values = solved[theirs].sel(influenced_dof=list(_DOFS), radiating_dof=list(_DOFS))
    turn = _HALF_TURN[:, None] * _HALF_TURN
    return np.asarray(values.transpose("omega", "influenced_dof", "radiating_dof").to_numpy() * turn)


def _phasors(solved: xr.Dataset, theirs: str) -> NDArray[np.complex128]:
    """A force (f, h, 3) in body axes, of e^{+i omega t}."""
    values = solved[theirs].sel(influenced_dof=list(_DOFS)).transpose("omega", "wave_direction", "influenced_dof")
    return np.asarray(1j * np.conj(values.to_numpy()) * _HALF_TURN)


def _radiation(solved: xr.Dataset) -> xr.Dataset:
    import xarray as xr

    dims = ("frequency", "mode", "mode_of_motion")
    fields = {
        ours: (dims, _matrix(solved, theirs), {"units": _UNITS, "symbol": letter, "long_name": ours.replace("_", " ")})
        for ours, theirs, letter in _RADIATION
    }
    omega = np.atleast_1d(solved["omega"].to_numpy()).astype(float)
    axis = ("frequency", omega, {"units": "rad/s", "symbol": "omega", "long_name": "wave frequency"})
    return xr.Dataset(fields, coords={"frequency": axis, "mode": list(MODES), "mode_of_motion": list(MODES)})


def _forces(solved: xr.Dataset) -> dict[str, Any]:
    parts = {ours: _phasors(solved, theirs) for ours, theirs in _FORCES.items()}
    parts["total"] = parts["froude_krylov"] + parts["diffraction"]
    units = "N/m (sway), N m/m (roll, yaw)"
    return {
        name: (
            ("frequency", "heading", "part", "mode"), np.stack([phasor.real, -phasor.imag], axis=-2),
            {"units": units, "symbol": "Y, K, N", "long_name": f"{name.replace('_', ' ')} wave force per metre of amplitude"},
        )
        for name, phasor in parts.items()
    }  # fmt: skip


def _attributes(ship: Ship, panels: tuple[int, int], lid: bool) -> dict[str, str | float]:
    return {
        "ship": ship.name,
        "speed": 0.0,
        "form": "bem",
        "axes": "body axes: x to the bow, y to starboard, z down; modes sway, roll, yaw",
        "reference_point": REFERENCE_POINT,
        "water_density": float(ship.loading.density),
        "method": f"Capytaine, {panels[0]} x {panels[1]} panels a side, {'with' if lid else 'without'} interior lid",
        "references": "Ancellin19",
    }
