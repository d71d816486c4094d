"""The certificate of a decision: the solver's answer recomputed and held against enumeration."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rgss.tradeoff.status import DecisionStatus
from rgss.tradeoff.values import TIE_TOLERANCE

if TYPE_CHECKING:
    from rgss.tradeoff.enumeration import Enumeration
    from rgss.tradeoff.evidence_table import Alternative
    from rgss.tradeoff.preferences import Preferences
    from rgss.tradeoff.stage import StageSolution


@dataclass(frozen=True, slots=True, kw_only=True)
class ConstraintResidual:
    """One constraint of the program, recomputed at the solver's choice.

    Attributes:
        name: The constraint, such as ``SYS-012: P_max >= 0.8 kg``.
        residual: By how much it is violated, in the unit of its limit; 0 where it holds.
        margin: How far the choice is on the good side of a limit, in that unit; None for
            constraints that are not limits, and where the statistic is unknown.
    """

    name: str
    residual: float
    margin: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class StageCertificate:
    """What the solver proved of one stage.

    Attributes:
        name: What was optimised.
        variant: The alternative that it selected.
        objective: The objective, as people read it.
        gap: How far the bound that the solver proved is from it.
    """

    name: str
    variant: int
    objective: float
    gap: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Certificate:
    """Why a decision can be trusted.

    Attributes:
        status: What the solver proved.
        solver: Which solver.
        program: Which program.
        alternatives: How many alternatives the problem has.
        considered: How many of them the program held after exact reduction.
        stages: What was proved in turn; empty if infeasible.
        solver_choice: The alternative that the solver selected last, one of the tied; None if
            infeasible.
        objective: The last stage's objective as the solver has it; None if infeasible.
        objective_recomputed: The same in NumPy from the evidence; None if infeasible or unknown.
        gap: How much better the best feasible alternative of the enumeration is; 0 up to the
            tolerance of ties; None if infeasible, or if the choice is not even feasible.
        residuals: The constraints at the solver's choice; empty if infeasible.
        enumeration_agrees: Enumeration comes to the same status, and for an optimum: the solver's
            choice is among the tied best, its objective is right and it violates nothing.
    """

    status: DecisionStatus
    solver: str
    program: str
    alternatives: int
    considered: int
    stages: tuple[StageCertificate, ...]
    solver_choice: int | None
    objective: float | None
    objective_recomputed: float | None
    gap: float | None
    residuals: tuple[ConstraintResidual, ...]
    enumeration_agrees: bool


def certify(
    preferences: Preferences, enumeration: Enumeration, solutions: Sequence[StageSolution], *, considered: int
) -> Certificate:
    """Hold the solver's answer against the evidence and against enumeration.

    Args:
        preferences: What is wanted.
        enumeration: Every alternative evaluated.
        solutions: The solver's answers, stage by stage; of an infeasible problem the one that says so.
        considered: How many alternatives the program held.

    Returns:
        The certificate, whether or not the two agree.
    """
    last = solutions[-1]
    recomputed = gap = None
    residuals: tuple[ConstraintResidual, ...] = ()
    feasible = enumeration.feasible
    if last.alternative is None or last.objective is None:
        agrees = not feasible.any()
    else:
        row = enumeration.table.row_of(last.alternative.variant)
        recomputed = enumeration.ordering.at(row)[-1]
        recomputed = None if math.isnan(recomputed) else recomputed
        gap = enumeration.ordering.shortfall(row, feasible)
        residuals = residuals_at(preferences, last.alternative, selection_error=last.selection_error)
        agrees = (
            bool(enumeration.tied[row])
            and recomputed is not None
            and math.isclose(last.objective, recomputed, rel_tol=TIE_TOLERANCE, abs_tol=TIE_TOLERANCE)
            and all(residual.residual == 0.0 for residual in residuals[1:])
        )
    return Certificate(
        status=last.status,
        solver="HIGHS",
        program=preferences.program.name,
        alternatives=len(enumeration.table),
        considered=considered,
        stages=stage_certificates(solutions),
        solver_choice=None if last.alternative is None else last.alternative.variant,
        objective=last.objective,
        objective_recomputed=recomputed,
        gap=gap,
        residuals=residuals,
        enumeration_agrees=agrees,
    )


def stage_certificates(solutions: Sequence[StageSolution]) -> tuple[StageCertificate, ...]:
    """What the solver proved stage by stage; empty if something was infeasible."""
    found = []
    for solution in solutions:
        if solution.alternative is None or solution.objective is None or solution.gap is None:
            return ()
        found.append(
            StageCertificate(
                name=solution.name,
                variant=solution.alternative.variant,
                objective=solution.objective,
                gap=solution.gap,
            )
        )
    return tuple(found)


def residuals_at(
    preferences: Preferences, choice: Alternative, *, selection_error: float
) -> tuple[ConstraintResidual, ...]:
    """Every constraint of a program recomputed at an alternative.

    Args:
        preferences: What is wanted.
        choice: The alternative.
        selection_error: How far the solver's variables are from selecting exactly it.
    """
    residuals = [ConstraintResidual(name="choose exactly one", residual=selection_error, margin=None)]
    for condition in preferences.conditions:
        statistic = condition.statistic(choice)
        margin = None if statistic is None else condition.sense.margin(statistic, condition.limit)
        met = condition.sense.holds(statistic, condition.limit)
        residual = 0.0 if met else math.inf if margin is None else -margin
        residuals.append(ConstraintResidual(name=condition.name, residual=residual, margin=margin))
    for constraint, (measure, every_replicate) in zip(
        preferences.constraints[len(preferences.conditions) :], preferences.evidence_needs.items(), strict=True
    ):
        unknown = choice.measures[measure] is None or (every_replicate and None in (choice.replicates(measure) or ()))
        residuals.append(ConstraintResidual(name=constraint.name, residual=float(unknown), margin=None))
    return tuple(residuals)
