"""Messages of Foxglove's schemas that others contain: times, poses, colours, scene entities."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

_NS_PER_S = 1_000_000_000
_VERTEX_DIGITS = 7
_PRIMITIVES = ("arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models")


def nanoseconds(time_s: float) -> int:
    """Simulated time in nanoseconds, as a file records it."""
    return round(time_s * _NS_PER_S)


def timestamp(time_s: float) -> dict[str, int]:
    """Simulated time as ``time`` of a message."""
    seconds, rest = divmod(nanoseconds(time_s), _NS_PER_S)
    return {"sec": seconds, "nsec": rest}


def vector(values: Sequence[float]) -> dict[str, float]:
    """``foxglove.Vector3`` or ``foxglove.Point3`` of three numbers."""
    x, y, z = values
    return {"x": x, "y": y, "z": z}


def quaternion(xyzw: Sequence[float]) -> dict[str, float]:
    """``foxglove.Quaternion`` of four numbers, scalar last."""
    x, y, z, w = xyzw
    return {"x": x, "y": y, "z": z, "w": w}


def pose(position_m: Sequence[float] = (0.0, 0.0, 0.0), xyzw: Sequence[float] = (0.0, 0.0, 0.0, 1.0)) -> dict[str, Any]:
    """``foxglove.Pose``, by default the identity."""
    return {"position": vector(position_m), "orientation": quaternion(xyzw)}


def colour(rgba: Sequence[float]) -> dict[str, float]:
    """``foxglove.Color`` of red, green, blue and opacity."""
    red, green, blue, opacity = rgba
    return {"r": red, "g": green, "b": blue, "a": opacity}


def points(rows: Iterable[Sequence[float]]) -> list[dict[str, float]]:
    """Points to a tenth of a micrometre, shape (n, 3)."""
    return [vector([round(float(value), _VERTEX_DIGITS) for value in row]) for row in rows]


def entity(
    identifier: str, *, frame: str, time_s: float, metadata: dict[str, str] | None = None, **primitives: object
) -> dict[str, Any]:
    """``foxglove.SceneEntity`` that moves with its frame and stays until it is replaced.

    Args:
        identifier: Its id, one for each entity of a topic.
        frame: Its frame.
        time_s: Its time.
        metadata: Keys and values that a viewer shows for it.
        primitives: The shapes of each kind, such as ``triangles``.
    """
    return {
        "timestamp": timestamp(time_s),
        "frame_id": frame,
        "id": identifier,
        "lifetime": {"sec": 0, "nsec": 0},
        "frame_locked": True,
        "metadata": [{"key": key, "value": value} for key, value in (metadata or {}).items()],
        **{kind: primitives.get(kind, []) for kind in _PRIMITIVES},
    }


def scene_update(entities: list[dict[str, Any]]) -> dict[str, Any]:
    """``foxglove.SceneUpdate`` that adds or replaces entities."""
    return {"deletions": [], "entities": entities}


def rotation_from_x(direction: NDArray[np.float64]) -> tuple[float, float, float, float]:
    """Shortest rotation from the x axis to a direction, as a quaternion with its scalar last.

    Args:
        direction: The direction, shape (3,), not zero.
    """
    x, y, z = (direction / np.linalg.norm(direction)).tolist()
    if x < -1.0 + 1e-12:
        return (0.0, 0.0, 1.0, 0.0)
    # The half-way quaternion (axis × direction, 1 + axis · direction), normalized.
    turn = np.array([0.0, -z, y, 1.0 + x])
    a, b, c, d = (turn / np.linalg.norm(turn)).tolist()
    return (a, b, c, d)
