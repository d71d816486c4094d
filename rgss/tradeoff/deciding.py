"""From a trade-off to a certified decision."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.errors import TradeoffError
from rgss.tradeoff.certificate import Certificate, certify
from rgss.tradeoff.conflicts import find_conflicts
from rgss.tradeoff.decision import Decision
from rgss.tradeoff.problem import TradeProblem
from rgss.tradeoff.program import choice_program
from rgss.tradeoff.reduction import reduced_alternatives

if TYPE_CHECKING:
    from rgss.tradeoff.enumeration import Enumeration


def decide(problem: TradeProblem) -> Decision:
    """Choose the best feasible alternative, prove it, and explain it.

    The mixed-integer program is solved to optimality and the answer is held against enumeration.
    Of alternatives tied within 1e-9 the solver may return any; the decision is the smallest id.

    Args:
        problem: The trade-off.

    Returns:
        The decision. That nothing is feasible is a decision too, with the status infeasible.

    Raises:
        TradeoffError: The solver failed, proved neither optimality nor infeasibility, or
            contradicts enumeration; no decision is made then.
    """
    # Imported here so that the package itself loads without NumPy.
    from rgss.tradeoff.enumeration import enumerate_alternatives
    from rgss.tradeoff.explanation import contributions, excluded_better, find_runner_up, infeasible_alternatives, rank

    enumeration = enumerate_alternatives(problem)
    considered = reduced_alternatives(problem)
    solution = choice_program(problem, considered).solve()
    certificate = certify(problem, enumeration, solution, considered=len(considered))
    if not certificate.enumeration_agrees:
        raise _disagreement(enumeration, certificate)

    ties = tuple(int(variant) for variant in enumeration.variants[enumeration.tied])
    ranking = rank(enumeration)
    chosen = ties[0] if ties else None
    runner_up = find_runner_up(ranking, ties)
    better, deciding_requirements = excluded_better(enumeration)
    return Decision(
        status=certificate.status,
        chosen=chosen,
        runner_up=runner_up,
        ties=ties,
        ranking=ranking,
        infeasible=infeasible_alternatives(enumeration),
        excluded_better=better,
        deciding_requirements=deciding_requirements,
        chosen_contributions=contributions(problem, chosen),
        runner_up_contributions=contributions(problem, runner_up),
        conflicts=find_conflicts(enumeration),
        certificate=certificate,
    )


def _disagreement(enumeration: Enumeration, certificate: Certificate) -> TradeoffError:
    best = enumeration.best_value
    ours = "nothing feasible" if best is None else f"variant {int(enumeration.variants[enumeration.tied][0])} ({best})"
    theirs = (
        "nothing feasible"
        if certificate.solver_choice is None
        else f"variant {certificate.solver_choice} ({certificate.objective})"
    )
    return TradeoffError(
        f"the solver finds {theirs}, enumeration finds {ours}",
        hint="no decision is made on contradictory answers; look for measures of extreme magnitude",
    )
