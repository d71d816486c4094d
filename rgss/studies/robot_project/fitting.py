"""Fitting of a cell to an arm: a layout that it reaches, and a home."""

from __future__ import annotations

import itertools
import math
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics import Arm, inverse_kinematics
from rgss.scenes import GripperGeometry, JointKind, Pose, Robot, Scene, Waypoint, load_scene, waypoint_poses
from rgss.studies.robot_project.descent_search import descent_search
from rgss.studies.robot_project.hand_size import HandSize
from rgss.studies.robot_project.layout import Layout, layouts, scene_text
from rgss.studies.robot_project.overhead_layout import overhead_layouts
from rgss.studies.robot_project.reach import arm_reach_m, sampled_configurations
from rgss.tasks import default_task
from rgss.trials import Workcell, every_stop_is_feasible, infeasible_waypoints, waypoint_configurations

Array = NDArray[np.float64]

POINTS_INTO_ARM = "the gripper touches the arm in most configurations"
"""Reason for which another axis of the flange is tried, and not a smaller gripper."""

_POINTING_SAMPLES, _MOST_TOUCHING = 96, 0.9
_PEDESTAL, _PEDESTAL_GAP_M = "pedestal", 0.15
_LEAST_REACH_M = 0.2
_POSE_FREEDOMS = 6
_CARRY_STATES = 64
# Between two tables side by side, a joint that turns farther carries the object round by another configuration.
_FARTHEST_CARRY_RAD = 2.5
_TURN_RAD = 6.29
"""One turn, rounded up so that written ranges are short."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedCell:
    """A cell that suits an arm.

    Attributes:
        layout: Positions of the tables.
        home: Joint positions above the object, in rad or m.
        lower: Lower ends of the joints' ranges, of more than one turn that of the turn about the task.
        upper: Their upper ends.
        carry_rad: Greatest change of a joint from table to table.
    """

    layout: Layout
    home: tuple[float, ...]
    lower: tuple[float, ...]
    upper: tuple[float, ...]
    carry_rad: float


class CellSearch:
    """Search for a cell in which an arm reaches every waypoint with every gripper."""

    def __init__(
        self,
        folder: Path,
        robot: Robot,
        robot_file: str,
        geometries: Sequence[GripperGeometry],
        *,
        size: HandSize,
        on_stage: Callable[[str], None],
    ) -> None:
        """Prepare the search.

        Args:
            folder: The project, with all files but the scene.
            robot: The arm.
            robot_file: Name of its file.
            geometries: The grippers.
            size: Scale of object and grippers.
            on_stage: Called with the name of each stage before it begins.
        """
        self._on_stage, self._tried = on_stage, 0
        self._path, self._robot, self._robot_file = folder / "scenes" / "kitchen.yaml", robot, robot_file
        self._geometries, self._size = geometries, size
        self._gap_m: float | None = None
        self._reason = "the tool does not come down to an object on a table"
        self._unserved: Workcell | None = None

    @property
    def reason(self) -> str:
        """An example of what prevents a cell; computed when it is wanted, since it takes long."""
        if self._unserved is not None:
            self._reason = next((str(one) for one in infeasible_waypoints(self._unserved).values()), self._reason)
            self._unserved = None
        return self._reason

    def cells(self) -> Iterator[FittedCell]:
        """Cells with a home for the arm, computed lazily, the most common layout first."""
        size, robot = self._size, self._robot
        reach_m, is_yaw_free = arm_reach_m(robot), len(robot.joints) < _POSE_FREEDOMS
        usual = layouts(reach_m, scale=size.scale, is_yaw_free=is_yaw_free)
        overhead = (replace(one, is_yaw_free=is_yaw_free) for one in _overhead(robot, self._geometries, size))
        common = self._fitting(itertools.chain(usual if reach_m >= _LEAST_REACH_M * size.scale else (), overhead))
        yield from itertools.islice(common, 1)
        if self._reason == POINTS_INTO_ARM:
            return
        self._on_stage("places where the tool comes down")
        longest = max(self._geometries, key=lambda geometry: geometry.grasp_depth_m)
        search = descent_search(robot, longest, scale=size.scale)
        if search.reason:
            self._reason, self._unserved = search.reason, None
        yield from self._fitting(search.layouts, is_direct=True)
        yield from common
        yield from self._fitting(search.layouts)

    def _fitting(self, tried: Iterable[Layout], *, is_direct: bool = False) -> Iterator[FittedCell]:
        """Cells of the layouts that suit the arm; direct ones let it carry the object by a straight joint move."""
        for layout in tried:
            found = self._fitted(layout, is_direct=is_direct)
            if found is not None:
                yield self._carrying_round_less(found, layout, is_direct=is_direct)
            elif self._reason == POINTS_INTO_ARM:
                return

    def _carrying_round_less(self, found: FittedCell, tried: Layout, *, is_direct: bool) -> FittedCell:
        """Cell, or that with the gripper turned as suits the arm if the arm would turn over between the tables.

        A range of the last joint below a turn may exclude the stated yaw at one of the tables; the cup is round.
        """
        if tried.is_yaw_free or found.carry_rad <= _FARTHEST_CARRY_RAD:
            return found
        before = self._reason, self._unserved
        free = self._fitted(replace(tried, is_yaw_free=True), is_direct=is_direct)
        self._reason, self._unserved = before
        return found if free is None or free.carry_rad > _FARTHEST_CARRY_RAD else free

    def _fitted(self, tried: Layout, *, is_direct: bool) -> FittedCell | None:
        self._tried += 1
        self._on_stage(f"layout {self._tried}")
        layout = replace(tried, own_cup=self._size.own_cup)
        if self._gap_m and not layout.is_overhead:
            layout = replace(layout, pedestal_gap_m=self._gap_m)
        scene = self._scene(layout)
        if not all(_reaches_ends(scene, geometry) for geometry in self._geometries):
            return None
        if self._gap_m is None and not layout.is_overhead:
            self._gap_m = _PEDESTAL_GAP_M if _stands_in_pedestal(self._cells(scene)[0]) else 0.0
            layout = replace(layout, pedestal_gap_m=self._gap_m)
            scene = self._scene(layout)
        cells = self._cells(scene)
        if any(_points_into_arm(cell) for cell in cells):
            self._reason, self._unserved = POINTS_INTO_ARM, None
            return None
        unserved = next((cell for cell in cells if not every_stop_is_feasible(cell)), None)
        if unserved is not None:
            self._unserved = unserved
            return None
        # Valid configurations at the waypoints, with the least travel from one to the next.
        stops = [waypoint_configurations(cell) for cell in cells]
        if not all(len(one) == len(Waypoint) for one in stops):
            return None
        if is_direct and not all(_carries_straight(cell, one) for cell, one in zip(cells, stops, strict=True)):
            return None
        lower, upper = _ranges(self._robot, np.array([q for one in stops for q in one.values()]))
        home = stops[0][Waypoint.GRASP_DEPARTURE].tolist()
        carries = [np.abs(one[Waypoint.PLACE_APPROACH] - one[Waypoint.GRASP_DEPARTURE]).max() for one in stops]
        return FittedCell(layout=layout, home=tuple(home), lower=lower, upper=upper, carry_rad=float(max(carries)))

    def _scene(self, layout: Layout) -> Scene:
        self._path.write_text(scene_text(layout, robot=self._robot_file), encoding="utf-8")
        return load_scene(self._path, project=self._path.parents[1])

    def _cells(self, scene: Scene) -> list[Workcell]:
        task = default_task()
        return [Workcell(scene, one, clearance_m=self._size.clearance_m, task=task) for one in self._geometries]


def _carries_straight(cell: Workcell, stops: Mapping[str, Array]) -> bool:
    """True if the straight move of the joints from table to table is free of collisions."""
    start, goal = stops[Waypoint.GRASP_DEPARTURE], stops[Waypoint.PLACE_APPROACH]
    leg = next(leg for leg in cell.route.legs if cell.route.stops[leg.goal].name == Waypoint.PLACE_APPROACH)
    model = cell.planning[leg.step.name]
    return all(model.is_valid(start + share * (goal - start)) for share in np.linspace(0.0, 1.0, _CARRY_STATES))


def _stands_in_pedestal(cell: Workcell) -> bool:
    """True if the arm touches its pedestal in most configurations."""
    model = next(iter(cell.planning.values()))
    samples = sampled_configurations(cell.scene.robot)[:_POINTING_SAMPLES]
    touching = sum(any(_PEDESTAL in pair for pair in model.contacts(q)) for q in samples)
    return touching > _MOST_TOUCHING * len(samples)


def _points_into_arm(cell: Workcell) -> bool:
    """True if the gripper touches the arm in most configurations, as one that points backwards does."""
    robot = cell.scene.robot
    model = next(iter(cell.planning.values()))
    links = {link.get("name") for link in ET.fromstring(robot.urdf).findall("link")}  # noqa: S314 - checked on reading
    others = {body.id for body in cell.scene.bodies} | {cell.scene.workpiece.id}
    samples = sampled_configurations(robot)[:_POINTING_SAMPLES]
    touching = sum(
        any(len({*pair} & links) == 1 and not {*pair} & others for pair in model.contacts(q)) for q in samples
    )
    return touching > _MOST_TOUCHING * len(samples)


def _overhead(robot: Robot, geometries: Sequence[GripperGeometry], size: HandSize) -> Iterator[Layout]:
    """Layouts under an arm that hangs; computed lazily."""
    samples = sampled_configurations(robot)
    arm = Arm(replace(robot, base=Pose()), Pose())
    tools = np.array([arm.tool_matrix(q) for q in samples])
    tool_m = max(geometry.grasp_centre.position_m[2] for geometry in geometries)
    yield from overhead_layouts(tools[:, :3, 3], tools[:, :3, 2], tool_m=tool_m, scale=size.scale)


def _ranges(robot: Robot, configurations: Array) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The joints' ranges, of more than one turn the turn about the middle of some configurations."""
    own = np.array([(joint.lower_rad, joint.upper_rad) for joint in robot.joints]).T
    turns = np.array([joint.kind is JointKind.REVOLUTE for joint in robot.joints]) & (own[1] - own[0] > _TURN_RAD)
    middle = (np.min(configurations, axis=0) + np.max(configurations, axis=0)) / 2
    lowest = np.clip(np.round(middle - math.pi, 2), own[0], own[1] - _TURN_RAD)
    lower = np.where(turns, lowest, own[0])
    upper = np.where(turns, np.minimum(np.round(lowest + _TURN_RAD, 4), own[1]), own[1])
    return tuple(lower.tolist()), tuple(upper.tolist())


def _reaches_ends(scene: Scene, geometry: GripperGeometry) -> bool:
    inverse, poses = (
        inverse_kinematics(Arm(scene.robot, geometry.grasp_centre), is_turn_free=scene.task.is_yaw_free),
        waypoint_poses(scene),
    )
    ends = (Waypoint.GRASP, Waypoint.GRASP_DEPARTURE, Waypoint.PLACE)
    return all(inverse.solve(poses[waypoint]) for waypoint in ends)
