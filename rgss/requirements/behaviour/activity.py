"""Activities: actions and their control flow."""

from __future__ import annotations

from enum import Enum

from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Identifier, Text
from rgss.requirements.fields import Entries


class FlowNodeKind(str, Enum):
    """The nodes of an activity diagram."""

    INITIAL = "initial"
    ACTION = "action"
    DECISION = "decision"
    MERGE = "merge"
    FORK = "fork"
    JOIN = "join"
    FINAL = "final"


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class FlowNode:
    """A node of an activity's flow."""

    id: Identifier
    kind: FlowNodeKind
    text: Text | None = None
    does: Identifier | None = None
    performer: Identifier | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class FlowEdge:
    """An edge between two nodes of an activity's flow."""

    source: Identifier
    target: Identifier
    guard: Text | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Flow:
    """The flow of an activity."""

    nodes: Entries[FlowNode]
    edges: Entries[FlowEdge]
