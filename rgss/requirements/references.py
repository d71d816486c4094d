"""Ids across the three files: declared once, naming what is there, resting on no cycle."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

from rgss.documents import Document
from rgss.findings import Finding
from rgss.requirements.requirement_set import nearest


class ElementKind(Enum):
    """What an id names, in the words of messages."""

    NEED = "stakeholder requirement"
    REQUIREMENT = "system requirement"
    BLOCK = "block"
    BEHAVIOUR = "behaviour"


@dataclass(frozen=True, slots=True, kw_only=True)
class Reference:
    """An element's mention of another element.

    Attributes:
        field: The key that it stands under.
        index: Its index in the list there; None if it is not in a list.
        target: The id that it names.
        kinds: What that id may be.
        ordering: The elements linked under this key must not rest on themselves.
    """

    field: str
    index: int | None
    target: str
    kinds: tuple[ElementKind, ...]
    ordering: bool = True

    @property
    def at(self) -> tuple[str | int, ...]:
        """The part of the element where it stands."""
        return (self.field,) if self.index is None else (self.field, self.index)


@dataclass(frozen=True, slots=True, kw_only=True)
class Declaration:
    """An id, what it names, where it is declared and what the element refers to."""

    id: str
    kind: ElementKind
    document: Document
    location: tuple[str | int, ...]
    references: tuple[Reference, ...] = ()

    def finding(self, rule: str, message: str, at: Sequence[str | int], *, hint: str = "") -> Finding:
        """A finding at a part of the element."""
        return self.document.finding(f"requirements.{rule}", message, (*self.location, *at), hint=hint)


def check_references(declarations: Sequence[Declaration], *, known: Iterable[ElementKind]) -> Iterator[Finding]:
    """Find ids declared twice, references to nothing, and elements that rest on themselves.

    Args:
        declarations: Everything declared, in the order of files and lines.
        known: The kinds whose file could be read; a reference to another kind is left alone.
    """
    first: dict[str, Declaration] = {}
    for declaration in declarations:
        if declaration.id in first:
            yield _duplicate(declaration, first[declaration.id])
        else:
            first[declaration.id] = declaration
    readable = frozenset(known)
    for declaration in declarations:
        yield from _wrong_references(declaration, first, readable)
    yield from _cycles(first)


def _duplicate(again: Declaration, first: Declaration) -> Finding:
    where = first.finding("duplicate-id", "", ("id",))
    message = f"id {again.id!r} stands already at {where.file}:{where.line}:{where.column}"
    return again.finding("duplicate-id", message, ("id",), hint="give it an id of its own")


def _wrong_references(
    declaration: Declaration, first: Mapping[str, Declaration], known: frozenset[ElementKind]
) -> Iterator[Finding]:
    seen: set[tuple[str, str]] = set()
    for reference in declaration.references:
        target = first.get(reference.target)
        if (reference.field, reference.target) in seen:
            message = f"{reference.field}: {reference.target!r} is named twice"
            yield declaration.finding("repeated-id", message, reference.at, hint="keep one")
        elif target is None and known.issuperset(reference.kinds):
            names = [name for name, other in first.items() if other.kind in reference.kinds]
            message = f"{reference.field}: {reference.target!r} is not declared"
            yield declaration.finding("dangling-id", message, reference.at, hint=nearest(reference.target, names))
        elif target is not None and target.kind not in reference.kinds:
            wanted = " or ".join(kind.value for kind in reference.kinds)
            message = f"{reference.field}: {reference.target!r} is a {target.kind.value}, not a {wanted}"
            yield declaration.finding("wrong-kind", message, reference.at)
        seen.add((reference.field, reference.target))


def _cycles(first: Mapping[str, Declaration]) -> Iterator[Finding]:
    """Walk depth first, without recursion; report each reference that leads back into the walk."""
    finished: set[str] = set()
    for root in first:
        walk = {} if root in finished else {root: _orderings(first, root)}
        while walk:
            name = next(reversed(walk))
            reference = next(walk[name], None)
            if reference is None:
                finished.add(name)
                walk.pop(name)
            elif reference.target in walk:
                names = list(walk)
                chain = " → ".join([name, *names[names.index(reference.target) :]])
                yield first[name].finding("cycle", f"{name!r} rests on itself: {chain}", reference.at, hint="cut it")
            elif reference.target not in finished:
                walk[reference.target] = _orderings(first, reference.target)


def _orderings(first: Mapping[str, Declaration], name: str) -> Iterator[Reference]:
    for reference in first[name].references:
        target = first.get(reference.target)
        if reference.ordering and target is not None and target.kind in reference.kinds:
            yield reference
