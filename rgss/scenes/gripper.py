"""Parametric grippers: a base and prismatic fingers that close towards the axis."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from rgss.scenes.linkage import Linkage
from rgss.scenes.linkage_inertia import pad_mass_kg
from rgss.scenes.pose import Pose
from rgss.scenes.shapes import Box, Cylinder

_CUP_MASS_SHARE = 0.05
_BOSS_M = 1.0e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class GripperGeometry:
    """Shape of a gripper, in the flange frame (z out of the flange).

    Each finger is a box that slides along its azimuth; its pad is the inner face. The opening
    is the distance of the pads from the axis.

    Attributes:
        id: Its name.
        azimuths_rad: Direction of each finger about z.
        base: The body between flange and fingers, its top face on the flange.
        finger: A finger: x radial (thickness), y tangential (width), z axial (length).
        largest_opening_m: Pad distance from the axis when open.
        stroke_m: Travel of each finger towards the axis.
        grasp_depth_m: Distance along z from the flange to the grasp centre.
        mounting: Name of the mounting of the fingers; empty if the gripper has only one.
        cup: Suction cup below the base; None for a gripper with fingers.
        linkage: Mechanism that moves the pads; None for sliding fingers. With a linkage `finger` is the part of a link
        with the pad, in its pose at the object's width, and the base ends where the pad begins.
    """

    id: str
    azimuths_rad: tuple[float, ...]
    base: Cylinder
    finger: Box
    largest_opening_m: float
    stroke_m: float
    grasp_depth_m: float
    mounting: str = ""
    cup: Cylinder | None = None
    linkage: Linkage | None = None

    @property
    def fingers(self) -> int:
        """Number of fingers."""
        return len(self.azimuths_rad)

    @property
    def least_opening_m(self) -> float:
        """Pad distance from the axis when closed."""
        return self.largest_opening_m - self.stroke_m

    @property
    def palm_height_m(self) -> float:
        """Distance along z from the flange to the palm in m, the limit for an object between the fingers.

        What protrudes from the fingers before their pads is a limit too.
        """
        if self.linkage is None:
            return self.base.height_m
        return min(self.base.height_m, max(self.linkage.palm_height_m, boss_height_m(self.linkage)))

    @property
    def tip_height_m(self) -> float:
        """Distance along z from the flange to the ends of the fingers in m."""
        return self.base.height_m + self.finger.size_m[2] if self.linkage is None else self.linkage.tip_height_m

    @property
    def base_pose(self) -> Pose:
        """Transform of the base's shape to the flange."""
        return Pose(position_m=(0.0, 0.0, self.base.height_m / 2))

    def finger_pose(self, finger: int, opening_m: float) -> Pose:
        """Transform of a finger's shape to the flange at a pad distance from the axis."""
        azimuth = self.azimuths_rad[finger]
        radius = opening_m + self.finger.size_m[0] / 2
        height = self.base.height_m + self.finger.size_m[2] / 2
        return Pose.from_roll_pitch_yaw(
            (radius * math.cos(azimuth), radius * math.sin(azimuth), height), (0.0, 0.0, azimuth)
        )

    @property
    def cup_pose(self) -> Pose:
        """Transform of the suction cup's shape to the flange."""
        half_m = 0.0 if self.cup is None else self.cup.half_height_m
        return Pose(position_m=(0.0, 0.0, self.base.height_m + half_m))

    @property
    def lip(self) -> Pose:
        """Transform of the centre of the suction cup's lip to the flange."""
        length_m = 0.0 if self.cup is None else self.cup.height_m
        return Pose(position_m=(0.0, 0.0, self.base.height_m + length_m))

    @property
    def grasp_centre(self) -> Pose:
        """Transform of the grasp-centre frame to the flange."""
        return Pose(position_m=(0.0, 0.0, self.grasp_depth_m))


