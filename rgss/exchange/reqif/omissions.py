"""Content of the objects of a ReqIF file that is not imported."""

from __future__ import annotations

import itertools
import shlex
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from rgss.exchange.attributes import ATTRIBUTES, Part
from rgss.exchange.foreign_names import (
    ATTRIBUTE_NAMES,
    LINKED,
    PART,
    ForeignNames,
    attribute_name,
    likely_attribute,
    option_for,
)
from rgss.exchange.plain_forms import PlainText
from rgss.exchange.reqif.vocabulary import EXCHANGE_IDS
from rgss.findings import shown

_MOST_NAMED = 8
_OF_OBJECT = ("LONG-NAME", "DESC")
"""What the object itself has; other tools repeat an attribute there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ObjectValues:
    """The values of one object, by the file's names of its attributes.

    Attributes:
        type_name: The name of its type.
        is_ours: True if rgss has written its type.
        stated: The names of all attributes of its type.
        line: Its first line.
        values: The values.
        losses: Line and content that each value loses, with its markup or since another has its name.
        lines: The line of each value, by the identifier of its attribute.
    """

    type_name: str
    is_ours: bool
    stated: tuple[str, ...]
    line: int
    values: dict[str, str] = field(default_factory=dict)
    losses: dict[str, tuple[int, tuple[str, ...]]] = field(default_factory=dict)
    lines: dict[str, int] = field(default_factory=dict)

    def add(self, long: str, definition: str, value: PlainText) -> None:
        """A value; of several attributes of one name, the first with a value counts, and the others are losses.

        Args:
            long: The name of its attribute.
            definition: The identifier of its attribute.
            value: The value.
        """
        line, before = self.lines.get(definition, self.line), self.values.get(long, "").strip()
        if not before:
            self.values[long], self.losses[long] = value.text, (line, value.losses)
        elif value.text.strip() not in ("", before):
            where, losses = self.losses.get(long, (line, ()))
            loss = f"the value {shown(value.text.strip())} of another attribute of that name is omitted"
            self.losses[long] = (where, (*losses, loss))


class Omissions:
    """Collector of the objects and attributes that are not imported, with the options that take them."""

    def __init__(self, mapped: ForeignNames) -> None:
        """Create a collector.

        Args:
            mapped: The mapped names of the file.
        """
        self._mapped = mapped
        self._lacking: Counter[tuple[str, tuple[str, ...]]] = Counter()
        """Number of objects by the name of their type and the attributes that they lack."""
        self._attributes: dict[tuple[str, tuple[str, ...]], dict[str, None]] = {}
        """The attributes of these objects."""
        self._of_no_part: Counter[tuple[str, str]] = Counter()
        """Number of objects by the name and the value of the attribute that states their part."""
        self._deleted: Counter[str] = Counter()
        """Number of objects that the other tool has deleted, by the name of their type."""
        self._unused: dict[str, str] = {}
        """The attributes that are not imported, with the reason."""
        self.lost: list[tuple[int, str]] = []
        """Line and message of all content that may change the meaning of an element."""

    def lacking(self, type_name: str, lacks: tuple[str, ...], attributes: Iterable[str]) -> None:
        """An object without id or text.

        Args:
            type_name: The name of its type.
            lacks: The attributes of rgss that it lacks: the id, the text or both.
            attributes: The names of the attributes that it has.
        """
        self._lacking[type_name, lacks] += 1
        self._attributes.setdefault((type_name, lacks), {}).update(dict.fromkeys(attributes))

    def deleted(self, type_name: str) -> None:
        """An object that the other tool has deleted."""
        self._deleted[type_name] += 1

    def of_no_part(self, long: str, value: str) -> None:
        """An object whose part, by an attribute mapped for it, is none of rgss."""
        self._of_no_part[long, value] += 1

    def attribute(
        self, long: str, read: ObjectValues, element_id: str, part: Part | None, sources: Mapping[str, str]
    ) -> None:
        """An attribute of an element that has no counterpart, unless it repeats another or the user leaves it out.

        Args:
            long: Its name in the file.
            read: The values of the element by the file's names.
            element_id: The id of the element.
            part: Its part.
            sources: The file's name of each attribute of rgss that the element has.
        """
        target = self._mapped.target(long)
        name, value = attribute_name(long) if target is None else target, read.values[long].strip()
        if not name or (name in EXCHANGE_IDS and value == element_id):
            return
        source = sources.get(name, long)
        names = [attribute.name for attribute in ATTRIBUTES[part]] if part is not None else []
        if long in _OF_OBJECT and value in (each.strip() for other, each in read.values.items() if other != long):
            return
        if source != long:
            if value == read.values.get(source, "").strip():
                return
            if target:
                message = f"{element_id}: {long}: the value {shown(value)} is omitted, since {source!r} is the {name}"
                self.lost.append((read.line, message))
            else:
                self._unused.setdefault(long, f"{source!r} is the {name}")
        elif target:
            kind = part.value if part is not None else "of no part"
            self._unused.setdefault(long, f"an element {kind!r} has no {name!r}" if names else "its part is open")
        elif name in LINKED and name in names:
            self._unused.setdefault(long, f"relations state {name!r} ({option_for(long, names)} takes its ids)")
        else:
            known = [PART, *(names or ATTRIBUTE_NAMES)]
            self._unused.setdefault(long, f"rgss has none of that name ({option_for(long, known)} takes it)")

    def notes(self) -> Iterator[str]:
        """A note for each kind of content that is not imported."""
        for (type_name, lacks), count in sorted(self._lacking.items()):
            attributes = list(self._attributes[type_name, lacks])
            had = ", ".join(map(shown, itertools.islice(attributes, _MOST_NAMED)))
            among = f" among their attributes {had}" if had else ""
            objects = f"{count} objects of type {shown(type_name)} are not imported"
            if count == 1:
                objects = f"1 object of type {shown(type_name)} is not imported"
            yield f"{objects}: {' and '.join(f'no {each}' for each in lacks)}{among}{_taken(lacks, attributes)}"
        for type_name, count in sorted(self._deleted.items()):
            objects = "1 object" if count == 1 else f"{count} objects"
            verb = "is" if count == 1 else "are"
            yield f"{objects} of type {shown(type_name)} {verb} not imported: 'ReqIF.ForeignDeleted' says deleted"
        for (long, value), count in sorted(self._of_no_part.items()):
            option = f"--map-value {shlex.quote(f'{PART}:{value}=…')}"
            objects = "1 object is" if count == 1 else f"{count} objects are"
            yield f"{objects} not imported: {shown(value)} of {shown(long)} is no part ({option} takes such)"
        for long, why in self._unused.items():
            yield f"the attribute {long!r} is not imported: {why}"


def _taken(lacks: Sequence[str], attributes: Sequence[str]) -> str:
    """Options that take the missing attributes, if some of the present ones are likely to be them."""
    likely = [next((each for each in attributes if likely_attribute(each) == name), None) for name in lacks]
    options = [option_for(each) for each in likely if each is not None]
    if not options and list(lacks) == ["id"]:
        options = ["--map IDENTIFIER=id --id-prefix …"]
    return f" ({' '.join(options)} takes them)" if options else ""
