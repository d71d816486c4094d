"""Names of another tool's attributes, values and types, and what they are in rgss."""

from __future__ import annotations

import difflib
import re
import shlex
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import TypeVar

from rgss.exchange.attributes import ATTRIBUTES, Attribute, Form, Part
from rgss.exchange.cells import joined
from rgss.exchange.content import Content, Row

PART = "part"
"""Name of the part of an element, where an attribute or a column of a file states it."""

ATTRIBUTE_NAMES: tuple[str, ...] = tuple(
    dict.fromkeys((PART, *(each.name for attributes in ATTRIBUTES.values() for each in attributes)))
)
"""The attributes that a name of another tool may stand for."""

LINKED: frozenset[str] = frozenset(
    each.name for attributes in ATTRIBUTES.values() for each in attributes if each.holds_ids
)
"""The attributes that name other elements."""

OF_TARGET = "target."
"""Prefix of the attribute that a relation states of its target, which then names the source."""

RELATION_MEANINGS: tuple[str, ...] = tuple(
    f"{end}{name}" for end in ("", OF_TARGET) for name in sorted(LINKED - {"measure"})
)
"""What a relation of another tool may be mapped to; measures are no objects of other tools."""

# Names of the ReqIF Implementation Guide, of StrictDoc and of Doorstop.
_SYNONYMS: Mapping[str, str] = MappingProxyType(
    {"foreignid": "id", "uid": "id", "statement": "text", "title": "name", "chaptername": "name"}
)
# Names that are too general to be read without being asked for, as DOORS, Polarion, Jama and Codebeamer have them.
_LIKELY: Mapping[str, str] = MappingProxyType(
    {
        "object_text": "text",
        "primary_text": "text",
        "description": "text",
        "requirement_text": "text",
        "requirement": "text",
        "object_identifier": "id",
        "identifier": "id",
        "requirement_id": "id",
        "verification_method": "verification",
        "verification_phase": "phase",
        "acceptance_criteria": "success",
        "responsible": "owner",
        "assigned_to": "owner",
        "assignee": "owner",
        "state": "status",
        "object_type": PART,
        "requirement_type": PART,
        "artifact_type": PART,
    }
)
_LEAST_LIKENESS = 0.8
_BETWEEN_IDS = re.compile(r"[;,\n]")
_BEGINS_WITH_LETTER = re.compile(r"[A-Za-z]")
_EMPTY: Mapping[str, str] = MappingProxyType({})
_Value = TypeVar("_Value")


def attribute_name(long: str) -> str:
    """Name in rgss of an attribute of any tool; the given name if there is none."""
    plain = _plain(long).removeprefix("reqif.")
    return _SYNONYMS.get(plain, plain)


