"""Route of a task: poses and configurations between its moves, and the collision context of each move."""

from __future__ import annotations

from dataclasses import dataclass, replace

from rgss.kinematics import CollisionContext
from rgss.scenes import (
    CUP_LINK,
    GripperGeometry,
    ObjectPlacement,
    Pose,
    Scene,
    Waypoint,
    grasp_opening_m,
    initial_placements,
    scene_about,
    tool_with_pads_at,
    waypoint_poses,
)
from rgss.tasks import HandAction, MoveStep, Stage, Target, TaskProgram, stages_of

_AT_PLACE = (Waypoint.PLACE_APPROACH, Waypoint.PLACE)


@dataclass(frozen=True, slots=True, kw_only=True)
class Stop:
    """Start or end of a move.

    Attributes:
        name: Its name in messages.
        pose: Transform of the grasp-centre frame to the world; None for a configuration.
        configuration_rad: Joint positions; empty for a pose.
        is_turn_free: True if the tool may be rotated about its axis at the pose.
        object: The object of a waypoint; empty for other poses.
        place: The named place of the waypoint; empty for the object's own.
        is_at_place: True for a waypoint at the place.
    """

    name: str
    pose: Pose | None = None
    configuration_rad: tuple[float, ...] = ()
    is_turn_free: bool = False
    object: str = ""
    place: str = ""
    is_at_place: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Leg:
    """A move between two stops.

    Attributes:
        step: The move.
        start: Index of the stop at its start.
        goal: Index of the stop at its end.
        scene: The scene during the move: its object is the workpiece, the others are bodies.
        context: Opening of the gripper, and pose of the object.
    """

    step: MoveStep
    start: int
    goal: int
    scene: Scene
    context: CollisionContext


@dataclass(frozen=True, slots=True, kw_only=True)
class Route:
    """Stops of a task and the moves between them.

    Attributes:
        stops: The stops in the order of the first visit. Repeated visits share a stop only if the moves then form one
        chain or cycle.
        legs: The moves in order.
    """

    stops: tuple[Stop, ...]
    legs: tuple[Leg, ...]

    @property
    def pairs(self) -> tuple[tuple[int, int], ...]:
        """Indices of the stops of each leg."""
        return tuple((leg.start, leg.goal) for leg in self.legs)


def route_of(scene: Scene, geometry: GripperGeometry, task: TaskProgram) -> Route:
    """Route of a task, from the expected object poses after each step.

    Args:
        scene: The perceived scene at the start.
        geometry: The gripper's shape.
        task: The task.
    """
    cell = _Cell(scene, geometry)
    visited: list[Stop] = []
    moves: list[tuple[MoveStep, Scene, CollisionContext]] = []
    for stage in stages_of(task, scene.workpiece.id):
        cell.enter(stage)
        if not visited:
            visited.append(cell.stop_of(task.start, stage) if task.start else cell.home)
        if isinstance(stage.step, MoveStep):
            visited.append(cell.stop_of(stage.step.target, stage))
            moves.append((stage.step, *cell.context_of(stage)))
        elif stage.step.hand is HandAction.CLOSES:
            cell.grip(stage)
        elif stage.step.hand is HandAction.OPENS:
            cell.release(stage)
    stops, indices = _numbered(visited)
    legs = tuple(
        Leg(step=step, start=indices[place], goal=indices[place + 1], scene=view, context=context)
        for place, (step, view, context) in enumerate(moves)
    )
    return Route(stops=stops, legs=legs)


