"""Scene of the task: fixed bodies, objects, place regions and robot."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from rgss.scenes.frames import NamedFrame
from rgss.scenes.grasps import ChosenGrasp, GivenGrasp, GraspCandidates
from rgss.scenes.mass_properties import Gyration
from rgss.scenes.pose import Pose
from rgss.scenes.robot import Robot
from rgss.scenes.shapes import Box, Cylinder, ObjectShape, Shape
from rgss.scenes.uncertainty import NOTHING_UNCERTAIN, Uncertainty

LARGEST_DROP_M = 0.01
LARGEST_DRAG_M = 0.001
ColourRgba = tuple[float, float, float, float]
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)

FORCE_WINDOW_S = 0.01
"""Default averaging window in s of the force limit of a workpiece: the period of a 100 Hz sensor."""

LANDING_LIMIT_M_S = 1.0
"""Default limit in m/s of a workpiece's velocity change on landing: that of a fall of 51 mm without rebound."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneBody:
    """Fixed body of the scene.

    Attributes:
        id: Its name.
        shape: Its solid: a box or a cylinder, unless it is another object.
        pose: Transform of the shape's frame to the world.
        friction: Its coefficient; a contact's coefficient is the product of both bodies'.
        colour: Colour in pictures.
        moves_with_robot: True if it moves with the base of the robot, where a design sets that.
    """

    id: str
    shape: ObjectShape
    pose: Pose
    friction: float
    colour: ColourRgba
    moves_with_robot: bool = field(default=False, compare=False)

    @property
    def primitive(self) -> Shape:
        """Its solid as a box or a cylinder, the shapes of bodies of a scene file."""
        if isinstance(self.shape, (Box, Cylinder)):
            return self.shape
        raise AssertionError("checked before: a body of a scene file is a box or a cylinder")


@dataclass(frozen=True, slots=True, kw_only=True)
class Workpiece:
    """The object that is picked and placed.

    Attributes:
        id: Its name.
        shape: Its solid; at rest the z axis of its frame is up.
        mass_kg: Its mass.
        friction: Its coefficient.
        force_limit_n: Normal force of a finger, averaged over the window, above which it counts as damaged.
        force_window_s: The averaging window; such a limit is measured quasi-statically with a sensor that averages.
        landing_limit_m_s: Velocity change on landing above which it counts as damaged: the critical velocity change of
            ASTM D3332. An impact shorter than the response of the object causes damage by its velocity change, not by
            its force, which at the same speed increases with the mass.
        centre_of_mass_m: Height of its centre of mass above the centre of its shape.
        centre_of_mass_across_m: Coordinates of the centre of mass along x and y.
        gyration_m2: Its inertia about the centre of mass divided by its mass; None for that of the homogeneous shape.
        rolling_resistance_m: Resisting torque of rolling divided by the normal force.
        grasps: The grasps given in its file.
        pose: Transform of its shape's frame to the world at the start.
        colour: Colour in pictures.
    """

    id: str
    shape: ObjectShape
    mass_kg: float
    friction: float
    force_limit_n: float
    force_window_s: float = FORCE_WINDOW_S
    landing_limit_m_s: float = LANDING_LIMIT_M_S
    centre_of_mass_m: float = 0.0
    centre_of_mass_across_m: tuple[float, float] = (0.0, 0.0)
    gyration_m2: Gyration | None = None
    rolling_resistance_m: float = 0.0
    grasps: tuple[GivenGrasp, ...] = ()
    pose: Pose
    colour: ColourRgba


