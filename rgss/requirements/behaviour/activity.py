"""Activities: actions and the order in which control passes through them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class FlowNodeKind(str, Enum):
    """The nodes of an activity diagram."""

    INITIAL = "initial"
    ACTION = "action"
    DECISION = "decision"
    MERGE = "merge"
    FORK = "fork"
    JOIN = "join"
    FINAL = "final"


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowNode:
    """One node of a flow.

    Attributes:
        id: Its id, unique within the flow.
        kind: What control does there.
        text: The action or the question; empty where the kind says it all.
        does: Id of the behaviour that an action calls; None if it calls none.
    """

    id: str
    kind: FlowNodeKind
    text: str
    does: str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowEdge:
    """One way from node to node.

    Attributes:
        source: Id of the node that it leaves.
        target: Id of the node that it reaches.
        guard: When it is taken; empty if always.
    """

    source: str
    target: str
    guard: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Flow:
    """What an activity diagram shows.

    Attributes:
        nodes: The nodes, in the file's order.
        edges: The ways between them, in the file's order.
    """

    nodes: tuple[FlowNode, ...]
    edges: tuple[FlowEdge, ...]
