"""The structure and the behaviour that requirements are allocated to."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from rgss.requirements.behaviour import Flow, Interaction, StateMachine
from rgss.requirements.exemption import Exemption


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
    SEQUENCE = "sequence"
    STATE_MACHINE = "state_machine"


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
        actor: It stands outside and takes part in use cases.
        exemptions: The rules that it may break, and why.
    """

    id: str
    name: str
    level: BlockLevel
    parent: str | None
    relation: BlockRelation
    text: str
    actor: bool = False
    exemptions: tuple[Exemption, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Behaviour:
    """Something that the system does.

    Attributes:
        id: Its id, such as ``ACT-grasp``.
        name: What it is called.
        kind: Use case, activity, sequence or state machine.
        allocated_to: Ids of the blocks that do it.
        refines: Ids of the behaviours, needs and requirements that it spells out.
        includes: Ids of the behaviours that always run as part of it.
        text: What happens.
        actors: Of a use case, ids of the blocks that take part in it from outside.
        flow: Of an activity, its actions and their order; None while that is open.
        interaction: Of a sequence, its messages; None while that is open.
        machine: Of a state machine, its states; None while that is open.
        exemptions: The rules that it may break, and why.
    """

    id: str
    name: str
    kind: BehaviourKind
    allocated_to: tuple[str, ...]
    refines: tuple[str, ...]
    includes: tuple[str, ...]
    text: str
    actors: tuple[str, ...] = ()
    flow: Flow | None = None
    interaction: Interaction | None = None
    machine: StateMachine | None = None
    exemptions: tuple[Exemption, ...] = ()


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
