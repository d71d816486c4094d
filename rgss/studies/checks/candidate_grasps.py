"""Grasp candidates by the sizes of object and hand alone: the mounting to check, and the room of its open fingers."""

from __future__ import annotations

from rgss.grasping.candidates import ranked_grasps
from rgss.scenes import GraspCandidates, GripperGeometry, Workpiece, at_object, misfit
from rgss.studies.checks.gripped_objects import gripped_views
from rgss.studies.project import Project


def checked_mounting(project: Project, file: str, friction: float) -> GripperGeometry:
    """Shape of a gripper in its first mounting that can hold the object, or most of the objects by candidates.

    What no mounting holds is found by the check, or by its trials at the grasp.

    Args:
        project: The project.
        file: The gripper's file.
        friction: Coefficient of the pads.
    """
    gripper, scene = project.grippers[file], project.scene
    options, mountings = scene.task.candidates, tuple(gripper.mountings.values())
    if options is None or len(mountings) == 1:
        held = (geometry for geometry in mountings if not misfit(geometry, scene))
        return at_object(next(held, gripper.geometry), scene)
    objects = [view.workpiece for _, view in gripped_views(project)]

    def held_by(geometry: GripperGeometry) -> int:
        return sum(bool(_openings_m(one, geometry, options, friction, None)) for one in objects)

    # The default mounting is the first of equals.
    best = max((gripper.geometry, *mountings), key=held_by)
    return at_object(best, scene)


def lack_of_room(project: Project, geometry: GripperGeometry, name: str, friction: float) -> str:
    """Reason why every candidate of an object is nearer to the open fingers than planned paths may be; empty if not so.

    Args:
        project: The project, whose task chooses among candidates.
        geometry: The gripper's shape.
        name: The object.
        friction: Coefficient of the pads.
    """
    options, clearance_m = project.scene.task.candidates, project.study.planning.settings.clearance_m
    if options is None or geometry.cup is not None:
        return ""
    workpiece = next(one.workpiece for one in project.scene.objects if one.workpiece.id == name)
    openings_m = _openings_m(workpiece, geometry, options, friction, clearance_m)
    room_m = geometry.largest_opening_m - clearance_m
    if not openings_m or min(openings_m) <= room_m:
        return ""
    mounting = f" in their mounting {geometry.mounting}" if geometry.mounting else ""
    return (
        f"the fingers{mounting} hold it {2e3 * min(openings_m):.4g} mm wide at best and open to "
        f"{2e3 * geometry.largest_opening_m:.4g} mm, which leaves room for {max(0.0, 2e3 * room_m):.4g} mm with the "
        f"clearance of planned paths, {1e3 * clearance_m:.4g} mm on each side ('planning.clearance' of the study)"
    )


def _openings_m(
    workpiece: Workpiece,
    geometry: GripperGeometry,
    options: GraspCandidates,
    friction: float,
    clearance_m: float | None,
) -> list[float]:
    """Distance of the pads from the tool axis in each candidate."""
    contact = friction * workpiece.friction
    ranked = ranked_grasps(workpiece, geometry, options, friction=contact, clearance_m=clearance_m)
    return [one.opening_m for one in ranked.grasps]
