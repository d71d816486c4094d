"""Identifiers of the elements of a ReqIF file."""

from __future__ import annotations

from rgss.exchange.attributes import Attribute, Form
from rgss.exchange.reqif.vocabulary import (
    identifier,
    is_string,
)

STRING, XHTML, FLAG = ("data", "string"), ("data", "xhtml"), ("data", "boolean")
"""Parts of the identifiers of data types other than enumerations."""


def choice_identifier(type_name: str, attribute: Attribute, choice: str) -> str:
    """The identifier of a choice of an attribute."""
    return identifier("data", type_name, attribute.name, choice)


def type_identifier(type_name: str) -> str:
    """The identifier of a type of objects.

    Args:
        type_name: The value of a part, or `MEASURE`.
    """
    return identifier("object type", type_name)


def relation_type_identifier(kind: str) -> str:
    """The identifier of a type of relations."""
    return identifier("relation type", kind)


def data_type_identifier(type_name: str, attribute: Attribute) -> str:
    """The identifier of the data type of an attribute."""
    if attribute.form is Form.CHOICE:
        return identifier("data", type_name, attribute.name)
    if attribute.form is Form.FLAG:
        return identifier(*FLAG)
    return identifier(*(STRING if is_string(attribute) else XHTML))


def object_identifier(name: str) -> str:
    """The identifier of the object of an element or a measure."""
    return identifier("object", name)
