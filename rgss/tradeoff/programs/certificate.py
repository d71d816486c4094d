"""Certificate of a decision: the solver's answer re-evaluated and checked independently."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from rgss.tradeoff.milp import Agreement, Check, CheckKind, DecisionStatus
from rgss.tradeoff.problem import TIE_TOLERANCE

if TYPE_CHECKING:
    from rgss.tradeoff.milp import StageSolution
    from rgss.tradeoff.problem import Alternative
    from rgss.tradeoff.programs.enumeration import Enumeration
    from rgss.tradeoff.programs.preferences import Preferences


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
    """Proof of the solver for one stage.

    Attributes:
        name: Name of the objective.
        variant: The alternative that it selected.
        objective: The objective, as people read it.
        gap: Distance of the bound that the solver proved from it.
    """

    name: str
    variant: int
    objective: float
    gap: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Certificate:
    """Certificate of a decision: recomputed objective and constraints, agreement, gap.

    Attributes:
        status: Proven status; best found if a stage's optimality was not proven.
        solver: The solver; if independent ones were run too, those with this result.
        program: The program.
        alternatives: Number of alternatives of the problem.
        considered: Number of them in the program after exact reduction.
        stages: Proven results of the stages, in turn; empty if infeasible.
        solver_choice: The alternative that the solver selected last, one of the tied; None if
            infeasible.
        objective: The solver's objective of the last stage; None if infeasible.
        objective_recomputed: The objective recomputed in NumPy from the evidence; None if infeasible or unknown.
        gap: Excess of the best feasible alternative of the enumeration over the choice; 0 within the tolerance of ties;
        without enumeration, the greatest possible improvement by the proven bound. None if infeasible, or if the choice
        is not feasible.
        residuals: The constraints at the solver's choice; empty if infeasible.
        enumeration_agrees: True if exhaustive enumeration was made and agrees with the solver: the same status, and for
        an optimum the solver's choice is among the tied best, with the same objective and without a violation.
        recomputation_agrees: Agreement among the evaluated alternatives.
        checks: The independent checks.
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
    enumeration_agrees: Agreement
    recomputation_agrees: bool
    checks: tuple[Check, ...]


def certify(
    preferences: Preferences,
    enumeration: Enumeration,
    solutions: Sequence[StageSolution],
    *,
    considered: int,
    whole: bool = True,
) -> Certificate:
    """Compare the solver's answer with the evidence and with enumeration.

    Args:
        preferences: Preferences that the alternatives are compared by.
        enumeration: Every alternative evaluated, or those that are known.
        solutions: The solver's answers, stage by stage; of an infeasible problem the one that shows it.
        considered: Number of alternatives in the program.
        whole: Whether the enumeration has every alternative.

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
    enumerated, checks = _checks(solutions, agrees=agrees, enumerated=len(enumeration.table) if whole else None)
    best_found = last.alternative is not None and any(one.status is DecisionStatus.BEST_FOUND for one in solutions)
    return Certificate(
        status=DecisionStatus.BEST_FOUND if best_found else last.status,
        solver=" and ".join(agreeing_solvers(solutions)),
        program=preferences.program.name,
        alternatives=len(enumeration.table) if whole else considered,
        considered=considered,
        stages=stage_certificates(solutions),
        solver_choice=None if last.alternative is None else last.alternative.variant,
        objective=last.objective,
        objective_recomputed=recomputed,
        gap=gap if whole else _unproven_gap(solutions),
        residuals=residuals,
        enumeration_agrees=enumerated,
        recomputation_agrees=agrees,
        checks=checks,
    )


def agreeing_solvers(solutions: Sequence[StageSolution]) -> tuple[str, ...]:
    """Solvers with the result of every stage."""
    every = set.intersection(*(set(solution.solvers) for solution in solutions))
    return tuple(solver for solver in solutions[-1].solvers if solver in every) or ("no solver",)


def _unproven_gap(solutions: Sequence[StageSolution]) -> float | None:
    """Gap of the last stage, plus the possible effect of unproven earlier stages; None if infeasible."""
    last = solutions[-1].gap
    earlier = [one.gap for one in solutions[:-1] if one.status is DecisionStatus.BEST_FOUND and one.gap is not None]
    return None if last is None else last + max(earlier, default=0.0)


def _checks(
    solutions: Sequence[StageSolution], *, agrees: bool, enumerated: int | None
) -> tuple[Agreement, tuple[Check, ...]]:
    """Agreement with enumeration, and every check that was made, with the stage where there are several."""
    checks = [
        replace(check, detail=f"{solution.name}: {check.detail}") if len(solutions) > 1 else check
        for solution in solutions
        for check in solution.checks
    ]
    if enumerated is not None:
        detail = f"the whole program evaluated at {enumerated} alternatives"
        checks.append(Check(kind=CheckKind.ENUMERATION, agrees=agrees, detail=detail))
    elif not all(solution.exhaustive for solution in solutions):
        return Agreement.NOT_ENUMERATED, tuple(checks)
    compared = [check.agrees for check in checks if check.kind is CheckKind.ENUMERATION]
    if False in compared:
        return Agreement.DISAGREED, tuple(checks)
    return Agreement.NOT_COMPARED if None in compared else Agreement.AGREED, tuple(checks)


def stage_certificates(solutions: Sequence[StageSolution]) -> tuple[StageCertificate, ...]:
    """Proofs of the solver by stage; empty if something was infeasible."""
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
        preferences: Preferences that the alternatives are compared by.
        choice: The alternative.
        selection_error: Distance of the solver's variables from selecting exactly it.
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
