"""A stage solver over levels whose answers are checked by methods that share nothing with the solver."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np

from rgss.errors import TradeoffError
from rgss.tradeoff.levels.bound import IntervalBound, interval_bound
from rgss.tradeoff.levels.grid import Designs, LevelGrid
from rgss.tradeoff.levels.search import search_levels
from rgss.tradeoff.levels.selection import LevelModel
from rgss.tradeoff.milp import (
    RUNS,
    Check,
    CheckKind,
    DecisionStatus,
    Exclusion,
    SolverRun,
    Stage,
    StageSolution,
    StageSolver,
    proven_gap,
    solve_program,
)
from rgss.tradeoff.problem import TIE_TOLERANCE, Alternative

MOST_EXCLUDED = 20
"""So many designs that the solver's tolerance lets pass are excluded one after another."""

NEEDED = 2
"""So many runs of the solver have to come to an answer that nothing else proves."""


class Outcome(str, Enum):
    """Outcome of one run of the solver."""

    PROVEN = "proven"
    INFEASIBLE = "infeasible"
    FAILED = "failed"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Attempt:
    """One run of the solver on a stage.

    Attributes:
        run: The options.
        outcome: What it came to.
        score: The objective of the selected design, recomputed; minus infinity if there is none.
        design: The selected design, shape (f,); None if there is none.
        gap: The gap that the solver proved.
        selection_error: How far its variables are from the design.
    """

    run: SolverRun
    outcome: Outcome
    score: float = -math.inf
    design: Designs | None = None
    gap: float = 0.0
    selection_error: float = 0.0

    def confirms(self, best: float) -> bool:
        """Whether the run proved what the best known objective is, or that there is none."""
        if self.outcome is Outcome.INFEASIBLE:
            return best == -math.inf
        return self.outcome is Outcome.PROVEN and self.score >= best - tolerance_at(best)


