"""Inverse dynamics of the arm with loads on its flange."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics.coupling import Coupling
from rgss.kinematics.description import build_model, link_frame, transform
from rgss.scenes import (
    Cylinder,
    Gripper,
    Linkage,
    Pose,
    Robot,
    Workpiece,
    linkage_masses_kg,
    motion_of,
    principal_frame,
    quaternion_of,
    solid_moments,
)

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Load:
    """Rigid body attached to the flange.

    Attributes:
        mass_kg: Its mass.
        moments_kg_m2: Its principal moments of inertia about its own centre.
        pose: Transform of its principal frame at the centre of mass to the flange.
    """

    mass_kg: float
    moments_kg_m2: tuple[float, float, float]
    pose: Pose


def gripper_loads(gripper: Gripper, opening_m: float) -> tuple[Load, ...]:
    """The gripper's base and fingers as loads of the flange.

    Args:
        gripper: The gripper.
        opening_m: Distance of its pads from its axis.
    """
    geometry = gripper.geometry
    if geometry.linkage is not None:
        return _linkage_loads(gripper, geometry.linkage, opening_m)
    base = Load(
        mass_kg=gripper.base_mass_kg - gripper.cup_mass_kg,
        moments_kg_m2=solid_moments(geometry.base, gripper.base_mass_kg - gripper.cup_mass_kg),
        pose=geometry.base_pose,
    )
    fingers = (
        Load(
            mass_kg=gripper.finger_mass_kg,
            moments_kg_m2=solid_moments(geometry.finger, gripper.finger_mass_kg),
            pose=geometry.finger_pose(finger, opening_m),
        )
        for finger in range(geometry.fingers)
    )
    if geometry.cup is None:
        return (base, *fingers)
    cup = Load(
        mass_kg=gripper.cup_mass_kg,
        moments_kg_m2=solid_moments(geometry.cup, gripper.cup_mass_kg),
        pose=geometry.cup_pose,
    )
    return (base, cup)


def _linkage_loads(gripper: Gripper, linkage: Linkage, opening_m: float) -> tuple[Load, ...]:
    """Links of a gripper as loads of the flange, with the inertias of the URDF."""
    motion = motion_of(linkage)
    poses = linkage.link_poses(motion.driven_at(motion.largest_opening_m - opening_m))
    loads = []
    for link, pose, mass_kg in zip(linkage.links, poses, linkage_masses_kg(gripper, linkage), strict=True):
        if mass_kg == 0.0:
            continue
        xx, yy, zz, xy, xz, yz = (moment * mass_kg / link.mass_kg for moment in link.inertia_kg_m2)
        (a, b, c), axes = np.linalg.eigh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        axes[:, 2] *= np.sign(np.linalg.det(axes))
        turned = Pose(quaternion_xyzw=quaternion_of(axes))
        moments = (float(a), float(b), float(c))
        loads.append(Load(mass_kg=mass_kg, moments_kg_m2=moments, pose=pose @ link.inertial @ turned))
    return tuple(loads)


def workpiece_load(workpiece: Workpiece, pose: Pose) -> Load:
    """A held workpiece as a load of the flange.

    Args:
        workpiece: The held workpiece.
        pose: Transform of its shape's frame to the flange.
    """
    if isinstance(workpiece.shape, Cylinder) and workpiece.gyration_m2 is None:
        # The controller's model of a cylinder has its centre of mass in the middle.
        return Load(
            mass_kg=workpiece.mass_kg, moments_kg_m2=solid_moments(workpiece.shape, workpiece.mass_kg), pose=pose
        )
    frame, moments = principal_frame(workpiece)
    return Load(mass_kg=workpiece.mass_kg, moments_kg_m2=moments, pose=pose @ frame)


class ArmDynamics:
    """Joint torques of the arm with loads on its flange."""

    def __init__(self, robot: Robot, loads: Sequence[Load], *, gravity_m_s2: float) -> None:
        """Build the model.

        Args:
            robot: The arm.
            loads: Loads on its flange.
            gravity_m_s2: Magnitude of gravity, along the world's -z.

        Raises:
            DefinitionError: The robot is ill defined.
        """
        import pinocchio

        self._engine = pinocchio
        self._model = build_model(robot)
        self._coupling = Coupling.of(robot, self._model)
        self._model.gravity.linear = np.array([0.0, 0.0, -gravity_m_s2])
        flange = link_frame(self._model, robot.flange)
        for load in loads:
            inertia = pinocchio.Inertia(load.mass_kg, np.zeros(3), np.diag(load.moments_kg_m2))
            self._model.appendBodyToJoint(flange.parentJoint, inertia, flange.placement * transform(load.pose))
        self._data = self._model.createData()

    def torques(
        self, q: Sequence[float] | Vector, dq: Sequence[float] | Vector, ddq: Sequence[float] | Vector
    ) -> Vector:
        """Inverse dynamics by the recursive Newton-Euler algorithm.

        Args:
            q: Joint positions, shape (n,).
            dq: Joint speeds in rad/s or m/s, shape (n,).
            ddq: Joint accelerations in rad/s² or m/s², shape (n,).

        Returns:
            Torques of the driven joints in N·m, or forces in N, shape (n,), with what they transmit to followers.
        """
        return self._coupling.reduced(self._torques_of_all(q, dq, ddq))

    def follower_torques(
        self, q: Sequence[float] | Vector, dq: Sequence[float] | Vector, ddq: Sequence[float] | Vector
    ) -> Vector:
        """Torques that the coupling transmits to the followers in N·m, or forces in N, from the base to the flange.

        Args:
            q: Joint positions, shape (n,).
            dq: Joint speeds in rad/s or m/s, shape (n,).
            ddq: Joint accelerations in rad/s² or m/s², shape (n,).
        """
        return self._torques_of_all(q, dq, ddq)[self._coupling.follower_rows]

    def _torques_of_all(
        self, q: Sequence[float] | Vector, dq: Sequence[float] | Vector, ddq: Sequence[float] | Vector
    ) -> Vector:
        found: Vector = self._engine.rnea(
            self._model,
            self._data,
            self._coupling.positions(q),
            self._coupling.rates(dq),
            self._coupling.rates(ddq),
        )
        return np.array(found)

    def potential_energy_j(self, q: Sequence[float] | Vector) -> float:
        """Potential energy of arm and loads in J, relative to the world's origin.

        Args:
            q: Joint positions, shape (n,).
        """
        return float(self._engine.computePotentialEnergy(self._model, self._data, self._coupling.positions(q)))
