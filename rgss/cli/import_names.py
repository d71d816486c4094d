"""Options of ``rgss import`` that say what the names of another tool are in rgss."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeVar

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from rgss.exchange import ForeignNames, ImportDefaults, Part

KINDS = ("stakeholder", "system")
_Meaning = TypeVar("_Meaning")


class ImportNames(NamedTuple):
    """The meaning of the names of a file.

    Attributes:
        assumed: Defaults for elements whose part or attributes the file does not state.
        names: The mapped names.
        typed: The names that were mapped on the command line.
        typed_relations: The types of relations that were.
    """

    assumed: ImportDefaults
    names: ForeignNames
    typed: tuple[str, ...]
    typed_relations: tuple[str, ...]


def add_names(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    parser.add_argument(
        "--as",
        dest="kinds",
        action="append",
        default=[],
        metavar="KIND",
        help=f"the kind of new elements: {' or '.join(KINDS)}; TYPE=KIND for those of a type of the file",
    )
    parser.add_argument(
        "--map",
        dest="mapped",
        action="append",
        default=[],
        metavar="NAME=ATTRIBUTE",
        help="an attribute or a column of the file, and what it is here; NAME= leaves it out",
    )
    parser.add_argument(
        "--map-value",
        dest="mapped_values",
        action="append",
        default=[],
        metavar="ATTRIBUTE:VALUE=OURS",
        help="a value of the file for an attribute, and what it is here",
    )
    parser.add_argument(
        "--map-relation",
        dest="mapped_relations",
        action="append",
        default=[],
        metavar="TYPE=LINK",
        help="what relations of a type of a ReqIF file state: an attribute of their source, such as derived_from, or "
        "of their target (target.derived_from); TYPE= leaves them out",
    )
    parser.add_argument(
        "--id-prefix", metavar="TEXT", help="text before ids that do not begin with a letter: SYS- makes 12 to SYS-12"
    )
    parser.add_argument("--mapping", type=Path, metavar="FILE", help="YAML file with all of these")
    parser.add_argument(
        "--default",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="an attribute that elements have if the file does not state it",
    )


def import_names(options: argparse.Namespace) -> ImportNames:
    """Names and defaults of the options, those of the command line before those of the file.

    Raises:
        DefinitionError: An option is malformed.
        DocumentError: The mapping file is.
    """
    from rgss.exchange import ForeignNames, ImportDefaults, NamesAndDefaults, read_mapping

    file = NamesAndDefaults(names=ForeignNames(), defaults={})
    if options.mapping is not None:
        file = read_mapping(options.mapping)
    part, types = _kinds(options)
    typed, relations = _attributes(options), _relations(options)
    # A name that is mapped in both is that of the command line.
    others = _unless_typed(file.names.attributes, typed)
    other_relations = _unless_typed(file.names.relations, relations)
    values = {name: dict(known) for name, known in file.names.values.items()}
    for name, value, ours in _values(options):
        values.setdefault(name, {})[value] = ours
    return ImportNames(
        assumed=ImportDefaults(part=part, defaults={**file.defaults, **_defaults(options)}),
        names=ForeignNames(
            attributes={**typed, **others},
            values=values,
            types={**file.names.types, **types},
            relations={**relations, **other_relations},
            id_prefix=_prefix(options) if options.id_prefix is not None else file.names.id_prefix,
        ),
        typed=tuple(typed),
        typed_relations=tuple(relations),
    )


def _unless_typed(of_file: Mapping[str, _Meaning], typed: Collection[str]) -> dict[str, _Meaning]:
    """The names of the file that the command line does not map."""
    folded = {key.casefold() for key in typed}
    return {key: meaning for key, meaning in of_file.items() if key.casefold() not in folded}


def _prefix(options: argparse.Namespace) -> str:
    from rgss.documents import IDENTIFIER_PATTERN
    from rgss.errors import DefinitionError

    text = str(options.id_prefix)
    if text and not re.fullmatch(IDENTIFIER_PATTERN.removesuffix("$"), text):
        message = f"--id-prefix {text!r}: an id is a letter, then letters, digits, and _ . -"
        raise DefinitionError(message, hint="such as --id-prefix SYS-")
    return text


def _relations(options: argparse.Namespace) -> dict[str, tuple[str, ...]]:
    from rgss.errors import DefinitionError
    from rgss.exchange import RELATION_MEANINGS, unknown_meaning_hint

    found: dict[str, tuple[str, ...]] = {}
    for each in options.mapped_relations:
        type_name, equals, meaning = each.rpartition("=")
        if not equals or not type_name.strip():
            hint = "such as --map-relation 'Satisfies=derived_from'"
            raise DefinitionError(f"--map-relation {each!r} is not TYPE=LINK", hint=hint)
        if meaning and meaning not in RELATION_MEANINGS:
            message = f"--map-relation {each!r}: {meaning!r} is not what a relation may state"
            raise DefinitionError(message, hint=unknown_meaning_hint(meaning))
        found[type_name] = (*found.get(type_name, ()), meaning) if meaning else ()
    return found


def _kinds(options: argparse.Namespace) -> tuple[Part | None, Mapping[str, Part]]:
    from rgss.errors import DefinitionError
    from rgss.exchange import Part

    part: Part | None = None
    types: dict[str, Part] = {}
    for each in options.kinds:
        type_name, equals, kind = each.rpartition("=")
        allowed = KINDS if not equals else [known.value for known in Part]
        if kind not in allowed:
            raise DefinitionError(f"--as {each!r} is not KIND or TYPE=KIND", hint=f"kinds: {', '.join(allowed)}")
        if equals:
            types[type_name] = Part(kind)
        else:
            part = Part(kind)
    return part, types


def _attributes(options: argparse.Namespace) -> dict[str, str]:
    from rgss.errors import DefinitionError
    from rgss.exchange import ATTRIBUTE_NAMES, unknown_attribute_hint

    found: dict[str, str] = {}
    for each in options.mapped:
        long, equals, name = each.rpartition("=")
        if not equals or not long.strip():
            raise DefinitionError(f"--map {each!r} is not NAME=ATTRIBUTE", hint="such as --map 'Object Text=text'")
        if name and name not in ATTRIBUTE_NAMES:
            raise DefinitionError(
                f"--map {each!r}: {name!r} is not an attribute of rgss", hint=unknown_attribute_hint(name)
            )
        found[long] = name
    return found


def _values(options: argparse.Namespace) -> list[tuple[str, str, str]]:
    from rgss.errors import DefinitionError
    from rgss.exchange import ATTRIBUTE_NAMES, unknown_attribute_hint

    found = []
    for each in options.mapped_values:
        name, colon, rest = each.partition(":")
        value, equals, ours = rest.rpartition("=")
        if not colon or not equals or not value.strip():
            hint = "such as --map-value priority:Mandatory=high"
            raise DefinitionError(f"--map-value {each!r} is not ATTRIBUTE:VALUE=OURS", hint=hint)
        if name not in ATTRIBUTE_NAMES:
            message = f"--map-value {each!r}: {name!r} is not an attribute of rgss"
            raise DefinitionError(message, hint=unknown_attribute_hint(name))
        found.append((name, value, ours))
    return found


def _defaults(options: argparse.Namespace) -> dict[str, str]:
    from rgss.errors import DefinitionError
    from rgss.exchange import DEFAULT_NAMES

    defaults: dict[str, str] = {}
    for each in options.default:
        name, equals, value = each.partition("=")
        if not equals or name not in DEFAULT_NAMES:
            known = ", ".join(sorted(DEFAULT_NAMES))
            raise DefinitionError(f"--default {each!r} is not NAME=VALUE with a known name", hint=f"names: {known}")
        defaults[name] = value
    return defaults
