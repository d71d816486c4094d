"""Monitor of a phase in contact physics."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

from rgss.evidence import Failure, Metric
from rgss.grasping import GraspGeometryCache
from rgss.physics import Contacts, ContactWorld
from rgss.scenes import Pose
from rgss.trials.monitors.arm_monitor import ArmMonitor, Array, ToolKinematics
from rgss.trials.monitors.force_sensor import ForceSensor
from rgss.trials.monitors.grasp_monitor import GraspMonitor
from rgss.trials.monitors.release_monitor import PlacedObjectMonitor, Violation
from rgss.trials.plants import ControlSettings, slip_detail

_FEWEST_FINGERS = 2
_TILT_ALLOWANCE_RAD = math.radians(2.0)


class PhaseMonitor:
    """Accumulator of the observations of one phase, with its first failure.

    Attributes:
        failure: The first failure; None so far.
        detail: Numbers of the failure.
        grip_margin: Last observed friction available over friction needed, or of a suction cup the factor by which
        its load could grow; None so far.
        robot_touched_object: Whether any link of the robot has been in contact with the object.
    """

    def __init__(
        self,
        world: ContactWorld,
        kinematics: ToolKinematics,
        control: ControlSettings,
        *,
        carried_at: Pose | None,
        resting_on: str,
        path_m: Sequence[Sequence[float]] | Array = (),
        memory: GraspGeometryCache | None = None,
        placed: PlacedObjectMonitor | None = None,
        sensor: ForceSensor | None = None,
    ) -> None:
        """Start the monitor.

        Args:
            world: The world.
            kinematics: Kinematics of the arm, with the tool at the grasp centre.
            control: Thresholds.
            carried_at: Transform of the object to the grasp-centre frame at the grasp; None if it is not carried.
            resting_on: The body that the object may touch in this phase; empty for none.
            path_m: Target positions of the tool in the world, at the start of a move and after each of its steps; empty
                if the arm is at rest.
            memory: Cache of the grasp analysis across phases.
            placed: Monitor of the released object, if the hand leaves it.
            sensor: The fingers' force sensors, shared across phases; new ones by default.
        """
        self.failure: Failure | None = None
        self.detail = ""
        self.grip_margin: float | None = None
        self.robot_touched_object = False
        self._world = world
        self._control = control
        self._resting_on, self._has_followers = resting_on, bool(world.scene.robot.followers)
        self._has_cup = world.gripper.geometry.cup is not None
        self._friction = world.gripper.grip_coefficient(world.scene.workpiece.friction)
        self._mass_kg = world.scene.workpiece.mass_kg
        # A planned path may use the whole tilt, and the hand gives a little.
        self._largest_tilt_rad = world.scene.task.largest_carry_tilt_rad + _TILT_ALLOWANCE_RAD
        self._step_s = world.settings.step_s
        self._window = max(1, round(control.force_window_s * world.settings.rate_hz))
        self._forces_n: deque[float] = deque(maxlen=self._window)
        self._as_it_may = ((), (resting_on,))
        workpiece = world.scene.workpiece
        self._limit_n = workpiece.force_limit_n
        self._sensor = sensor or ForceSensor(workpiece.force_window_s, world.settings.rate_hz)
        self._sensor.restart()
        self._lost_s = 0.0
        self._touches = 0
        self._peak_force_n = 0.0
        self._margin = math.inf
        # While the hand is empty and moves, the object is at rest.
        self._is_empty_handed = carried_at is None
        self._standing: Contacts | None = None
        self._arm = ArmMonitor(kinematics, world.scene.robot, control, world.settings, path_m=path_m)
        self._placed = placed
        self._grasp = (
            None if carried_at is None else GraspMonitor(world, control, carried_at, memory or GraspGeometryCache())
        )

    def after_step(self, load_m_s2: float, target_rad: Sequence[float] | None) -> Contacts:
        """Observe the world after a step.

        Args:
            load_m_s2: Tool acceleration minus gravity, in magnitude.
            target_rad: Target positions of the joints; None if the arm is at rest.
        """
        world = self._world
        contacts = world.contacts(self._standing)
        # A check that passed in the previous step need not be repeated.
        if contacts is not self._standing:
            self._check_contacts(contacts)
            is_standing = self._is_empty_handed and target_rad is not None and not contacts.is_robot_touching
            self._standing = contacts if is_standing else None
            if self._placed is not None:
                self.note(self._placed.after_step(contacts))
            if is_standing:
                self._sensor.clear()
        if self._has_followers and (slipped := world.slipped_follower):
            self.fail(Failure.TRACKING_ERROR, slip_detail(world.scene.robot, slipped))
        if target_rad is None:
            self._arm.note(world.arm_state())
        elif (stray := self._arm.follow(world.arm_state(), target_rad)) is not None:
            self.fail(Failure.TRACKING_ERROR, stray)
        if self._grasp is not None:
            self._check_grip(contacts.finger_forces_n, load_m_s2)
            slip_m = self._grasp.after_step()
            if slip_m is not None:
                self._check_hold(slip_m)
        return contacts

    def finish(self) -> None:
        """Final observation of a carried or released object at the end of the phase."""
        if self._placed is not None:
            self.note(self._placed.finish())
        if self._grasp is not None:
            self._check_hold(self._grasp.finish())

    def fail(self, failure: Failure, detail: str) -> None:
        """Record a failure, unless one is recorded."""
        if self.failure is None:
            self.failure, self.detail = failure, detail

    def note(self, violation: Violation | None) -> None:
        """Record a failure found by a monitor, if any."""
        if violation is not None:
            self.fail(*violation)

    def metrics(self) -> dict[str, Metric]:
        """Metrics by name with unit."""
        grasp = self._grasp
        return {
            "arm_scene_contacts": self._touches,
            "sensed_finger_force_n": self._sensor.peak_n,
            "peak_finger_force_n": self._peak_force_n,
            **self._arm.metrics(),
            "slip_m": grasp.slip_m if grasp is not None else None,
            "grip_margin_min": self._margin if math.isfinite(self._margin) else None,
            **(grasp.metrics() if grasp is not None else {}),
            **(self._placed.metrics() if self._placed is not None else {}),
        }

    def _check_contacts(self, contacts: Contacts) -> None:
        forces_n, other_n, _, robot_bodies, workpiece_bodies, pressing_links, _ = contacts
        force_n = max(forces_n)
        if force_n > self._peak_force_n:
            self._peak_force_n = force_n
        if force_n > 0.0 or other_n > 0.0:
            self.robot_touched_object = True
        sensor = self._sensor
        sensor.note(forces_n)
        # Mostly there is nothing to report.
        is_whole = sensor.peak_n <= self._limit_n
        if is_whole and not robot_bodies and other_n <= 0.0 and workpiece_bodies in self._as_it_may:
            return
        if robot_bodies:
            self._touches += 1
            link, body = robot_bodies[0]
            self.fail(Failure.ARM_COLLISION, f"{link} touched {body}")
        if other_n > 0.0:
            links = " and ".join(pressing_links)
            self.fail(Failure.OBJECT_COLLISION, f"{links} pressed the object with {other_n:.2f} N")
        for body in workpiece_bodies:
            if body != self._resting_on:
                self.fail(Failure.OBJECT_COLLISION, f"the object touched {body}")
        if not is_whole:
            window_ms = self._world.scene.workpiece.force_window_s * 1e3
            presses = "the cup" if self._has_cup else "a finger"
            force = f"{sensor.peak_n:.2f} N over {window_ms:g} ms, above its limit of {self._limit_n:g} N"
            self.fail(Failure.OBJECT_DAMAGED, f"{presses} pressed with {force}")

    def _check_grip(self, forces_n: tuple[float, ...], load_m_s2: float) -> None:
        margin = self._world.seal_margin if self._has_cup else self._friction_margin(forces_n, load_m_s2)
        if margin is not None:
            self.grip_margin = margin
            if margin < self._margin:
                self._margin = margin
        # The common case, in which all fingers press, is decided first.
        if min(forces_n) > 0.0:
            self._lost_s = 0.0
            return
        touching = sum(force > 0.0 for force in forces_n)
        if touching >= _FEWEST_FINGERS:
            self._lost_s = 0.0
            return
        self._lost_s += self._step_s
        if self._lost_s >= self._control.lost_contact_s:
            lost = f"{touching} fingers touched the object for {self._lost_s * 1e3:.0f} ms"
            self.fail(Failure.OBJECT_DROPPED, self._world.grip_fault or lost)

    def _friction_margin(self, forces_n: tuple[float, ...], load_m_s2: float) -> float | None:
        """Friction available over friction needed, averaged over a window; None until it is full."""
        window = self._forces_n
        window.append(math.fsum(forces_n))
        if len(window) < self._window:
            return None
        return self._friction * math.fsum(window) / self._window / (self._mass_kg * load_m_s2)

    def _check_hold(self, slip_m: float) -> None:
        """Displacement in the hand, and tilt: an object may turn about the line between the pads without one."""
        if slip_m > self._control.largest_slip_m:
            self.fail(Failure.OBJECT_DROPPED, f"the object slipped {slip_m * 1e3:.1f} mm in the gripper")
        tilt_rad = self._world.workpiece_pose().tilt_rad
        if tilt_rad > self._largest_tilt_rad:
            self.fail(
                Failure.OBJECT_DROPPED,
                f"the object tilted by {math.degrees(tilt_rad):.0f} deg in the gripper, more than the "
                f"{math.degrees(self._world.scene.task.largest_carry_tilt_rad):g} deg of the task",
            )
