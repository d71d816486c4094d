"""State costs of planner objectives."""

from __future__ import annotations

from functools import lru_cache

from rgss.kinematics import ArmDynamics
from rgss.motion import Objective, StateCost
from rgss.scenes import Scene
from rgss.trials.workcell import Workcell

_LEAST_CLEARANCE_M = 0.001


def state_cost(cell: Workcell, phase: str, objective: Objective | None) -> StateCost | None:
    """Cost of a state in a move; the objective sums its increases along a path.

    With d the distance between moving and fixed parts, at least 1 mm, it is 1/d in 1/m for `Objective.CLEARANCE`. For
    `Objective.MECHANICAL_WORK` it is the potential energy of the arm's links in J, without gripper and held object,
    since grippers of any mass share a plan.

    Args:
        cell: Scene, arm and collision models.
        phase: The move.
        objective: The planner's objective.
    """
    if objective is Objective.CLEARANCE:
        clearance_m = cell.planning[phase].clearance_m
        return lambda q: 1.0 / max(_LEAST_CLEARANCE_M, clearance_m(q))
    if objective is Objective.MECHANICAL_WORK:
        return _dynamics_of(cell.scene).potential_energy_j
    return None


@lru_cache(maxsize=4)
def _dynamics_of(scene: Scene) -> ArmDynamics:
    return ArmDynamics(scene.robot, (), gravity_m_s2=scene.gravity_m_s2)
