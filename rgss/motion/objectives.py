"""Optimisation objectives of OMPL over the cost of a state."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rgss.motion.engine import Engine


def objective_of(engine: Engine, information: Any, cost_of: Callable[[Any], float] | None) -> Any:
    """Optimisation objective whose cost threshold any path meets, so that a planner ends at its first path.

    Without a cost of states it is the path length in rad. With the cost c it is the *mechanical work* of Jaillet,
    Cortés and Siméon (2010), the criterion of TRRT: the sum of the increases of c along the path, to which OMPL adds
    1e-5 of its length.

    Args:
        engine: The planning engine.
        information: Space information; it must outlive the objective.
        cost_of: Cost of a state of the engine; None for the length of the path.
    """
    base = engine.base
    if cost_of is None:
        made = base.PathLengthOptimizationObjective(information)
    else:
        made = _work_against(engine, information, cost_of)
    # An optimising planner would run to its limit, and the result under a shorter limit would be unknown.
    made.setCostThreshold(base.Cost(float("inf")))
    return made


def _work_against(engine: Engine, information: Any, cost_of: Callable[[Any], float]) -> Any:
    base = engine.base

    class WorkAgainstCost(base.MechanicalWorkOptimizationObjective):  # type: ignore[misc, name-defined]
        """Mechanical-work objective over a cost of states."""

        def stateCost(self, state: Any) -> Any:  # noqa: N802 - the engine's name
            """The cost of a state."""
            return base.Cost(cost_of(state))

    return WorkAgainstCost(information)
