"""The bilge between the edge of the flat bottom and the lowest waterline, where offsets leave it open."""

from __future__ import annotations

import numpy as np

from quartering.hull.section import Floats

_POINTS = 7


def elliptic_bilge(y: Floats, height: Floats) -> tuple[Floats, Floats]:
    """Contour whose first two points are joined by a quarter ellipse, level at the first and upright at the second.

    Parameters
    ----------
    y, height : (n,) float    first point the edge of the flat bottom, second the lowest waterline [m]

    Returns
    -------
    y, height : (n + 8,) float    with points of the ellipse between the first two, and the second given twice, since
                                  the flare above it starts with its own slope [m]

    Notes
    -----
    Source: [Todd63] gives the edge of the flat bottom ("Tan.") and the 0.075 waterline; the quarter ellipse
    reproduces its sectional areas to 0.003 B T.  Valid: second point outside the first.

    Examples
    --------
    >>> import numpy as np
    >>> y, height = elliptic_bilge(np.array([7.0, 8.0, 8.0]), np.array([0.0, 1.0, 5.0]))
    >>> len(y), round(float(y[4]), 4), round(float(height[4]), 4)
    (11, 7.7071, 0.2929)
    """
    angle = np.linspace(0.0, np.pi / 2, _POINTS + 2)[1:-1]
    dy, dh = y[1] - y[0], height[1] - height[0]
    if dy <= 0 or dh <= 0:
        return y, height
    return (
        np.concatenate([y[:1], y[0] + dy * np.sin(angle), y[1:2], y[1:]]),
        np.concatenate([height[:1], height[0] + dh * (1 - np.cos(angle)), height[1:2], height[1:]]),
    )
