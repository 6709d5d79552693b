"""The ship in its wave, moving: from aft and from above, to scale."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final, cast

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.loads.waves import Wave, encounter_frequency, heading_components
from quartering.motion.equations.model import Model
from quartering.view.moves import Moves, moves_of, pace_of
from quartering.view.plots import style
from quartering.view.ship_shape import shape_of
from quartering.view.wording import ship_notes, speed_words

Floats = NDArray[np.float64]
FRAMES_OF_A_PERIOD: Final = 24
MOST_FRAMES: Final = 168
_WATER, _SKY, _HULL = "#8fbbdd", "#f4f7fa", "#d9d2c5"
_ALONG, _ACROSS = 1.5, 1.1
"""The view from above is so many ship lengths high and wide."""
_GRID, _SHADES = (75, 55), 14
"""Points of the water seen from above; few shades keep a file small."""


class Scene:
    """The pictures of a ship in a regular wave: what stands still is drawn once, what moves in every frame.

    ship, wave, speed [m/s], heading [deg]
    moves: what moves
    title, note: above and below
    """

    def __init__(
        self, ship: Ship, wave: Wave, speed: float, heading: float, moves: Moves, title: str, note: str
    ) -> None:
        self.shape, self.wave, self.moves = shape_of(ship), wave, moves
        self.k1, self.k2 = (float(wave.wavenumber * part) for part in heading_components(heading))
        self.omega = float(encounter_frequency(wave.frequency, speed, heading))
        self.figure = style.figure(9.4, 6.3)
        self.figure.get_layout_engine().set(rect=(0, 0, 1, 1))  # type: ignore[union-attr, call-arg]
        self.canvas = cast(Any, FigureCanvasAgg(self.figure))
        grid = self.figure.add_gridspec(2, 2, height_ratios=(3.2, 1.0), width_ratios=(1.5, 1.0))
        self.aft, self.above = self.figure.add_subplot(grid[0, 0]), self.figure.add_subplot(grid[0, 1])
        self.strip = self.figure.add_subplot(grid[1, :])
        self.moving: list[tuple[Axes, Any]] = []
        self._from_aft(ship)
        self._from_above(ship)
        self._history()
        style.title(self.figure, title)
        style.footnote(self.figure, note)
        for _, artist in self.moving:
            artist.set_animated(True)
        self.canvas.draw()
        self.still = self.canvas.copy_from_bbox(self.figure.bbox)

    def elevation(self, x: Floats, y: Floats, time: float) -> Floats:
        """Height of the water over its mean [m]: at time 0 it passes the mean level at G, moving down."""
        return -self.wave.amplitude * np.sin(self.k1 * x - self.k2 * y + self.omega * time)

    def frame(self, i: int) -> NDArray[np.uint8]:
        """The picture at a sample, (height, width, 3)."""
        self._move(i)
        self.canvas.restore_region(self.still)
        for ax, artist in self.moving:
            ax.draw_artist(artist)
        return np.asarray(self.canvas.buffer_rgba())[..., :3].copy()

    def _from_aft(self, ship: Ship) -> None:
        """Axes of the view from aft: starboard on the right."""
        ax, shape = self.aft, self.shape
        reach = 0.95 * ship.hull.beam
        top = float(shape.surface[..., 2].max())
        low, high = float(shape.surface[..., 2].min()), top
        tall = max(high - low, 2 * self.wave.amplitude)
        ax.set_xlim(-reach, reach)
        ax.set_ylim(low - 0.35 * tall, high + 0.35 * tall)
        ax.set_aspect("equal", adjustable="box")
        ax.set_facecolor(_SKY)
        ax.set_title("from aft")
        ax.set_xlabel("to starboard [m]")
        ax.set_ylabel("height over G [m]")
        wide = np.linspace(-3 * reach, 3 * reach, 121)
        self.wide = wide
        water = ax.fill(wide, wide, facecolor=_WATER, edgecolor="none", alpha=0.75, zorder=3)[0]
        surface = ax.plot(wide, wide, color=style.CONTRAST[0], linewidth=1.4, zorder=4)[0]
        filled = ax.fill([0, 1, 1], [0, 0, 1], facecolor=_HULL, edgecolor=style.INK, linewidth=1.4, zorder=2)[0]
        lines = [ax.plot([], [], color=style.QUIET, linewidth=0.7, zorder=2.5)[0] for _ in shape.sections[1:]]
        point = ax.plot([0.0], [0.0], "o", color=style.INK, markersize=4, zorder=5)[0]
        self.aft_parts = (water, surface, filled, lines, point)
        self.moving += [(ax, part) for part in (filled, *lines, water, surface, point)]

    def _from_above(self, ship: Ship) -> None:
        """Axes of the view from above: bow up, the water shaded from trough to crest."""
        ax, length = self.above, ship.hull.length
        high, wide = 0.5 * _ALONG * length, 0.5 * _ACROSS * length
        ax.set_xlim(-wide, wide)
        ax.set_ylim(-high, high)
        ax.set_aspect("equal")
        ax.set_title("from above; dark: trough, light: crest")
        ax.set_xlabel("to starboard [m]")
        ax.set_ylabel("ahead [m]")
        ax.grid(visible=False)
        self.x, self.y = np.meshgrid(
            np.linspace(-high, high, _GRID[0]), np.linspace(-wide, wide, _GRID[1]), indexing="ij"
        )
        a = max(self.wave.amplitude, 1e-9)
        shades = mpl.colormaps["Blues_r"].resampled(_SHADES)
        extent = (-wide, wide, -high, high)
        sea = ax.imshow(np.zeros(_GRID), shades, origin="lower", extent=extent, interpolation="bilinear", zorder=0)
        sea.set_clim(-1.6 * a, 1.4 * a)
        deck = ax.fill([0, 1, 1], [0, 0, 1], facecolor=_HULL, edgecolor=style.INK, linewidth=1.2, zorder=2)[0]
        line = ax.plot([], [], color=style.QUIET, linewidth=0.8, zorder=3)[0]
        self.above_parts = (sea, deck, line)
        self.moving += [(ax, part) for part in (sea, deck, line)]

    def _history(self) -> None:
        """Roll over time with a point that runs along."""
        ax, roll = self.strip, np.degrees(self.moves.roll)
        ax.plot(self.moves.time, roll, color=style.CONTRAST[0], linewidth=1.0)
        ax.set_xlim(self.moves.time[0], self.moves.time[-1])
        ax.set_xlabel("time [s]")
        ax.set_ylabel("roll [deg]")
        self.dot = ax.plot([0.0], [0.0], "o", color=style.INK, markersize=6, zorder=5)[0]
        self.moving.append((ax, self.dot))

    def _move(self, i: int) -> None:
        """Put everything where it is at a sample."""
        m = self.moves
        time, roll, yaw = float(m.time[i]), float(m.roll[i]), float(m.yaw[i])
        sway, heave = float(m.sway[i]), float(m.heave[i])
        water, surface, filled, lines, point = self.aft_parts
        level = self.shape.water + self.elevation(np.zeros_like(self.wide), self.wide, time)
        floor = -10 * abs(self.shape.surface[..., 2].min()) - 10 * self.wave.height
        water.set_xy(np.stack([[*self.wide, *self.wide[::-1]], [*level, *np.full_like(level, floor)]], axis=1))
        surface.set_data(self.wide, level)
        # Positive roll puts the starboard side (right, seen from aft) down.
        turn = np.array([[np.cos(roll), -np.sin(roll)], [np.sin(roll), np.cos(roll)]])
        placed = [section @ turn + [sway, heave] for section in self.shape.sections]
        filled.set_xy(placed[0])
        for line, section in zip(lines, placed[1:], strict=True):
            line.set_data(section[:, 0], section[:, 1])
        point.set_data([sway], [heave])
        sea, deck, line = self.above_parts
        sea.set_data(self.elevation(self.x, self.y, time))
        # Positive yaw turns the bow to starboard: x ahead is drawn up, y to starboard right.
        turn = np.array([[np.sin(yaw), np.cos(yaw)], [np.cos(yaw), -np.sin(yaw)]])
        deck.set_xy(self.shape.deck @ turn + [sway, 0.0])
        line.set_data(*(self.shape.waterline @ turn + [sway, 0.0]).T)
        self.dot.set_data([time], [np.degrees(roll)])


NO_HEAVE = "Heave and pitch are not in these equations: the ship is drawn at its mean level."
TO_SCALE = "To scale in both views; drift to the side and off the course is left out."


def write_moving(path: Path, ship: Ship, model: Model, trace: xr.Dataset, program: str = "") -> None:
    """Write the ship moving in its wave: a .gif, or by a program a film.

    trace: of `quartering.simulate`
    program: path of ffmpeg for a .mp4
    """
    about = model.source
    wave, speed = Wave(float(about["wave_length"]), float(about["wave_height"])), float(about["speed"])
    heading, period = float(about["heading"]), 2 * np.pi / model.frequency
    moves = moves_of(trace, period)
    chosen, step = frames_shown(moves, period)
    pace = pace_of(period)
    at = (
        f"heading {heading:g} deg, {speed_words(speed, ship.hull.length)}, wave {wave.length:.4g} x {wave.height:.3g} m"
    )
    missing = "" if "heave" in trace else f"{NO_HEAVE} "
    note = f"{missing}{TO_SCALE} Shown {pace:g} times as fast as in nature. {ship_notes(ship)}"
    scene = Scene(ship, wave, speed, heading, moves, f"{ship.name}: {at}", note)
    frames = (scene.frame(int(i)) for i in chosen)
    if path.suffix.lower() == ".gif":
        write_gif(path, frames, step / pace)
    else:
        write_mp4(path, frames, step / pace, program)


def frames_shown(moves: Moves, period: float) -> tuple[NDArray[np.intp], float]:
    """Samples of the frames, the last `MOST_FRAMES` where there are more, and seconds between two of them."""
    step = max(1, round(period / FRAMES_OF_A_PERIOD / (moves.time[1] - moves.time[0]))) if moves.time.size > 1 else 1
    chosen = np.arange(moves.time.size - 1, -1, -step)[::-1][-MOST_FRAMES:]
    return chosen, step * float(moves.time[1] - moves.time[0]) if moves.time.size > 1 else period


def write_gif(path: Path, frames: Iterator[NDArray[np.uint8]], seconds: float) -> None:
    """Write frames as an animated GIF that goes round.

    seconds: a frame stands
    """
    from PIL import Image

    images = [Image.fromarray(frame) for frame in frames]
    palette = images[0].quantize(64, dither=Image.Dither.NONE)
    drawn = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    drawn[0].save(
        path, format="GIF", save_all=True, append_images=drawn[1:], duration=max(20, 10 * round(100 * seconds)), loop=0,
        optimize=False, disposal=1,
    )  # fmt: skip


def write_mp4(path: Path, frames: Iterator[NDArray[np.uint8]], seconds: float, program: str) -> None:
    """Write frames as a film, by ffmpeg.

    program: path of ffmpeg
    Raises InputError where it fails
    """
    import subprocess

    first = next(frames)
    high, wide = (size - size % 2 for size in first.shape[:2])  # the encoder wants even sizes
    words = [
        program, "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{wide}x{high}",
        "-r", f"{1 / seconds:.4g}", "-i", "-", "-pix_fmt", "yuv420p", "-f", "mp4", str(path),
    ]  # fmt: skip
    whole = b"".join(np.ascontiguousarray(frame[:high, :wide]).tobytes() for frame in (first, *frames))
    done = subprocess.run(words, input=whole, capture_output=True, check=False)
    if done.returncode != 0:
        said = done.stderr.decode(errors="replace").strip().splitlines()
        raise InputError(f"ffmpeg cannot write the film ({said[-1] if said else 'it gave no reason'}); write a .gif")
