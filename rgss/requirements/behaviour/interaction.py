"""Sequences: messages between blocks, and the time that may pass between them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Message:
    """One message from block to block.

    Attributes:
        id: Its id, unique within the interaction.
        source: Id of the block that sends it.
        target: Id of the block that receives it.
        text: The request or the reply.
        does: Id of the behaviour that it sets off; None if none.
        reply: It answers an earlier message.
    """

    id: str
    source: str
    target: str
    text: str
    does: str | None
    reply: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class TimingConstraint:
    """A bound on the time between two messages: the criterion of a requirement.

    Attributes:
        first: Id of the message that starts the time.
        last: Id of the message that ends it.
        criterion_of: Id of the system requirement whose criterion bounds it.
        text: What is timed.
    """

    first: str
    last: str
    criterion_of: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Interaction:
    """What a sequence diagram shows.

    Attributes:
        lifelines: Ids of the blocks that take part, from left to right.
        messages: The messages, in their order.
        timings: The bounds on the time between them.
    """

    lifelines: tuple[str, ...]
    messages: tuple[Message, ...]
    timings: tuple[TimingConstraint, ...]
