"""Numbers of a study's additional conditions that can be supposed: chances, tails, and limits of its program."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from rgss.decision.preference_model import program_of, risks_of
from rgss.errors import DefinitionError
from rgss.studies import Project
from rgss.studies.trade_off import AnchoredEpsilonConstraint, BoundChoice, RiskChoice, TradeOff
from rgss.tradeoff import Comparison

THRESHOLD = "threshold"


@dataclass(frozen=True, slots=True, kw_only=True)
class DemandNumber:
    """Number of a condition that a study states in addition to the requirements.

    Attributes:
        id: Its name, such as ``tail:SYS-033.threshold``.
        value: Its value.
        unit: The unit of the value.
        changed: Function that returns the trade-off with another value.
    """

    id: str
    value: float
    unit: str
    changed: Callable[[TradeOff, float], TradeOff]


def demand_numbers(project: Project) -> Mapping[str, DemandNumber]:
    """Numbers of the additional conditions of a study, by name.

    Raises:
        DefinitionError: A condition is anchored on a requirement that does not bound its measure.
        TradeoffError: As for `program_of`.
    """
    trade_off = project.study.trade_off
    found = []
    for choice, risk in zip(trade_off.risks, risks_of(project), strict=True):
        place = BoundChoice(measure=risk.measure, comparison=risk.comparison, value=risk.value)
        found.append(
            DemandNumber(
                id=f"{choice.id}.{THRESHOLD}", value=risk.value, unit=risk.unit, changed=_risk_bound(choice.id, place)
            )
        )
        found.append(
            DemandNumber(
                id=f"{choice.id}.{choice.kind.share_key}", value=choice.share, unit="1", changed=_risk_share(choice.id)
            )
        )
    if isinstance(trade_off.program, AnchoredEpsilonConstraint):
        found += [
            DemandNumber(
                id=f"{limit.requirement}.{THRESHOLD}",
                value=limit.value,
                unit=limit.unit,
                changed=_program_limit(limit.measure, limit.comparison),
            )
            for limit in program_of(project, ()).limits
        ]
    return {number.id: number for number in found}


def share_checked(name: str, value: float) -> float:
    """A share of the replicates.

    Raises:
        DefinitionError: It is not above 0 and below 1.
    """
    if not 0.0 < value < 1.0:
        raise DefinitionError(
            f"--what-if: {name} must be above 0 and below 1, got {value:g}", hint="give a share, such as 0.8 or 80 %"
        )
    return value


def _risk_bound(risk: str, place: BoundChoice) -> Callable[[TradeOff, float], TradeOff]:
    # Its own bound replaces that of a requirement, which is not changed.
    return lambda trade_off, value: _with_risk(
        trade_off, risk, lambda one: replace(one, bound=replace(place, value=value))
    )


def _risk_share(risk: str) -> Callable[[TradeOff, float], TradeOff]:
    return lambda trade_off, value: _with_risk(trade_off, risk, lambda one: replace(one, share=value))


def _with_risk(trade_off: TradeOff, risk: str, change: Callable[[RiskChoice], RiskChoice]) -> TradeOff:
    return replace(trade_off, risks=tuple(change(one) if one.id == risk else one for one in trade_off.risks))


def _program_limit(measure: str, comparison: Comparison) -> Callable[[TradeOff, float], TradeOff]:
    def changed(trade_off: TradeOff, value: float) -> TradeOff:
        program = trade_off.program
        if not isinstance(program, AnchoredEpsilonConstraint):
            return trade_off
        limits = tuple(
            replace(bound, value=value) if (bound.measure, bound.comparison) == (measure, comparison) else bound
            for bound in program.limits
        )
        return replace(trade_off, program=replace(program, limits=limits))

    return changed