class _Cell:
    """Object poses, step by step."""

    def __init__(self, scene: Scene, geometry: GripperGeometry) -> None:
        self._scene = scene
        self._geometry = geometry
        self._opening_m = geometry.largest_opening_m
        self._placements = initial_placements(scene)
        self._turns: dict[str, int] = {}
        # Pose of each object before its last grip, the reference of the grasp's waypoints until the next grip.
        self._origins = dict(self._placements)
        self._held: Pose | None = None
        self.home = Stop(name="home", configuration_rad=scene.robot.home_rad)

    def enter(self, stage: Stage) -> None:
        """Begin a stage."""
        if self._turns.get(stage.object) != stage.turn:
            self._turns[stage.object] = stage.turn
            self._origins[stage.object] = self._placements[stage.object]

    def stop_of(self, target: Target, stage: Stage) -> Stop:
        """Stop of a target."""
        if target.configuration_rad:
            return Stop(name=target.name, configuration_rad=target.configuration_rad)
        if target.frame:
            return Stop(name=target.name, pose=self._pose_in_frame(target))
        if target.pose is not None:
            return Stop(name=target.name, pose=target.pose)
        waypoint = Waypoint(target.waypoint)
        name = stage.object if waypoint in _AT_PLACE else target.object or stage.object
        place = target.place or stage.place
        origin = self._origins[name] if name == stage.object else self._placements[name]
        view = scene_about(self._scene, name, place=place, placements={**self._placements, name: origin})
        parts = [target.name]
        parts += [f"of {name}"] if name != self._scene.workpiece.id else []
        parts += [f"at {place}"] if place and waypoint in _AT_PLACE else []
        pads = waypoint_poses(view)[waypoint].raised(target.raised_m)
        return Stop(
            name=" ".join(parts),
            pose=tool_with_pads_at(pads, view, self._geometry),
            is_turn_free=self._scene.task.is_yaw_free,
            object=name,
            place=place,
            is_at_place=waypoint in _AT_PLACE,
        )

    def _pose_in_frame(self, target: Target) -> Pose:
        """Transform of the grasp-centre frame to the world at a target in a named frame."""
        frame = next(one for one in self._scene.frames if one.id == target.frame)
        at = self._placements[frame.object].pose @ frame.pose if frame.object else frame.pose
        return (at if target.pose is None else at @ target.pose).raised(target.raised_m)

    def context_of(self, stage: Stage) -> tuple[Scene, CollisionContext]:
        """Scene and collision context of a move."""
        view = self._view(stage)
        if self._held is None:
            touched = frozenset({(view.workpiece.id, CUP_LINK)} if self._geometry.cup is not None else ())
            return view, CollisionContext(opening_m=self._opening_m, standing=view.workpiece.pose, allowed=touched)
        carrying = CollisionContext(
            opening_m=grasp_opening_m(view, self._geometry),
            carried=self._held,
            largest_tilt_rad=view.task.largest_carry_tilt_rad,
        )
        if stage.is_leaving:
            carrying = replace(carrying, allowed=frozenset({(view.workpiece.id, view.support)}))
        return view, carrying

    def grip(self, stage: Stage) -> None:
        """Move the object into the hand."""
        view = self._view(stage)
        self._held = tool_with_pads_at(view.grasp, view, self._geometry).inverse() @ view.workpiece.pose

    def release(self, stage: Stage) -> None:
        """Leave the object at its place."""
        if self._held is None:
            raise AssertionError("checked before: an object is held")
        view = self._view(stage)
        tool = tool_with_pads_at(view.place_pose, view, self._geometry)
        pose = (tool @ self._held).raised(-view.task.place_clearance_m)
        self._placements[stage.object] = ObjectPlacement(pose=pose, support=view.place_support)
        self._held = None

    def _view(self, stage: Stage) -> Scene:
        return scene_about(self._scene, stage.object, place=stage.place, placements=self._placements)


def _numbered(visited: list[Stop]) -> tuple[tuple[Stop, ...], list[int]]:
    """Distinct stops, and the index of the stop of each visit.

    The choice of configurations needs a chain or a cycle. If a task returns in another way, each visit is a separate
    stop.
    """
    stops = list(dict.fromkeys(visited))
    indices = [stops.index(stop) for stop in visited]
    once = indices[:-1] if len(indices) > 2 and indices[-1] == indices[0] else indices
    if sorted(once) == list(range(len(stops))):
        return tuple(stops), indices
    return tuple(visited), list(range(len(visited)))
