"""What brings the tab that compares up to the state of its page: two maps through the job queue, piece by piece."""

from __future__ import annotations

import tempfile
from collections.abc import Awaitable, Callable, Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from quartering._machine.digest import fingerprint
from quartering.conventions import InputError
from quartering.view.explorer.comparison.beside import Compared, Kept, compared, kept, link_of, offered, same
from quartering.view.explorer.comparison.compare_panel import ALIKE, STOPPED, ComparePanel
from quartering.view.explorer.computing.computations import HEADINGS, Scene, joined, map_blocks
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.service.problems import without_paths
from quartering.view.explorer.state import State

Take = Callable[[Callable[[], Any]], Awaitable[tuple[Any, list[str]]]]
Going = Callable[[], str]
"""Why a comparison goes no further: "moved on", "stopped", or "" while it goes."""


class Comparison:
    """The comparison of one page; it remembers the map of what is kept while ship, speed and waves stay.

    Parameters
    ----------
    panel : ComparePanel
    registry : ShipRegistry
    take : function      hands a piece of work to the job queue
    """

    def __init__(self, panel: ComparePanel, registry: ShipRegistry, take: Take) -> None:
        self._panel, self._registry, self._take = panel, registry, take
        self._map_of: tuple[Any, ...] | None = None
        self._map: xr.Dataset | None = None
        self._shown: Compared | None = None

    def front(self, state: State, of: Scene) -> None:
        """Show what is chosen before it is computed."""
        self._panel.front(state, of, offered(state, of.known, self._registry), link_of(state))
        self._panel.wait()

    async def follow(
        self, state: State, of: Scene, own: Sequence[xr.Dataset], going: Going, say: Callable[[str], object]
    ) -> None:
        """Compare the page with what it keeps; own: blocks of its map, none where that was stopped."""
        self._shown = None
        if not state.beside:
            self._panel.say()
            return
        link = state.beside
        try:
            other, _ = await self._take(lambda: kept(link, self._registry))
            found = None if same(of, other) else await self._compare(of, other, own, going, say)
        except InputError as error:
            self._panel.say(without_paths(str(error)), wrong=True)
            return
        if found is not None:
            self._shown = found
            self._panel.show(found)
        elif same(of, other):
            self._panel.say(ALIKE)
        elif going() == "stopped":
            self._panel.say(STOPPED)

    async def _compare(
        self, of: Scene, other: Kept, own: Sequence[xr.Dataset], going: Going, say: Callable[[str], object]
    ) -> Compared | None:
        """Both maps, and what differs; None where the page moved on, or was stopped."""
        beside = of._replace(known=other.known, ship=other.ship)
        asked = (other.known.key, fingerprint(other.ship), of.speed, of.waves, of.harmonics)
        if self._map is None or asked != self._map_of:
            self._map, parts = None, []
            for block in map_blocks(beside):
                if going():
                    return None
                part, _ = await self._take(block)
                parts.append(part)
                done = sum(one.sizes["heading"] for one in parts)
                say(f"beside: {done} of {HEADINGS.size} headings" if done < HEADINGS.size else "")
            self._map, self._map_of = joined(parts), asked
        if going():
            return None
        maps = (self._map, joined(own))
        found: Compared
        found, _ = await self._take(lambda: compared(of, other, maps))
        return None if going() else found

    def picture(self) -> tuple[str, bytes]:
        """Name and content of the picture of the comparison that is shown.

        Raises
        ------
        InputError    none is shown
        """
        from quartering.view.plots import style
        from quartering.view.plots.difference_map import difference_map

        found = self._shown
        if found is None:
            raise InputError("nothing is compared yet; choose a ship or a loading first")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "difference.png"
            style.save(difference_map(found.ds, found.length, found.title, " ".join(found.said)), path)
            return "difference.png", path.read_bytes()