@dataclass(frozen=True, slots=True, kw_only=True)
class GuardedStageSolver(StageSolver):
    """Solves stages over levels, and repairs what the solver gets wrong.

    Where all combinations can be evaluated, the answer is compared with them. Elsewhere a second run with
    other options, a primal search and interval branch and bound check it. The best design that any of them
    found is the answer; it is called optimal where exhaustive evaluation, interval branch and bound, or two
    runs of the solver prove it, and best found elsewhere.

    Attributes:
        grid: The tables as arrays.
        model: What the variables stand for.
        exhaustive: Whether all combinations are evaluated.
        known: Feasible designs of earlier stages, from which the search starts.
        independent: Runs of other solvers than HiGHS. Each is made on every stage, and where neither enumeration
            nor interval branch and bound proves the answer, counts as one of the runs that have to agree.
    """

    grid: LevelGrid
    model: LevelModel
    exhaustive: bool
    known: list[Designs] = field(default_factory=list, hash=False)
    independent: tuple[SolverRun, ...] = ()

    def solve(self, stage: Stage) -> StageSolution:
        """Solve a stage.

        Raises:
            TradeoffError: Neither a feasible design was found nor that there is none was proved.
        """
        solution = self._compared_with_all(stage) if self.exhaustive else self._searched(stage)
        if solution.alternative is not None:
            self.known.append(self._places(solution.alternative))
        return solution

    def _compared_with_all(self, stage: Stage) -> StageSolution:
        found = self.grid.best(stage, self.constraints)
        best = -math.inf if found is None else found[0]
        attempt, wrong = self._attempt(stage, RUNS[0]), 0
        for run in RUNS[1:]:
            if attempt.confirms(best):
                break
            attempt, wrong = self._attempt(stage, run), wrong + 1
        agrees = attempt.confirms(best)
        detail = f"all {self.grid.size} combinations evaluated"
        if not agrees:
            detail += "; the solver's answer is wrong with all options, the best of the enumeration is used"
        elif wrong:
            detail += f"; {_runs(wrong)} of the solver came to another answer and was discarded"
        opinions = [self._attempt(stage, run) for run in self.independent]
        checks = (
            Check(kind=CheckKind.ENUMERATION, agrees=agrees, detail=detail),
            *(_opinion_check(one, best) for one in opinions),
        )
        solvers = self._agreeing([attempt, *opinions], best)
        if found is None:
            return _infeasible(stage, checks, exhaustive=True, solvers=solvers)
        if agrees and attempt.design is not None:
            return self._solution(
                stage, attempt.design, DecisionStatus.OPTIMAL, attempt, checks, gap=attempt.gap, solvers=solvers
            )
        return self._solution(stage, found[1], DecisionStatus.OPTIMAL, None, checks, gap=0.0, solvers=solvers)

    def _searched(self, stage: Stage) -> StageSolution:
        attempts = [self._attempt(stage, RUNS[0])]
        best, design = self._improved(stage, attempts)
        checks = [_search_check(attempts[0], best)]
        bound = interval_bound(self.grid, stage, self.constraints, known=best, tolerance=tolerance_at(best))
        if bound.better is not None:
            best, design = bound.bound, bound.better
        opinions = [self._attempt(stage, run) for run in self.independent]
        for one in opinions:
            if one.score > best + tolerance_at(best):
                best, design = one.score, one.design
        if not bound.complete:
            # What interval branch and bound does not prove, two runs of the solver have to agree on.
            for run in RUNS[1:]:
                attempts.append(self._attempt(stage, run))
                if attempts[-1].score > best + tolerance_at(best):
                    best, design = attempts[-1].score, attempts[-1].design
                if sum(one.confirms(best) for one in (*attempts, *opinions)) >= NEEDED + len(opinions):
                    break
            checks.append(_run_check(attempts, best))
        checks.append(_bound_check(bound, best))
        checks += [_opinion_check(one, best) for one in opinions]
        confirming = [one for one in (*attempts, *opinions) if one.confirms(best)]
        proven = bound.complete or len(confirming) >= NEEDED
        solvers = self._agreeing([*attempts, *opinions], best)
        if design is None:
            if proven:
                return _infeasible(stage, tuple(checks), exhaustive=False, solvers=solvers)
            raise TradeoffError(
                f"stage {stage.name!r}: no feasible design was found, and that there is none was not proved",
                hint="relax a requirement, or look for measures of extreme magnitude",
            )
        gap = max(0.0, bound.bound - best)
        if proven:
            gap = 0.0 if bound.complete else max((one.gap for one in confirming), default=0.0)
        same = next((one for one in confirming if one.design is not None and (one.design == design).all()), None)
        status = DecisionStatus.OPTIMAL if proven else DecisionStatus.BEST_FOUND
        return self._solution(stage, design, status, same, tuple(checks), gap=gap, solvers=solvers)

    def _agreeing(self, attempts: Sequence[Attempt], best: float) -> tuple[str, ...]:
        """The solvers of the runs that came to the answer; HiGHS where no other was run."""
        if not self.independent:
            return (RUNS[0].solver,)
        return tuple(dict.fromkeys(one.run.solver for one in attempts if one.confirms(best)))

    def _improved(self, stage: Stage, attempts: Sequence[Attempt]) -> tuple[float, Designs | None]:
        """The best of the solver's design and of those that the primal search meets."""
        designs = [one.design for one in attempts if one.design is not None]
        found = search_levels(self.grid, stage, self.constraints, [*self.known, *designs])
        best, design = (-math.inf, None) if found is None else found
        for one in attempts:
            # Of equals the solver's, so that the search changes an answer only where it is wrong.
            if one.design is not None and one.score >= best - tolerance_at(best):
                best, design = one.score, one.design
        return best, design

    def _attempt(self, stage: Stage, run: SolverRun) -> Attempt:
        """One run of the solver; what its tolerances let pass and is not feasible is excluded."""
        excluded: tuple[Exclusion, ...] = ()
        for _ in range(MOST_EXCLUDED):
            problem, selection = self.compiled(replace(stage, constraints=(*stage.constraints, *excluded)))
            try:
                if not solve_program(problem, run):
                    return Attempt(run=run, outcome=Outcome.INFEASIBLE)
                alternative, error = selection.read()
            except TradeoffError:
                return Attempt(run=run, outcome=Outcome.FAILED)
            design = self._places(alternative)
            score = float(self.grid.scores(stage, self.constraints, design[None, :])[0])
            if math.isfinite(score):
                gap = proven_gap(problem) / stage.scale if stage.quantity is None else 0.0
                return Attempt(
                    run=run, outcome=Outcome.PROVEN, score=score, design=design, gap=gap, selection_error=error
                )
            excluded = (*excluded, Exclusion(alternative=alternative))
        return Attempt(run=run, outcome=Outcome.FAILED)

    def _places(self, alternative: Alternative) -> Designs:
        return np.array(np.unravel_index(alternative.variant - 1, self.grid.counts), dtype=np.intp)

    def _solution(
        self,
        stage: Stage,
        design: Designs,
        status: DecisionStatus,
        attempt: Attempt | None,
        checks: tuple[Check, ...],
        *,
        gap: float,
        solvers: tuple[str, ...],
    ) -> StageSolution:
        factors = self.model.space.factors
        alternative = self.model.alternative_of(
            tuple(factor.levels[place] for factor, place in zip(factors, design.tolist(), strict=True))
        )
        score = float(self.grid.scores(stage, self.constraints, design[None, :])[0])
        return StageSolution(
            name=stage.name,
            status=status,
            alternative=alternative,
            objective=stage.sign * score + 0.0 if stage.quantity is None else alternative.measures[stage.quantity],
            gap=gap,
            selection_error=0.0 if attempt is None else attempt.selection_error,
            checks=checks,
            exhaustive=self.exhaustive,
            solvers=solvers,
        )


