"""Scene, arm and gripper for planning."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

from rgss.evidence import Phase
from rgss.kinematics import Arm, CollisionContext, CollisionModel
from rgss.scenes import CUP_LINK, GripperGeometry, Scene
from rgss.trials.conditions import conditions_of
from rgss.trials.trial_spec import TrialSpec

_SHARE_KEPT = 0.25


class Workcell:
    """The arm's kinematics and the collision models of each move, for planning and for what runs.

    Building it costs more than a timed move, so that pieces with the same scene and gripper
    shape share it; it holds no state that a use changes.
    """

    def __init__(self, scene: Scene, geometry: GripperGeometry, *, clearance_m: float) -> None:
        """Build the models.

        Args:
            scene: The scene with its robot.
            geometry: The gripper's shape.
            clearance_m: Distance that planned paths keep from everything.
        """
        self.scene = scene
        self.geometry = geometry
        self.arm = Arm(scene.robot, geometry.grasp_centre)
        found = situations(scene, geometry)
        self.planning: Mapping[Phase, CollisionModel] = {
            phase: CollisionModel(scene, geometry, situation, clearance_m=clearance_m)
            for phase, situation in found.items()
        }
        # Between two checked states, and where a held object gives way, some clearance may be lost.
        self.running: Mapping[Phase, CollisionModel] = {
            phase: CollisionModel(scene, geometry, situation, clearance_m=_SHARE_KEPT * clearance_m)
            for phase, situation in found.items()
        }


@lru_cache(maxsize=4)
def workcell_of(scene: Scene, geometry: GripperGeometry, clearance_m: float) -> Workcell:
    """The workcell of a scene and a gripper shape, built once in a process.

    Args:
        scene: The scene with its robot.
        geometry: The gripper's shape.
        clearance_m: Distance that planned paths keep from everything.
    """
    return Workcell(scene, geometry, clearance_m=clearance_m)


def cell_of(spec: TrialSpec) -> Workcell:
    """The workcell of a trial as the robot perceives it.

    Args:
        spec: The trial.
    """
    return workcell_of(conditions_of(spec).perceived_scene, spec.gripper.geometry, spec.settings.planning.clearance_m)


def situations(scene: Scene, geometry: GripperGeometry) -> dict[Phase, CollisionContext]:
    """Collision context of each move: the held object, or the pose of the standing one."""
    workpiece = scene.workpiece
    opening = geometry.largest_opening_m
    held = scene.grasp.inverse() @ workpiece.pose
    carrying = CollisionContext(
        opening_m=workpiece.shape.radius_m,
        carried=held,
        largest_tilt_rad=scene.task.largest_carry_tilt_rad,
    )
    leaving = replace(carrying, allowed=frozenset({(workpiece.id, scene.support)}))
    touched = frozenset({(workpiece.id, CUP_LINK)} if geometry.cup is not None else ())
    placed = (scene.place_pose @ held).raised(-scene.task.place_clearance_m)
    return {
        Phase.MOVE_TO_GRASP: CollisionContext(opening_m=opening, standing=workpiece.pose, allowed=touched),
        Phase.LIFT: leaving,
        Phase.MOVE_TO_GRASP_DEPARTURE: carrying,
        Phase.MOVE_TO_PLACE_APPROACH: carrying,
        Phase.MOVE_TO_PLACE: carrying,
        Phase.MOVE_TO_GRASP_APPROACH: CollisionContext(opening_m=opening, standing=placed, allowed=touched),
    }
