"""Scene seen from one of several objects: it is the workpiece, the others are bodies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from rgss.scenes.pose import Pose
from rgss.scenes.scene import Scene, SceneBody


@dataclass(frozen=True, slots=True, kw_only=True)
class Standing:
    """Where an object stands.

    Attributes:
        pose: Transform of its shape's frame to the world.
        support: Id of the body that bears it.
    """

    pose: Pose
    support: str


def initial_standings(scene: Scene) -> dict[str, Standing]:
    """Where each object of a scene stands at the start.

    Args:
        scene: The scene.
    """
    return {one.workpiece.id: Standing(pose=one.workpiece.pose, support=one.support) for one in scene.objects}


def scene_about(scene: Scene, name: str, *, place: str, standings: Mapping[str, Standing]) -> Scene:
    """The scene with an object as its workpiece, and those that stand around it as fixed bodies.

    Args:
        scene: The scene as its file says.
        name: The object.
        place: The place at which it is released; empty for its own.
        standings: Where the objects stand; the object itself may be held, and then stands where it last did.
    """
    about = next(one for one in scene.objects if one.workpiece.id == name)
    region, bearing = about.place, about.place_support
    if place:
        named = next(one for one in scene.places if one.id == place)
        region, bearing = named.region, named.support
    own = standings[name]
    around = tuple(
        SceneBody(
            id=one.workpiece.id,
            shape=one.workpiece.shape,
            pose=standings[one.workpiece.id].pose,
            friction=one.workpiece.friction,
            colour=one.workpiece.colour,
        )
        for one in scene.objects
        if one.workpiece.id != name
    )
    workpiece = about.workpiece
    return replace(
        scene,
        bodies=(*scene.bodies, *around),
        support=own.support,
        place_support=bearing,
        workpiece=workpiece if own.pose == workpiece.pose else replace(workpiece, pose=own.pose),
        place=region,
        others=tuple(one for one in scene.objects if one.workpiece.id != name),
    )
