"""Rig of the payload bench: a gripper on a vertical rail over an object on a post.

A rail replaces the arm, because the payload is a property of the gripper: the lift is exactly vertical with exactly the
specified acceleration for any mass, and a probe takes milliseconds. The hand is assembled and driven by the same code
as on the arm, so that masses, finger control and contacts are those of a trial.
"""

# long file: one class builds, drives and monitors the rig.

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from enum import Enum
from types import TracebackType

from rgss.physics import Contacts, open_world
from rgss.scenes import (
    ChosenGrasp,
    Cylinder,
    Joint,
    PlaceRegion,
    Pose,
    Robot,
    Scene,
    SceneBody,
    Task,
    Workpiece,
    grasp_opening_m,
    half_extents_m,
    motion_of,
)
from rgss.trials.monitors import ForceSensor
from rgss.trials.payload_bench.spec import BenchSpec

_CARRIAGE = "carriage"
_RAIL_JOINT = "rail_joint"
_CARRIAGE_MASS_KG = 10.0
_CARRIAGE_INERTIA_KG_M2 = 0.1
_RAIL_FORCE_N = 1.0e6
_RAIL_LENGTH_M = 1.0e3
_POST_HEIGHT_M = 0.2
_POST_SHARE = 0.5
_POST = "post"
_BLACK = (0.0, 0.0, 0.0, 1.0)


class PayloadLimit(str, Enum):
    """Cause that limits the payload of a gripper."""

    SLIP = "slip"
    DAMAGE = "damage"
    NO_FIRM_GRASP = "no_firm_grasp"
    RATED = "rated"


@dataclass(frozen=True, slots=True, kw_only=True)
class Probe:
    """Result of grasping and lifting one mass.

    Attributes:
        mass_kg: The object's mass.
        stopped_by: Cause of the failure; None if it was held to the end.
        slip_m: Displacement of the object in the hand since the firm grasp.
        creep_m_s: Mean speed of that displacement over the second half of the lift; None if it ended before.
        peak_force_n: Greatest normal force of a finger on the object, averaged over the object's force window.
        grip_margin_min: Least mu ΣN / (m (g + a)) during the lift; None if there was none.
    """

    mass_kg: float
    stopped_by: PayloadLimit | None
    slip_m: float
    creep_m_s: float | None
    peak_force_n: float
    grip_margin_min: float | None

    @property
    def held(self) -> bool:
        """True if the object was carried to the end, undamaged."""
        return self.stopped_by is None


def probe(spec: BenchSpec, mass_kg: float) -> Probe:
    """Grasp an object and lift it at the bench's acceleration.

    Args:
        spec: The bench.
        mass_kg: The object's mass.

    Raises:
        SimulationError: The physics engine cannot build the rig.
    """
    half_s = spec.lift_s / 2
    with PayloadRig(spec, mass_kg) as rig:
        rig.grasp()
        rig.accelerate(spec.acceleration_m_s2, half_s)
        halfway_m = rig.slip_m
        rig.accelerate(spec.acceleration_m_s2, half_s)
        return Probe(
            mass_kg=mass_kg,
            stopped_by=rig.stopped_by,
            slip_m=rig.slip_m,
            creep_m_s=(rig.slip_m - halfway_m) / half_s if rig.stopped_by is None else None,
            peak_force_n=rig.peak_force_n,
            grip_margin_min=rig.grip_margin_min,
        )


