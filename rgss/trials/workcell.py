"""Workcell: scene, arm and gripper for planning."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from itertools import takewhile

from rgss.kinematics import Arm, CollisionContext, CollisionModel
from rgss.scenes import GripperGeometry, Scene
from rgss.tasks import TaskProgram
from rgss.trials.conditions import conditions_of
from rgss.trials.grasp_choice import GraspSearch, NoGrasp, search_grasps, with_stated_suction
from rgss.trials.route import Leg, route_of
from rgss.trials.trial_spec import TrialSpec

_SHARE_KEPT = 0.25


class Workcell:
    """Kinematics of the arm and collision models of each move, for planning and execution.

    Its collision models take longer to build than a move to time, so pieces with the same scene and gripper shape share
    it, and a model is built when it is first asked for: a check asks for few of them. It is immutable in use.
    """

    def __init__(
        self,
        scene: Scene,
        geometry: GripperGeometry,
        *,
        clearance_m: float,
        task: TaskProgram,
        ungrasped: Iterable[NoGrasp] = (),
    ) -> None:
        """Build the models.

        Args:
            scene: The scene with its robot.
            geometry: The gripper's shape.
            clearance_m: Clearance of planned paths.
            task: The task.
            ungrasped: Objects of which no grasp candidate can be carried out.
        """
        self.scene = scene
        self.geometry = geometry
        self.task = task
        self.ungrasped: Mapping[str, NoGrasp] = {one.object: one for one in ungrasped}
        self.arm = Arm(scene.robot, geometry.grasp_centre)
        self.route = route_of(scene, geometry, self.task)
        contexts = {leg.step.name: (leg.scene, leg.context) for leg in self.route.legs}
        self.planning: Mapping[str, CollisionModel] = _MoveModels(contexts, geometry, clearance_m)
        # Between two checked states, and by compliance of a held object, some clearance may be lost.
        self.running: Mapping[str, CollisionModel] = _MoveModels(contexts, geometry, _SHARE_KEPT * clearance_m)
        # A stated grasp is no substitute for candidates: the task ends before the first move of an object without one.
        self.legs: tuple[Leg, ...] = tuple(takewhile(lambda leg: self.without_grasp(leg) is None, self.route.legs))

    def without_grasp(self, leg: Leg) -> NoGrasp | None:
        """Object of a move without a grasp for which the move could be planned; None if it has one."""
        names = (leg.scene.workpiece.id, self.route.stops[leg.goal].object)
        return next((one for one in map(self.ungrasped.get, names) if one is not None and not one.has_best), None)


class _MoveModels(Mapping[str, CollisionModel]):
    """Collision model of each move, built when it is first asked for; moves in the same context share one."""

    def __init__(
        self,
        contexts: Mapping[str, tuple[Scene, CollisionContext]],
        geometry: GripperGeometry,
        clearance_m: float,
    ) -> None:
        self._contexts = contexts
        self._geometry = geometry
        self._clearance_m = clearance_m
        self._of_move: dict[str, CollisionModel] = {}
        self._of_context: dict[tuple[Scene, CollisionContext], CollisionModel] = {}

    def __getitem__(self, name: str) -> CollisionModel:
        # A scene takes long to hash, and a search asks for the model of a move again and again.
        found = self._of_move.get(name)
        if found is None:
            key = scene, context = self._contexts[name]
            if key not in self._of_context:
                self._of_context[key] = CollisionModel(scene, self._geometry, context, clearance_m=self._clearance_m)
            found = self._of_move[name] = self._of_context[key]
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(self._contexts)

    def __len__(self) -> int:
        return len(self._contexts)


@lru_cache(maxsize=4)
def workcell_of(
    scene: Scene,
    geometry: GripperGeometry,
    clearance_m: float,
    task: TaskProgram,
    ungrasped: tuple[NoGrasp, ...] = (),
) -> Workcell:
    """Workcell of a scene and a gripper shape, cached in the process.

    Args:
        scene: The scene with its robot.
        geometry: The gripper's shape.
        clearance_m: Clearance of planned paths.
        task: The task.
        ungrasped: Objects of which no grasp candidate can be carried out.
    """
    return Workcell(scene, geometry, clearance_m=clearance_m, task=task, ungrasped=ungrasped)


def cell_of(spec: TrialSpec) -> Workcell:
    """Workcell of a trial, as perceived by the robot."""
    clearance_m = spec.settings.planning.clearance_m
    perceived = with_stated_suction(conditions_of(spec).perceived_scene, spec.gripper.geometry)
    ungrasped: tuple[NoGrasp, ...] = ()
    if perceived.task.candidates is not None:
        searches = grasp_searches_of(
            perceived,
            spec.gripper.geometry,
            friction=spec.gripper.grip_coefficient(1.0),
            clearance_m=clearance_m,
            task=spec.task,
        )
        perceived = searches[-1].scene
        ungrasped = tuple(search.no_grasp for search in searches if search.no_grasp is not None)
    return workcell_of(perceived, spec.gripper.geometry, clearance_m, spec.task, ungrasped)


@lru_cache(maxsize=16)
def grasp_searches_of(
    scene: Scene,
    geometry: GripperGeometry,
    *,
    friction: float,
    clearance_m: float,
    task: TaskProgram,
) -> tuple[GraspSearch, ...]:
    """Choice of a grasp for each object of a task; the last one has the scene with all of them.

    Args:
        scene: The perceived scene.
        geometry: The gripper's shape.
        friction: Coefficient of the pads.
        clearance_m: Clearance of planned paths.
        task: The task.
    """
    if scene.task.candidates is None:
        raise AssertionError("asked before: the task states candidates")
    return search_grasps(
        scene,
        geometry,
        scene.task.candidates,
        friction=friction,
        clearance_m=clearance_m,
        task=task,
        build=lambda tried: Workcell(tried, geometry, clearance_m=clearance_m, task=task),
    )


def with_grasp_of(scene: Scene, cell: Workcell) -> Scene:
    """Scene with the grasps chosen for the perceived scene.

    Args:
        scene: The true scene.
        cell: The workcell of the perceived one.
    """
    taken = cell.scene.grasps
    return scene.with_grasps(taken) if taken else scene
