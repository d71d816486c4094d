"""Picture of an arm's workspace: positions of its flange, from the side and from above."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rgss.documents import write_output
from rgss.errors import DefinitionError

_SUFFIXES = (".png", ".svg")


def draw_workspace(positions_m: NDArray[np.float64], path: Path, *, title: str) -> None:
    """Draw sampled positions of an arm's flange.

    Args:
        positions_m: Positions from the base, shape (k, 3).
        path: The picture, a .png or .svg file.
        title: The title of the picture.

    Raises:
        DefinitionError: The file is of another kind.
        StorageError: It cannot be written.
    """
    from matplotlib.figure import Figure

    if path.suffix.lower() not in _SUFFIXES:
        raise DefinitionError(f"picture must be a PNG or SVG file, got {path}", hint="name a .png or .svg file")
    figure = Figure(figsize=(9.0, 4.6), layout="constrained")
    side, above = figure.subplots(1, 2)
    x, y, z = positions_m.T
    side.scatter(np.hypot(x, y), z, s=2, color="#2f6db3", linewidths=0)
    side.set(xlabel="distance from the base's axis in m", ylabel="height over the base in m", title="from the side")
    above.scatter(x, y, s=2, color="#2f6db3", linewidths=0)
    above.set(xlabel="x in m", ylabel="y in m", title="from above")
    for axes in (side, above):
        axes.set_aspect("equal")
        axes.grid(visible=True, color="#dddddd", linewidth=0.5)
    figure.suptitle(f"Workspace of the flange of {title}")
    drawn = BytesIO()
    kind = path.suffix.lower().removeprefix(".")
    figure.savefig(drawn, format=kind, metadata={"Date": None} if kind == "svg" else None)
    write_output(path, drawn.getvalue())
