"""A portfolio: at most k designs that together serve several tasks, each by the one that does it best."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING, Any

from rgss.errors import TradeoffError
from rgss.tradeoff.problem import TradeProblem
from rgss.tradeoff.program import AdditiveValue
from rgss.tradeoff.selection import INTEGRALITY_TOLERANCE
from rgss.tradeoff.stage import OBJECTIVE_SCALE, proven_gap, solve_program
from rgss.tradeoff.status import DecisionStatus
from rgss.tradeoff.values import TIE_TOLERANCE
from rgss.tradeoff.weighting import Weighting

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MOST_ENTRIES = 20_000_000
"""So many values of members in tasks are looked at to enumerate all portfolios and check the solver's answer."""


class FleetAim(str, Enum):
    """What a portfolio is judged by: the weighted mean of the tasks' values, or the worst of them."""

    MEAN = "mean"
    WORST = "worst"


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetTask:
    """One task or scene that is to be served.

    Attributes:
        name: Its name.
        weight: Its share in the mean.
        problem: The same alternatives with their evidence in this task, and what it demands.
    """

    name: str
    weight: float
    problem: TradeProblem


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetProblem:
    """Choose at most k designs, or kinds of designs, so that every task is served as well as possible.

    Attributes:
        tasks: The tasks.
        at_most: The largest number of members.
        groups: What counts as one member, by id of the alternative, such as the gripper that it
            has: then a member may serve each task by another alternative of its group. Every
            alternative counts by itself where there are none.
        aim: Mean or worst.

    Raises:
        TradeoffError: The problem is ill posed.
    """

    tasks: tuple[FleetTask, ...]
    at_most: int
    groups: Mapping[int, str] | None = field(default=None, hash=False)
    aim: FleetAim = FleetAim.MEAN

    def __post_init__(self) -> None:
        if not self.tasks:
            raise TradeoffError("a fleet without tasks has nothing to do", hint="name at least one task")
        names = [task.name for task in self.tasks]
        for name in names:
            if names.count(name) > 1:
                raise TradeoffError(f"task {name!r} is given twice", hint="keep one of them")
        if self.at_most < 1:
            raise TradeoffError(f"a fleet of at most {self.at_most} designs serves no task", hint="allow at least 1")
        Weighting(weights={task.name: task.weight for task in self.tasks})
        variants = [one.variant for one in self.tasks[0].problem.alternatives]
        for task in self.tasks:
            if not isinstance(task.problem.program, AdditiveValue):
                raise TradeoffError(
                    f"task {task.name!r} is decided by the {task.problem.program.name} program",
                    hint="a fleet is chosen by weighted value; use the additive program",
                )
            others = {one.variant for one in task.problem.alternatives}
            for variant in sorted(others.symmetric_difference(variants)):
                raise TradeoffError(
                    f"variant {variant} is not among the alternatives of every task",
                    hint="give every task the same designs",
                )
        for variant in variants:
            if self.groups is not None and variant not in self.groups:
                raise TradeoffError(f"variant {variant} belongs to no group", hint="give every variant its group")


@dataclass(frozen=True, slots=True, kw_only=True)
class Assignment:
    """Which alternative serves a task.

    Attributes:
        task: The task.
        member: The member of the fleet that the alternative belongs to.
        variant: The alternative.
        value: Its weighted value in this task.
    """

    task: str
    member: str
    variant: int
    value: float


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetDecision:
    """The outcome of choosing a fleet.

    Attributes:
        status: Optimal, or infeasible if no fleet of the size serves every task.
        members: The chosen members: of the tied best portfolios one with the fewest, and of these
            the first in the order of their smallest variants.
        assignments: Who serves each task.
        objective: Mean or worst value; None if infeasible.
        by_size: The best objective with at most 1, 2, … members; None where infeasible.
        unserved: Tasks that no alternative serves at all.
        gap: How far the bound that the solver proved is from its objective; None if infeasible.
        objective_recomputed: The objective of the chosen members in NumPy; None if infeasible.
        considered: How many members were left after exact reduction.
        enumeration_agrees: Whether enumeration of all portfolios comes to the same objective; None
            where there are too many.
    """

    status: DecisionStatus
    members: tuple[str, ...]
    assignments: tuple[Assignment, ...]
    objective: float | None
    by_size: tuple[float | None, ...]
    unserved: tuple[str, ...]
    gap: float | None
    objective_recomputed: float | None
    considered: int
    enumeration_agrees: bool | None


