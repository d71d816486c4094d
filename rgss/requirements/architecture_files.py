"""What the YAML files of the architecture look like."""

from __future__ import annotations

from typing import Any

from pydantic import model_validator

from rgss.documents import DocumentModel, Identifier, Text
from rgss.requirements.architecture import BehaviourKind, BlockLevel, BlockRelation
from rgss.requirements.behaviour import FlowNodeKind, StateKind
from rgss.requirements.files import Entries, ExemptionFile


class BlockFile(DocumentModel):
    """A block."""

    id: Identifier
    name: Text
    level: BlockLevel
    parent: Identifier | None = None
    relation: BlockRelation = BlockRelation.PART
    text: Text
    actor: bool = False
    exempt: tuple[ExemptionFile, ...] = ()


class FlowNodeFile(DocumentModel):
    """A node of an activity's flow."""

    id: Identifier
    kind: FlowNodeKind
    text: Text | None = None
    does: Identifier | None = None


class FlowEdgeFile(DocumentModel):
    """A way from node to node of an activity's flow."""

    source: Identifier
    target: Identifier
    guard: Text | None = None


class FlowFile(DocumentModel):
    """The flow of an activity."""

    nodes: Entries[FlowNodeFile]
    edges: Entries[FlowEdgeFile]


class MessageFile(DocumentModel):
    """A message of a sequence."""

    id: Identifier
    source: Identifier
    target: Identifier
    text: Text
    does: Identifier | None = None
    reply: bool = False


class TimingFile(DocumentModel):
    """A bound on the time between two messages of a sequence."""

    first: Identifier
    last: Identifier
    criterion_of: Identifier
    text: Text


class InteractionFile(DocumentModel):
    """The messages of a sequence."""

    lifelines: Entries[Identifier]
    messages: Entries[MessageFile]
    timings: tuple[TimingFile, ...] = ()


class StateFile(DocumentModel):
    """A state of a state machine."""

    id: Identifier
    kind: StateKind
    name: Text
    phase: Identifier | None = None
    does: Identifier | None = None


class TransitionFile(DocumentModel):
    """A way from state to state of a state machine."""

    source: Identifier
    target: Identifier
    guard: Text | None = None
    failure: Identifier | None = None


class MachineFile(DocumentModel):
    """The states of a state machine."""

    states: Entries[StateFile]
    transitions: Entries[TransitionFile]


class BehaviourFile(DocumentModel):
    """A behaviour."""

    id: Identifier
    name: Text
    kind: BehaviourKind
    allocated_to: tuple[Identifier, ...] = ()
    refines: tuple[Identifier, ...] = ()
    includes: tuple[Identifier, ...] = ()
    text: Text
    actors: tuple[Identifier, ...] = ()
    flow: FlowFile | None = None
    interaction: InteractionFile | None = None
    machine: MachineFile | None = None
    exempt: tuple[ExemptionFile, ...] = ()

    @model_validator(mode="after")
    def _detail_fits_kind(self) -> BehaviourFile:
        details: dict[str, tuple[Any, BehaviourKind]] = {
            "actors": (self.actors, BehaviourKind.USE_CASE),
            "flow": (self.flow, BehaviourKind.ACTIVITY),
            "interaction": (self.interaction, BehaviourKind.SEQUENCE),
            "machine": (self.machine, BehaviourKind.STATE_MACHINE),
        }
        for key, (detail, kind) in details.items():
            if detail and self.kind is not kind:
                raise ValueError(f"{key!r} belongs to a behaviour of kind {kind.value!r}, not {self.kind.value!r}")
        return self


class ArchitectureFile(DocumentModel):
    """The file ``architecture.yaml``, or one of the folder of that name."""

    blocks: tuple[BlockFile, ...] = ()
    behaviours: tuple[BehaviourFile, ...] = ()

    @model_validator(mode="after")
    def _not_empty(self) -> ArchitectureFile:
        if not self.blocks and not self.behaviours:
            raise ValueError("blocks or behaviours are expected")
        return self
