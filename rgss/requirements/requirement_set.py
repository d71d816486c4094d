"""Requirement set: stakeholder requirements, system requirements and architecture of one project."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from rgss.documents import Document
from rgss.errors import DefinitionError
from rgss.findings import Finding, Severity
from rgss.requirements.architecture import Architecture, Behaviour
from rgss.requirements.content import Element, content_digest_of
from rgss.requirements.hints import Hints
from rgss.requirements.links import LinkKind, TraceLink
from rgss.requirements.needs import StakeholderNeed
from rgss.requirements.requirement import Requirement
from rgss.requirements.review import Review
from rgss.requirements.rule_settings import RuleSetting
from rgss.requirements.verification_record import VerificationRecord


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """Position of a declaration: a file and a location in it.

    Attributes:
        document: The file.
        location: Keys and indices from the top of the file to it.
    """

    document: Document
    location: tuple[str | int, ...]

    def finding(
        self,
        rule: str,
        message: str,
        *,
        at: Sequence[str | int] = (),
        hint: str = "",
        severity: Severity = Severity.ERROR,
        at_key: bool = False,
    ) -> Finding:
        """Finding at this position, or at a part of the element.

        Args:
            rule: The id of the violated rule.
            message: The problem.
            at: The part to point at, such as ``("criterion", "threshold")``.
            hint: Advice.
            severity: Its severity.
            at_key: True to point at the key instead of its value.
        """
        location = (*self.location, *at)
        return self.document.finding(rule, message, location, hint=hint, severity=severity, at_key=at_key)


@dataclass(frozen=True, slots=True, kw_only=True)
class RequirementSet:
    """Requirements of a project, and the model of the system.

    A set from `load_requirements` has unique ids, no unknown references, and no element that depends on itself.

    Attributes:
        stakeholder: The stakeholder requirements, in the file's order.
        system: The system requirements, in the file's order.
        architecture: The model of the system.
        places: Place of each element's declaration, by its id.
        reviews: The reviews by id of the element, which may have been removed.
        review_places: Place of each review.
        records: The verification records by id of the requirement, which may have been removed.
        record_places: Place of each verification record.
        settings: Settings of rules by id, which may be unknown.
        setting_places: Place of each setting.
    """

    stakeholder: tuple[StakeholderNeed, ...]
    system: tuple[Requirement, ...]
    architecture: Architecture
    places: Mapping[str, Place]
    reviews: Mapping[str, Review] = field(default_factory=lambda: MappingProxyType({}))
    review_places: Mapping[str, Place] = field(default_factory=lambda: MappingProxyType({}))
    records: Mapping[str, VerificationRecord] = field(default_factory=lambda: MappingProxyType({}))
    record_places: Mapping[str, Place] = field(default_factory=lambda: MappingProxyType({}))
    settings: Mapping[str, RuleSetting] = field(default_factory=lambda: MappingProxyType({}))
    setting_places: Mapping[str, Place] = field(default_factory=lambda: MappingProxyType({}))
    _by_id: Mapping[str, Element] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        # Reversed, so that of two elements with the same id the first is found.
        object.__setattr__(self, "_by_id", {element.id: element for element in reversed(self.elements)})

    @property
    def elements(self) -> tuple[Element, ...]:
        """All elements with an id: stakeholder requirements, system requirements, blocks, behaviours."""
        return (*self.stakeholder, *self.system, *self.architecture.elements)

    @property
    def links(self) -> tuple[TraceLink, ...]:
        """All stated links, in the order of `elements`.

        A requirement states by which element it is satisfied, so the source of that link is another element. Behaviours
        that run as part of others, and criteria, which measures verify, are not links of this list.
        """
        return tuple(link for element in self.elements for link in _links_of(element))

    def element(self, element_id: str) -> Element:
        """Element by id.

        Raises:
            DefinitionError: The id is unknown; the hint names the nearest id.
        """
        element = self._by_id.get(element_id)
        if element is None:
            raise self._unknown(element_id)
        return element

    def content_digest(self, element_id: str) -> str:
        """Digest of the reviewed content of an element; see `content_digest_of`.

        Raises:
            DefinitionError: The id is unknown; the hint names the nearest id.
        """
        return content_digest_of(self.element(element_id))

    def requirement(self, requirement_id: str) -> Requirement:
        """System requirement by id.

        Raises:
            DefinitionError: The id is unknown; the hint names the nearest id.
        """
        element = self._by_id.get(requirement_id)
        if isinstance(element, Requirement):
            return element
        raise DefinitionError(
            f"{requirement_id!r} is not a system requirement",
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
        """Finding at an element of the set.

        Args:
            rule: The id of the violated rule.
            element_id: The element.
            message: The problem.
            at: The part of the element to point at, such as ``("criterion", "threshold")``.
            hint: Advice.
            severity: Its severity.

        Raises:
            DefinitionError: The set has no such element.
        """
        place = self.places.get(element_id)
        if place is None:
            raise self._unknown(element_id)
        return place.finding(rule, message, at=at, hint=hint, severity=severity)

    def _unknown(self, element_id: str) -> DefinitionError:
        hint = nearest(element_id, self._by_id)
        return DefinitionError(f"{element_id!r} is not an element of the requirements", hint=hint)


def nearest(name: str, names: Collection[str]) -> str:
    """Hint with the id nearest to an unknown one; empty if none is similar."""
    return Hints().nearest(name, names)


def _links_of(element: Element) -> Iterator[TraceLink]:
    parent = None if isinstance(element, Behaviour) else element.parent
    if parent is not None:
        yield _link(element.id, parent, LinkKind.CONTAINMENT)
    if isinstance(element, Requirement):
        yield from (_link(element.id, other, LinkKind.DERIVE) for other in element.derived_from)
        yield from (_link(element.id, other, LinkKind.TRACE) for other in element.traces)
        yield from (_link(other, element.id, LinkKind.SATISFY) for other in element.satisfied_by)
    elif isinstance(element, Behaviour):
        yield from (_link(element.id, block, LinkKind.ALLOCATE) for block in element.allocated_to)
        yield from (_link(element.id, other, LinkKind.REFINE) for other in element.refines)
        if element.interaction is not None:
            bounds = dict.fromkeys(timing.criterion_of for timing in element.interaction.timings)
            yield from (_link(element.id, other, LinkKind.TRACE) for other in bounds)


def _link(source: str, target: str, kind: LinkKind) -> TraceLink:
    return TraceLink(source=source, target=target, kind=kind)
