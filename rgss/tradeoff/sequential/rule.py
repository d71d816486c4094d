"""The rule of replication until decided: error rate, margin, and how many replicates it may take."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from rgss.errors import TradeoffError
from rgss.tradeoff.sequential.evidence import SequentialEvidence


@dataclass(frozen=True, slots=True, kw_only=True)
class SequentialRule:
    """Stopping rule of sequential replication.

    Attributes:
        error_rate: α: probability that the decision is called decided and is wrong. Replicates are added for a
            verdict until it would be wrong with a probability of at most α/2.
        margin: Difference of value that is practically none: the indifference zone.
        slack: Share of a threshold by which it may be missed without an effect on the decision.
        pilot: Replicates that every alternative gets.
        batch: Replicates that are added at a look.
        cap: Most replicates of an alternative.
        verdict_cap: Most replicates of an alternative that only its verdicts need.
        budget: Most replicates of all alternatives together; None for no such limit.
        finalists: Number of leading alternatives that a budget is spent on, kept at the same seeds; None to spend it by
            posterior probability.
        reserve: Replicates of all alternatives together beyond the budget, while the probability of good selection
            is below `good_selection`; None for none.
        good_selection: Probability of good selection at which the reserve is left.

    Raises:
        TradeoffError: A number is out of its range.
    """

    error_rate: float = 0.05
    margin: float = 0.05
    slack: float = 0.1
    pilot: int = 8
    batch: int = 4
    cap: int = 200
    verdict_cap: int = 16
    budget: int | None = None
    finalists: int | None = None
    reserve: int | None = None
    good_selection: float = 0.9

    def __post_init__(self) -> None:
        if not 0.0 < self.error_rate < 1.0:
            raise TradeoffError(
                f"error rate must be between 0 and 1, got {self.error_rate:g}", hint="give one such as 0.05"
            )
        for name, number in (("margin", self.margin), ("slack", self.slack)):
            if not (math.isfinite(number) and 0.0 <= number < 1.0):
                raise TradeoffError(
                    f"{name} must be from 0 to below 1, got {number:g}", hint="give a number such as 0.05"
                )
        if self.pilot < 2 or self.batch < 1:
            raise TradeoffError(
                f"pilot must be at least 2 and batch at least 1, got {self.pilot} and {self.batch}",
                hint="give numbers of replicates",
            )
        if self.finalists is not None and self.finalists < 2:
            raise TradeoffError(
                f"finalists must be at least 2, got {self.finalists}", hint="one alternative is compared with nothing"
            )
        if self.reserve is not None and (self.budget is None or self.reserve < 1):
            raise TradeoffError(
                f"reserve must be at least 1 replicate beyond a budget, got {self.reserve}",
                hint="give a budget too, and a positive reserve",
            )
        if not 0.0 < self.good_selection < 1.0:
            raise TradeoffError(
                f"good selection must be between 0 and 1, got {self.good_selection:g}", hint="give one such as 0.9"
            )
        if self.cap < self.pilot or not 0 <= self.verdict_cap <= self.cap:
            raise TradeoffError(
                f"cap must be at least the pilot of {self.pilot} and the verdict cap of {self.verdict_cap}, "
                f"got {self.cap}",
                hint="the cap is the largest of the three",
            )


def check_pilot(rule: SequentialRule, count: int) -> None:
    """Check that the budget has room for the pilot.

    Raises:
        TradeoffError: It has not.
    """
    if rule.budget is not None and rule.pilot * count > rule.budget:
        raise TradeoffError(
            f"a budget of {rule.budget} trials is less than the pilot of {rule.pilot} replicates of {count} variants",
            hint=f"give a budget of at least {rule.pilot * count}, or a smaller pilot",
        )


def affordable_replicates(
    evidence: SequentialEvidence, rule: SequentialRule, wanted: Mapping[int, int], *, first: int | None
) -> Mapping[int, int]:
    """The replicates that the budget has room for: the choice's, then those of the others by ascending id.

    Args:
        evidence: The evidence so far.
        rule: The rule.
        wanted: The number that each of some alternatives should have in all.
        first: The choice.
    """
    if rule.budget is None:
        return wanted
    left = rule.budget - int(evidence.replicates.sum())
    found = {}
    for variant in sorted(wanted, key=lambda each: (each != first, each)):
        more = min(left, wanted[variant] - int(evidence.replicates[evidence.table.row_of(variant)]))
        if more > 0:
            found[variant] = more + int(evidence.replicates[evidence.table.row_of(variant)])
            left -= more
    return found