def tolerance_at(best: float) -> float:
    """The difference up to which an objective is as good as another."""
    return TIE_TOLERANCE * max(1.0, abs(best)) if math.isfinite(best) else 0.0


def _infeasible(
    stage: Stage, checks: tuple[Check, ...], *, exhaustive: bool, solvers: tuple[str, ...]
) -> StageSolution:
    return StageSolution(
        name=stage.name,
        status=DecisionStatus.INFEASIBLE,
        alternative=None,
        objective=None,
        gap=None,
        selection_error=0.0,
        checks=checks,
        exhaustive=exhaustive,
        solvers=solvers,
    )


def _run_check(attempts: Sequence[Attempt], best: float) -> Check:
    confirming = [one.run.name for one in attempts if one.confirms(best)]
    other = [f"{one.run.name}: {one.outcome.value}" for one in attempts if not one.confirms(best)]
    detail = f"confirmed by {', '.join(confirming) or 'no run'}"
    if other:
        detail += f"; not by {', '.join(other)}"
    return Check(kind=CheckKind.SECOND_RUN, agrees=not other, detail=detail)


def _opinion_check(attempt: Attempt, best: float) -> Check:
    agrees = attempt.confirms(best)
    other = f": {attempt.outcome.value}" + (
        f" {attempt.score:.9g}, not {best:.9g}" if attempt.design is not None else ""
    )
    detail = f"{attempt.run.name}{' comes to the same answer' if agrees else other}"
    return Check(kind=CheckKind.INDEPENDENT_SOLVER, agrees=agrees, detail=detail)


def _search_check(attempt: Attempt, best: float) -> Check:
    if attempt.outcome is Outcome.FAILED:
        detail, agrees = f"{attempt.run.name} gave no answer; the search's is used", False
    elif attempt.confirms(best):
        detail, agrees = "nothing better was found", True
    else:
        detail, agrees = f"found a better design than {attempt.run.name}", False
    return Check(kind=CheckKind.PRIMAL_SEARCH, agrees=agrees, detail=detail)


def _bound_check(bound: IntervalBound, best: float) -> Check:
    if bound.better is not None:
        detail = "interval branch and bound found a better design"
    elif bound.complete:
        detail = "interval branch and bound leaves no better design"
    else:
        # Of a stage without any feasible design there is no bound to compare.
        over = f" exceeds the answer by {bound.bound - best:.3g}" if math.isfinite(best) else " is open"
        detail = f"interval branch and bound not completed; its bound{over}"
    return Check(kind=CheckKind.DUAL_BOUND, agrees=bound.better is None, detail=detail)


def _runs(count: int) -> str:
    return "1 run" if count == 1 else f"{count} runs"
