"""Rig of the payload bench: a gripper on a vertical rail over an object on a post.

A rail replaces the arm, because the payload is a property of the gripper: the lift is exactly vertical with exactly the
specified acceleration for any mass, and a probe takes milliseconds. The hand is assembled and driven by the same code
as on the arm, so that masses, finger control and contacts are those of a trial.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from types import TracebackType

from rgss.physics import Contacts, open_world
from rgss.scenes import Pose, grasp_opening_m, motion_of
from rgss.trials.monitors import ForceSensor
from rgss.trials.payload_bench.rig_scene import rig_scene
from rgss.trials.payload_bench.spec import BenchSpec

_ONSET_S = 0.6
_WHOLE = 0.999


class PayloadLimit(str, Enum):
    """Cause that limits the payload of a gripper."""

    SLIP = "slip"
    SEAL = "seal"
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
        grip_margin_min: Least mu ΣN / (m (g + a)) during the lift, of a cup the least factor by which the load could
        have grown before its seal broke; None if there was no lift.
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

    Raises:
        SimulationError: The physics engine cannot build the rig.
    """
    half_s = spec.lift_s / 2
    with PayloadRig(spec, mass_kg) as rig:
        rig.grasp()
        if spec.suction is not None:
            rig.begin_to_accelerate(spec.acceleration_m_s2)
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
        grip_margin_min: Least mu ΣN / (m (g + a)) while the hand moves, of a cup the least margin of its seal; None
        before.
        height_m: Commanded height of the hand above the grasp.
        speed_m_s: Commanded upward speed of the hand.
    """

    def __init__(self, spec: BenchSpec, mass_kg: float) -> None:
        """Build the rig with the open hand around the object.

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
        self._world = open_world(rig_scene(spec, mass_kg), spec.gripper, spec.physics_for(mass_kg))
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
        """Close until every finger has pressed firmly for long enough, or the cup has held its whole vacuum so long."""
        spec, settings, gripper = self._spec, self._spec.settings, self._spec.gripper
        step_s = spec.physics.step_s
        if gripper.suction is None:
            firm_n = settings.firm_share * self._least_force_n()
            longest_s = gripper.geometry.stroke_m / gripper.finger_velocity_m_s + settings.grasp_timeout_s
        else:
            # A vacuum switch reports a firm grasp; a cup that cannot hold the weight has none.
            firm_n = max(_WHOLE * spec.total_force_n, self._mass_kg * spec.gravity_m_s2)
            longest_s = gripper.suction.build_up_s + settings.grasp_timeout_s
        self._world.drive_fingers(gripper.finger_velocity_m_s, gripper.finger_force_n)
        firm_s, steps = 0.0, 0
        while firm_s < settings.firm_grasp_s - 1e-9 and self.stopped_by is None:
            contacts = self._step(0.0)
            steps += 1
            firm_s = firm_s + step_s if min(contacts.finger_forces_n, default=0.0) > firm_n else 0.0
            if steps * step_s > longest_s:
                self._stop(PayloadLimit.NO_FIRM_GRASP)
        self._held_at = self._object_in_hand()

    def accelerate(self, acceleration_m_s2: float, duration_s: float) -> None:
        """Move the hand along the rail with a constant acceleration, upwards if positive.

        Args:
            acceleration_m_s2: The acceleration; zero keeps the speed.
            duration_s: Duration.
        """
        for _ in range(round(duration_s / self._spec.physics.step_s)):
            self._move(acceleration_m_s2)

    def begin_to_accelerate(self, acceleration_m_s2: float) -> None:
        """Raise the acceleration from zero to a value without a jump of it or of its rate, a quintic in time.

        A cup is bonded to the object rigidly. A jump of the acceleration while the post still bears the object would
        strain the bond by more than the load, as no compliant cup is strained.
        """
        steps = round(_ONSET_S / self._spec.physics.step_s)
        for number in range(steps):
            share = number / steps
            self._move(acceleration_m_s2 * share**3 * (10.0 - 15.0 * share + 6.0 * share**2))

    def _move(self, acceleration_m_s2: float) -> None:
        """Move the hand by one step and check the grip, unless it has failed."""
        if self.stopped_by is not None:
            return
        contacts = self._step(acceleration_m_s2)
        margin = self._margin(contacts, acceleration_m_s2)
        if margin is not None:
            self.grip_margin_min = min(margin, math.inf if self.grip_margin_min is None else self.grip_margin_min)
        if self._world.grip_fault:
            self._stop(PayloadLimit.SEAL)
        self.slip_m = math.dist(self._object_in_hand().position_m, self._held_at.position_m)
        if self.slip_m > self._spec.settings.largest_slip_m:
            self._stop(PayloadLimit.SLIP)

    def _margin(self, contacts: Contacts, acceleration_m_s2: float) -> float | None:
        """Load that the grip would bear, divided by that of the step; None if there is none or it is unknown."""
        if self._spec.suction is not None:
            return self._world.seal_margin
        needed_n = self._mass_kg * (self._spec.gravity_m_s2 + acceleration_m_s2)
        return self._spec.friction * contacts.finger_force_sum_n / needed_n if needed_n > 0.0 else None

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
