"""The decision: what is chosen, what nearly was, what excluded what is better, and the certificate."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.tradeoff.certificate import Certificate
from rgss.tradeoff.conflicts import Conflicts, RequirementCount
from rgss.tradeoff.status import DecisionStatus


@dataclass(frozen=True, slots=True, kw_only=True)
class RankedAlternative:
    """A feasible alternative with its weighted value.

    Attributes:
        variant: Its id.
        value: Its weighted value, from 0 to 1.
    """

    variant: int
    value: float


@dataclass(frozen=True, slots=True, kw_only=True)
class InfeasibleAlternative:
    """An alternative that cannot be chosen, and why.

    Attributes:
        variant: Its id.
        requirements: The requirements that it violates, in the problem's order; among them
            ``evidence:<measure>`` for a weighted measure without a threshold that is unknown.
        value: The weighted value that it would have; None where a weighted measure is unknown.
    """

    variant: int
    requirements: tuple[str, ...]
    value: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Contribution:
    """What one measure adds to the value of one alternative.

    Attributes:
        measure: The measure.
        quantity: The alternative's evidence, in the measure's unit; None only where the weight is
            0 and the evidence does not tell.
        value: Its value, from 0 to 1; None where the quantity is.
        weight: The weight of the measure.
        contribution: Weight times value; the contributions of all measures sum to the weighted value.
    """

    measure: str
    quantity: float | None
    value: float | None
    weight: float
    contribution: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision:
    """The outcome of a trade-off.

    Attributes:
        status: Optimal, or infeasible when no alternative meets every requirement; then nothing
            is chosen and the conflicts say why.
        chosen: Among the tied best, the smallest id.
        runner_up: The next in the ranking whose value lies below the tie; if all feasible
            alternatives are tied, the next of these; None if only one is feasible.
        ties: All feasible alternatives within 1e-9 of the best value, by ascending id; the chosen
            one is the first, and alone where the choice is unique.
        ranking: The feasible alternatives, best first, equals by ascending id: first the tied,
            which count as equal, then the others by value.
        infeasible: The others by ascending id.
        excluded_better: The infeasible alternatives whose value is above the chosen one's by more
            than a tie, best first.
        deciding_requirements: The requirements that exclude these, with how many each excludes;
            empty if the choice would be the same without any requirement.
        chosen_contributions: What each measure adds to the chosen alternative's value, in the
            order of the weights; empty if nothing is chosen.
        runner_up_contributions: The same for the runner-up.
        conflicts: Why nothing is feasible; None if something is.
        certificate: The recomputation of all this.
    """

    status: DecisionStatus
    chosen: int | None
    runner_up: int | None
    ties: tuple[int, ...]
    ranking: tuple[RankedAlternative, ...]
    infeasible: tuple[InfeasibleAlternative, ...]
    excluded_better: tuple[InfeasibleAlternative, ...]
    deciding_requirements: tuple[RequirementCount, ...]
    chosen_contributions: tuple[Contribution, ...]
    runner_up_contributions: tuple[Contribution, ...]
    conflicts: Conflicts | None
    certificate: Certificate
