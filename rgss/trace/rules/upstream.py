"""Elements that each element depends on, and the places that state it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rgss.requirements import Behaviour, Element, Requirement, RequirementSet


@dataclass(frozen=True, slots=True, kw_only=True)
class Upstream:
    """Dependency of an element on another.

    Attributes:
        target: Id of the element on which the other depends.
        stated_by: Id of the element whose entry states the link; a requirement states by which element it is satisfied.
        at: The part of that entry.
    """

    target: str
    stated_by: str
    at: tuple[str | int, ...]


def upstream_of_each(requirements: RequirementSet) -> Mapping[str, tuple[Upstream, ...]]:
    """Direct dependencies of each element by id, in the stated order.

    A requirement depends on those from which it derives, to which it traces and in which it is contained; a block or
    behaviour on the requirements that it satisfies or refines and on its containing block.
    """
    found: dict[str, list[Upstream]] = {element.id: [] for element in requirements.elements}
    for element in requirements.elements:
        found[element.id].extend(_stated(element))
        if isinstance(element, Requirement):
            for index, other in enumerate(element.satisfied_by):
                link = Upstream(target=element.id, stated_by=element.id, at=("satisfied_by", index))
                found.setdefault(other, []).append(link)
    return {name: tuple(links) for name, links in found.items()}


def _stated(element: Element) -> Iterator[Upstream]:
    if isinstance(element, Behaviour):
        yield from _each(element.id, "refines", element.refines)
        if element.interaction is not None:
            for index, timing in enumerate(element.interaction.timings):
                at = ("interaction", "timings", index, "criterion_of")
                yield Upstream(target=timing.criterion_of, stated_by=element.id, at=at)
        return
    if element.parent is not None:
        yield Upstream(target=element.parent, stated_by=element.id, at=("parent",))
    if isinstance(element, Requirement):
        yield from _each(element.id, "derived_from", element.derived_from)
        yield from _each(element.id, "traces", element.traces)


def _each(element_id: str, key: str, targets: tuple[str, ...]) -> Iterator[Upstream]:
    for index, target in enumerate(targets):
        yield Upstream(target=target, stated_by=element_id, at=(key, index))
