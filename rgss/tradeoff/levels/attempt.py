"""Solver run on a stage over levels, and its checks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from rgss.tradeoff.levels.bound import IntervalBound
from rgss.tradeoff.levels.grid import Designs
from rgss.tradeoff.milp import Check, CheckKind, SolverRun
from rgss.tradeoff.problem import TIE_TOLERANCE


class Outcome(str, Enum):
    """Outcome of one run of the solver; ended is one that exceeded its limit of time."""

    PROVEN = "proven"
    INFEASIBLE = "infeasible"
    FAILED = "failed"
    ENDED = "not finished"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Attempt:
    """One run of the solver on a stage.

    Attributes:
        run: The options.
        outcome: Its outcome.
        score: The objective of the selected design, recomputed; minus infinity if there is none.
        design: The selected design, shape (f,); None if there is none.
        gap: The gap proven by the solver.
        selection_error: Distance of its variables from the design.
    """

    run: SolverRun
    outcome: Outcome
    score: float = -math.inf
    design: Designs | None = None
    gap: float = 0.0
    selection_error: float = 0.0

    def confirms(self, best: float) -> bool:
        """True if the run proved the best known objective, or infeasibility."""
        if self.outcome is Outcome.INFEASIBLE:
            return best == -math.inf
        return self.outcome is Outcome.PROVEN and self.score >= best - tolerance_at(best)


@dataclass(slots=True)
class BestKnown:
    """The best design that is known while a stage is decided.

    Attributes:
        score: Its objective; minus infinity while none is known.
        design: The design, shape (f,).
    """

    score: float = -math.inf
    design: Designs | None = None

    def take(self, found: tuple[float, Designs] | None) -> bool:
        """Keep an objective with its design if it is better; returns True if it is."""
        if found is None or not found[0] > self.score + tolerance_at(self.score):
            return False
        self.score, self.design = found
        return True

    def take_from(self, attempt: Attempt) -> None:
        """Keep the design of a run if it is better."""
        if attempt.design is not None:
            self.take((attempt.score, attempt.design))

    def prefer(self, attempt: Attempt) -> None:
        """Keep the design of a run if it is as good, so that the checks change an answer only where it is wrong."""
        if attempt.design is not None and attempt.score >= self.score - tolerance_at(self.score):
            self.score, self.design = attempt.score, attempt.design


def tolerance_at(best: float) -> float:
    """The difference up to which an objective is as good as another."""
    return TIE_TOLERANCE * max(1.0, abs(best)) if math.isfinite(best) else 0.0


def enumeration_check(size: int, attempts: Sequence[Attempt], best: float) -> Check:
    """Comparison of the solver with all combinations.

    Args:
        size: The number of combinations.
        attempts: The runs in their order, of which at most the last confirms the best of all combinations.
        best: The best objective; minus infinity if nothing is feasible.
    """
    ended = sum(one.outcome is Outcome.ENDED for one in attempts)
    agrees: bool | None = attempts[-1].confirms(best)
    wrong = len(attempts) - ended - int(bool(agrees))
    detail = f"all {size} combinations evaluated"
    if not agrees and not wrong:
        agrees = None
        detail += f"; {_runs(ended)} of the solver exceeded the limit, the best of the enumeration is used"
    elif not agrees:
        detail += "; the solver's answer is wrong with all options, the best of the enumeration is used"
    elif wrong:
        detail += f"; {_runs(wrong)} of the solver came to another answer and was discarded"
    if ended and agrees is not None:
        detail += f"; {_runs(ended)} exceeded the limit"
    return Check(kind=CheckKind.ENUMERATION, agrees=agrees, detail=detail)


def run_check(attempts: Sequence[Attempt], best: float) -> Check:
    """Comparison of the runs of the solver with each other."""
    confirming = [one.run.name for one in attempts if one.confirms(best)]
    others = [one for one in attempts if not one.confirms(best)]
    detail = f"confirmed by {', '.join(confirming) or 'no run'}"
    if others:
        detail += f"; not by {', '.join(f'{one.run.name}: {one.outcome.value}' for one in others)}"
    return Check(kind=CheckKind.SECOND_RUN, agrees=_verdict(others), detail=detail)


def opinion_check(attempt: Attempt, best: float) -> Check:
    """Comparison with the run of another solver."""
    others = [] if attempt.confirms(best) else [attempt]
    other = f": {attempt.outcome.value}" + (
        f" {attempt.score:.9g}, not {best:.9g}" if attempt.design is not None else ""
    )
    detail = f"{attempt.run.name}{other if others else ' comes to the same answer'}"
    return Check(kind=CheckKind.INDEPENDENT_SOLVER, agrees=_verdict(others), detail=detail)


def search_check(attempt: Attempt, best: float) -> Check:
    """Comparison of the first run with the best that the primal search met."""
    if attempt.outcome is Outcome.ENDED:
        detail, agrees = f"{attempt.run.name} exceeded its limit; there is no answer to compare with", None
    elif attempt.outcome is Outcome.FAILED:
        detail, agrees = f"{attempt.run.name} gave no answer; the search's is used", False
    elif attempt.score >= best - tolerance_at(best):
        detail, agrees = "nothing better was found", True
    else:
        detail, agrees = f"found a better design than {attempt.run.name}", False
    return Check(kind=CheckKind.PRIMAL_SEARCH, agrees=agrees, detail=detail)


def bound_check(bound: IntervalBound, attempt: Attempt, best: float) -> Check:
    """Comparison of the first run with interval branch and bound.

    Args:
        bound: The bound.
        attempt: The first run.
        best: The best objective of all that is known.
    """
    found = bound.better is not None
    agrees = not found or attempt.confirms(best) or attempt.outcome is Outcome.ENDED
    if found:
        detail = "interval branch and bound found a better design"
        detail += " than the primal search" if agrees else ""
    elif bound.complete:
        detail = "interval branch and bound leaves no better design"
    else:
        # Of a stage without any feasible design there is no bound to compare.
        over = f" exceeds the answer by {bound.bound - best:.3g}" if math.isfinite(best) else " is open"
        detail = f"interval branch and bound not completed; its bound{over}"
    return Check(kind=CheckKind.DUAL_BOUND, agrees=agrees, detail=detail)


def _verdict(others: Sequence[Attempt]) -> bool | None:
    """True if the runs that do not confirm an answer contradict it; None where all of them were only ended."""
    if not others:
        return True
    return None if all(one.outcome is Outcome.ENDED for one in others) else False


def _runs(count: int) -> str:
    return "1 run" if count == 1 else f"{count} runs"
