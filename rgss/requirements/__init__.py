"""Needs, requirements, criteria and architecture: what is asked for, and what is to satisfy it."""

from rgss.requirements.architecture import (
    Architecture,
    Behaviour,
    BehaviourKind,
    Block,
    BlockLevel,
    BlockRelation,
)
from rgss.requirements.attributes import NeedKind, Priority, RequirementGroup, Status, VerificationMethod
from rgss.requirements.criterion import Comparison, Criterion, Statistic
from rgss.requirements.links import LinkKind, TraceLink
from rgss.requirements.loading import load_requirements
from rgss.requirements.needs import StakeholderNeed
from rgss.requirements.requirement import Requirement
from rgss.requirements.requirement_set import Place, RequirementSet

__all__ = [
    "Architecture",
    "Behaviour",
    "BehaviourKind",
    "Block",
    "BlockLevel",
    "BlockRelation",
    "Comparison",
    "Criterion",
    "LinkKind",
    "NeedKind",
    "Place",
    "Priority",
    "Requirement",
    "RequirementGroup",
    "RequirementSet",
    "StakeholderNeed",
    "Statistic",
    "Status",
    "TraceLink",
    "VerificationMethod",
    "load_requirements",
]
