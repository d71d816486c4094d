"""Objects that a gripper still holds with its drive off."""

from __future__ import annotations

from rgss.scenes.gripper import Gripper
from rgss.scenes.scene import Scene


def unpowered_shortfall(gripper: Gripper, scene: Scene) -> str:
    """Why unpowered fingers do not hold the object of a scene by Coulomb friction; empty if they do.

    Args:
        gripper: The gripper.
        scene: The scene, with the held object as its workpiece.
    """
    if gripper.suction is not None:
        return "the vacuum is off"
    workpiece = scene.workpiece
    friction = gripper.grip_coefficient(workpiece.friction)
    needed_n = workpiece.mass_kg * scene.gravity_m_s2 / (friction * gripper.geometry.fingers)
    resisted_n = min(gripper.drive.unpowered_force_n, gripper.finger_force_n)
    if resisted_n >= needed_n:
        return ""
    return f"the unpowered fingers resist with {resisted_n:.2f} N, each needs {needed_n:.2f} N"
