"""The machine of the task program on the second engine, judged by what the second engine shows."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

import numpy as np

from rgss.evidence import Failure, Phase
from rgss.scenes import Gripper, Scene
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plants.control import ControlSettings
from rgss.trials.reference import Reference

from .machine import add_arm, add_cup, add_hand, add_scene, empty_model, finger_names, machine_shapes
from .stepping import SteppedModel, Touching

_CARRYING = (Phase.LIFT, Phase.MOVE_TO_GRASP_DEPARTURE, Phase.MOVE_TO_PLACE_APPROACH, Phase.MOVE_TO_PLACE)
_OPEN_M = 5.0e-4


class MujocoPlant:
    """Arm, hand, cup and scene of a trial, as the task program needs them.

    The hand is controlled by the thresholds of the trials; contacts, forces and poses are the
    second engine's.

    Attributes:
        tightenings: How often the fingers were commanded to close further.
        slip_m: Greatest displacement of the cup in the hand while it was carried.
        tracking_error_m: Greatest distance of the tool from where it should be.
        place_error_m: Distance of the cup from the place, as last judged.
    """

    def __init__(self, scene: Scene, gripper: Gripper, control: ControlSettings, *, step_s: float) -> None:
        """Build the model.

        Args:
            scene: The scene with its robot and the cup.
            gripper: The gripper on the robot's flange.
            control: Thresholds.
            step_s: Length of a step, at which the references are sampled too.
        """
        cup, fingers = scene.workpiece, finger_names(gripper)
        root = empty_model(scene.gravity_m_s2, step_s=step_s)
        add_scene(root, scene)
        add_hand(root, add_arm(root, scene), gripper)
        frictions = {body.id: body.friction * cup.friction for body in scene.bodies}
        # What else of the machine touches the cup ends the trial, so that its friction does not matter.
        frictions |= dict.fromkeys(machine_shapes(root), 0.0)
        frictions |= dict.fromkeys(fingers, gripper.friction * cup.friction)
        add_cup(root, cup.shape, cup.mass_kg, cup.pose, frictions)
        self.tightenings = 0
        self.slip_m = self.tracking_error_m = 0.0
        self.place_error_m: float | None = None
        self._grip_n = control.holding_share * gripper.finger_force_n
        self._engine = SteppedModel(root, driven=[joint.name for joint in scene.robot.joints], fingers=fingers)
        self._scene, self._gripper, self._control = scene, gripper, control
        self._friction = frictions[fingers[0]]
        self._position = np.zeros(len(scene.robot.joints))
        self._held_m = np.zeros(3)
        self._failure: Failure | None = None
        self._detail = ""

    @property
    def torque_ratio(self) -> float:
        """Greatest share of its rated torque that was asked of a joint."""
        return self._engine.torque_ratio

    def start(self, configuration_rad: Sequence[float]) -> None:
        """Stand at rest at a configuration, the hand open."""
        self._position = np.array(configuration_rad)
        self._engine.reset(configuration_rad)
        self._engine.drive_fingers(-self._gripper.finger_velocity_m_s, self._gripper.finger_force_n)

    def move(self, phase: Phase, reference: Reference) -> PhaseResult:
        """Follow a timed motion, with what is held."""
        engine, control = self._engine, self._control
        resting_on = self._resting_on(phase)
        window: deque[float] = deque(maxlen=round(control.force_window_s / engine.step_s))
        lost_s = waited_s = 0.0
        steps = 0
        while steps < reference.steps and self._failure is None:
            engine.step(reference.positions_rad[steps], reference.velocities_rad_s[steps])
            forces = self._touching(resting_on).finger_forces_n
            self._watch_tracking(reference.tool_m[steps + 1])
            if phase in _CARRYING:
                lost_s = 0.0 if sum(force > 0.0 for force in forces) >= 2 else lost_s + engine.step_s
                self._watch_hold(lost_s)
                window.append(sum(forces))
                waited_s += engine.step_s
                available_n = self._friction * sum(window) / len(window)
                needed_n = self._scene.workpiece.mass_kg * float(reference.load_m_s2[steps])
                if available_n < control.tighten_below * needed_n and waited_s >= control.force_window_s:
                    waited_s = 0.0
                    self._tighten()
            steps += 1
        self._position = reference.positions_rad[-1]
        if phase is Phase.MOVE_TO_GRASP:
            moved = math.dist(engine.cup_m, self._scene.workpiece.pose.position_m)
            if moved > control.displaced_m:
                self._fail(Failure.OBJECT_COLLISION, f"the cup was pushed {moved * 1e3:.1f} mm")
        if phase is Phase.MOVE_TO_GRASP_APPROACH:
            self._judge_place()
        return self._result(phase, steps)

    def grasp(self) -> PhaseResult:
        """Close the hand until every finger presses firmly."""
        engine, gripper, control, scene = self._engine, self._gripper, self._control, self._scene
        weight_n = scene.workpiece.mass_kg * scene.gravity_m_s2
        needed_n = weight_n / (self._friction * gripper.geometry.fingers)
        engine.drive_fingers(gripper.finger_velocity_m_s, self._grip_n)
        firm_s = touching_s = 0.0
        steps = 0
        while firm_s < control.firm_grasp_s and self._failure is None:
            least_n = min(self._stand(scene.support).finger_forces_n)
            steps += 1
            firm_s = firm_s + engine.step_s if least_n > needed_n else 0.0
            touching_s = touching_s + engine.step_s if least_n > 0.0 else 0.0
            if firm_s == 0.0 and touching_s > control.firm_grasp_s:
                touching_s = 0.0
                self._tighten()
            if steps * engine.step_s > self._travel_s + control.grasp_timeout_s:
                self._fail(Failure.NO_FIRM_GRASP, f"a finger presses with {least_n:.2f} N of {needed_n:.2f} N")
        self._held_m = engine.cup_in_hand_m
        return self._result(Phase.GRASP, steps)

    def place(self) -> PhaseResult:
        """Open the hand and wait until the cup stands."""
        engine, gripper, control, scene = self._engine, self._gripper, self._control, self._scene
        engine.drive_fingers(-gripper.finger_velocity_m_s, gripper.finger_force_n)
        steps = 0
        while max(engine.finger_travel_m) > _OPEN_M and self._failure is None:
            self._stand(scene.place_support)
            steps += 1
            if steps * engine.step_s > self._travel_s + control.grasp_timeout_s:
                self._fail(Failure.NOT_RELEASED, "the hand is not open")
        still_s = waited_s = 0.0
        forces: tuple[float, ...] = ()
        while still_s < control.settled_s and waited_s < control.settling_timeout_s and self._failure is None:
            forces = self._stand(scene.place_support).finger_forces_n
            steps += 1
            waited_s += engine.step_s
            linear, angular = engine.cup_speed
            edge = angular * scene.workpiece.shape.half_height_m
            still_s = still_s + engine.step_s if linear + edge < control.settled_speed_m_s else 0.0
        if any(force > 0.0 for force in forces):
            self._fail(Failure.NOT_RELEASED, "a finger still touches the cup")
        self._judge_place()
        return self._result(Phase.PLACE, steps)

    @property
    def _travel_s(self) -> float:
        return self._gripper.geometry.stroke_m / self._gripper.finger_velocity_m_s

    def _resting_on(self, phase: Phase) -> str:
        if phase in (Phase.MOVE_TO_GRASP, Phase.LIFT):
            return self._scene.support
        return self._scene.place_support if phase is Phase.MOVE_TO_GRASP_APPROACH else ""

    def _stand(self, resting_on: str) -> Touching:
        self._engine.step(self._position, np.zeros(len(self._position)))
        return self._touching(resting_on)

    def _tighten(self) -> None:
        most_n = self._gripper.finger_force_n
        if self._grip_n < most_n:
            self.tightenings += 1
            self._grip_n = min(most_n, self._grip_n + self._control.tightening_share * most_n)
            self._engine.drive_fingers(self._gripper.finger_velocity_m_s, self._grip_n)

    def _touching(self, resting_on: str) -> Touching:
        touching = self._engine.touching()
        if touching.machine:
            self._fail(Failure.ARM_COLLISION, " touched ".join(touching.machine[0]))
        for name in touching.cup:
            if name != resting_on:
                self._fail(Failure.OBJECT_COLLISION, f"the cup touched {name}")
        greatest_n = max(touching.finger_forces_n)
        if greatest_n > self._scene.workpiece.force_limit_n:
            self._fail(Failure.OBJECT_DAMAGED, f"a finger pressed with {greatest_n:.1f} N")
        return touching

    def _watch_tracking(self, commanded_m: np.ndarray) -> None:
        error = float(np.linalg.norm(self._engine.tool_m - commanded_m))
        self.tracking_error_m = max(self.tracking_error_m, error)
        if error > self._control.largest_tracking_error_m:
            self._fail(Failure.TRACKING_ERROR, f"the tool was {error * 1e3:.2f} mm from where it should be")

    def _watch_hold(self, lost_s: float) -> None:
        slip = float(np.linalg.norm(self._engine.cup_in_hand_m - self._held_m))
        self.slip_m = max(self.slip_m, slip)
        if lost_s >= self._control.lost_contact_s or slip > self._control.largest_slip_m:
            self._fail(Failure.OBJECT_DROPPED, f"the cup slipped {slip * 1e3:.1f} mm in the hand")

    def _judge_place(self) -> None:
        place = self._scene.place
        cup = self._engine.cup_m
        standing_m = place.centre_m[2] + self._scene.workpiece.shape.half_height_m
        error = self.place_error_m = math.dist(cup[:2], place.centre_m[:2])
        tilt = math.acos(min(1.0, float(self._engine.cup_axis[2])))
        if tilt > place.largest_tilt_rad:
            self._fail(Failure.NOT_UPRIGHT, f"the cup leans by {math.degrees(tilt):.1f} deg")
        if max(error, abs(cup[2] - standing_m)) > place.radius_m:
            self._fail(Failure.NOT_IN_PLACE_REGION, f"the cup is {error * 1e3:.1f} mm from the place")

    def _fail(self, failure: Failure, detail: str) -> None:
        if self._failure is None:
            self._failure, self._detail = failure, detail

    def _result(self, phase: Phase, steps: int) -> PhaseResult:
        return PhaseResult(
            phase=phase,
            failure=self._failure,
            detail=self._detail,
            duration_s=steps * self._engine.step_s,
            metrics={},
        )
