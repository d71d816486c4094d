"""Performers of an activity's actions: all actions have one or none has, within the activity's allocation."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rgss.findings import Finding
from rgss.requirements.architecture import Behaviour, Block
from rgss.requirements.behaviour import FlowNodeKind
from rgss.requirements.references import Declaration


def check_performers(declaration: Declaration, activity: Behaviour, blocks: Mapping[str, Block]) -> Iterator[Finding]:
    """Findings on who performs the actions of an activity.

    Args:
        declaration: The activity.
        activity: The same, with its flow.
        blocks: The blocks that could be read, by their ids.
    """
    nodes = () if activity.flow is None else activity.flow.nodes
    divided = any(node.performer is not None for node in nodes)
    for index, node in enumerate(nodes):
        at = ("flow", "nodes", index)
        if node.kind is not FlowNodeKind.ACTION and node.performer is not None:
            message = f"{node.kind.value} {node.id!r} has a performer; only an action has"
            yield declaration.finding("flow", message, (*at, "performer"))
        elif node.kind is FlowNodeKind.ACTION and node.performer is None and divided:
            message = f"action {node.id!r} has no performer, but other actions of the flow have one"
            yield declaration.finding("flow", message, at, hint="name the block that performs it")
        elif node.performer in blocks and not _is_within(node.performer, activity.allocated_to, blocks):
            message = f"performer: {node.performer!r} is no block that the activity is allocated to, nor one within it"
            yield declaration.finding("flow", message, (*at, "performer"), hint="add it to 'allocated_to'")


def _is_within(block_id: str | None, allocated: tuple[str, ...], blocks: Mapping[str, Block]) -> bool:
    """True if a block is one of those allocated, or a part or a kind of one over any number of steps."""
    seen: set[str] = set()
    while block_id is not None and block_id in blocks and block_id not in seen:
        if block_id in allocated:
            return True
        seen.add(block_id)
        block_id = blocks[block_id].parent
    return False
