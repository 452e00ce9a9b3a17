"""Maps in Matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Optional

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ogm_maps import Map


def draw_map(map: Map, ax: Optional[Axes]) -> Axes:
    """Draws a map in metres of its frame, turned as its origin is; unknown cells stay clear."""
    import numpy as np
    from matplotlib.transforms import Affine2D

    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.gca()
    width, height = map.width * map.resolution, map.height * map.resolution
    percent = np.ma.masked_less(map.array, 0)
    x, y, theta = map.origin
    placed = Affine2D().rotate(theta).translate(x, y)
    ax.imshow(
        percent,
        cmap="gray_r",
        vmin=0,
        vmax=100,
        origin="lower",
        interpolation="nearest",
        extent=(0.0, width, 0.0, height),
        transform=placed + ax.transData,
    )
    corners = placed.transform([(0, 0), (width, 0), (0, height), (width, height)])
    ax.update_datalim(corners)
    ax.autoscale_view()
    ax.set_aspect("equal")
    ax.set_xlabel("x (m)")
    ax.set_ylabel("y (m)")
    return ax
