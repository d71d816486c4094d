"""Activities, interactions and state machines."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.requirements.behaviour.activity import Flow, FlowEdge, FlowNode, FlowNodeKind
    from rgss.requirements.behaviour.interaction import Interaction, Message, TimingConstraint
    from rgss.requirements.behaviour.state_machine import State, StateKind, StateMachine, Transition
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
