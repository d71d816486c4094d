"""A stage solver over levels whose answers are checked by methods that share nothing with the solver."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rgss.errors import TradeoffError
from rgss.tradeoff.levels.attempt import (
    Attempt,
    BestKnown,
    Outcome,
    bound_check,
    enumeration_check,
    opinion_check,
    run_check,
    search_check,
    tolerance_at,
)
from rgss.tradeoff.levels.bound import IntervalBound, interval_bound
from rgss.tradeoff.levels.grid import Designs, LevelGrid
from rgss.tradeoff.levels.search import improve_design, search_levels
from rgss.tradeoff.levels.selection import LevelModel
from rgss.tradeoff.milp import (
    RUNS,
    Check,
    DecisionStatus,
    Exclusion,
    LimitedRuns,
    SolverLimitError,
    SolverRun,
    Stage,
    StageSolution,
    StageSolver,
    proven_gap,
)
from rgss.tradeoff.problem import Alternative

MOST_EXCLUDED = 20
"""So many designs that the solver's tolerance lets pass are excluded one after another."""

NEEDED = 2
"""So many runs of the solver have to come to an answer that nothing else proves."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GuardedStageSolver(StageSolver):
    """Solver of stages over levels with independent checks and repair of solver errors.

    If all combinations can be evaluated, the result is compared with them. Otherwise it is checked by a second run with
    other options, a primal search and interval branch and bound. The best design found by any of them is returned; it
    is optimal if exhaustive evaluation, interval branch and bound, or two solver runs prove it, and best found
    otherwise.

    Attributes:
        grid: The tables as arrays.
        model: Meaning of the variables.
        exhaustive: Whether all combinations are evaluated.
        runs: Runner of the solver with time limits.
        known: Feasible designs of earlier stages, the start of the search.
        independent: Runs of solvers other than HiGHS, made on every stage; if neither enumeration nor interval branch
        and bound proves the result, each counts as one of the runs that must agree.
    """

    grid: LevelGrid
    model: LevelModel
    exhaustive: bool
    runs: LimitedRuns
    known: list[Designs] = field(default_factory=list, hash=False)
    independent: tuple[SolverRun, ...] = ()

    def solve(self, stage: Stage) -> StageSolution:
        """Solve a stage.

        Raises:
            TradeoffError: Neither a feasible design nor a proof of infeasibility was found.
        """
        solution = self._compared_with_all(stage) if self.exhaustive else self._searched(stage)
        if solution.alternative is not None:
            self.known.append(self._places(solution.alternative))
        return solution

    def _compared_with_all(self, stage: Stage) -> StageSolution:
        found = self.grid.best(stage, self.constraints)
        best = -math.inf if found is None else found[0]
        attempts: list[Attempt] = []
        for run in RUNS:
            attempts.append(self._attempt(stage, run))
            if attempts[-1].confirms(best):
                break
        last = attempts[-1]
        opinions = [self._attempt(stage, run) for run in self.independent]
        checks = (
            enumeration_check(self.grid.size, attempts, best),
            *(opinion_check(one, best) for one in opinions),
        )
        solvers = self._agreeing([last, *opinions], best)
        if found is None:
            return StageSolution(
                name=stage.name,
                status=DecisionStatus.INFEASIBLE,
                checks=checks,
                exhaustive=True,
                solvers=solvers,
            )
        if last.confirms(best) and last.design is not None:
            return self._solution(
                stage, last.design, DecisionStatus.OPTIMAL, last, checks, gap=last.gap, solvers=solvers
            )
        return self._solution(stage, found[1], DecisionStatus.OPTIMAL, None, checks, gap=0.0, solvers=solvers)

    def _searched(self, stage: Stage) -> StageSolution:
        # What needs no solver comes first: where it proves the answer, the solver only confirms it.
        known = BestKnown()
        known.take(search_levels(self.grid, stage, self.constraints, self.known))
        searched = known.score
        bound = self._bounded(stage, known)
        first = self._attempt(stage, RUNS[0])
        if (
            not bound.complete
            and first.design is not None
            and known.take(improve_design(self.grid, stage, self.constraints, first.design))
        ):
            searched = known.score
            bound = self._bounded(stage, known)
        known.prefer(first)
        opinions = [self._attempt(stage, run) for run in self.independent]
        for one in opinions:
            known.take_from(one)
        checks, attempts = [search_check(first, searched)], [first]
        if not bound.complete:
            attempts = self._compared_runs(stage, first, opinions, known)
            checks.append(run_check(attempts, known.score))
        checks.append(bound_check(bound, first, known.score))
        checks += [opinion_check(one, known.score) for one in opinions]
        return self._judged(stage, known, bound, [*attempts, *opinions], tuple(checks))

    def _bounded(self, stage: Stage, known: BestKnown) -> IntervalBound:
        """Interval branch and bound from the known designs, in half of the remaining time."""
        bound = interval_bound(
            self.grid,
            stage,
            self.constraints,
            known=known.score,
            tolerance=tolerance_at(known.score),
            is_over=self.runs.half_over(),
        )
        known.take(None if bound.better is None else (bound.bound, bound.better))
        return bound

    def _compared_runs(
        self, stage: Stage, first: Attempt, opinions: Sequence[Attempt], known: BestKnown
    ) -> list[Attempt]:
        """Solver runs until two agree, if interval branch and bound gives no proof.

        Every run is first made with a short limit, before an unfinished one gets more time.
        """
        attempts = [first]

        def agree() -> bool:
            return sum(one.confirms(known.score) for one in (*attempts, *opinions)) >= NEEDED + len(opinions)

        for run in RUNS[1:]:
            attempts.append(self._attempt(stage, run))
            known.take_from(attempts[-1])
            if agree():
                return attempts
        for place, run in enumerate(RUNS):
            if attempts[place].outcome is Outcome.ENDED:
                attempts[place] = self._attempt(stage, run, brief=False)
                known.take_from(attempts[place])
                if agree():
                    break
        return attempts

    def _judged(
        self,
        stage: Stage,
        known: BestKnown,
        bound: IntervalBound,
        attempts: Sequence[Attempt],
        checks: tuple[Check, ...],
    ) -> StageSolution:
        """Best known design, with its proof.

        Raises:
            TradeoffError: Neither a feasible design nor a proof of infeasibility was found.
        """
        best, design = known.score, known.design
        confirming = [one for one in attempts if one.confirms(best)]
        proven = bound.complete or len(confirming) >= NEEDED
        solvers = self._agreeing(attempts, best)
        if design is None:
            if proven:
                return StageSolution(
                    name=stage.name,
                    status=DecisionStatus.INFEASIBLE,
                    checks=checks,
                    exhaustive=False,
                    solvers=solvers,
                )
            raise TradeoffError(
                f"stage {stage.name!r}: no feasible design was found, but infeasibility was not proven",
                hint="relax a requirement, allow more time, or look for measures of extreme magnitude",
            )
        gap = max(0.0, bound.bound - best)
        if proven:
            gap = 0.0 if bound.complete else max((one.gap for one in confirming), default=0.0)
        same = next((one for one in confirming if one.design is not None and (one.design == design).all()), None)
        status = DecisionStatus.OPTIMAL if proven else DecisionStatus.BEST_FOUND
        return self._solution(stage, design, status, same, checks, gap=gap, solvers=solvers)

    def _agreeing(self, attempts: Sequence[Attempt], best: float) -> tuple[str, ...]:
        """Solvers of the runs with this result; HiGHS if no other was run."""
        if not self.independent:
            return (RUNS[0].solver,)
        return tuple(dict.fromkeys(one.run.solver for one in attempts if one.confirms(best)))

    def _attempt(self, stage: Stage, run: SolverRun, *, brief: bool = True) -> Attempt:
        """One solver run, without designs that are feasible only within the solver's tolerances."""
        excluded: tuple[Exclusion, ...] = ()
        for _ in range(MOST_EXCLUDED):
            problem, selection = self.compiled(replace(stage, constraints=(*stage.constraints, *excluded)))
            try:
                if not self.runs.solve(problem, run, brief=brief):
                    return Attempt(run=run, outcome=Outcome.INFEASIBLE)
                alternative, error = selection.read()
            except SolverLimitError:
                return Attempt(run=run, outcome=Outcome.ENDED)
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
