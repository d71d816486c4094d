"""Conversion of the documents into the domain types."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType

from rgss.requirements.architecture import Behaviour, Block
from rgss.requirements.architecture_files import BehaviourFile, BlockFile, FlowFile, InteractionFile, MachineFile
from rgss.requirements.behaviour import (
    Flow,
    FlowEdge,
    FlowNode,
    Interaction,
    Message,
    State,
    StateMachine,
    TimingConstraint,
    Transition,
)
from rgss.requirements.criterion import Criterion
from rgss.requirements.exemption import Exemption
from rgss.requirements.files import (
    CriterionFile,
    ExemptionFile,
    NeedFile,
    RequirementFile,
    ReviewFile,
    RuleSettingFile,
    split_quantity,
)
from rgss.requirements.needs import StakeholderNeed
from rgss.requirements.requirement import Requirement
from rgss.requirements.review import Review
from rgss.requirements.rule_settings import RuleSetting


def build_need(item: NeedFile) -> StakeholderNeed:
    """A stakeholder requirement as the file says it."""
    return StakeholderNeed(
        id=item.id,
        kind=item.kind,
        text=item.text,
        rationale=item.rationale,
        source=item.source,
        priority=item.priority,
        status=item.status,
        owner=item.owner,
        parent=item.parent,
        exemptions=_exemptions(item.exempt),
    )


def build_requirement(item: RequirementFile) -> Requirement:
    """A system requirement as the file says it."""
    return Requirement(
        id=item.id,
        group=item.group,
        text=item.text,
        rationale=item.rationale,
        source=item.source,
        derived_from=item.derived_from,
        satisfied_by=item.satisfied_by,
        verification=item.verification,
        criterion=None if item.criterion is None else build_criterion(item.criterion),
        criterion_exemption=item.criterion_exemption or "",
        priority=item.priority,
        status=item.status,
        owner=item.owner,
        parent=item.parent,
        traces=item.traces,
        success=item.success or "",
        facility=item.facility or "",
        phase=item.phase,
        exemptions=_exemptions(item.exempt),
    )


def build_criterion(item: CriterionFile) -> Criterion:
    """A criterion as the file says it, in the unit that the file uses."""
    threshold, unit = split_quantity(item.threshold)
    return Criterion(
        measure=item.measure, statistic=item.statistic, comparison=item.comparison, threshold=threshold, unit=unit
    )


def build_block(item: BlockFile) -> Block:
    """A block as the file says it."""
    return Block(
        id=item.id,
        name=item.name,
        level=item.level,
        parent=item.parent,
        relation=item.relation,
        text=item.text,
        actor=item.actor,
        exemptions=_exemptions(item.exempt),
    )


def build_behaviour(item: BehaviourFile) -> Behaviour:
    """A behaviour as the file says it."""
    return Behaviour(
        id=item.id,
        name=item.name,
        kind=item.kind,
        allocated_to=item.allocated_to,
        refines=item.refines,
        includes=item.includes,
        text=item.text,
        actors=item.actors,
        flow=None if item.flow is None else _flow(item.flow),
        interaction=None if item.interaction is None else _interaction(item.interaction),
        machine=None if item.machine is None else _machine(item.machine),
        exemptions=_exemptions(item.exempt),
    )


def build_setting(rule: str, item: RuleSettingFile) -> RuleSetting:
    """A rule's setting as the file says it."""
    return RuleSetting(
        rule=rule,
        severity=item.severity,
        enabled=item.enabled,
        terms_added=item.terms_added,
        terms_removed=item.terms_removed,
        reason=item.reason,
    )


def build_review(element_id: str, item: ReviewFile) -> Review:
    """An element's review as the file says it."""
    return Review(
        id=element_id, digest=item.digest, upstream=MappingProxyType(dict(item.upstream)), reviewer=item.reviewer
    )


def _exemptions(items: Sequence[ExemptionFile]) -> tuple[Exemption, ...]:
    return tuple(Exemption(rule=item.rule, reason=item.reason) for item in items)


def _flow(item: FlowFile) -> Flow:
    return Flow(
        nodes=tuple(FlowNode(id=node.id, kind=node.kind, text=node.text or "", does=node.does) for node in item.nodes),
        edges=tuple(FlowEdge(source=edge.source, target=edge.target, guard=edge.guard or "") for edge in item.edges),
    )


def _interaction(item: InteractionFile) -> Interaction:
    return Interaction(
        lifelines=item.lifelines,
        messages=tuple(
            Message(
                id=message.id,
                source=message.source,
                target=message.target,
                text=message.text,
                does=message.does,
                reply=message.reply,
            )
            for message in item.messages
        ),
        timings=tuple(
            TimingConstraint(first=timing.first, last=timing.last, criterion_of=timing.criterion_of, text=timing.text)
            for timing in item.timings
        ),
    )


def _machine(item: MachineFile) -> StateMachine:
    return StateMachine(
        states=tuple(
            State(id=state.id, kind=state.kind, name=state.name, phase=state.phase or "", does=state.does)
            for state in item.states
        ),
        transitions=tuple(
            Transition(source=way.source, target=way.target, guard=way.guard or "", failure=way.failure or "")
            for way in item.transitions
        ),
    )
