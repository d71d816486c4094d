"""Arms of the designs: the scene with the robot of each manipulator that names a robot file, at the design's base."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from rgss.designs import BASE_POSITION, BASE_YAW, DesignSpace, DesignVariant
from rgss.scenes import Pose, Scene
from rgss.studies.design_settings import setters_of
from rgss.studies.trial_values import values_of

ARM = "manipulator"
"""The role of the components that may have a robot file."""

_ROUNDING_RAD = 1e-12
_PLACEMENT = (*BASE_POSITION, BASE_YAW)


@dataclass(frozen=True, slots=True, kw_only=True)
class PlacedArm:
    """Robot at its base, as a design has it.

    Attributes:
        file: The robot file of the design's manipulator; empty for the robot of the scene.
        base: Transform of its base frame to the world.
    """

    file: str
    base: Pose


def arm_of(variant: DesignVariant) -> str:
    """The robot file of a design's manipulator; empty for the robot of the scene."""
    component = variant.components.get(ARM)
    return "" if component is None else component.geometry


def scene_with_arm(variant: DesignVariant, scene: Scene, arms: Mapping[str, Scene]) -> Scene:
    """The scene with the arm of a design at its base.

    Args:
        variant: The design.
        scene: The scene with its own robot.
        arms: The scene with each robot of the catalogue, by robot file.
    """
    own = arms.get(arm_of(variant), scene)
    values = values_of(variant, {})
    if values.keys().isdisjoint(_PLACEMENT):
        return own
    base = own.robot.base
    x, y, z = (float(values.get(name, at)) for name, at in zip(BASE_POSITION, base.position_m, strict=True))
    if BASE_YAW not in values:
        return _with_base(own, Pose(position_m=(x, y, z), quaternion_xyzw=base.quaternion_xyzw))
    # An angle that conversion left a rounding error beside 0 would be another input of the trials.
    roll, pitch, _ = (0.0 if abs(angle) < _ROUNDING_RAD else angle for angle in base.roll_pitch_yaw_rad())
    return _with_base(own, Pose.from_roll_pitch_yaw((x, y, z), (roll, pitch, float(values[BASE_YAW]))))


def scenes_by_arm(designs: DesignSpace, scene: Scene, arms: Mapping[str, Scene]) -> dict[str, Scene]:
    """The scene with each robot that a design has, at the base of the scene.

    Args:
        designs: The design space.
        scene: The scene with its own robot.
        arms: The scene with each robot of the catalogue, by robot file.

    Returns:
        By robot file, in the order of the designs; the scene's own robot under an empty name, if a design has it.
    """
    if not arms:
        return {"": scene}
    used = dict.fromkeys(arm_of(variant) for variant in designs.expand())
    return {name: arms.get(name, scene) for name in used}


def scenes_by_placed_arm(
    designs: DesignSpace, scene: Scene, arms: Mapping[str, Scene]
) -> dict[PlacedArm, tuple[Scene, tuple[DesignVariant, ...]]]:
    """The scene with each robot at each base that a design has, and the designs that have it, in their order.

    Args:
        designs: The design space.
        scene: The scene with its own robot.
        arms: The scene with each robot of the catalogue, by robot file.
    """
    if not arms and setters_of(designs).isdisjoint(_PLACEMENT):
        return {PlacedArm(file="", base=scene.robot.base): (scene, designs.expand())}
    scenes: dict[PlacedArm, Scene] = {}
    having: dict[PlacedArm, list[DesignVariant]] = {}
    for variant in designs.expand():
        placed = scene_with_arm(variant, scene, arms)
        key = PlacedArm(file=arm_of(variant), base=placed.robot.base)
        scenes.setdefault(key, placed)
        having.setdefault(key, []).append(variant)
    return {key: (found, tuple(having[key])) for key, found in scenes.items()}


def _with_base(scene: Scene, base: Pose) -> Scene:
    """Scene with the base of the robot at another pose, and the bodies and frames that move with it."""
    if base == scene.robot.base:
        return scene
    moved = base @ scene.robot.base.inverse()
    frames = tuple(replace(one, pose=moved @ one.pose) if one.is_on_robot else one for one in scene.frames)
    bodies = tuple(replace(one, pose=moved @ one.pose) if one.moves_with_robot else one for one in scene.bodies)
    return replace(scene, robot=replace(scene.robot, base=base), bodies=bodies, frames=frames)