@dataclass(frozen=True, slots=True, kw_only=True)
class ForeignNames:
    """Names of another tool that the user has mapped; names are compared without regard to case and blanks.

    Attributes:
        attributes: The attribute of rgss for each name; empty for an attribute that is left out without a note.
        values: The value of rgss for each value of the file, by the attribute of rgss.
        types: The part of the elements of each type.
        relations: The links that a relation of each type may be, of which the first that fits its ends counts, such as
            ``derived_from`` or ``target.satisfied_by``; none for relations that are left out without a note.
        id_prefix: Text before ids that do not begin with a letter, which ids of rgss do.
    """

    attributes: Mapping[str, str] = field(default_factory=lambda: _EMPTY)
    values: Mapping[str, Mapping[str, str]] = field(default_factory=lambda: MappingProxyType({}))
    types: Mapping[str, Part] = field(default_factory=lambda: MappingProxyType({}))
    relations: Mapping[str, tuple[str, ...]] = field(default_factory=lambda: MappingProxyType({}))
    id_prefix: str = ""
    _folded_attributes: Mapping[str, str] = field(init=False, repr=False, compare=False)
    _folded_types: Mapping[str, Part] = field(init=False, repr=False, compare=False)
    _folded_relations: Mapping[str, tuple[str, ...]] = field(init=False, repr=False, compare=False)
    _folded_values: Mapping[str, Mapping[str, str]] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Fold the names once: they are compared for each element of a file."""
        object.__setattr__(self, "_folded_attributes", _with_folded_keys(self.attributes))
        object.__setattr__(self, "_folded_types", _with_folded_keys(self.types))
        object.__setattr__(self, "_folded_relations", _with_folded_keys(self.relations))
        object.__setattr__(
            self, "_folded_values", {name: _with_folded_keys(values) for name, values in self.values.items()}
        )

    @property
    def is_given(self) -> bool:
        """True if the user has mapped a name, a type or ids: the file is of another tool."""
        return bool(self.attributes or self.types or self.id_prefix)

    def target(self, long: str) -> str | None:
        """The attribute for which a name was mapped; empty if it is left out, None if it is not mapped."""
        return self._folded_attributes.get(_folded(long))

    def part_of_type(self, type_name: str) -> Part | None:
        """The part for which a type was mapped."""
        return self._folded_types.get(_folded(type_name))

    def links_of(self, relation_type: str) -> tuple[str, ...] | None:
        """The links for which a type of relations was mapped; none if it is left out, None if it is not mapped."""
        return self._folded_relations.get(_folded(relation_type))

    def own_id(self, text: str) -> str:
        """The id in rgss for one of the file.

        An id that begins with a letter is unchanged, so that those of an export can be imported again.

        Args:
            text: The id; empty if there is none.
        """
        return text if not text or _BEGINS_WITH_LETTER.match(text) else f"{self.id_prefix}{text}"

    def own_ids(self, name: str, text: str) -> str:
        """Ids as rgss writes them, from a text that separates them by commas, semicolons or lines.

        Args:
            name: The attribute of rgss that has them.
            text: The text of the file, or the value to which it is mapped.
        """
        ids = [each.strip() for each in _BETWEEN_IDS.split(text) if each.strip()]
        if name != "measure":
            known = self._folded_values.get(name, _EMPTY)
            # A mapped one may be of another module of the tool, which counts its objects anew.
            ids = [known.get(_folded(each), "") or self.own_id(each) for each in ids]
        return joined(list(dict.fromkeys(ids)))

    def stated_part(self, text: str) -> Part | None:
        """The part that a value states, by its own name or by the mapping."""
        word = self.value(PART, text).strip().lower()
        return next((part for part in Part if part.value == word), None)

    def value(self, name: str, text: str) -> str:
        """The value of rgss for a value of the file.

        Several chosen values are mapped each, if the whole is not, and all become the same one or are ids.

        Args:
            name: The attribute of rgss.
            text: The value of the file.
        """
        known = self._folded_values.get(name, _EMPTY)
        if not known or not text.strip():
            return text
        if (whole := known.get(_folded(text))) is not None:
            return whole
        each = dict.fromkeys(known.get(_folded(part), part.strip()) for part in text.split(";"))
        return "; ".join(each) if len(each) == 1 or name in LINKED else text

    def sources(self, stated: Sequence[str], values: Mapping[str, str]) -> dict[str, str]:
        """The file's name of each attribute of rgss that an element has; a mapped name counts before any other.

        Args:
            stated: The file's names of the attributes that the element may have.
            values: The values of those that it has. Of two names for one attribute, the first with a value counts.
        """
        found: dict[str, str] = {}
        order = {key: place for place, key in enumerate(self._folded_attributes)}
        mapped = sorted((each for each in stated if self.target(each)), key=lambda each: order[_folded(each)])
        own = [each for each in stated if self.target(each) is None]
        for group, name_of in ((mapped, self.target), (own, attribute_name)):
            here: dict[str, str] = {}
            for long in group:
                name = name_of(long) or ""
                if name not in here or not values.get(here[name], "").strip():
                    here[name] = long if values.get(long, "").strip() else here.get(name, long)
            found = {**here, **found}
        return found

    def unknown(self, present: Iterable[str]) -> tuple[str, ...]:
        """Mapped names that a file does not have.

        Args:
            present: The names of all attributes in the file.
        """
        folded = {_folded(each) for each in present}
        return tuple(key for key in self.attributes if _folded(key) not in folded)


def option_for(long: str, names: Iterable[str] = ATTRIBUTE_NAMES) -> str:
    """The option of `rgss import` that maps a name, with its likely attribute if there is one.

    Args:
        long: The file's name.
        names: The attributes from which to choose.
    """
    target = likely_attribute(long, names) or "…"
    return f"--map {shlex.quote(f'{long}={target}')}"


def likely_attribute(long: str, names: Iterable[str] = ATTRIBUTE_NAMES) -> str:
    """The attribute that another tool probably means by a name; empty if none is likely."""
    plain, known = _plain(long).strip("_"), list(names)
    named = _LIKELY.get(plain, plain)
    near = [named] if named in known else difflib.get_close_matches(plain, known, n=1, cutoff=_LEAST_LIKENESS)
    return near[0] if near else ""


def with_values_mapped(foreign: Content, names: ForeignNames) -> Content:
    """Content of a file with the values of rgss in place of the mapped ones."""
    if not names.values:
        return foreign
    return replace(foreign, rows=tuple(_mapped(row, names) for row in foreign.rows))


def choice_hint(attribute: Attribute, text: str) -> str:
    """Hint with the option that maps a value of another tool; empty for attributes without a closed list."""
    if attribute.form is not Form.CHOICE:
        return ""
    near = difflib.get_close_matches(text.lower(), attribute.choices, n=1)
    target = near[0] if near else "…"
    return f"--map-value {shlex.quote(f'{attribute.name}:{text}={target}')} maps it"


def _mapped(row: Row, names: ForeignNames) -> Row:
    cells = {name: names.value(name, text) for name, text in row.cells.items()}
    return replace(row, cells=cells)


def _plain(long: str) -> str:
    return re.sub(r"[\s-]+", "_", long.strip()).lower()


def _with_folded_keys(values: Mapping[str, _Value]) -> dict[str, _Value]:
    return {_folded(key): value for key, value in values.items()}


def _folded(name: str) -> str:
    return " ".join(name.split()).casefold()
