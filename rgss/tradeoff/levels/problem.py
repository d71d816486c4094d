"""A choice of components and levels by tables, without a list of all designs: the mixed-integer form."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rgss.errors import TradeoffError
from rgss.tradeoff.levels.selection import LevelModel, LevelSelection, LevelTable
from rgss.tradeoff.milp import DecisionStatus, LimitedRuns, SolverRun, StageSolution
from rgss.tradeoff.problem import Alternative, LevelSpace, Risk, Threshold, ValueFunction, WeightBounds, Weighting
from rgss.tradeoff.programs import (
    AdditiveValue,
    Certificate,
    Preferences,
    Program,
    TradeProblem,
    certify,
    check_preferences,
)

LARGEST_ENUMERATED = 5_000_000
"""Up to so many combinations are evaluated, block by block, to check each stage of the solver's answer."""

LARGEST_TABULATED = 1_000_000
"""Largest number of combinations that are kept in one table, so that the whole program is checked at once."""

MOST_ROUNDS = 3
"""So often a program is solved anew where a later stage finds better designs than an earlier one."""

Table = LevelTable[float | None]


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelProblem(Preferences):
    """Choose a level of each factor so that the design that they make is best.

    Attributes:
        space: The factors with the compatibility rules.
        tables: For each measure the tables whose sum it is: each over the levels, or the
            combinations of levels, that the part depends on; None where a part is unknown. A cost,
            for instance, is the sum of one table for each component.
        thresholds: Thresholds of the requirements.
        value_functions: One for every measure that has a weight, and for no other.
        weighting: The weights.
        program: Decision program; the highest weighted value by default.
        weight_bounds: Bounds and orders of the weights.
        risks: None, because tables have no replicates.

    Raises:
        TradeoffError: The problem is ill posed.
    """

    space: LevelSpace
    tables: Mapping[str, tuple[Table, ...]] = field(hash=False)
    thresholds: tuple[Threshold, ...]
    value_functions: tuple[ValueFunction, ...]
    weighting: Weighting
    program: Program = field(default_factory=AdditiveValue)
    weight_bounds: WeightBounds = field(default_factory=WeightBounds)
    risks: tuple[Risk, ...] = field(default=(), init=False)

    def __post_init__(self) -> None:
        check_preferences(self)
        for measure, who in self.measures_named.items():
            if measure not in self.tables:
                raise TradeoffError(
                    f"{who} the unknown measure {measure!r}",
                    hint=f"there are tables of {', '.join(sorted(self.tables)) or 'no measures at all'}",
                )
        for measure, tables in self.tables.items():
            for table in tables:
                _check_table(self.space, measure, table)

    def replicate_count(self, measures: Sequence[str]) -> int:  # noqa: ARG002 - tables have none
        """Tables have no replicates.

        Raises:
            TradeoffError: Always.
        """
        raise TradeoffError(
            "levels that are chosen by tables have no replicates", hint="take the regret over weights instead"
        )

    def alternative(self, levels: tuple[str, ...]) -> Alternative:
        """The design that a level of each factor makes; its id is its number among all combinations."""
        number = 0
        for factor, level in zip(self.space.factors, levels, strict=True):
            number = number * len(factor.levels) + factor.levels.index(level)
        at = dict(zip((factor.id for factor in self.space.factors), levels, strict=True))
        measures: dict[str, float | None] = {}
        for measure, tables in self.tables.items():
            parts = [table.entries.get(tuple(at[factor] for factor in table.factors)) for table in tables]
            known = [part for part in parts if part is not None]
            measures[measure] = math.fsum(known) if len(known) == len(parts) else None
        return Alternative(variant=number + 1, measures=measures)

    def some_design(self) -> Alternative:
        """The first combination that the rules allow.

        Raises:
            TradeoffError: They allow none.
        """
        for _, levels in self.space.combinations():
            return self.alternative(levels)
        raise TradeoffError("the rules leave no combination of levels", hint="relax a rule")

    def levels_of(self, variant: int) -> tuple[str, ...]:
        """The level of each factor of the design with a number."""
        number = variant - 1
        found = []
        for factor in reversed(self.space.factors):
            number, place = divmod(number, len(factor.levels))
            found.append(factor.levels[place])
        return tuple(reversed(found))

    def feasible_alternatives(self, *, at_most: int) -> Sequence[Alternative] | None:
        """The combinations of levels that meet every condition, if there are at most so many."""
        return self.enumerated().feasible_alternatives(at_most=at_most) if self.space.size <= at_most else None

    def enumerated(self) -> TradeProblem:
        """The same choice as one among alternatives, each of which is a combination of levels.

        Raises:
            TradeoffError: No combination is a design.
        """
        return self.among(tuple(self.alternative(levels) for _, levels in self.space.combinations()))

    def among(self, alternatives: Sequence[Alternative]) -> TradeProblem:
        """The same choice among some designs only."""
        return TradeProblem(
            alternatives=alternatives,
            thresholds=self.thresholds,
            value_functions=self.value_functions,
            weighting=self.weighting,
            program=self.program,
            weight_bounds=self.weight_bounds,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelDecision:
    """Outcome of a choice of levels.

    Attributes:
        status: Optimal, best found or infeasible.
        levels: The level of each factor; empty if infeasible.
        variant: The number of the combination among all, from 1; None if infeasible.
        measures: Value of the design in every measure; empty if infeasible.
        combinations: Number of combinations of levels, including excluded ones.
        certificate: Certificate: proven results and checks, recomputed from the tables.
        enumerated: Whether each stage was compared with all combinations, which is done up to
            `LARGEST_ENUMERATED`.
    """

    status: DecisionStatus
    levels: Mapping[str, str] = field(hash=False)
    variant: int | None
    measures: Mapping[str, float | None] = field(hash=False)
    combinations: int
    certificate: Certificate
    enumerated: bool


def decide_levels(
    problem: LevelProblem,
    *,
    independent: tuple[SolverRun, ...] = (),
    time_limit: float | None = None,
) -> LevelDecision:
    """Choose the best combination of levels, with proof.

    The size of the program is that of the tables, not of all combinations. Of equally good combinations any may be
    chosen.

    Every solver result is checked: by exhaustive evaluation if the combinations are few enough, otherwise by a primal
    search, interval branch and bound, and a second run with other options. A result contradicted by a check is replaced
    by the better one; without a proof the status is best found, with its gap. The solver runs in a separate process,
    which is killed at its time limit; the result may still be proven by the other checks.

    Args:
        problem: The problem.
        independent: Runs of solvers other than HiGHS, made on every stage as further checks.
        time_limit: Time limit of the proofs in s, instead of the limits of each run; the result then depends on the
            machine.

    Raises:
        TradeoffError: Neither a feasible design nor a proof of infeasibility was found, the stages are inconsistent, no
        combination is a design, or the time limit is not positive.
    """
    from rgss.tradeoff.levels.grid import LevelGrid
    from rgss.tradeoff.levels.guard import GuardedStageSolver

    first = problem.some_design()
    model = LevelModel(
        space=problem.space,
        quantities=problem.tables,
        replicates={},
        alternative_of=problem.alternative,
        levels_of=problem.levels_of,
        curved=frozenset(one.measure for one in problem.value_functions if one.breakpoints is None),
    )
    exhaustive = problem.space.size <= LARGEST_ENUMERATED
    grid = LevelGrid.of(problem.space, problem.tables)
    tabulated = (
        problem.among(grid.table()) if problem.space.size <= min(LARGEST_TABULATED, LARGEST_ENUMERATED) else None
    )
    with LimitedRuns(time_limit) as runs:
        solver = GuardedStageSolver(
            select=lambda: LevelSelection(model),
            constraints=problem.constraints,
            grid=grid,
            model=model,
            exhaustive=exhaustive,
            runs=runs,
            independent=independent,
        )
        for _ in range(MOST_ROUNDS):
            solutions = problem.program.solve(problem, solver)
            certificate = _certified(problem, first, solutions, tabulated)
            if certificate is not None:
                break
        else:
            raise TradeoffError(
                f"the stages of the {problem.program.name} program contradict each other",
                hint="no decision is made on contradictory answers; look for measures of extreme magnitude",
            )
    last = solutions[-1].alternative
    levels = () if last is None else problem.levels_of(last.variant)
    return LevelDecision(
        status=certificate.status,
        levels=dict(zip((factor.id for factor in problem.space.factors), levels, strict=False)),
        variant=None if last is None else last.variant,
        measures={} if last is None else dict(last.measures),
        combinations=problem.space.size,
        certificate=certificate,
        enumerated=exhaustive,
    )


def _certified(
    problem: LevelProblem, first: Alternative, solutions: Sequence[StageSolution], tabulated: TradeProblem | None
) -> Certificate | None:
    """The certificate of the stages' answers; None where they contradict each other as a whole."""
    from rgss.tradeoff.programs import enumerate_alternatives

    if tabulated is None:
        met = {solution.alternative.variant: solution.alternative for solution in solutions if solution.alternative}
        some = problem.among(tuple(met.values()) or (first,))
    else:
        some = tabulated
    enumeration = enumerate_alternatives(some)
    if solutions[-1].alternative is None and tabulated is None:
        # Designs that earlier stages met say nothing of a stage that proved that there is none.
        return certify(
            problem,
            enumerate_alternatives(problem.among((first,))),
            solutions,
            considered=problem.space.size,
            whole=False,
        )
    certificate = certify(problem, enumeration, solutions, considered=problem.space.size, whole=tabulated is not None)
    return certificate if certificate.recomputation_agrees else None


def _check_table(space: LevelSpace, measure: str, table: Table) -> None:
    known = {factor.id for factor in space.factors}
    for factor in table.factors:
        if factor not in known:
            raise TradeoffError(
                f"a table of {measure!r} names the unknown factor {factor!r}",
                hint=f"factors: {', '.join(sorted(known))}",
            )
    for combination in space.levels_of(table.factors):
        entry = table.entries.get(combination)
        if combination not in table.entries:
            raise TradeoffError(
                f"a table of {measure!r} lacks the combination {', '.join(combination)}",
                hint="give an entry for each combination; an unknown one is given as None",
            )
        if entry is not None and not math.isfinite(entry):
            raise TradeoffError(
                f"{measure!r} at {', '.join(combination)} must be finite or None, got {entry:g}",
                hint="give None where it is unknown",
            )
