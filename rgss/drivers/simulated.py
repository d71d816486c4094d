"""Simulated robot as a driver: the arm under joint torques, with the tracking errors of its controller."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rgss.drivers.driver import Estimate, GripperState, SetPoint
from rgss.errors import DriverError
from rgss.kinematics import ArmDynamics, gripper_loads, workpiece_load
from rgss.physics import PhysicsSettings, TorqueArm
from rgss.scenes import Gripper, Scene, grasp_opening_m, object_in_hand, unpowered_shortfall


@dataclass(frozen=True, slots=True, kw_only=True)
class ServoGains:
    """Gains of the simulated joint controller (computed torque), the same for every joint.

    The commanded acceleration is q̈_target + 2 ζ ω ė + ω² e, with e the deviation to be removed.

    Attributes:
        natural_frequency_rad_s: ω.
        damping_ratio: ζ.
    """

    natural_frequency_rad_s: float = 40.0
    damping_ratio: float = 1.0


class SimulatedDriver:
    """A simulated arm with its own clock; the object is fixed to the flange while the gripper is closed.

    It is a `StreamClock` too: a wait advances the simulation, so that a stream is the same on every machine.
    """

    name = "simulated"

    def __init__(
        self,
        scene: Scene,
        gripper: Gripper,
        settings: PhysicsSettings,
        *,
        start_rad: tuple[float, ...],
        grips: Sequence[Scene] = (),
        gains: ServoGains | None = None,
    ) -> None:
        """Store the robot; the world is built by `connect`.

        Args:
            scene: The robot, gravity and the object.
            gripper: The hand.
            settings: Step length and solver.
            start_rad: Start configuration of the arm.
            grips: For each closing of the gripper in order, the scene with what it takes as its workpiece; by default
                the workpiece of the scene each time.
            gains: Gains of the controller.
        """
        self._scene, self._gripper, self._settings = scene, gripper, settings
        self._start_rad = start_rad
        self._grips = tuple(grips) or (scene,)
        self._closings = 0
        self._held: Scene | None = None
        self._gains = gains or ServoGains()
        self._machine: TorqueArm | None = None
        self._steps = 0
        still = (0.0,) * len(start_rad)
        self._point = SetPoint(positions_rad=start_rad, velocities_rad_s=still, gripper=GripperState.OPEN)
        self._speed = np.zeros(len(start_rad))
        self._limits = np.array([joint.torque_n_m for joint in scene.robot.joints])

    @property
    def rate_hz(self) -> float:
        """One set point for each physics step."""
        return float(self._settings.rate_hz)

    def connect(self) -> None:
        """Build the world with the arm at rest at its start.

        Raises:
            SimulationError: The engine cannot build it.
        """
        scene, gripper = self._scene, self._gripper
        self._machine = TorqueArm(scene.robot, gripper, self._settings, gravity_m_s2=scene.gravity_m_s2)
        self._machine.reset(self._start_rad, 0.0)
        opening_m = gripper.geometry.largest_opening_m
        self._empty = ArmDynamics(scene.robot, gripper_loads(gripper, opening_m), gravity_m_s2=scene.gravity_m_s2)
        self._loaded, self._held = self._empty, None
        self._closings = 0

    def read(self) -> Estimate:
        """The joints' positions and velocities; the stamp is the number of steps."""
        positions, velocities = self._running().state()
        return Estimate(
            positions_rad=positions,
            velocities_rad_s=velocities,
            gripper=self._point.gripper,
            stamp=float(self._steps),
        )

    def send(self, point: SetPoint) -> None:
        """Take the set point for the next step, and fix or release the object where the gripper changes."""
        machine, was = self._running(), self._point.gripper
        if point.gripper is not was:
            if point.gripper is GripperState.CLOSED:
                view = self._grips[min(self._closings, len(self._grips) - 1)]
                self._closings += 1
                self._take(machine, view)
            elif point.gripper is GripperState.OPEN:
                self._drop(machine)
                machine.hold_fingers(0.0)
            elif self._held is not None and unpowered_shortfall(self._gripper, self._held):
                self._drop(machine)
        self._point = point

    def _take(self, machine: TorqueArm, view: Scene) -> None:
        """Fix the workpiece of a scene to the hand."""
        geometry = self._gripper.geometry
        opening_m, held = grasp_opening_m(view, geometry), object_in_hand(view, geometry)
        machine.hold_fingers(min(geometry.stroke_m, geometry.largest_opening_m - opening_m))
        machine.attach(view.workpiece, held)
        centre = geometry.grasp_centre if held is None else geometry.grasp_centre @ held
        loads = (*gripper_loads(self._gripper, opening_m), workpiece_load(view.workpiece, centre))
        self._loaded, self._held = ArmDynamics(view.robot, loads, gravity_m_s2=view.gravity_m_s2), view

    def _drop(self, machine: TorqueArm) -> None:
        """Release the workpiece, if one is held."""
        if self._held is not None:
            machine.detach()
            self._held = None

    def stop(self) -> None:
        """Hold the joints where they are."""
        positions, velocities = self._running().state()
        still = (0.0,) * len(velocities)
        self._point = SetPoint(positions_rad=positions, velocities_rad_s=still, gripper=self._point.gripper)

    def disconnect(self) -> None:
        """Close the world."""
        if self._machine is not None:
            self._machine.close()
            self._machine = None

    def now_s(self) -> float:
        """Simulated time."""
        return self._steps * self._settings.step_s

    def wait_until(self, time_s: float) -> None:
        """Advance the simulation to a time."""
        while self.now_s() < time_s - 0.5 * self._settings.step_s:
            self._step()

    def _step(self) -> None:
        machine, gains, point = self._running(), self._gains, self._point
        target, speed = np.array(point.positions_rad), np.array(point.velocities_rad_s)
        q, dq = (np.array(values) for values in machine.state())
        omega, zeta = gains.natural_frequency_rad_s, gains.damping_ratio
        acceleration = (speed - self._speed) / self._settings.step_s
        wanted = acceleration + 2 * zeta * omega * (speed - dq) + omega**2 * (target - speed / self.rate_hz - q)
        # The target is to be reached at the end of the step; the deviation is that at its beginning.
        self._speed = speed
        model = self._empty if self._held is None else self._loaded
        torques = np.clip(model.torques(q, dq, wanted), -self._limits, self._limits)
        machine.step(torques.tolist())
        self._steps += 1

    def _running(self) -> TorqueArm:
        if self._machine is None:
            raise DriverError("the simulated robot is not connected", hint="call connect first")
        return self._machine
