"""Attributes of needs, requirements, blocks and behaviours, for all exchange formats."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType

from rgss.requirements import (
    Behaviour,
    BehaviourKind,
    Block,
    BlockLevel,
    BlockRelation,
    Comparison,
    Element,
    LinkKind,
    NeedKind,
    Priority,
    Requirement,
    RequirementGroup,
    StakeholderNeed,
    Statistic,
    Status,
    VerificationMethod,
    VerificationPhase,
)


class Part(str, Enum):
    """Part of the project that an element belongs to."""

    STAKEHOLDER = "stakeholder"
    SYSTEM = "system"
    BLOCK = "block"
    BEHAVIOUR = "behaviour"


class Form(str, Enum):
    """Form in which an attribute is written as one text."""

    LINE = "line"
    """A short text."""
    PROSE = "prose"
    """A text of any length."""
    CHOICE = "choice"
    """One value of an enumeration."""
    FLAG = "flag"
    """``true``, or nothing."""
    LINKS = "links"
    """Ids, separated by semicolons, unordered."""
    EXEMPTIONS = "exemptions"
    """``rule: reason``, separated by semicolons."""
    DETAIL = "detail"
    """A flow, an interaction or a state machine, as JSON."""
    DETAILS = "details"
    """Values, ports or connectors of a block, as a JSON list."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Attribute:
    """One attribute of an element.

    Attributes:
        name: Its name in exchange files.
        path: The keys that lead to it in an entry of a YAML file.
        form: The form of its text.
        choices: The values of an enumeration; otherwise empty.
        link: The relation that it states; None if it states none, or one that is not a link.
    """

    name: str
    path: tuple[str, ...]
    form: Form
    choices: tuple[str, ...] = ()
    link: LinkKind | None = None

    @property
    def holds_ids(self) -> bool:
        """True if it names other elements, one or more."""
        return self.form is Form.LINKS or self.link is not None


def _line(name: str, *path: str, link: LinkKind | None = None) -> Attribute:
    return Attribute(name=name, path=path or (name,), form=Form.LINE, link=link)


def _prose(name: str) -> Attribute:
    return Attribute(name=name, path=(name,), form=Form.PROSE)


def _choice(name: str, choices: type[Enum], *path: str) -> Attribute:
    values = tuple(str(choice.value) for choice in choices)
    return Attribute(name=name, path=path or (name,), form=Form.CHOICE, choices=values)


def _links(name: str, link: LinkKind | None = None) -> Attribute:
    return Attribute(name=name, path=(name,), form=Form.LINKS, link=link)


def _detail(name: str) -> Attribute:
    return Attribute(name=name, path=(name,), form=Form.DETAIL)


def _details(name: str) -> Attribute:
    return Attribute(name=name, path=(name,), form=Form.DETAILS)


_EXEMPT = Attribute(name="exempt", path=("exempt",), form=Form.EXEMPTIONS)
_PARENT = _line("parent", link=LinkKind.CONTAINMENT)
_STATE = (_choice("priority", Priority), _choice("status", Status), _line("owner"), _EXEMPT)

ATTRIBUTES: Mapping[Part, tuple[Attribute, ...]] = MappingProxyType(
    {
        Part.STAKEHOLDER: (
            _line("id"),
            _choice("kind", NeedKind),
            _PARENT,
            _prose("text"),
            _prose("rationale"),
            _prose("source"),
            *_STATE,
        ),
        Part.SYSTEM: (
            _line("id"),
            _choice("group", RequirementGroup),
            _PARENT,
            _prose("text"),
            _prose("rationale"),
            _prose("source"),
            _links("derived_from", LinkKind.DERIVE),
            _links("traces", LinkKind.TRACE),
            _links("satisfied_by", LinkKind.SATISFY),
            _choice("verification", VerificationMethod),
            _line("facility"),
            _choice("phase", VerificationPhase),
            _line("measure", "criterion", "measure", link=LinkKind.VERIFY),
            _choice("statistic", Statistic, "criterion", "statistic"),
            _choice("comparison", Comparison, "criterion", "comparison"),
            _line("threshold", "criterion", "threshold"),
            _prose("criterion_exemption"),
            _prose("success"),
            *_STATE,
        ),
        Part.BLOCK: (
            _line("id"),
            _line("name"),
            _choice("level", BlockLevel),
            _PARENT,
            _choice("relation", BlockRelation),
            _prose("text"),
            Attribute(name="actor", path=("actor",), form=Form.FLAG),
            _line("multiplicity"),
            _details("values"),
            _details("ports"),
            _details("connectors"),
            _EXEMPT,
        ),
        Part.BEHAVIOUR: (
            _line("id"),
            _line("name"),
            _choice("kind", BehaviourKind),
            _links("allocated_to", LinkKind.ALLOCATE),
            _links("refines", LinkKind.REFINE),
            _links("includes"),
            _prose("text"),
            _links("actors"),
            _detail("flow"),
            _detail("interaction"),
            _detail("machine"),
            _EXEMPT,
        ),
    }
)
"""The attributes of each part, in the order of the YAML files."""

MODELS: Mapping[Part, type[Element]] = MappingProxyType(
    {Part.STAKEHOLDER: StakeholderNeed, Part.SYSTEM: Requirement, Part.BLOCK: Block, Part.BEHAVIOUR: Behaviour}
)
"""Model of an entry of a YAML file."""
