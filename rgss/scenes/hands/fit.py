"""Whether the fingers of a gripper can enter round an object and touch it."""

from __future__ import annotations

from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.shapes import Cylinder


def too_wide(geometry: GripperGeometry, shape: Cylinder) -> str:
    """Why open fingers cannot enter round an object; empty where they can.

    Args:
        geometry: The gripper's shape.
        shape: The object.
    """
    if geometry.cup is not None or shape.radius_m < geometry.largest_opening_m:
        return ""
    return (
        f"the object of {_millimetres(2 * shape.radius_m)} is too wide to enter {_named(geometry)}, "
        f"which opens to {_millimetres(2 * geometry.largest_opening_m)}"
    )


def too_narrow(geometry: GripperGeometry, shape: Cylinder) -> str:
    """Why closed fingers do not touch an object; empty where they do.

    Args:
        geometry: The gripper's shape.
        shape: The object.
    """
    if geometry.cup is not None or shape.radius_m > geometry.least_opening_m:
        return ""
    return (
        f"the object of {_millimetres(2 * shape.radius_m)} is too narrow to be touched by {_named(geometry)}, "
        f"which closes to {_millimetres(2 * geometry.least_opening_m)}"
    )


def misfit(geometry: GripperGeometry, shape: Cylinder) -> str:
    """Why a gripper cannot hold an object by its size; empty where it can.

    Args:
        geometry: The gripper's shape.
        shape: The object.
    """
    return too_wide(geometry, shape) or too_narrow(geometry, shape) or unsealed(geometry, shape)


def unsealed(geometry: GripperGeometry, shape: Cylinder) -> str:
    """Why a cup does not seal on the top of an object; empty where it does, and for fingers.

    Args:
        geometry: The gripper's shape.
        shape: The object.
    """
    if geometry.cup is None or shape.radius_m >= geometry.cup.radius_m:
        return ""
    return (
        f"the top of the object of {_millimetres(2 * shape.radius_m)} is smaller than the cup of "
        f"{_named(geometry)}, {_millimetres(2 * geometry.cup.radius_m)}"
    )


def _named(geometry: GripperGeometry) -> str:
    return f"gripper {geometry.id}" + (f" in its mounting {geometry.mounting}" if geometry.mounting else "")


def _millimetres(metres: float) -> str:
    return f"{metres * 1e3:.4g} mm"
