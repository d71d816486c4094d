"""Stakeholder requirements, system requirements and architecture of one project."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rgss.documents import Document
from rgss.errors import DefinitionError
from rgss.findings import Finding, Severity
from rgss.requirements.architecture import Architecture
from rgss.requirements.links import LinkKind, TraceLink
from rgss.requirements.needs import StakeholderNeed
from rgss.requirements.requirement import Requirement


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """Where an element is declared.

    Attributes:
        document: The file.
        location: Keys and indices from the top of the file to the element.
    """

    document: Document
    location: tuple[str | int, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class RequirementSet:
    """What a project asks for, and the model that is to satisfy it.

    A set from `load_requirements` has unique ids, no reference to an id that is not there, and
    no element that rests on itself.

    Attributes:
        stakeholder: The stakeholder requirements, in the file's order.
        system: The system requirements, in the file's order.
        architecture: The model of the system.
        places: Where each element is declared, by its id.
    """

    stakeholder: tuple[StakeholderNeed, ...]
    system: tuple[Requirement, ...]
    architecture: Architecture
    places: Mapping[str, Place]

    @property
    def links(self) -> tuple[TraceLink, ...]:
        """Every link that the three files state, in their order."""
        links = [_link(item.id, parent, LinkKind.DERIVE) for item in self.system for parent in item.derived_from]
        links += [_link(element, item.id, LinkKind.SATISFY) for item in self.system for element in item.satisfied_by]
        links += [_link(item.id, item.parent, LinkKind.CONTAINMENT) for item in self.architecture.blocks if item.parent]
        for behaviour in self.architecture.behaviours:
            links += [_link(behaviour.id, block, LinkKind.ALLOCATE) for block in behaviour.allocated_to]
            links += [_link(behaviour.id, other, LinkKind.REFINE) for other in behaviour.refines]
        return tuple(links)

    def requirement(self, requirement_id: str) -> Requirement:
        """The system requirement of an id.

        Raises:
            DefinitionError: There is none; the hint names the nearest id.
        """
        for requirement in self.system:
            if requirement.id == requirement_id:
                return requirement
        raise DefinitionError(
            f"{requirement_id!r} is no system requirement",
            hint=nearest(requirement_id, [requirement.id for requirement in self.system]),
        )

    def finding(
        self,
        rule: str,
        element_id: str,
        message: str,
        *,
        at: Sequence[str | int] = ("id",),
        hint: str = "",
        severity: Severity = Severity.ERROR,
    ) -> Finding:
        """A finding at an element of the set.

        Args:
            rule: The id of the broken rule.
            element_id: The element.
            message: What is wrong.
            at: The part of the element to point at, such as ``("criterion", "threshold")``.
            hint: How to mend it.
            severity: How much it matters.

        Raises:
            DefinitionError: The set has no such element.
        """
        place = self.places.get(element_id)
        if place is None:
            raise DefinitionError(
                f"{element_id!r} is no element of the requirements", hint=nearest(element_id, self.places)
            )
        return place.document.finding(rule, message, (*place.location, *at), hint=hint, severity=severity)


def nearest(name: str, names: Sequence[str] | Mapping[str, object]) -> str:
    """A hint that names the id most like a wrong one; empty if none is like it."""
    near = difflib.get_close_matches(name, list(names), n=1)
    return f"did you mean {near[0]!r}?" if near else ""


def _link(source: str, target: str, kind: LinkKind) -> TraceLink:
    return TraceLink(source=source, target=target, kind=kind)