class PayloadRig:
    """Rig with one object; a context manager that always closes its world.

    Attributes:
        stopped_by: Cause of the failure, after which the rig no longer moves; None so far.
        slip_m: Displacement of the object in the hand since the firm grasp.
        peak_force_n: Greatest normal force of a finger on the object so far, averaged over its force window.
        grip_margin_min: Least mu ΣN / (m (g + a)) while the hand moves; None before.
        height_m: Commanded height of the hand above the grasp.
        speed_m_s: Commanded upward speed of the hand.
    """

    def __init__(self, spec: BenchSpec, mass_kg: float) -> None:
        """Build the rig with the open hand around the object.

        Args:
            spec: The bench.
            mass_kg: The object's mass.

        Raises:
            SimulationError: The physics engine cannot build it.
        """
        self.stopped_by: PayloadLimit | None = None
        self.slip_m = 0.0
        self.peak_force_n = 0.0
        self.grip_margin_min: float | None = None
        self.height_m = 0.0
        self.speed_m_s = 0.0
        self._sensor = ForceSensor(spec.force_window_s, spec.physics.rate_hz)
        self._spec = spec
        self._mass_kg = mass_kg
        self._held_at = Pose()
        self._world = open_world(_rig_scene(spec, mass_kg), spec.gripper, spec.physics_for(mass_kg))
        self._world.reset_arm((0.0,))

    def __enter__(self) -> PayloadRig:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._world.close()

    def contacts(self) -> Contacts:
        """Contacts after the last step."""
        return self._world.contacts()

    def hand_pose(self) -> Pose:
        """Transform of the grasp-centre frame to the world, at the hand's true pose."""
        return self._world.tool_pose()

    def grasp(self) -> None:
        """Close until every finger has pressed firmly for long enough."""
        spec, settings, gripper = self._spec, self._spec.settings, self._spec.gripper
        step_s = spec.physics.step_s
        firm_n = settings.firm_share * self._least_force_n()
        longest_s = gripper.geometry.stroke_m / gripper.finger_velocity_m_s + settings.grasp_timeout_s
        self._world.drive_fingers(gripper.finger_velocity_m_s, gripper.finger_force_n)
        firm_s, steps = 0.0, 0
        while firm_s < settings.firm_grasp_s - 1e-9 and self.stopped_by is None:
            contacts = self._step(0.0)
            steps += 1
            firm_s = firm_s + step_s if min(contacts.finger_forces_n) > firm_n else 0.0
            if steps * step_s > longest_s:
                self._stop(PayloadLimit.NO_FIRM_GRASP)
        self._held_at = self._object_in_hand()

    def accelerate(self, acceleration_m_s2: float, duration_s: float) -> None:
        """Move the hand along the rail with a constant acceleration, upwards if positive.

        Args:
            acceleration_m_s2: The acceleration; zero keeps the speed.
            duration_s: Duration.
        """
        step_s = self._spec.physics.step_s
        needed_n = self._mass_kg * (self._spec.gravity_m_s2 + acceleration_m_s2)
        for _ in range(round(duration_s / step_s)):
            if self.stopped_by is not None:
                return
            contacts = self._step(acceleration_m_s2)
            if needed_n > 0.0:
                margin = self._spec.friction * contacts.finger_force_sum_n / needed_n
                self.grip_margin_min = min(margin, self.grip_margin_min or math.inf)
            self.slip_m = math.dist(self._object_in_hand().position_m, self._held_at.position_m)
            if self.slip_m > self._spec.settings.largest_slip_m:
                self._stop(PayloadLimit.SLIP)

    def _least_force_n(self) -> float:
        """Force of a finger on an object whose friction opposes the travel of its pad along the tool axis.

        A pad of a linkage that moves by s along the axis per travel inwards presses with F / (1 + mu s) while it slides
        on the object, by virtual work: F is the force without friction.
        """
        spec, geometry = self._spec, self._spec.gripper.geometry
        if geometry.linkage is None:
            return spec.gripper.finger_force_n
        motion = motion_of(geometry.linkage)
        opening_m = grasp_opening_m(self._world.scene, geometry)
        slope = motion.axial_slope(motion.driven_at(motion.largest_opening_m - opening_m))
        return spec.gripper.finger_force_n / (1.0 + spec.friction * abs(slope))

    def _step(self, acceleration_m_s2: float) -> Contacts:
        step_s = self._spec.physics.step_s
        mean_speed = self.speed_m_s + acceleration_m_s2 * step_s / 2
        self._world.command_arm((self.height_m,), (mean_speed,))
        self._world.step()
        self.height_m += mean_speed * step_s
        self.speed_m_s += acceleration_m_s2 * step_s
        contacts = self._world.contacts()
        self._sensor.note(contacts.finger_forces_n)
        self.peak_force_n = self._sensor.peak_n
        if self.peak_force_n > self._spec.force_limit_n:
            self._stop(PayloadLimit.DAMAGE)
        return contacts

    def _stop(self, limit: PayloadLimit) -> None:
        if self.stopped_by is None:
            self.stopped_by = limit

    def _object_in_hand(self) -> Pose:
        return self._world.tool_pose().inverse() @ self._world.workpiece_pose()


