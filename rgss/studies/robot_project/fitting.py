"""Fitting of a cell to an arm: a layout that it reaches, and a home."""

from __future__ import annotations

import itertools
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics import Arm, inverse_kinematics
from rgss.scenes import GripperGeometry, JointKind, Pose, Robot, Scene, Waypoint, load_scene, waypoint_poses
from rgss.studies.robot_project.layout import Layout, layouts, scene_text
from rgss.studies.robot_project.overhead_layout import overhead_layouts
from rgss.studies.robot_project.reach import horizontal_reach_m, sampled_configurations
from rgss.tasks import default_task
from rgss.trials import Workcell, every_stop_is_feasible, infeasible_waypoints, waypoint_configurations

Array = NDArray[np.float64]

_POINTING_SAMPLES, _MOST_TOUCHING = 96, 0.9
_PEDESTAL, _PEDESTAL_GAP_M = "pedestal", 0.15
_LEAST_REACH_M = 0.2
_POSE_FREEDOMS = 6
_ROOM = {JointKind.REVOLUTE: 0.6, JointKind.PRISMATIC: 0.15}
_CLEARANCE_M = 0.008


def is_yaw_free(robot: Robot) -> bool:
    """True for an arm that cannot turn its tool to every pose, whose task constrains the tool's axis alone.

    Args:
        robot: The arm.
    """
    return len(robot.joints) < _POSE_FREEDOMS


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedCell:
    """A cell that suits an arm.

    Attributes:
        layout: Positions of the tables.
        home: Joint positions above the object, in rad or m.
        lower: Lower ends of ranges about the configurations at all waypoints.
        upper: Their upper ends.
    """

    layout: Layout
    home: tuple[float, ...]
    lower: tuple[float, ...]
    upper: tuple[float, ...]


def fitted(
    folder: Path, robot: Robot, robot_file: str, geometries: Sequence[GripperGeometry]
) -> tuple[FittedCell | None, str]:
    """The first layout in which the arm reaches every waypoint with every gripper, and a home for it.

    Args:
        folder: The project, with all files but the scene.
        robot: The arm.
        robot_file: Name of its file.
        geometries: The grippers.

    Returns:
        The cell; None without one, and an example of what prevents it.
    """
    path = folder / "scenes" / "kitchen.yaml"
    reach_m = horizontal_reach_m(robot)
    on_pedestal = layouts(reach_m) if reach_m >= _LEAST_REACH_M else ()
    gap_m: float | None = None
    reason = "the tool does not come down to an object on a table"
    for tried in itertools.chain(on_pedestal, _overhead(robot, geometries)):
        layout = tried if not gap_m or tried.is_overhead else replace(tried, pedestal_gap_m=gap_m)
        scene = _scene(path, layout, robot, robot_file)
        if not all(_reaches_ends(scene, geometry) for geometry in geometries):
            continue
        if gap_m is None and not layout.is_overhead:
            gap_m = _PEDESTAL_GAP_M if _stands_in_pedestal(_cells(scene, geometries)[0]) else 0.0
            layout = replace(layout, pedestal_gap_m=gap_m)
            scene = _scene(path, layout, robot, robot_file)
        cells = _cells(scene, geometries)
        if any(_points_into_arm(cell) for cell in cells):
            return None, "the gripper touches the arm in most configurations"
        unserved = next((cell for cell in cells if not every_stop_is_feasible(cell)), None)
        if unserved is not None:
            reason = next((str(one) for one in infeasible_waypoints(unserved).values()), reason)
            continue
        # Valid configurations at the waypoints, with the least travel from one to the next.
        stops = [waypoint_configurations(cell) for cell in cells]
        if all(len(one) == len(Waypoint) for one in stops):
            lower, upper = _ranges(robot, np.array([q for one in stops for q in one.values()]))
            home = stops[0][Waypoint.GRASP_DEPARTURE].tolist()
            return FittedCell(layout=layout, home=tuple(home), lower=lower, upper=upper), ""
    return None, reason


def _scene(path: Path, layout: Layout, robot: Robot, robot_file: str) -> Scene:
    path.write_text(scene_text(layout, robot=robot_file, is_yaw_free=is_yaw_free(robot)), encoding="utf-8")
    return load_scene(path, project=path.parents[1])


def _cells(scene: Scene, geometries: Sequence[GripperGeometry]) -> list[Workcell]:
    return [Workcell(scene, geometry, clearance_m=_CLEARANCE_M, task=default_task()) for geometry in geometries]


def _stands_in_pedestal(cell: Workcell) -> bool:
    """Whether the arm touches its pedestal in most configurations."""
    model = next(iter(cell.planning.values()))
    samples = sampled_configurations(cell.scene.robot)[:_POINTING_SAMPLES]
    touching = sum(any(_PEDESTAL in pair for pair in model.contacts(q)) for q in samples)
    return touching > _MOST_TOUCHING * len(samples)


def _points_into_arm(cell: Workcell) -> bool:
    """Whether the gripper touches the arm in most configurations, as where it is mounted the wrong way round."""
    robot = cell.scene.robot
    model = next(iter(cell.planning.values()))
    links = {link.get("name") for link in ET.fromstring(robot.urdf).findall("link")}  # noqa: S314 - checked on reading
    others = {body.id for body in cell.scene.bodies} | {cell.scene.workpiece.id}
    samples = sampled_configurations(robot)[:_POINTING_SAMPLES]
    touching = sum(
        any(len({*pair} & links) == 1 and not {*pair} & others for pair in model.contacts(q)) for q in samples
    )
    return touching > _MOST_TOUCHING * len(samples)


def _overhead(robot: Robot, geometries: Sequence[GripperGeometry]) -> Iterator[Layout]:
    """Layouts under an arm that hangs; computed lazily."""
    samples = sampled_configurations(robot)
    tools = np.array([Arm(replace(robot, base=Pose()), Pose()).tool_matrix(q) for q in samples])
    tool_m = max(geometry.grasp_centre.position_m[2] for geometry in geometries)
    yield from overhead_layouts(tools[:, :3, 3], tools[:, :3, 2], tool_m=tool_m)


def _ranges(robot: Robot, configurations: Array) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Ranges that hold configurations with some room, within the arm's own."""
    room = np.array([_ROOM[joint.kind] for joint in robot.joints])
    own = np.array([(joint.lower_rad, joint.upper_rad) for joint in robot.joints]).T
    lower = np.maximum(np.round(np.min(configurations, axis=0) - room, 2), own[0])
    upper = np.minimum(np.round(np.max(configurations, axis=0) + room, 2), own[1])
    return tuple(lower.tolist()), tuple(upper.tolist())


def _reaches_ends(scene: Scene, geometry: GripperGeometry) -> bool:
    inverse, poses = (
        inverse_kinematics(Arm(scene.robot, geometry.grasp_centre), is_turn_free=scene.task.is_yaw_free),
        waypoint_poses(scene),
    )
    ends = (Waypoint.GRASP, Waypoint.GRASP_DEPARTURE, Waypoint.PLACE)
    return all(inverse.nearest(poses[waypoint], scene.robot.home_rad) is not None for waypoint in ends)
