"""Options of ``rgss import`` that say what the names of another tool are in rgss."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rgss.exchange import ForeignNames, ImportDefaults, Part

KINDS = ("stakeholder", "system")


class ImportNames(NamedTuple):
    """The meaning of the names of a file.

    Attributes:
        assumed: Defaults for elements whose part or attributes the file does not state.
        names: The mapped names.
        typed: The names that were mapped on the command line.
    """

    assumed: ImportDefaults
    names: ForeignNames
    typed: tuple[str, ...]


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
        "--mapping", type=Path, metavar="FILE", help="YAML file with such names, values, types and defaults"
    )
    parser.add_argument(
        "--default",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="an attribute of new elements that the file does not state",
    )


def import_names(options: argparse.Namespace) -> ImportNames:
    """What the options say, those of the command line before those of the file.

    Raises:
        DefinitionError: An option is malformed.
        DocumentError: The mapping file is.
    """
    from rgss.exchange import ForeignNames, ImportDefaults, NamesAndDefaults, read_mapping

    file = NamesAndDefaults(names=ForeignNames(), defaults={})
    if options.mapping is not None:
        file = read_mapping(options.mapping)
    part, types = _kinds(options)
    typed = _attributes(options)
    # A name that is mapped in both is that of the command line.
    folded = {key.casefold() for key in typed}
    others = {key: name for key, name in file.names.attributes.items() if key.casefold() not in folded}
    values = {name: dict(known) for name, known in file.names.values.items()}
    for name, value, ours in _values(options):
        values.setdefault(name, {})[value] = ours
    return ImportNames(
        assumed=ImportDefaults(part=part, defaults={**file.defaults, **_defaults(options)}),
        names=ForeignNames(attributes={**typed, **others}, values=values, types={**file.names.types, **types}),
        typed=tuple(typed),
    )


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
    from rgss.exchange import ATTRIBUTES

    names = {each.name for attributes in ATTRIBUTES.values() for each in attributes} - {"id"}
    defaults: dict[str, str] = {}
    for each in options.default:
        name, equals, value = each.partition("=")
        if not equals or name not in names:
            known = ", ".join(sorted(names))
            raise DefinitionError(f"--default {each!r} is not NAME=VALUE with a known name", hint=f"names: {known}")
        defaults[name] = value
    return defaults
