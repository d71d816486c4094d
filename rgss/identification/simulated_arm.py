"""Recording of a simulated arm: each joint in turn follows the excitation through its servo."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.identification.excitation import Signal, chosen_joints, signals
from rgss.identification.excitation_document import ExcitationDocument
from rgss.identification.motion_of_servos import steps_per_sample
from rgss.identification.recording import JointSeries, Recording, Segment
from rgss.kinematics import ArmDynamics, gripper_loads
from rgss.physics import PhysicsSettings, TorqueArm, VelocityLoop, mean_commands
from rgss.scenes import Gripper, JointKind, JointServo, Robot, ServoControl

Array = NDArray[np.float64]

NOMINAL_FREQUENCY_RAD_S = 40.0
"""Natural frequency of a joint without a calibration; its damping is critical, as in the dynamic fidelity."""


def nominal_servo() -> JointServo:
    """Servo of a joint without a calibration: the gains of the dynamic fidelity, no delay, no friction."""
    omega = NOMINAL_FREQUENCY_RAD_S
    return JointServo(velocity_gain_hz=2 * omega, position_gain_hz2=omega**2)


def simulated_recording(
    excitation: ExcitationDocument,
    robot: Robot,
    gripper: Gripper,
    *,
    gravity_m_s2: float,
    servos: Mapping[str, JointServo],
) -> Recording:
    """Run an excitation on the arm under joint torques.

    Inverse dynamics turns the acceleration that a servo wants into torques, which the joints' limits bound; the
    physics engine moves the arm. Joints that are not excited hold their position. The name of a signal under which a
    joint reached its torque limit ends with ``(torque limit)``: such a response is not that of the servo.

    Args:
        excitation: The signals and the poses; it keeps the robot's limits.
        robot: The arm.
        gripper: The gripper on its flange.
        gravity_m_s2: Magnitude of gravity.
        servos: Servos by joint; joints that are missing have the nominal one.

    Raises:
        DefinitionError: A servo is of an unknown joint.
        SimulationError: The engine cannot build the arm.
    """
    names = tuple(joint.name for joint in robot.joints)
    unknown = sorted(set(servos) - set(names))
    if unknown:
        raise DefinitionError(f"unknown joint {unknown[0]!r}", hint=f"the robot has {', '.join(names)}")
    noise = excitation.noise
    generator = np.random.default_rng(noise.seed)
    segments, begin_s = [], 0.0
    kinds = {joint.name: joint.kind for joint in robot.joints}
    slides = np.array([joint.kind is JointKind.PRISMATIC for joint in robot.joints])
    deviations = (
        np.where(slides, noise.slide_position, noise.position),
        np.where(slides, noise.slide_velocity, noise.velocity),
    )
    settings = PhysicsSettings(rate_hz=excitation.rate * steps_per_sample(1.0 / excitation.rate))
    with TorqueArm(robot, gripper, settings, gravity_m_s2=gravity_m_s2) as machine:
        arm = _ServoArm(machine, robot, gripper, excitation, gravity_m_s2)
        for pose, positions in excitation.poses.items():
            configuration = tuple(position.value for position in positions)
            for joint in chosen_joints(excitation, robot):
                for course in signals(excitation, kinds[joint]):
                    index = names.index(joint)
                    found = arm.run(np.array(configuration), index, course, servos.get(joint, nominal_servo()))
                    signal = f"{course.name} (torque limit)" if arm.saturated else course.name
                    q, v = (
                        values + deviation * generator.standard_normal(values.shape)
                        for values, deviation in zip(found, deviations, strict=True)
                    )
                    times_s = begin_s + np.arange(len(q)) / excitation.rate
                    begin_s = float(times_s[-1]) + 1.0 / excitation.rate
                    series = _series(names, configuration, index, course, q, v)
                    segments.append(Segment(pose=pose, joint=joint, signal=signal, times_s=times_s, series=series))
    return Recording(
        robot=robot.id,
        recorded=f"simulated, excitation {excitation.excitation}, seed {noise.seed}",
        control=excitation.control,
        joints=names,
        segments=tuple(segments),
        slides=frozenset(name for name, kind in kinds.items() if kind is JointKind.PRISMATIC),
    )


class _ServoArm:
    """The arm with one servo that follows a signal while the others hold.

    Attributes:
        saturated: A joint reached its torque limit in the last run.
    """

    def __init__(
        self, machine: TorqueArm, robot: Robot, gripper: Gripper, excitation: ExcitationDocument, gravity_m_s2: float
    ) -> None:
        self._machine = machine
        self._limits = np.array([joint.torque_n_m for joint in robot.joints])
        loads = gripper_loads(gripper, gripper.geometry.largest_opening_m)
        self._model = ArmDynamics(robot, loads, gravity_m_s2=gravity_m_s2)
        self._sampling_s = 1.0 / excitation.rate
        self._pieces = steps_per_sample(self._sampling_s)
        self._control = excitation.control
        self.saturated = False

    def run(self, home_rad: Array, index: int, course: Signal, servo: JointServo) -> tuple[Array, Array]:
        """Positions (rad) and speeds (rad/s) at each sample, each of shape (times, joints)."""
        count, step_s = len(course.velocities_rad_s), self._sampling_s / self._pieces
        under = servo
        if self._control is ServoControl.VELOCITY:
            under = JointServo(
                velocity_gain_hz=servo.velocity_gain_hz,
                viscous_hz=servo.viscous_hz,
                coulomb_rad_s2=servo.coulomb_rad_s2,
            )
        loop = VelocityLoop([under], step_s)
        times_s: Array = self._sampling_s * np.arange(count, dtype=np.float64)
        edges: Array = step_s * np.arange(count * self._pieces + 1, dtype=np.float64)
        speeds = mean_commands(times_s, course.velocities_rad_s, edges - servo.delay_s)
        targets = home_rad[index] + mean_commands(times_s, course.positions_rad, edges - servo.delay_s)
        positions, velocities = np.empty((count, len(home_rad))), np.empty((count, len(home_rad)))
        self._machine.reset(home_rad.tolist(), 0.0)
        omega = NOMINAL_FREQUENCY_RAD_S
        self.saturated = False
        for step in range(count * self._pieces):
            ahead, v = (np.array(values) for values in self._machine.state())
            # The engine adds the speed after a step for the whole step, so that its positions are half a step ahead.
            q = ahead - step_s / 2 * v
            sample, piece = divmod(step, self._pieces)
            if piece == 0:
                positions[sample], velocities[sample] = q, v
            wanted = omega**2 * (home_rad - q) - 2 * omega * v
            _, after = loop.after(
                q[index : index + 1], v[index : index + 1], targets[step : step + 1], speeds[step : step + 1]
            )
            wanted[index] = (after[0] - v[index]) / step_s
            torques = self._model.torques(ahead, v, wanted)
            self.saturated = self.saturated or bool(np.any(np.abs(torques) > self._limits))
            self._machine.step(np.clip(torques, -self._limits, self._limits).tolist())
        return positions, velocities


def _series(
    names: Sequence[str], home_rad: Sequence[float], excited: int, course: Signal, q: Array, v: Array
) -> dict[str, JointSeries]:
    still = np.zeros(len(q))
    return {
        name: JointSeries(
            commanded_rad=home_rad[index] + (course.positions_rad if index == excited else still),
            commanded_rad_s=course.velocities_rad_s if index == excited else still,
            measured_rad=q[:, index],
            measured_rad_s=v[:, index],
        )
        for index, name in enumerate(names)
    }