@dataclass(frozen=True, slots=True, kw_only=True)
class GripperDrive:
    """Drive of the fingers, from the gripper's file.

    Attributes:
        inertia_kg: Inertia of the drive of one finger reflected to the finger, as an equivalent mass.
        firm_force_n: Normal force that each finger must exceed for a firm grasp; None for the force that Coulomb
        friction requires to hold the object.
        command_s: Duration of a command to open or close, without feedback of force or position; None for a gripper
        that measures its fingers' forces.
        unpowered_force_n: Force at each finger up to which the mechanism resists while the drive is off.
    """

    inertia_kg: float = 0.0
    firm_force_n: float | None = None
    command_s: float | None = None
    unpowered_force_n: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Suction:
    """Sealing conditions and holding force of a suction cup; its greatest normal force is the force of the gripper.

    Attributes:
        tangential_force_n: Greatest tangential force, at full vacuum.
        leak: Share of both forces lost by leakage at the surface of the object.
        largest_gap_m: Greatest distance of the lip from a surface for sealing.
        largest_angle_rad: Greatest angle between the cup's axis and the normal of that surface.
        build_up_s: Time from the command to full vacuum, which rises linearly.
        release_s: Time from the command to the release of the object.
    """

    tangential_force_n: float
    leak: float
    largest_gap_m: float
    largest_angle_rad: float
    build_up_s: float
    release_s: float


@dataclass(frozen=True, slots=True, kw_only=True)
class GripperFile:
    """A gripper file.

    Attributes:
        mountings: The gripper's shape in each mounting, by name; the empty name if it has only one.
        mounting: The default mounting, if no design sets it.
        drive: The drive of its fingers.
        suction: Its suction cup; None for a gripper with fingers.
        settings: Values in SI that apply if no design sets them, such as ``gripper.finger.mass``.
    """

    mountings: Mapping[str, GripperGeometry]
    mounting: str = ""
    drive: GripperDrive
    suction: Suction | None = None
    settings: Mapping[str, float | str]

    @property
    def geometry(self) -> GripperGeometry:
        """Shape in the default mounting."""
        return self.mountings[self.mounting]


@dataclass(frozen=True, slots=True, kw_only=True)
class Gripper:
    """Gripper of a design variant.

    Attributes:
        geometry: Its shape.
        base_mass_kg: Mass of the base with its actuators.
        finger_mass_kg: Mass of one finger.
        finger_velocity_m_s: Greatest finger speed.
        finger_force_n: Force of one finger.
        friction: Coefficient of the pads; a contact's coefficient is the product with the object's.
        drive: The drive of its fingers.
        suction: Its suction cup; None for a gripper with fingers.
    """

    geometry: GripperGeometry
    base_mass_kg: float
    finger_mass_kg: float
    finger_velocity_m_s: float
    finger_force_n: float
    friction: float
    drive: GripperDrive = GripperDrive()
    suction: Suction | None = None

    def grip_coefficient(self, object_friction: float) -> float:
        """Holding force in the weakest direction divided by the sum of the normal forces of fingers or cup.

        For fingers it is the coefficient of friction; for a cup the lesser of 1, along its axis, and the ratio of its
        greatest tangential to its greatest normal force.
        """
        if self.suction is None:
            return self.friction * object_friction
        return min(1.0, self.suction.tangential_force_n / self.finger_force_n)

    @property
    def cup_mass_kg(self) -> float:
        """Mass of the suction cup with its fitting, a share of the base's mass; 0 without a cup."""
        return _CUP_MASS_SHARE * self.base_mass_kg if self.geometry.cup is not None else 0.0

    @property
    def driven_mass_kg(self) -> float:
        """Mass moved by the motor of one finger: the finger and the reflected inertia of its drive.

        Of a linkage it is the equivalent mass at the pad.
        """
        linkage = self.geometry.linkage
        if linkage is None:
            return self.finger_mass_kg + self.drive.inertia_kg
        return pad_mass_kg(linkage) * self.geometry.fingers * self.finger_mass_kg / linkage.moved_mass_kg

    @property
    def mass_kg(self) -> float:
        """Mass of the whole gripper."""
        return self.base_mass_kg + self.geometry.fingers * self.finger_mass_kg


def boss_height_m(linkage: Linkage) -> float:
    """Distance along z from the flange to the end of what protrudes before the faces of the pads in m; else 0."""
    poses = linkage.link_poses(linkage.opened)
    hulls = ((pad, hull) for pad in linkage.pads for hull in linkage.links[pad.link].hulls_m)
    corners = ((pad, Pose(position_m=corner)) for pad, hull in hulls for corner in hull)
    before = ((pad, at) for pad, at in corners if (pad.frame.inverse() @ at).position_m[0] < -_BOSS_M)
    return max(((poses[pad.link] @ at).position_m[2] for pad, at in before), default=0.0)
