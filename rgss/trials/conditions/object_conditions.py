"""Conditions of one object: its true values, and the robot's perception of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol

from rgss.scenes import Pose, Workpiece


class OfObject(Protocol):
    """What uncertain quantities change of an object."""

    @property
    def stands_x_m(self) -> float:
        """True offset from its nominal position along x."""

    @property
    def stands_y_m(self) -> float:
        """The same along y."""

    @property
    def perceived_x_m(self) -> float:
        """Perceived less true position along x."""

    @property
    def perceived_y_m(self) -> float:
        """The same along y."""

    @property
    def perceived_z_m(self) -> float:
        """The same along z."""

    @property
    def perceived_yaw_rad(self) -> float:
        """Perceived less true turn about the vertical."""

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
    """Conditions of a further object of which something is drawn; the fields are those of `Conditions`.

    Attributes:
        id: The object.
        stands_x_m: True offset from its nominal position along x.
        stands_y_m: The same along y.
        perceived_x_m: Perceived less true position along x.
        perceived_y_m: The same along y.
        perceived_z_m: The same along z.
        perceived_yaw_rad: Perceived less true turn about the vertical.
        perceived_roll_rad: Perceived tilt about x.
        perceived_pitch_rad: Perceived tilt about y.
        mass_kg: True mass.
        centre_of_mass_m: True height of its centre of mass above the centre of its shape.
        friction: True friction coefficient.
    """

    id: str
    stands_x_m: float = 0.0
    stands_y_m: float = 0.0
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
    """The conditions of an object as the files say.

    Args:
        workpiece: The object.
    """
    return ObjectConditions(
        id=workpiece.id,
        mass_kg=workpiece.mass_kg,
        centre_of_mass_m=workpiece.centre_of_mass_m,
        friction=workpiece.friction,
    )


def true_workpiece(believed: Workpiece, one: OfObject) -> Workpiece:
    """The object as it is.

    Args:
        believed: The object as the files or the case of the workload say.
        one: Its conditions.
    """
    return replace(
        believed,
        pose=moved(believed.pose, (one.stands_x_m, one.stands_y_m, 0.0)),
        mass_kg=one.mass_kg,
        centre_of_mass_m=one.centre_of_mass_m,
        friction=one.friction,
    )


def perceived_workpiece(believed: Workpiece, one: OfObject) -> Workpiece:
    """The object where the robot perceives it; what else there is of it is believed.

    Args:
        believed: The object as the files or the case of the workload say.
        one: Its conditions.
    """
    shift = (one.stands_x_m + one.perceived_x_m, one.stands_y_m + one.perceived_y_m, one.perceived_z_m)
    pose = moved(believed.pose, shift)
    turn = (one.perceived_roll_rad, one.perceived_pitch_rad, one.perceived_yaw_rad)
    if any(turn):
        pose = pose @ Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), turn)
    return replace(believed, pose=pose)


def moved(pose: Pose, shift_m: tuple[float, float, float]) -> Pose:
    """A pose that is moved along the world's axes; itself for no shift.

    Args:
        pose: The pose.
        shift_m: By how much along x, y and z.
    """
    if not any(shift_m):
        return pose
    (x, y, z), (dx, dy, dz) = pose.position_m, shift_m
    return Pose(position_m=(x + dx, y + dy, z + dz), quaternion_xyzw=pose.quaternion_xyzw)