def decide_fleet(problem: FleetProblem) -> FleetDecision:
    """Choose the best portfolio and prove it.

    A member's value in a task is that of its best feasible alternative. ``max Σ_t w_t Σ_g h_gt x_gt``
    (or the least of ``Σ_g h_gt x_gt``) with ``Σ_g x_gt = 1``, ``x_gt <= y_g``, ``Σ_g y_g <= k``, y boolean:
    the facility-location model. A member that another is at least as good as in every task is left
    out before.

    Raises:
        TradeoffError: The solver failed or contradicts enumeration.
    """
    import numpy as np

    names, values, best_variants = _member_values(problem)
    weights = np.array([task.weight for task in problem.tasks])
    unserved = tuple(task.name for task, column in zip(problem.tasks, values.T, strict=True) if (column < 0.0).all())
    kept = _undominated(values)
    by_size: list[float | None] = []
    solved: tuple[tuple[int, ...], float, float] | None = None
    for size in range(1, min(problem.at_most, len(kept)) + 1):
        solved = _solved(values[kept], weights, size, problem.aim)
        by_size.append(None if solved is None else solved[1])
    by_size += by_size[-1:] * (problem.at_most - len(by_size))
    enumerated = _enumerated(values[kept], weights, problem.at_most, problem.aim)
    infeasible = FleetDecision(
        status=DecisionStatus.INFEASIBLE,
        members=(),
        assignments=(),
        objective=None,
        by_size=tuple(by_size),
        unserved=unserved,
        gap=None,
        objective_recomputed=None,
        considered=len(kept),
        enumeration_agrees=None if enumerated is None else enumerated[0] is None,
    )
    if solved is None:
        if enumerated is not None and enumerated[0] is not None:
            raise _contradiction(None, enumerated[1])
        return infeasible
    rows, objective, gap = solved
    agrees = None
    if enumerated is not None:
        members, best = enumerated
        if members is None or abs(best - objective) > TIE_TOLERANCE:
            raise _contradiction(objective, best)
        rows, agrees = members, True
    chosen = [int(kept[row]) for row in rows]
    recomputed = float(_objective(values[chosen], weights, problem.aim))
    if abs(recomputed - objective) > TIE_TOLERANCE:
        raise _contradiction(objective, recomputed)
    return FleetDecision(
        status=DecisionStatus.OPTIMAL,
        members=tuple(names[row] for row in chosen),
        assignments=tuple(
            _assignment(task, [(float(values[row, at]), -best_variants[row][at], names[row]) for row in chosen])
            for at, task in enumerate(problem.tasks)
        ),
        objective=objective,
        by_size=tuple(by_size),
        unserved=unserved,
        gap=gap,
        objective_recomputed=recomputed,
        considered=len(kept),
        enumeration_agrees=agrees,
    )


def _assignment(task: FleetTask, offers: list[tuple[float, int, str]]) -> Assignment:
    """The best offer of the members; of equals, the smallest id."""
    value, negated, member = max(offers)
    return Assignment(task=task.name, member=member, variant=-negated, value=value)


def _member_values(problem: FleetProblem) -> tuple[list[str], NDArray[np.float64], list[list[int]]]:
    """Every member's best value in every task, -1 where it cannot serve it, and by which alternative."""
    import numpy as np

    from rgss.tradeoff.enumeration import enumerate_alternatives

    enumerations = [enumerate_alternatives(task.problem) for task in problem.tasks]
    variants = enumerations[0].variants.tolist()
    offered = np.stack([np.where(one.feasible, one.values, -1.0) for one in enumerations], axis=1)
    rows: dict[str, list[int]] = {}
    for row, variant in enumerate(variants):
        rows.setdefault(str(variant) if problem.groups is None else problem.groups[variant], []).append(row)
    values = np.stack([offered[members].max(axis=0) for members in rows.values()])
    best = [[variants[members[at]] for at in offered[members].argmax(axis=0)] for members in rows.values()]
    return list(rows), values, best


