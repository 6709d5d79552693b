"""Pictures of datasets by their own name: ``ds.quartering.map()``, ``ds.quartering.branch()``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray as xr

from quartering.conventions import InputError, written

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@xr.register_dataset_accessor("quartering")  # type: ignore[no-untyped-call]
class Pictures:
    """Pictures of a dataset of this library: ``ds.quartering.map()``, ``ds.quartering.branch()``.

    Parameters
    ----------
    dataset : xarray.Dataset    as `quartering.polar` or `quartering.branch` returns it, or read from its file

    Examples
    --------
    >>> import quartering as qt
    >>> ds = qt.polar(qt.ship("wigley"), [qt.Wave(80.0, 1.0), qt.Wave(100.0, 1.0)], 5.0, [0.0, 60.0, 120.0, 180.0])
    >>> len(ds.quartering.map().axes) > 0
    True
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    def map(self) -> Figure:
        """Polar map of the largest roll over heading and wave length, one panel a speed, unstable cells hatched.

        Returns
        -------
        matplotlib Figure

        Raises
        ------
        InputError    a dataset that is no map

        Examples
        --------
        See `Pictures`.
        """
        self._needs({"verdict", "speed", "heading", "wave_length"}, "a map", "quartering.polar")
        from quartering.view.plots.polar_map import polar_map

        return polar_map(self._dataset)

    def branch(self) -> Figure:
        """Largest roll of every motion over a parameter, stable ones solid, and their Floquet multipliers.

        Returns
        -------
        matplotlib Figure

        Raises
        ------
        InputError    a dataset that is no branch

        Examples
        --------
        See `Pictures`.
        """
        self._needs({"event", "curve", "multiplier_real"}, "a branch", "quartering.branch")
        from quartering.view.plots.branch import branch_picture

        over = str(self._dataset.attrs["over"])
        return branch_picture(self._dataset, over, f"Motions over {written(over)}")

    def _repr_html_(self) -> str:
        """The picture there is of the dataset."""
        from quartering.view.report.pictures import inline_svg

        made = self.branch() if "event" in self._dataset else self.map()
        return str(inline_svg(made, "Picture of the dataset"))

    def _needs(self, wanted: set[str], what: str, by: str) -> None:
        """Refuse a dataset of something else."""
        missing = sorted(wanted - set(map(str, self._dataset.variables)))
        if missing:
            raise InputError(f"this dataset is not {what} (no {', '.join(missing)}); give one of {by}")
