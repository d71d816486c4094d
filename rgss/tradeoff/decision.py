"""Decision: choice, near-ties, deciding requirements and certificate."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape

from rgss.html_tables import html_table, html_view
from rgss.tradeoff.infeasibility import Conflicts, RequirementCount
from rgss.tradeoff.milp import DecisionStatus
from rgss.tradeoff.problem import EVIDENCE_PREFIX
from rgss.tradeoff.programs import Certificate

LONGEST_LIST = 10_000
"""The longest list of alternatives that a decision holds."""


_LONGEST_RANKING = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class RankedAlternative:
    """A feasible alternative with its weighted value.

    Attributes:
        variant: Its id.
        value: Its weighted value, from 0 to 1; None where a weighted measure is unknown that the
            program does not use.
        objectives: Objectives of the program, in turn.
    """

    variant: int
    value: float | None
    objectives: tuple[float, ...]


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
    """Contribution of one measure to the value of one alternative.

    Attributes:
        measure: The measure.
        quantity: The alternative's evidence, in the measure's unit; None only where the weight is
            0 and it is unknown.
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
class FlatMeasure:
    """A valued measure whose weight decides nothing, because no alternative differs in it.

    Attributes:
        measure: The measure.
        weight: Its weight.
        low: The least quantity that is known.
        high: The largest quantity that is known.
        among_feasible: Whether only the feasible alternatives do not differ in it.
        value: Their common value, from 0 at the worst end to 1 at the best.
    """

    measure: str
    weight: float
    low: float
    high: float
    among_feasible: bool
    value: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Counts:
    """Numbers of alternatives by kind.

    Attributes:
        alternatives: All.
        feasible: Those that meet every demand.
        excluded_better: Those that do not and are better than the chosen one.
    """

    alternatives: int
    feasible: int
    excluded_better: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision:
    """Outcome of a trade-off.

    The ranking and the lists of infeasible and excluded alternatives are truncated to `LONGEST_LIST` entries; `counts`
    has the full numbers. Programs that compare one measure after another rank at most about five million divided by the
    number of alternatives, since each place is a separate optimisation.

    Attributes:
        program: The program that decided.
        objectives: Its objectives, in turn.
        status: Optimal, or infeasible if no alternative meets every requirement; then nothing is chosen and the
            conflicts give the reason.
        chosen: Among the tied best that none of them surpasses, the smallest id, or the largest if the study chooses
            the last of equals.
        near_ties: Feasible alternatives that are not tied but come within the practical margin of
            the best, in the order of the ranking.
        runner_up: The next in the ranking that is not tied; if all feasible
            alternatives are tied, the next of these; None if only one is feasible.
        ties: All feasible alternatives within 1e-9 of the best: those that none of them surpasses, then the others,
            each by ascending id, or by falling id if the last of equals is chosen. The chosen one is the first.
        surpassed: The tied alternatives that another of them surpasses: it is at least as good in the quantity of every
            valued measure and better in one, beyond an end of its value function.
        ranking: The feasible alternatives, best first, equals by ascending id: first the tied,
            which count as equal, then what would be chosen without these, and so on.
        infeasible: The others by ascending id.
        excluded_better: The infeasible alternatives that the program would prefer to the chosen
            one by more than a tie, by falling weighted value.
        deciding_requirements: The requirements that exclude these, with how many each excludes;
            empty if the choice would be the same without any requirement.
        chosen_contributions: Contribution of each measure to the value of the chosen alternative, in the order of the
            weights; empty if nothing is chosen.
        runner_up_contributions: Contributions to the value of the runner-up.
        conflicts: Explanation of infeasibility; None if an alternative is feasible.
        flat_measures: Valued measures whose weight has no effect.
        demands: Text of each condition by id, such as ``P_max >= 0.8 kg``.
        counts: Number of alternatives of each kind.
        certificate: Certificate of the decision.
    """

    program: str
    objectives: tuple[str, ...]
    status: DecisionStatus
    chosen: int | None
    runner_up: int | None
    ties: tuple[int, ...]
    surpassed: tuple[int, ...]
    near_ties: tuple[int, ...]
    ranking: tuple[RankedAlternative, ...]
    infeasible: tuple[InfeasibleAlternative, ...]
    excluded_better: tuple[InfeasibleAlternative, ...]
    deciding_requirements: tuple[RequirementCount, ...]
    chosen_contributions: tuple[Contribution, ...]
    runner_up_contributions: tuple[Contribution, ...]
    conflicts: Conflicts | None
    flat_measures: tuple[FlatMeasure, ...]
    demands: Mapping[str, str] = field(hash=False)
    counts: Counts
    certificate: Certificate

    @property
    def unmeasured(self) -> tuple[str, ...]:
        """Conditions of which no alternative has a value, if they alone leave nothing feasible; empty otherwise.

        Then nothing is shown to be infeasible: the evidence does not have what is asked of it.
        """
        if self.conflicts is None:
            return ()
        unknown = (*self.conflicts.unmeasured, *(EVIDENCE_PREFIX + one for one in self.conflicts.unvalued))
        is_for_want = any(set(one.requirements) <= set(unknown) for one in self.infeasible)
        return unknown if is_for_want else ()

    def __repr__(self) -> str:
        counts = self.counts
        return (
            f"Decision({self.status.value}: chosen {self.chosen}, runner-up {self.runner_up}, "
            f"{counts.feasible} of {counts.alternatives} alternatives feasible)"
        )

    def _repr_html_(self) -> str:
        return decision_view(self)


def decision_view(decision: Decision, *, title: str = "") -> str:
    """The decision with the first places of its ranking.

    Args:
        decision: The decision.
        title: A heading above its own.
    """
    first = decision.ranking[:_LONGEST_RANKING]
    rows = [
        (place, one.variant, "–" if one.value is None else f"{one.value:.3f}", _role(decision, one.variant))
        for place, one in enumerate(first, start=1)
    ]
    rest = len(decision.ranking) - len(first)
    more = f"<p>and {rest} more in <code>ranking</code></p>" if rest else ""
    table = html_table(("place", "variant", "weighted value", ""), rows) if rows else ""
    if title:
        return html_view(title, f"<p>{escape(repr(decision))}</p>{table}{more}")
    return html_view(repr(decision), f"{table}{more}")


def _role(decision: Decision, variant: int) -> str:
    if variant == decision.chosen:
        return "chosen"
    if variant in decision.ties:
        return "tied"
    return "runner-up" if variant == decision.runner_up else ""
