"""Decision before and after suppositions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rgss.assessment import VariantMeasures
from rgss.decision.what_if import Scenario
from rgss.studies import Project
from rgss.tradeoff import Decision


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionSide:
    """One side of the comparison.

    Attributes:
        decision: The decision.
        value: The value of the choice; None if unknown, or nothing is chosen.
        lead: The lead of the choice over the runner-up in value; None if there is none, or the program chooses by
            something else.
        estimates: The estimate of the choice in each weighted measure; None if unknown.
    """

    decision: Decision
    value: float | None
    lead: float | None
    estimates: Mapping[str, float | None] = field(hash=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class WhatIf:
    """Effect of suppositions on the decision.

    Attributes:
        scenario: The suppositions.
        units: The unit of each weighted measure.
        before: The decision without them.
        after: The decision under them.
        reopened: Screened-out designs that would be promoted under the suppositions.
        separated: True if the evidence separates the former choice from the one under the suppositions; None if they
            are the same, or if there is no choice on a side.
    """

    scenario: Scenario
    units: Mapping[str, str] = field(hash=False)
    before: DecisionSide
    after: DecisionSide
    reopened: tuple[int, ...] = ()
    separated: bool | None = None

    @property
    def value_of_former_choice(self) -> float | None:
        """Value of the former choice under the suppositions; None if unknown, or not feasible."""
        former = self.before.decision.chosen
        return None if former is None else _value(self.after.decision, former)

    @property
    def violated_by_former_choice(self) -> tuple[str, ...]:
        """The requirements that the former choice would violate."""
        former = self.before.decision.chosen
        found = (one.requirements for one in self.after.decision.infeasible if one.variant == former)
        return next(found, ())


def decision_side(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> DecisionSide:
    """A side of the comparison.

    Args:
        project: The project, as it is or under suppositions.
        measured: Every variant with its estimates.
        decision: The decision between them.
    """
    chosen = next((entry for entry in measured if entry.variant.id == decision.chosen), None)
    best, next_best = _value(decision, decision.chosen), _value(decision, decision.runner_up)
    return DecisionSide(
        decision=decision,
        value=best,
        lead=best - next_best
        if decision.program == "additive" and best is not None and next_best is not None
        else None,
        estimates={
            measure: None if chosen is None else chosen.estimates[measure].value
            for measure in project.study.trade_off.weighting.weights
        },
    )


def _value(decision: Decision, variant: int | None) -> float | None:
    return next((one.value for one in decision.ranking if one.variant == variant), None)
