"""Factory of contact worlds: PyBullet, or the engine of the settings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.physics.contact_world import ContactWorld
from rgss.physics.settings import PhysicsSettings
from rgss.physics.world import World
from rgss.scenes import Gripper, Scene


@dataclass(frozen=True, slots=True, kw_only=True)
class OtherEngineSettings(PhysicsSettings):
    """Settings of a contact engine other than PyBullet, with the factory of its worlds.

    The engine is an input of a trial like its rate, so that evidence of two engines has different keys. It is accessed
    only through this class, so that the code of PyBullet's trials does not depend on it.

    Attributes:
        engine: Name of the engine.
        version: Its release.
        code: Digest of the code of this package that adapts it.
    """

    engine: str
    version: str
    code: str

    def open(self, scene: Scene, gripper: Gripper, *, joint_offsets_rad: Sequence[float] = ()) -> ContactWorld:
        """New world of the engine.

        Args:
            scene: Fixed bodies, workpiece and robot.
            gripper: The gripper on the robot's flange.
            joint_offsets_rad: True minus reported angle of each joint of the arm; empty if they are equal.

        Raises:
            SimulationError: The engine cannot build it.
        """
        raise NotImplementedError


def open_world(
    scene: Scene, gripper: Gripper, settings: PhysicsSettings, *, joint_offsets_rad: Sequence[float] = ()
) -> ContactWorld:
    """New world of the engine that the settings name.

    Args:
        scene: Fixed bodies, workpiece and robot.
        gripper: The gripper on the robot's flange.
        settings: Step length and solver; those of another engine select it, else PyBullet.
        joint_offsets_rad: True minus reported angle of each joint of the arm; empty if they are equal.

    Raises:
        SimulationError: The engine cannot build it.
    """
    if isinstance(settings, OtherEngineSettings):
        return settings.open(scene, gripper, joint_offsets_rad=joint_offsets_rad)
    return World(scene, gripper, settings, joint_offsets_rad=joint_offsets_rad)
