"""Needs, requirements, criteria and architecture: what is asked for, and what is to satisfy it."""

from rgss.requirements.activity import Flow, FlowEdge, FlowNode, FlowNodeKind
from rgss.requirements.architecture import (
    Architecture,
    Behaviour,
    BehaviourKind,
    Block,
    BlockLevel,
    BlockRelation,
)
from rgss.requirements.attributes import (
    NeedKind,
    Priority,
    RequirementGroup,
    Status,
    VerificationMethod,
    VerificationPhase,
)
from rgss.requirements.content import Element, content_digest_of
from rgss.requirements.criterion import Comparison, Criterion, Statistic
from rgss.requirements.exemption import Exemption
from rgss.requirements.interaction import Interaction, Message, TimingConstraint
from rgss.requirements.links import LinkKind, TraceLink
from rgss.requirements.loading import load_requirements
from rgss.requirements.needs import StakeholderNeed
from rgss.requirements.requirement import Requirement
from rgss.requirements.requirement_set import Place, RequirementSet
from rgss.requirements.review import Review
from rgss.requirements.rule_settings import RuleSetting
from rgss.requirements.state_machine import State, StateKind, StateMachine, Transition

__all__ = [
    "Architecture",
    "Behaviour",
    "BehaviourKind",
    "Block",
    "BlockLevel",
    "BlockRelation",
    "Comparison",
    "Criterion",
    "Element",
    "Exemption",
    "Flow",
    "FlowEdge",
    "FlowNode",
    "FlowNodeKind",
    "Interaction",
    "LinkKind",
    "Message",
    "NeedKind",
    "Place",
    "Priority",
    "Requirement",
    "RequirementGroup",
    "RequirementSet",
    "Review",
    "RuleSetting",
    "StakeholderNeed",
    "State",
    "StateKind",
    "StateMachine",
    "Statistic",
    "Status",
    "TimingConstraint",
    "TraceLink",
    "Transition",
    "VerificationMethod",
    "VerificationPhase",
    "content_digest_of",
    "load_requirements",
]
