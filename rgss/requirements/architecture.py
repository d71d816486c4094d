"""Architecture: structure and behaviour, to which requirements are allocated."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from enum import Enum
from typing import Any

from pydantic import model_validator
from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Identifier, Text
from rgss.requirements.behaviour import Flow, Interaction, StateMachine
from rgss.requirements.exemption import Exemption
from rgss.requirements.structure import Connector, Multiplicity, Port, ValueProperty


class BlockLevel(str, Enum):
    """Level of a block in the decomposition."""

    CONTEXT = "context"
    SYSTEM = "system"
    SUBSYSTEM = "subsystem"
    ELEMENT = "element"


class BlockRelation(str, Enum):
    """Relation of a block to its parent: a part of it, or a kind of it."""

    PART = "part"
    KIND = "kind"


class BehaviourKind(str, Enum):
    """Kind of a behaviour."""

    USE_CASE = "use_case"
    ACTIVITY = "activity"
    SEQUENCE = "sequence"
    STATE_MACHINE = "state_machine"


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Block:
    """A block."""

    id: Identifier
    name: Text
    level: BlockLevel
    parent: Identifier | None = None
    relation: BlockRelation = BlockRelation.PART
    text: Text
    actor: bool = False
    multiplicity: Multiplicity | None = None
    values: tuple[ValueProperty, ...] = ()
    ports: tuple[Port, ...] = ()
    connectors: tuple[Connector, ...] = ()
    exempt: tuple[Exemption, ...] = ()


def inherited_blocks(block: Block, blocks: Mapping[str, Block]) -> Iterator[Block]:
    """A block, then those that it is a kind of, whose parts, values and ports it has too."""
    seen: set[str] = set()
    step: Block | None = block
    while step is not None and step.id not in seen:
        seen.add(step.id)
        yield step
        is_kind = step.parent is not None and step.relation is BlockRelation.KIND
        step = blocks.get(step.parent) if is_kind and step.parent is not None else None


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Behaviour:
    """A behaviour."""

    id: Identifier
    name: Text
    kind: BehaviourKind
    allocated_to: tuple[Identifier, ...] = ()
    refines: tuple[Identifier, ...] = ()
    includes: tuple[Identifier, ...] = ()
    text: Text
    actors: tuple[Identifier, ...] = ()
    flow: Flow | None = None
    interaction: Interaction | None = None
    machine: StateMachine | None = None
    exempt: tuple[Exemption, ...] = ()

    @model_validator(mode="after")
    def _detail_fits_kind(self) -> Behaviour:
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


@dataclasses.dataclass(frozen=True, slots=True, kw_only=True)
class Architecture:
    """The model of the system.

    Attributes:
        blocks: Its structure, in the file's order.
        behaviours: Its behaviour, in the file's order.
    """

    blocks: tuple[Block, ...]
    behaviours: tuple[Behaviour, ...]

    @property
    def elements(self) -> tuple[Block | Behaviour, ...]:
        """Blocks, then behaviours: all elements that can satisfy a requirement."""
        return (*self.blocks, *self.behaviours)
