"""Costs of a state that a planner's objective may keep low."""

from __future__ import annotations

from functools import lru_cache

from rgss.kinematics import ArmDynamics
from rgss.motion import Objective, StateCost
from rgss.scenes import Scene
from rgss.trials.workcell import Workcell

_LEAST_CLEARANCE_M = 0.001


def state_cost(cell: Workcell, phase: str, objective: Objective | None) -> StateCost | None:
    """The cost of a state in a move, of which the objective takes the increases along a path.

    With d the distance from what moves to what stands, of at least 1 mm, it is 1/d in 1/m for `Objective.CLEARANCE`.
    For `Objective.MECHANICAL_WORK` it is the potential energy of the arm's links in J; the gripper and what it holds
    are left out, since a plan is shared by grippers of any mass.

    Args:
        cell: Scene, arm and collision models.
        phase: The move.
        objective: What the planner keeps low.
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
