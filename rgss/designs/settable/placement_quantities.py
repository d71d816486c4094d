"""Settable quantities of the pose of the robot's base in the scene."""

from __future__ import annotations

from rgss.designs.settable.quantity import Application, SettableQuantity

BASE_YAW = "robot.base.yaw"
BASE_POSITION = ("robot.base.x", "robot.base.y", "robot.base.z")
"""Coordinates of the base in the world, in this order."""

PLACEMENT_QUANTITIES = tuple(
    SettableQuantity(
        name=name,
        unit=unit,
        meaning=meaning,
        field="scene.robot.base",
        application=Application.PLACEMENT,
        default=f"robot.{key} in the scene",
        required=False,
        positive=False,
    )
    for name, unit, key, meaning in (
        (BASE_POSITION[0], "m", "base", "Position of the robot's base along the world's x axis."),
        (BASE_POSITION[1], "m", "base", "Position of the robot's base along the world's y axis."),
        (BASE_POSITION[2], "m", "base", "Height of the robot's base."),
        (BASE_YAW, "rad", "yaw", "Yaw of the robot's base."),
    )
)
"""The quantities; those that no design sets are the scene's."""
