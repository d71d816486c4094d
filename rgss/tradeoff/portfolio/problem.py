"""A portfolio problem: tasks to be served by at most k designs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rgss.errors import TradeoffError
from rgss.tradeoff.portfolio.checks import PortfolioAim
from rgss.tradeoff.problem import Weighting
from rgss.tradeoff.programs import AdditiveValue, TradeProblem


@dataclass(frozen=True, slots=True, kw_only=True)
class PortfolioTask:
    """Task or scene of a portfolio.

    Attributes:
        name: Its name.
        weight: Its share in the mean.
        problem: The alternatives with their evidence in this task, and its conditions; the same in every task but for
            those left out.
        left_out: Alternatives of other tasks that do not serve this one, such as those that its screening left out.
    """

    name: str
    weight: float
    problem: TradeProblem
    left_out: frozenset[int] = frozenset()

    @property
    def variants(self) -> frozenset[int]:
        """Ids of its alternatives, with those left out."""
        return self.left_out.union(one.variant for one in self.problem.alternatives)


@dataclass(frozen=True, slots=True, kw_only=True)
class PortfolioProblem:
    """Choose at most k designs, or kinds of designs, so that every task is served as well as possible.

    Attributes:
        tasks: The tasks.
        at_most: The greatest number of members.
        groups: Member of each alternative, by id, such as its gripper: a member may serve each task by another
        alternative of its group. Without groups every alternative is a member.
        aim: Mean or worst.

    Raises:
        TradeoffError: The problem is ill posed.
    """

    tasks: tuple[PortfolioTask, ...]
    at_most: int
    groups: Mapping[int, str] | None = field(default=None, hash=False)
    aim: PortfolioAim = PortfolioAim.MEAN

    def __post_init__(self) -> None:
        if not self.tasks:
            raise TradeoffError("a portfolio without tasks has nothing to do", hint="name at least one task")
        names = [task.name for task in self.tasks]
        for name in names:
            if names.count(name) > 1:
                raise TradeoffError(f"task {name!r} is given twice", hint="keep one of them")
        if self.at_most < 1:
            raise TradeoffError(
                f"a portfolio of at most {self.at_most} designs serves no task", hint="allow at least 1"
            )
        Weighting(weights={task.name: task.weight for task in self.tasks})
        variants = self.tasks[0].variants
        for task in self.tasks:
            if not isinstance(task.problem.program, AdditiveValue):
                raise TradeoffError(
                    f"task {task.name!r} is decided by the {task.problem.program.name} program",
                    hint="a portfolio is chosen by weighted value; use the additive program",
                )
            for variant in sorted(task.variants ^ variants):
                raise TradeoffError(
                    f"variant {variant} is not among the alternatives of every task",
                    hint="give every task the same designs",
                )
        for variant in sorted(variants):
            if self.groups is not None and variant not in self.groups:
                raise TradeoffError(f"variant {variant} belongs to no group", hint="give every variant its group")
