"""A commented ship file to start from."""

from __future__ import annotations

from pathlib import Path

from quartering.conventions import InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.readers import available_ships, read_ship
from quartering.hull.ship import Ship

_TEXT = """\
# Ship file of quartering, started from the built-in ship {base}.
# Values carry their unit: m, ft, kg/m3; L, B and T stand for length, beam and draught of this file ("0.05 B").
# A line left out keeps the value of {base}. A loading value may also say where it comes from:
#   gm: {{value: 0.81 m, status: published, source: inclining test}}    # status: published, derived, assumed or given
name: {name}
base: {base:<24} # the lines come from this built-in ship (`quartering ships` lists them)

length: {length:<22} # between perpendiculars; stretches the lines
beam: {beam:<24} # moulded; stretches the lines
design_draught: {design:<14} # draught the lines are drawn for; stretches their heights
draught: {draught:<21} # draught the ship floats at; the lines stay

loading:
  {centre}
  gyradius_roll: {roll:<13} # radius of gyration in roll, without added mass; {roll_note}
  gyradius_yaw: {yaw:<14} # radius of gyration in yaw, without added mass; {yaw_note}
  roll_damping: {damping:<14} # added viscous roll damping, of critical, or ikeda, ikeda-simplified; {damping_note}
  water_density: {density:<13} # sea water 1025, fresh water 1000

linear: {linear:<22} # sway-yaw derivatives: default (lift from regression) or strip (potential flow alone)
velocities: {velocities:<18} # lift acts on the velocity relative to the water, or absolute, as in the paper
righting: {righting:<20} # righting curve in the equations: polynomial (odd, to phi^7) or spline (the curve itself)
sections: {sections:<20} # section coefficients: auto (the section's own contour, as close-fit) or lewis (Lewis forms)
ends: {ends:<24} # water round stem and stern: strips (none), or three-dimensional
drag_coefficient: {drag:<12} # cross-flow drag of the sections, 1; gives the cubic coefficients; {drag_note}

# What keeps the course (off when left out): rudder angle = gain x heading off course + rate_gain x rate of turn.
# autopilot: {{gain: 1.0, rate_gain: 10 s, lag: 2 s}}
# rudder: {{area: 20 m2, aspect: 1.8}}    # its lift is estimated from these; by rule when left out
# Bilge keels, one of the pair; ikeda and ikeda-simplified allow for them (remove the # to use it).
# bilge_keels: {{length: 0.25 L, breadth: 0.02 B}}

# Your own coefficients and wave forces at zero speed, in place of strip theory: a file of Capytaine or WAMIT beside this one.
# database: {{file: my.nc, midship: 0.0}}      # midship in the file's axes, m; moments_about: [x, z], and length (ULEN) of a .1

# Coefficients you know, in SI about G, by their SNAME names; they replace the estimates (remove the # to use them).
# coefficients:
#   K_ppp: -2.0e8               # kg m2 s
# Factors on coefficients, however they were found.
# multipliers:
#   K_ppp: 1.0                  # 1
"""


def write_ship(name: str, path: str | Path) -> Path:
    """Write a commented ship file that starts from a built-in ship, a unit on every line.

    Parameters
    ----------
    name : str             built-in ship
    path : str or Path     file to write; one that exists is not overwritten

    Returns
    -------
    Path    the file, which reads back as the same ship

    Raises
    ------
    InputError    no such built-in ship, or the file exists or cannot be written

    Notes
    -----
    Source: values of the built-in ship; the comments say which are assumed.

    Examples
    --------
    >>> import tempfile
    >>> from quartering.hull.ship import ship
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     ship(write_ship("box", f"{folder}/my.yaml")).loading.gm
    1.0
    """
    names = [entry.name for entry in available_ships()]
    if name not in names:
        read_ship(name) if not Path(name).is_file() else None  # says which names there are
        raise InputError(f'"{name}" is a file; a new ship file starts from a built-in ship: {", ".join(names)}')
    target = Path(path)
    if target.exists():
        raise InputError(f"{target} exists; it is not overwritten; give another name, or remove it first")
    try:
        target.write_text(_text(name, read_ship(name)), encoding="utf-8")
    except OSError as error:
        raise InputError(f"{target} cannot be written: {error.strerror}; give a file in a folder that exists") from None
    return target


def _text(base: str, ship: Ship) -> str:
    hull, loading = ship.hull, ship.loading
    status = {key: note.split(":")[0] for key, note in ship.provenance.items()}
    return _TEXT.format(
        base=base,
        name=f"{ship.name} (copy)",
        length=_metres(hull.length),
        beam=_metres(hull.beam),
        design=_metres(hull.design_draught),
        draught=_metres(hull.draught),
        centre=_centre(ship, status),
        roll=_metres(loading.gyradius_roll),
        roll_note=f"{status['gyradius_roll']}, {loading.gyradius_roll / hull.beam:.3f} B",
        yaw=_metres(loading.gyradius_yaw),
        yaw_note=f"{status['gyradius_yaw']}, {loading.gyradius_yaw / hull.length:.3f} L",
        damping=f"{loading.roll_damping:g}",
        damping_note=status["roll_damping"],
        density=f"{loading.density:g} kg/m3",
        linear=ship.linear,
        righting=ship.righting,
        velocities=ship.velocities,
        sections=hull.section_method,
        ends=hull.ends,
        drag=f"{ship.drag_coefficient:g}",
        drag_note=status["drag_coefficient"],
    )


def _centre(ship: Ship, status: dict[str, str]) -> str:
    """The line of gm, or of kg when that is what the ship's own file gives."""
    loading, km = ship.loading, hydrostatics(ship.hull).km
    if status["gm"] == "derived":
        words = f"height of G over the keel, below KM = {km:.3f} m; or give `gm:`, here {loading.gm:.3f} m"
        return f"kg: {_metres(loading.kg):<24} # {words}; {status['kg']}"
    words = f"metacentric height, above 0; or give `kg:`, height of G over the keel, here {loading.kg:.3f} m"
    return f"gm: {_metres(loading.gm):<24} # {words}; {status['gm']}"


def _metres(value: float) -> str:
    return f"{value:.10g} m"