def _undominated(values: NDArray[np.float64]) -> NDArray[np.intp]:
    """Members that no other is at least as good as in every task; of equals the first."""
    import numpy as np

    from rgss.tradeoff.dominance import nondominated

    _, first = np.unique(values, axis=0, return_index=True)
    rows = np.sort(first)
    return np.asarray(rows[nondominated(values[rows])], dtype=np.intp)


def _objective(values: NDArray[np.float64], weights: NDArray[np.float64], aim: FleetAim) -> Any:
    """The objective of portfolios, shape (..., members, tasks) to (...); negative where a task is not served."""
    import numpy as np

    best = values.max(axis=-2)
    served = (best >= 0.0).all(axis=-1)
    score = best @ weights if aim is FleetAim.MEAN else best.min(axis=-1)
    return np.where(served, score, -1.0)


def _solved(
    values: NDArray[np.float64], weights: NDArray[np.float64], at_most: int, aim: FleetAim
) -> tuple[tuple[int, ...], float, float] | None:
    """The chosen rows, the objective and the gap of the mixed-integer program; None if infeasible."""
    import cvxpy
    import numpy as np

    members, tasks = values.shape
    chosen = cvxpy.Variable(members, boolean=True)
    serves = cvxpy.Variable((members, tasks), nonneg=True)
    able = values >= 0.0
    constraints = [
        cvxpy.sum(serves, axis=0) == 1.0,
        serves <= cvxpy.multiply(able, chosen[:, None] @ np.ones((1, tasks))),
        cvxpy.sum(chosen) <= float(at_most),
    ]
    by_task = cvxpy.sum(cvxpy.multiply(np.where(able, values, 0.0), serves), axis=0)
    objective = weights @ by_task if aim is FleetAim.MEAN else cvxpy.min(by_task)
    program = cvxpy.Problem(cvxpy.Maximize(OBJECTIVE_SCALE * objective), constraints)
    if not solve_program(program):
        return None
    answer = np.asarray(chosen.value, dtype=np.float64)
    error = float(np.abs(answer - answer.round()).max())
    if error > INTEGRALITY_TOLERANCE:
        raise TradeoffError(
            f"the solver's answer selects no fleet (off by {error:.3g})",
            hint="the answer is not used; look for measures of extreme magnitude",
        )
    open_rows = np.flatnonzero(answer > 0.5)
    # The program may choose a member that is the best in no task; it is left out.
    rows = tuple(sorted({int(open_rows[place]) for place in values[open_rows].argmax(axis=0)}))
    return rows, float(_objective(values[list(rows)], weights, aim)), proven_gap(program) / OBJECTIVE_SCALE


def _enumerated(
    values: NDArray[np.float64], weights: NDArray[np.float64], at_most: int, aim: FleetAim
) -> tuple[tuple[int, ...] | None, float] | None:
    """The best portfolio of all, with the fewest members; None if there are too many to look at."""
    import numpy as np

    count = len(values)
    sizes = range(1, min(at_most, count) + 1)
    if sum(math.comb(count, size) * size for size in sizes) * values.shape[1] > MOST_ENTRIES:
        return None
    best: tuple[tuple[int, ...] | None, float] = (None, -1.0)
    for size in sizes:
        portfolios = np.array(list(itertools.combinations(range(count), size)), dtype=np.intp)
        scores = _objective(values[portfolios], weights, aim)
        top = float(scores.max())
        if top >= 0.0 and (best[0] is None or top > best[1] + TIE_TOLERANCE):
            place = int(np.flatnonzero(scores >= top - TIE_TOLERANCE)[0])
            best = (tuple(portfolios[place].tolist()), top)
    return best


def _contradiction(solver: float | None, ours: object) -> TradeoffError:
    theirs = "no fleet" if solver is None else f"a fleet of value {solver}"
    return TradeoffError(
        f"the solver finds {theirs}, enumeration finds {ours}",
        hint="no decision is made on contradictory answers; look for measures of extreme magnitude",
    )
