"""Consistency of a sequence's messages and of its timing constraints."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping

from rgss.findings import Finding
from rgss.requirements.behaviour import Interaction, TimingConstraint
from rgss.requirements.checks.inner_ids import At, repeated, unknown
from rgss.requirements.hints import Hints
from rgss.requirements.references import Declaration
from rgss.requirements.requirement import Requirement

_MESSAGES: At = ("interaction", "messages")
_TIMINGS: At = ("interaction", "timings")


def check_interaction(
    declaration: Declaration,
    interaction: Interaction,
    requirements: Mapping[str, Requirement],
    hints: Hints,
) -> Iterator[Finding]:
    """Findings on an interaction.

    Args:
        declaration: The sequence.
        interaction: Its messages.
        requirements: The readable system requirements, by id.
        hints: Finder of the nearest known id.
    """
    yield from repeated(declaration, _MESSAGES, [message.id for message in interaction.messages])
    order = {message.id: index for index, message in enumerate(interaction.messages)}
    lifelines = frozenset(interaction.lifelines)
    open_calls: Counter[tuple[str, str]] = Counter()
    for index, message in enumerate(interaction.messages):
        at = (*_MESSAGES, index)
        yield from unknown(declaration, (*at, "source"), message.source, lifelines, "lifeline", hints)
        yield from unknown(declaration, (*at, "target"), message.target, lifelines, "lifeline", hints)
        if not message.reply:
            open_calls[message.source, message.target] += 1
            continue
        if not open_calls[message.target, message.source]:
            yield _broken(declaration, f"reply {message.id!r} answers no message", at)
        else:
            open_calls[message.target, message.source] -= 1
        if message.does is not None:
            yield _broken(declaration, f"reply {message.id!r} sets nothing off", (*at, "does"))
    for index, timing in enumerate(interaction.timings):
        yield from _check_timing(declaration, timing, order, (*_TIMINGS, index), hints)
        yield from _check_criterion(declaration, timing, requirements, (*_TIMINGS, index, "criterion_of"))


def _check_timing(
    declaration: Declaration, timing: TimingConstraint, order: Mapping[str, int], at: At, hints: Hints
) -> Iterator[Finding]:
    yield from unknown(declaration, (*at, "first"), timing.first, order, "message of the sequence", hints)
    yield from unknown(declaration, (*at, "last"), timing.last, order, "message of the sequence", hints)
    if timing.first in order and timing.last in order and order[timing.first] >= order[timing.last]:
        yield _broken(declaration, f"message {timing.last!r} does not come after {timing.first!r}", (*at, "last"))


def _check_criterion(
    declaration: Declaration, timing: TimingConstraint, requirements: Mapping[str, Requirement], at: At
) -> Iterator[Finding]:
    requirement = requirements.get(timing.criterion_of)
    # The unit of the criterion is checked elsewhere, so that one error gives one finding.
    if requirement is not None and requirement.criterion is None:
        message = f"criterion_of: {requirement.id!r} has no criterion that could bound a time"
        yield _broken(declaration, message, at)


def _broken(declaration: Declaration, message: str, at: At) -> Finding:
    return declaration.finding("interaction", message, at)
