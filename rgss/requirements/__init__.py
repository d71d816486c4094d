"""Stakeholder needs, requirements, criteria and architecture."""

from rgss.requirements.architecture import (
    Architecture,
    Behaviour,
    BehaviourKind,
    Block,
    BlockLevel,
    BlockRelation,
    inherited_blocks,
)
from rgss.requirements.attribute_texts import common_attributes
from rgss.requirements.attributes import (
    NeedKind,
    Priority,
    RequirementGroup,
    Status,
    VerificationMethod,
    VerificationPhase,
)
from rgss.requirements.behaviour import (
    Flow,
    FlowEdge,
    FlowNode,
    FlowNodeKind,
    Interaction,
    Message,
    State,
    StateKind,
    StateMachine,
    TimingConstraint,
    Transition,
)
from rgss.requirements.comparison import RELATIVE_TOLERANCE, ZERO_TOLERANCE, Comparison
from rgss.requirements.content import Element, content_digest_of
from rgss.requirements.criterion import Criterion, CriterionFile, Statistic
from rgss.requirements.exemption import Exemption
from rgss.requirements.files import (
    ArchitectureFile,
    ReviewsFile,
    RulesFile,
    StakeholderFile,
    SystemFile,
    VerificationsFile,
)
from rgss.requirements.links import LinkKind, TraceLink
from rgss.requirements.loading import load_requirements
from rgss.requirements.needs import StakeholderNeed
from rgss.requirements.requirement import Requirement
from rgss.requirements.requirement_set import Place, RequirementSet, nearest
from rgss.requirements.review import Review
from rgss.requirements.rule_settings import RuleSetting
from rgss.requirements.structure import Connector, Port, PortDirection, ValueProperty
from rgss.requirements.verification_record import RecordedResult, VerificationRecord
