"""Conditions of one object: its true values, and the robot's perception of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Protocol

from rgss.scenes import Pose, Scene, Workpiece


class ObjectValues(Protocol):
    """Interface of an object's values that uncertain quantities change."""

    @property
    def offset_x_m(self) -> float:
        """True offset from its nominal position along x."""

    @property
    def offset_y_m(self) -> float:
        """The same along y."""

    @property
    def perceived_x_m(self) -> float:
        """Perceived minus true position along x."""

    @property
    def perceived_y_m(self) -> float:
        """The same along y."""

    @property
    def perceived_z_m(self) -> float:
        """The same along z."""

    @property
    def perceived_yaw_rad(self) -> float:
        """Perceived minus true yaw."""

    @property
    def perceived_roll_rad(self) -> float:
        """Perceived tilt about x."""

    @property
    def perceived_pitch_rad(self) -> float:
        """Perceived tilt about y."""

    @property
    def mass_kg(self) -> float:
        """True mass."""

    @property
    def centre_of_mass_m(self) -> float:
        """True height of its centre of mass above the centre of its shape."""

    @property
    def friction(self) -> float:
        """True friction coefficient."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ObjectConditions:
    """Conditions of a further object with draws; the fields are those of `Conditions`.

    Attributes:
        id: The object.
        offset_x_m: True offset from its nominal position along x.
        offset_y_m: The same along y.
        perceived_x_m: Perceived minus true position along x.
        perceived_y_m: The same along y.
        perceived_z_m: The same along z.
        perceived_yaw_rad: Perceived minus true yaw.
        perceived_roll_rad: Perceived tilt about x.
        perceived_pitch_rad: Perceived tilt about y.
        mass_kg: True mass.
        centre_of_mass_m: True height of its centre of mass above the centre of its shape.
        friction: True friction coefficient.
    """

    id: str
    offset_x_m: float = 0.0
    offset_y_m: float = 0.0
    perceived_x_m: float = 0.0
    perceived_y_m: float = 0.0
    perceived_z_m: float = 0.0
    perceived_yaw_rad: float = 0.0
    perceived_roll_rad: float = 0.0
    perceived_pitch_rad: float = 0.0
    mass_kg: float
    centre_of_mass_m: float
    friction: float


def nominal_object(workpiece: Workpiece) -> ObjectConditions:
    """Nominal conditions of an object, from the files."""
    return ObjectConditions(
        id=workpiece.id,
        mass_kg=workpiece.mass_kg,
        centre_of_mass_m=workpiece.centre_of_mass_m,
        friction=workpiece.friction,
    )


def true_workpiece(assumed: Workpiece, one: ObjectValues) -> Workpiece:
    """Object with true values.

    Args:
        assumed: The object of the files or of the case of the workload.
        one: Its conditions.
    """
    return replace(
        assumed,
        pose=moved(assumed.pose, (one.offset_x_m, one.offset_y_m, 0.0)),
        mass_kg=one.mass_kg,
        centre_of_mass_m=one.centre_of_mass_m,
        friction=one.friction,
    )


def perceived_workpiece(assumed: Workpiece, one: ObjectValues) -> Workpiece:
    """Object at its perceived pose, with the properties that the robot assumes.

    Args:
        assumed: The object of the files or of the case of the workload.
        one: Its conditions.
    """
    shift = (one.offset_x_m + one.perceived_x_m, one.offset_y_m + one.perceived_y_m, one.perceived_z_m)
    pose = moved(assumed.pose, shift)
    turn = (one.perceived_roll_rad, one.perceived_pitch_rad, one.perceived_yaw_rad)
    if any(turn):
        pose = pose @ Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), turn)
    return replace(assumed, pose=pose)


def support_offsets_m(scene: Scene, own_m: Mapping[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    """True offset along x and y of the support of each stacked object: the sum over all objects below it.

    Args:
        scene: The scene at the start.
        own_m: True offset of each object with draws.
    """
    beneath = {one.workpiece.id: one.support for one in scene.objects}
    found = {}
    for name, support in beneath.items():
        x_m, y_m, lower = 0.0, 0.0, support
        while lower in beneath:
            dx_m, dy_m = own_m.get(lower, (0.0, 0.0))
            x_m, y_m, lower = x_m + dx_m, y_m + dy_m, beneath[lower]
        if x_m or y_m:
            found[name] = (x_m, y_m)
    return found


def moved(pose: Pose, shift_m: tuple[float, float, float]) -> Pose:
    """Pose translated along the world's axes; unchanged for a zero shift.

    Args:
        pose: The pose.
        shift_m: Translation along x, y and z.
    """
    if not any(shift_m):
        return pose
    (x, y, z), (dx, dy, dz) = pose.position_m, shift_m
    return Pose(position_m=(x + dx, y + dy, z + dz), quaternion_xyzw=pose.quaternion_xyzw)