def _rig_scene(spec: BenchSpec, mass_kg: float) -> Scene:
    """Scene with the object on top of a post, the origin at its foot below the grasp centre, and the rail above."""
    half_m = spec.shape.half_height_m
    radius_m = min(half_extents_m(spec.shape)[:2])
    stands, tool_m, taken = Pose(position_m=(0.0, 0.0, half_m)), half_m, None
    if spec.grasp is not None:
        tool_m += spec.grasp.position_m[2]
        tool = Pose.from_roll_pitch_yaw((0.0, 0.0, tool_m), (math.pi, 0.0, 0.0))
        stands = tool @ spec.grasp.inverse()
        taken = ChosenGrasp(
            id="bench",
            tool_in_object=spec.grasp,
            opening_m=spec.gripper.geometry.largest_opening_m,
            place_yaw_rad=0.0,
            quality_1=0.0,
            com_distance_m=0.0,
            candidates=1,
            rejected=0,
        )
    workpiece = Workpiece(
        id="object",
        shape=spec.shape,
        mass_kg=mass_kg,
        friction=spec.object_friction,
        force_limit_n=spec.force_limit_n,
        force_window_s=spec.force_window_s,
        gyration_m2=spec.gyration_m2,
        pose=stands,
        colour=_BLACK,
    )
    return Scene(
        id="payload-bench",
        gravity_m_s2=spec.gravity_m_s2,
        robot=_rail(tool_m + spec.gripper.geometry.grasp_depth_m),
        bodies=(_post(stands, radius_m),),
        support=_POST,
        place_support=_POST,
        workpiece=workpiece,
        # A scene has a task; nothing is placed on the bench.
        place=PlaceRegion(centre_m=(0.0, 0.0, 0.0), radius_m=radius_m, largest_tilt_rad=math.pi),
        task=Task(
            approach_height_m=0.0,
            lift_height_m=0.0,
            departure_height_m=0.0,
            place_approach_height_m=0.0,
            place_clearance_m=0.0,
            largest_carry_tilt_rad=math.pi,
            grasp_yaw_rad=0.0,
            place_yaw_rad=0.0,
            grasp=taken,
        ),
    )


def _post(stands: Pose, radius_m: float) -> SceneBody:
    """Post under the middle of the object, which three fingers hold beside their axis if it is a box.

    It is thinner than the object, so that low fingers pass it, and without friction: on a rough post the object can jam
    between post and hand, and geared fingers then press unevenly.
    """
    x, y, _ = stands.position_m
    return SceneBody(
        id=_POST,
        shape=Cylinder(radius_m=_POST_SHARE * radius_m, height_m=_POST_HEIGHT_M),
        pose=Pose(position_m=(x, y, -_POST_HEIGHT_M / 2)),
        friction=0.0,
        colour=_BLACK,
    )


def _rail(flange_height_m: float) -> Robot:
    """Robot with one vertical prismatic joint at the flange, whose z points down; up is positive.

    The limits are in m and N despite their names, and so large that they are never active.
    """
    root = ET.Element("robot", {"name": "rail"})
    ET.SubElement(root, "link", {"name": "rail"})
    carriage = ET.SubElement(root, "link", {"name": _CARRIAGE})
    inertial = ET.SubElement(carriage, "inertial")
    ET.SubElement(inertial, "mass", {"value": repr(_CARRIAGE_MASS_KG)})
    along, across = repr(_CARRIAGE_INERTIA_KG_M2), "0"
    ET.SubElement(
        inertial, "inertia", {"ixx": along, "iyy": along, "izz": along, "ixy": across, "ixz": across, "iyz": across}
    )
    joint = ET.SubElement(root, "joint", {"name": _RAIL_JOINT, "type": "prismatic"})
    ET.SubElement(joint, "origin", {"xyz": "0 0 0", "rpy": f"{math.pi!r} 0 0"})
    ET.SubElement(joint, "parent", {"link": "rail"})
    ET.SubElement(joint, "child", {"link": _CARRIAGE})
    ET.SubElement(joint, "axis", {"xyz": "0 0 -1"})
    limits = {
        "lower": repr(-_RAIL_LENGTH_M),
        "upper": repr(_RAIL_LENGTH_M),
        "velocity": repr(_RAIL_LENGTH_M),
        "effort": repr(_RAIL_FORCE_N),
    }
    ET.SubElement(joint, "limit", limits)
    return Robot(
        id="rail",
        urdf=ET.tostring(root, encoding="unicode"),
        flange=_CARRIAGE,
        joints=(
            Joint(
                name=_RAIL_JOINT,
                lower_rad=-_RAIL_LENGTH_M,
                upper_rad=_RAIL_LENGTH_M,
                speed_rad_s=_RAIL_LENGTH_M,
                acceleration_rad_s2=_RAIL_LENGTH_M,
                torque_n_m=_RAIL_FORCE_N,
            ),
        ),
        base=Pose(position_m=(0.0, 0.0, flange_height_m)),
        payload_kg=_RAIL_LENGTH_M,
        tool_acceleration_m_s2=_RAIL_LENGTH_M,
        home_rad=(0.0,),
    )