@dataclass(frozen=True, slots=True, kw_only=True)
class PlaceRegion:
    """Place region of the workpiece at the end of the task.

    Attributes:
        centre_m: Centre of the region on the supporting surface, in the world; on an object where it stands at first.
        radius_m: Greatest distance of the workpiece's axis from the centre.
        largest_tilt_rad: Greatest tilt of the workpiece from upright.
        largest_drop_m: Greatest height above the surface at which the workpiece may be released; from a greater height
        it counts as dropped. From the default of 10 mm it lands with 0.44 m/s.
        largest_drag_m: Greatest displacement of the workpiece by the robot after its release. The default of 1 mm is
        ten times the motion of a carried object in the hand.
        largest_turn_rad: Greatest angle about the vertical between the workpiece and its orientation at the place, up
        to the rotations that leave its shape as it is; None for any.
        offset_m: Position of the centre on a supporting object, from its middle, in its frame; None on a fixed body.
    """

    centre_m: tuple[float, float, float]
    radius_m: float
    largest_tilt_rad: float
    largest_drop_m: float = LARGEST_DROP_M
    largest_drag_m: float = LARGEST_DRAG_M
    largest_turn_rad: float | None = None
    offset_m: tuple[float, float] | None = None

    def on(self, pose: Pose, half_height_m: float) -> PlaceRegion:
        """The region on its supporting object where that stands now; itself on a fixed body.

        Args:
            pose: Transform of the supporting object to the world.
            half_height_m: Half of its height.
        """
        if self.offset_m is None:
            return self
        return replace(self, centre_m=(pose @ Pose(position_m=(*self.offset_m, half_height_m))).position_m)


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneObject:
    """Object with its support at the start and its place region.

    Attributes:
        workpiece: The object.
        support: Id of the body or object on which it stands at the start.
        place: Its place region.
        place_support: Id of the body or object of its place region.
        grasp: The grasp chosen for it; None before the choice.
    """

    workpiece: Workpiece
    support: str
    place: PlaceRegion
    place_support: str
    grasp: ChosenGrasp | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedPlace:
    """Place region without an object.

    Attributes:
        id: Its name.
        region: The region.
        support: Id of its supporting body or object.
    """

    id: str
    region: PlaceRegion
    support: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """Waypoints of the pick-and-place task; the tool points down unless a grasp is chosen from candidates.

    Attributes:
        approach_height_m: Height of the grasp approach above the grasp.
        lift_height_m: Height of the lift above the grasp.
        departure_height_m: Height of the grasp departure above the grasp.
        place_approach_height_m: Height of the place approach above the place.
        place_clearance_m: Gap between workpiece and surface at which it is released.
        largest_carry_tilt_rad: Greatest angle between the carried workpiece's axis and the vertical.
        grasp_yaw_rad: Yaw of the gripper at the grasp.
        place_yaw_rad: Yaw of the gripper at the place.
        candidates: Specification of the grasp candidates; None for the grasp from above at the stated yaw.
        grasp: The grasp chosen for the workpiece; None before the choice.
        is_yaw_free: True if the yaw of the gripper at the waypoints may be chosen to suit the arm.
    """

    approach_height_m: float
    lift_height_m: float
    departure_height_m: float
    place_approach_height_m: float
    place_clearance_m: float
    largest_carry_tilt_rad: float
    grasp_yaw_rad: float
    place_yaw_rad: float
    candidates: GraspCandidates | None = None
    grasp: ChosenGrasp | None = None
    is_yaw_free: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """Environment of the gripper: robot, fixed bodies, objects and task.

    Attributes:
        id: Its name.
        gravity_m_s2: Magnitude of gravity, along the world's -z.
        robot: The arm.
        bodies: The fixed bodies.
        support: Id of the supporting body of the workpiece at the start.
        place_support: Id of its supporting body at the end.
        workpiece: The object to pick and place.
        place: Its place region.
        task: The waypoints.
        uncertainty: Uncertain quantities stated in the scene's file.
        others: The further objects.
        places: Places without an object.
        frames: The named frames of scene and robot, in the world or in an object.
    """

    id: str
    gravity_m_s2: float
    robot: Robot
    bodies: tuple[SceneBody, ...]
    support: str
    place_support: str
    workpiece: Workpiece
    place: PlaceRegion
    task: Task
    uncertainty: Uncertainty = NOTHING_UNCERTAIN
    others: tuple[SceneObject, ...] = ()
    places: tuple[NamedPlace, ...] = ()
    frames: tuple[NamedFrame, ...] = ()

    @property
    def objects(self) -> tuple[SceneObject, ...]:
        """All objects, the workpiece first."""
        own = SceneObject(
            workpiece=self.workpiece,
            support=self.support,
            place=self.place,
            place_support=self.place_support,
            grasp=self.task.grasp,
        )
        return (own, *self.others)

    @property
    def grasps(self) -> dict[str, ChosenGrasp]:
        """Chosen grasps by object."""
        return {one.workpiece.id: one.grasp for one in self.objects if one.grasp is not None}

    def with_grasps(self, grasps: Mapping[str, ChosenGrasp]) -> Scene:
        """Scene with chosen grasps of some objects; the others keep theirs."""
        own = grasps.get(self.workpiece.id)
        others = tuple(
            one if one.workpiece.id not in grasps else replace(one, grasp=grasps[one.workpiece.id])
            for one in self.others
        )
        return replace(self, task=self.task if own is None else replace(self.task, grasp=own), others=others)

    @property
    def grasp(self) -> Pose:
        """Transform of the grasp-centre frame to the world at the grasp, the chosen one or from above."""
        stands, taken = self.workpiece.pose, self.task.grasp
        if taken is not None:
            return stands @ taken.tool_in_object
        if stands.quaternion_xyzw == _UPRIGHT:
            return _tool_down(stands.position_m, self.task.grasp_yaw_rad)
        return stands @ _tool_down((0.0, 0.0, 0.0), self.task.grasp_yaw_rad)

    @property
    def place_pose(self) -> Pose:
        """Transform of the grasp-centre frame to the world at the place, the workpiece just above the surface."""
        x, y, z = self.place.centre_m
        taken = self.task.grasp
        if taken is not None:
            return self.placed_object.raised(self.task.place_clearance_m) @ taken.tool_in_object
        height = self.workpiece.shape.half_height_m + self.task.place_clearance_m
        return _tool_down((x, y, z + height), self.task.place_yaw_rad)

    @property
    def grasp_in_object(self) -> Pose | None:
        """Transform of the grasp-centre frame to the object; None for a cylinder gripped along its axis from above."""
        if self.task.grasp is not None:
            return self.task.grasp.tool_in_object
        if isinstance(self.workpiece.shape, Cylinder):
            return None
        return _tool_down((0.0, 0.0, 0.0), self.task.grasp_yaw_rad)

    @property
    def placed_object(self) -> Pose:
        """Transform of the object to the world at its place, with the yaw of the chosen grasp."""
        x, y, z = self.place.centre_m
        taken = self.task.grasp
        yaw = self.task.place_yaw_rad - self.task.grasp_yaw_rad if taken is None else taken.place_yaw_rad
        height = self.workpiece.shape.half_height_m
        return Pose.from_roll_pitch_yaw((x, y, z + height), (0.0, 0.0, yaw))


def _tool_down(position_m: tuple[float, float, float], yaw_rad: float) -> Pose:
    return Pose.from_roll_pitch_yaw(position_m, (math.pi, 0.0, yaw_rad))
