"""The certificate of a decision: the solver's answer recomputed and held against enumeration."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rgss.tradeoff.problem import EVIDENCE_PREFIX, TradeProblem
from rgss.tradeoff.status import DecisionStatus
from rgss.tradeoff.values import TIE_TOLERANCE

if TYPE_CHECKING:
    from rgss.tradeoff.enumeration import Enumeration
    from rgss.tradeoff.program import Solution


@dataclass(frozen=True, slots=True, kw_only=True)
class ConstraintResidual:
    """One constraint of the program, recomputed at the solver's choice.

    Attributes:
        name: The constraint, such as ``SYS-012: P_max >= 0.8 kg``.
        residual: By how much it is violated, in the measure's unit; 0 where it holds.
        margin: How far the choice is on the good side of a threshold, in the measure's unit; None
            for constraints that are not thresholds, and where the measure is unknown.
    """

    name: str
    residual: float
    margin: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Certificate:
    """Why a decision can be trusted.

    Attributes:
        status: What the solver proved.
        solver: Which solver.
        alternatives: How many alternatives the problem has.
        considered: How many of them the program held after exact reduction.
        solver_choice: The alternative that the solver selected, one of the tied; None if
            infeasible.
        objective: Its value as the solver has it; None if infeasible.
        objective_recomputed: The same in NumPy from the evidence; None if infeasible or unknown.
        gap: How much better the best feasible alternative of the enumeration is; 0 up to the
            tolerance of ties; None if infeasible.
        residuals: The constraints at the solver's choice; empty if infeasible.
        enumeration_agrees: Enumeration comes to the same status, and for an optimum: the solver's
            choice is among the tied best, its objective is right and it violates nothing.
    """

    status: DecisionStatus
    solver: str
    alternatives: int
    considered: int
    solver_choice: int | None
    objective: float | None
    objective_recomputed: float | None
    gap: float | None
    residuals: tuple[ConstraintResidual, ...]
    enumeration_agrees: bool


def certify(problem: TradeProblem, enumeration: Enumeration, solution: Solution, *, considered: int) -> Certificate:
    """Hold the solver's answer against the evidence and against enumeration.

    Args:
        problem: The trade-off.
        enumeration: Every alternative evaluated.
        solution: The solver's answer.
        considered: How many alternatives the program held.

    Returns:
        The certificate, whether or not the two agree.
    """
    best = enumeration.best_value
    recomputed = gap = None
    residuals: tuple[ConstraintResidual, ...] = ()
    if solution.variant is None or solution.objective is None:
        agrees = best is None
    else:
        recomputed = enumeration.value_of(solution.variant)
        residuals = _residuals(problem, solution)
        agrees = (
            best is not None
            and recomputed is not None
            and solution.variant in enumeration.variants[enumeration.tied]
            and abs(solution.objective - recomputed) <= TIE_TOLERANCE
            and not enumeration.violated_by(solution.variant)
            and all(residual.residual == 0.0 for residual in residuals if residual.margin is not None)
        )
        if best is not None and recomputed is not None:
            gap = best - recomputed
    return Certificate(
        status=solution.status,
        solver="HIGHS",
        alternatives=len(problem.alternatives),
        considered=considered,
        solver_choice=solution.variant,
        objective=solution.objective,
        objective_recomputed=recomputed,
        gap=gap,
        residuals=residuals,
        enumeration_agrees=bool(agrees),
    )


def _residuals(problem: TradeProblem, solution: Solution) -> tuple[ConstraintResidual, ...]:
    choice = next(alternative for alternative in problem.alternatives if alternative.variant == solution.variant)
    residuals = [ConstraintResidual(name="choose exactly one", residual=solution.selection_error, margin=None)]
    for threshold in problem.thresholds:
        quantity = choice.measures[threshold.measure]
        margin = None if quantity is None else threshold.margin(quantity)
        residual = math.inf if margin is None else max(0.0, -margin)
        residuals.append(ConstraintResidual(name=threshold.name, residual=residual, margin=margin))
    for measure in problem.evidence_measures:
        unknown = float(choice.measures[measure] is None)
        residuals.append(ConstraintResidual(name=EVIDENCE_PREFIX + measure, residual=unknown, margin=None))
    return tuple(residuals)
