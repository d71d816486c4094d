"""Scene, arm and gripper for planning."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

from rgss.kinematics import Arm, CollisionContext, CollisionModel
from rgss.scenes import GripperGeometry, Scene
from rgss.tasks import TaskProgram
from rgss.trials.conditions import conditions_of
from rgss.trials.grasp_choice import GraspSearch, search_grasp
from rgss.trials.route import route_of
from rgss.trials.trial_spec import TrialSpec

_SHARE_KEPT = 0.25


class Workcell:
    """The arm's kinematics and the collision models of each move, for planning and for what runs.

    Building it costs more than a timed move, so that pieces with the same scene and gripper
    shape share it; it holds no state that a use changes.
    """

    def __init__(self, scene: Scene, geometry: GripperGeometry, *, clearance_m: float, task: TaskProgram) -> None:
        """Build the models.

        Args:
            scene: The scene with its robot.
            geometry: The gripper's shape.
            clearance_m: Distance that planned paths keep from everything.
            task: The task.
        """
        self.scene = scene
        self.geometry = geometry
        self.task = task
        self.arm = Arm(scene.robot, geometry.grasp_centre)
        self.route = route_of(scene, geometry, self.task)
        contexts = {leg.step.name: (leg.scene, leg.context) for leg in self.route.legs}
        self.planning: Mapping[str, CollisionModel] = _models(contexts, geometry, clearance_m)
        # Between two checked states, and where a held object gives way, some clearance may be lost.
        self.running: Mapping[str, CollisionModel] = _models(contexts, geometry, _SHARE_KEPT * clearance_m)


def _models(
    contexts: Mapping[str, tuple[Scene, CollisionContext]], geometry: GripperGeometry, clearance_m: float
) -> dict[str, CollisionModel]:
    """The collision model of each move; moves in the same context share one."""
    built: dict[tuple[Scene, CollisionContext], CollisionModel] = {}
    for scene, context in contexts.values():
        if (scene, context) not in built:
            built[scene, context] = CollisionModel(scene, geometry, context, clearance_m=clearance_m)
    return {name: built[key] for name, key in contexts.items()}


@lru_cache(maxsize=4)
def workcell_of(scene: Scene, geometry: GripperGeometry, clearance_m: float, task: TaskProgram) -> Workcell:
    """The workcell of a scene and a gripper shape, built once in a process.

    Args:
        scene: The scene with its robot.
        geometry: The gripper's shape.
        clearance_m: Distance that planned paths keep from everything.
        task: The task.
    """
    return Workcell(scene, geometry, clearance_m=clearance_m, task=task)


def cell_of(spec: TrialSpec) -> Workcell:
    """The workcell of a trial as the robot perceives it.

    Args:
        spec: The trial.
    """
    perceived, clearance_m = conditions_of(spec).perceived_scene, spec.settings.planning.clearance_m
    if perceived.task.candidates is not None:
        perceived = grasp_search_of(
            perceived,
            spec.gripper.geometry,
            friction=spec.gripper.grip_coefficient(1.0),
            clearance_m=clearance_m,
            task=spec.task,
        ).scene
    return workcell_of(perceived, spec.gripper.geometry, clearance_m, spec.task)


@lru_cache(maxsize=16)
def grasp_search_of(
    scene: Scene,
    geometry: GripperGeometry,
    *,
    friction: float,
    clearance_m: float,
    task: TaskProgram,
) -> GraspSearch:
    """The grasp that is taken of the candidates that a scene states.

    Args:
        scene: The scene as it is perceived.
        geometry: The gripper's shape.
        friction: Coefficient of the pads.
        clearance_m: Distance that planned paths keep from everything.
        task: The task.
    """
    if scene.task.candidates is None:
        raise AssertionError("asked before: the task states candidates")
    return search_grasp(
        scene,
        geometry,
        scene.task.candidates,
        friction=friction,
        build=lambda tried: Workcell(tried, geometry, clearance_m=clearance_m, task=task),
    )


def with_grasp_of(scene: Scene, cell: Workcell) -> Scene:
    """A scene with the grasp that was taken for the perceived one.

    Args:
        scene: The scene as it is.
        cell: The workcell of the perceived one.
    """
    taken = cell.scene.task.grasp
    return scene if taken is None else replace(scene, task=replace(scene.task, grasp=taken))
