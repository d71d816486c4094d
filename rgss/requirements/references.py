"""Checks of ids across all files: unique declarations, existing targets, acyclic order."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

from rgss.documents import Document
from rgss.findings import Finding
from rgss.requirements.hints import Hints

_LONGEST_CHAIN = 10


class ElementKind(Enum):
    """Kind of the element of an id, as named in messages."""

    NEED = "stakeholder requirement"
    REQUIREMENT = "system requirement"
    BLOCK = "block"
    BEHAVIOUR = "behaviour"


@dataclass(frozen=True, slots=True, kw_only=True)
class Reference:
    """Reference of an element to another element.

    Attributes:
        at: Location of the reference within the element.
        target: The target id.
        kinds: Allowed kinds of the target.
        ordering: True if links under this key must be acyclic.
    """

    at: tuple[str | int, ...]
    target: str
    kinds: tuple[ElementKind, ...]
    ordering: bool = True

    @property
    def field(self) -> str:
        """Key of the reference."""
        return str(self.at[-2] if self.in_list else self.at[-1])

    @property
    def in_list(self) -> bool:
        """True for an entry of a list, which must not contain it twice."""
        return isinstance(self.at[-1], int)


@dataclass(frozen=True, slots=True, kw_only=True)
class Declaration:
    """Declaration of an element, with its references to other elements and to rules.

    Attributes:
        id: The id.
        kind: Kind of the element.
        document: The file.
        location: Keys and indices from the top of the file to the element.
        references: References of the element.
        exempt: The rules from which it is exempt.
    """

    id: str
    kind: ElementKind
    document: Document
    location: tuple[str | int, ...]
    references: tuple[Reference, ...] = ()
    exempt: tuple[str, ...] = ()

    def finding(self, rule: str, message: str, at: Sequence[str | int], *, hint: str = "") -> Finding:
        """Finding at a part of the element."""
        return self.document.finding(f"requirements.{rule}", message, (*self.location, *at), hint=hint)


def check_references(
    declarations: Sequence[Declaration], *, known: Iterable[ElementKind], hints: Hints
) -> Iterator[Finding]:
    """Findings about duplicate ids, unknown references, and elements that depend on themselves.

    Args:
        declarations: All declarations, in the order of files and lines.
        known: The kinds whose files are all readable; references to other kinds are not checked.
        hints: Finder of the nearest known id.
    """
    first: dict[str, Declaration] = {}
    for declaration in declarations:
        if declaration.id in first:
            yield _duplicate(declaration, first[declaration.id])
        else:
            first[declaration.id] = declaration
    names: dict[ElementKind, list[str]] = {kind: [] for kind in ElementKind}
    for declaration in first.values():
        names[declaration.kind].append(declaration.id)
    readable = frozenset(known)
    for declaration in declarations:
        yield from _repetitions(declaration)
        for reference in declaration.references:
            target = first.get(reference.target)
            if target is None and readable.issuperset(reference.kinds):
                message = f"{reference.field}: {reference.target!r} is not declared"
                hint = hints.nearest(reference.target, [name for kind in reference.kinds for name in names[kind]])
                yield declaration.finding("dangling-id", message, reference.at, hint=hint)
            elif target is not None and target.kind not in reference.kinds:
                *others, last = (kind.value for kind in reference.kinds)
                wanted = f"{', '.join(others)} or {last}" if others else last
                message = f"{reference.field}: {reference.target!r} is a {target.kind.value}, not a {wanted}"
                yield declaration.finding("wrong-kind", message, reference.at)
    yield from _cycles(first)


def _duplicate(again: Declaration, first: Declaration) -> Finding:
    where = first.finding("duplicate-id", "", ("id",))
    message = f"id {again.id!r} is already declared at {where.file}:{where.line}:{where.column}"
    return again.finding("duplicate-id", message, ("id",), hint="use a unique id")


def _repetitions(declaration: Declaration) -> Iterator[Finding]:
    seen: set[tuple[str, str]] = set()
    for reference in declaration.references:
        if reference.in_list:
            yield from _repetition(declaration, reference.field, reference.target, reference.at, seen)
    for index, rule in enumerate(declaration.exempt):
        yield from _repetition(declaration, "exempt", rule, ("exempt", index, "rule"), seen)


def _repetition(
    declaration: Declaration, field: str, named: str, at: Sequence[str | int], seen: set[tuple[str, str]]
) -> Iterator[Finding]:
    if (field, named) in seen:
        yield declaration.finding("repeated-id", f"{field}: {named!r} is named twice", at, hint="keep one")
    seen.add((field, named))


def _cycles(first: Mapping[str, Declaration]) -> Iterator[Finding]:
    """Depth-first search without recursion; reports each reference back into the search path."""
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
                chain = _chain(walk, reference.target)
                yield first[name].finding("cycle", f"{name!r} depends on itself: {chain}", reference.at, hint="cut it")
            elif reference.target not in finished:
                walk[reference.target] = _orderings(first, reference.target)


def _chain(walk: dict[str, Iterator[Reference]], start: str) -> str:
    """Cycle at the end of a search path, abbreviated if long."""
    backwards: list[str] = []
    for name in reversed(walk):
        backwards.append(name)
        if name == start or len(backwards) > _LONGEST_CHAIN:
            break
    whole = backwards[-1] == start
    onward = backwards[::-1] if whole else [start, "…", *backwards[_LONGEST_CHAIN // 2 :: -1]]
    return " → ".join([backwards[0], *onward])


def _orderings(first: Mapping[str, Declaration], name: str) -> Iterator[Reference]:
    for reference in first[name].references:
        target = first.get(reference.target)
        if reference.ordering and target is not None and target.kind in reference.kinds:
            yield reference
