"""Portfolio decision: members, assignments and proofs."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.tradeoff.milp import Agreement, Check, DecisionStatus
from rgss.tradeoff.portfolio.work import Cut


@dataclass(frozen=True, slots=True, kw_only=True)
class Assignment:
    """Assignment of an alternative to a task.

    Attributes:
        task: The task.
        member: The member of the portfolio that the alternative belongs to.
        variant: The alternative.
        value: Its weighted value in this task.
    """

    task: str
    member: str
    variant: int
    value: float


@dataclass(frozen=True, slots=True, kw_only=True)
class PortfolioDecision:
    """Outcome of the choice of a portfolio.

    Attributes:
        status: Optimal; best found if a limit ended the proof; infeasible if no portfolio of the size serves every
        task; undecided if a limit ended the search.
        members: The chosen members: of the tied best portfolios one with the fewest, and of these, if all were
        enumerated, the first in the order of their smallest variants.
        assignments: Member that serves each task.
        objective: Mean or worst value; None if there is none.
        by_size: The best objective found with at most 1, 2, … members, non-decreasing; None if there is none.
        by_size_gap: Greatest possible improvement for each size; None if none was found.
        unserved: Tasks that no alternative serves at all.
        gap: Distance of the proven bound from the objective; None if there is none. objective_recomputed: The objective
        of the chosen members in NumPy; None if there is none.
        considered: Number of members after exact reduction.
        enumeration_agrees: Whether enumeration of all portfolios gives the same objective.
        checks: The independent checks.
        cut: The limit that ended a proof; None if all are complete. Under a time limit the result depends on the
        machine.
    """

    status: DecisionStatus
    members: tuple[str, ...]
    assignments: tuple[Assignment, ...]
    objective: float | None
    by_size: tuple[float | None, ...]
    by_size_gap: tuple[float | None, ...]
    unserved: tuple[str, ...]
    gap: float | None
    objective_recomputed: float | None
    considered: int
    enumeration_agrees: Agreement
    checks: tuple[Check, ...]
    cut: Cut | None
