"""Ids within one behaviour: the nodes of a flow, the messages of a sequence, the states of a machine."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

from rgss.findings import Finding
from rgss.requirements.hints import Hints
from rgss.requirements.references import Declaration

At = tuple["str | int", ...]


def repeated(declaration: Declaration, at: At, ids: Sequence[str]) -> Iterator[Finding]:
    """Findings about duplicate ids in a list.

    Args:
        declaration: The behaviour.
        at: The list within it.
        ids: The ids of its entries, in their order.
    """
    seen: set[str] = set()
    for index, each in enumerate(ids):
        if each in seen:
            yield declaration.finding("duplicate-id", f"id {each!r} is repeated in {at[-1]}", (*at, index, "id"))
        seen.add(each)


def unknown(
    declaration: Declaration, at: At, named: str, known: Collection[str], what: str, hints: Hints
) -> Iterator[Finding]:
    """Finding about an id that is unknown in the same behaviour.

    Args:
        declaration: The behaviour.
        at: Location of the id within it.
        named: The id.
        known: The known ids.
        what: Name of its kind in messages.
        hints: Finder of the nearest known id.
    """
    if named not in known:
        message = f"{at[-1]}: {named!r} is not a {what}"
        yield declaration.finding("dangling-id", message, at, hint=hints.nearest(named, known))


def reached_from(starts: Iterable[str], ways: Iterable[tuple[str, str]]) -> frozenset[str]:
    """Ids reachable from start ids over any number of edges, including the start ids.

    Args:
        starts: Start ids.
        ways: Source and target of each edge.
    """
    onward: dict[str, list[str]] = {}
    for source, target in ways:
        onward.setdefault(source, []).append(target)
    reached: set[str] = set()
    pending = [*starts]
    while pending:
        here = pending.pop()
        if here not in reached:
            reached.add(here)
            pending += onward.get(here, [])
    return frozenset(reached)
