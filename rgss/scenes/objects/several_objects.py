"""Scene of several objects with one as the workpiece and the others as fixed bodies."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from rgss.scenes.pose import Pose
from rgss.scenes.scene import PlaceRegion, Scene, SceneBody


@dataclass(frozen=True, slots=True, kw_only=True)
class ObjectPlacement:
    """Pose and support of an object.

    Attributes:
        pose: Transform of its shape's frame to the world.
        support: Id of its supporting body or object.
    """

    pose: Pose
    support: str


def initial_placements(scene: Scene) -> dict[str, ObjectPlacement]:
    """Pose and support of each object of a scene at the start."""
    return {one.workpiece.id: ObjectPlacement(pose=one.workpiece.pose, support=one.support) for one in scene.objects}


def scene_about(scene: Scene, name: str, *, place: str, placements: Mapping[str, ObjectPlacement]) -> Scene:
    """Scene with an object as its workpiece, and the other objects as fixed bodies.

    Args:
        scene: The scene of the file.
        name: The object.
        place: The place at which it is released; empty for its own.
        placements: Poses and supports of the objects; of a held object, those before it was gripped.
    """
    about = next(one for one in scene.objects if one.workpiece.id == name)
    region, bearing = about.place, about.place_support
    if place:
        named = next(one for one in scene.places if one.id == place)
        region, bearing = named.region, named.support
    region = region_now(scene, region, bearing, lambda support: placements[support].pose)
    own = placements[name]
    around = tuple(
        SceneBody(
            id=one.workpiece.id,
            shape=one.workpiece.shape,
            pose=placements[one.workpiece.id].pose,
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
        task=scene.task if about.grasp == scene.task.grasp else replace(scene.task, grasp=about.grasp),
        others=tuple(one for one in scene.objects if one.workpiece.id != name),
    )


def region_now(scene: Scene, region: PlaceRegion, support: str, pose_of: Callable[[str], Pose]) -> PlaceRegion:
    """Place region where its support is now: that of a body does not move.

    Args:
        scene: The scene.
        region: The region.
        support: Id of its supporting body or object.
        pose_of: Present transform of an object to the world.
    """
    if region.offset_m is None:
        return region
    beneath = next(one.workpiece for one in scene.objects if one.workpiece.id == support)
    return region.on(pose_of(support), beneath.shape.half_height_m)


def with_raised_stack(scene: Scene, name: str, rise_m: float) -> Scene:
    """Scene in which the objects above one in its stack are raised.

    Args:
        scene: The scene.
        name: The lowest object, which stays.
        rise_m: Distance along the vertical.
    """
    above = {name}
    for _ in scene.others:
        above |= {one.workpiece.id for one in scene.others if one.support in above}
    if not rise_m or len(above) == 1:
        return scene
    others = tuple(
        replace(one, workpiece=replace(one.workpiece, pose=one.workpiece.pose.raised(rise_m)))
        if one.workpiece.id in above
        else one
        for one in scene.others
    )
    return replace(scene, others=others)
