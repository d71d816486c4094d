"""Containment as the hierarchy of a specification of ReqIF."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rgss.errors import DefinitionError
from rgss.exchange.reqif.identifiers import object_identifier
from rgss.exchange.reqif.vocabulary import NO_TIME, identifier
from rgss.exchange.xml_guard import DEEPEST_NESTING

_AROUND, _EACH = 9, 2
"""XML elements around the reference to an element at the top, and for each further level."""
DEEPEST_CONTAINMENT = (DEEPEST_NESTING - _AROUND) // _EACH + 1


def hierarchies(models: Any, name: str, inner: Mapping[str, Sequence[str]]) -> list[Any]:
    """The nodes at the top of the hierarchy of one specification.

    Args:
        models: The classes of the library.
        name: The name of the specification.
        inner: The ids of the elements in each element; those at the top are in ``""``.

    Raises:
        DefinitionError: Elements are nested deeper than an import reads.
    """
    return _within(models, name, inner, "", 1)


def _within(models: Any, name: str, inner: Mapping[str, Sequence[str]], parent: str, level: int) -> list[Any]:
    if level > DEEPEST_CONTAINMENT:
        message = f"{parent} contains elements that are nested more than {DEEPEST_CONTAINMENT} deep"
        raise DefinitionError(f"{message}, which an import of ReqIF refuses", hint="export csv, or nest them less")
    return [
        models.ReqIFSpecHierarchy(
            identifier=identifier("hierarchy", name, each),
            last_change=NO_TIME,
            spec_object=object_identifier(each),
            level=level,
            editable=None,
            is_table_internal=None,
            children=_within(models, name, inner, each, level + 1) if each in inner else None,
        )
        for each in inner.get(parent, [])
    ]
