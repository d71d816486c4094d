"""The structure and the behaviour that requirements are allocated to."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class BlockLevel(str, Enum):
    """How far down the decomposition a block stands."""

    CONTEXT = "context"
    SYSTEM = "system"
    SUBSYSTEM = "subsystem"
    ELEMENT = "element"


class BlockRelation(str, Enum):
    """How a block belongs to its parent: as a part of it, or as one kind of it."""

    PART = "part"
    KIND = "kind"


class BehaviourKind(str, Enum):
    """What sort of behaviour it is."""

    USE_CASE = "use_case"
    ACTIVITY = "activity"


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """A piece of structure: physical, software or environment.

    Attributes:
        id: Its id, such as ``BLK-manipulator``.
        name: What it is called.
        level: How far down the decomposition it stands.
        parent: Id of the block that contains it; None at the top.
        relation: Whether it is a part or a kind of its parent.
        text: What it is.
    """

    id: str
    name: str
    level: BlockLevel
    parent: str | None
    relation: BlockRelation
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Behaviour:
    """Something that the system does.

    Attributes:
        id: Its id, such as ``ACT-grasp``.
        name: What it is called.
        kind: Use case or activity.
        allocated_to: Ids of the blocks that do it.
        refines: Ids of the behaviours that it spells out.
        includes: Ids of the behaviours that always run as part of it.
        text: What happens.
    """

    id: str
    name: str
    kind: BehaviourKind
    allocated_to: tuple[str, ...]
    refines: tuple[str, ...]
    includes: tuple[str, ...]
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
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
        """Blocks, then behaviours: everything that can satisfy a requirement."""
        return (*self.blocks, *self.behaviours)
