"""Names of attributes and relations in ReqIF, and other tools' names for them."""

from __future__ import annotations

import re
import uuid
from collections.abc import Mapping
from types import MappingProxyType

from rgss.exchange.attributes import Attribute, Form, Part
from rgss.requirements import LinkKind

TOOL = "rgss"
MEASURE = "Measure"
INCLUDE, ACTOR = "include", "actor"
NO_TIME = "2000-01-01T00:00:00Z"
"""Time of the last change, which ReqIF requires; it is unknown, and the time of writing would change the bytes."""

TYPE_NAMES: Mapping[Part, str] = MappingProxyType(
    {
        Part.STAKEHOLDER: "Stakeholder requirement",
        Part.SYSTEM: "System requirement",
        Part.BLOCK: "Block",
        Part.BEHAVIOUR: "Behaviour",
    }
)
"""The types of objects."""

RELATIONS: tuple[str, ...] = (
    *(kind.value for kind in LinkKind if kind is not LinkKind.CONTAINMENT),
    INCLUDE,
    ACTOR,
)
"""The types of relations; containment is the hierarchy."""

_STANDARD: Mapping[str, str] = MappingProxyType({"id": "ReqIF.ForeignID", "text": "ReqIF.Text", "name": "ReqIF.Name"})
EXCHANGE_IDS = ("ie_puid", "puid")
"""Ids of DOORS and Capella for exchange, which count where an object has no other id."""

_OTHER_RELATIONS: Mapping[str, str] = MappingProxyType(
    {
        "parent": LinkKind.DERIVE.value,
        "derive": LinkKind.DERIVE.value,
        "derives": LinkKind.DERIVE.value,
        "derivesfrom": LinkKind.DERIVE.value,
        "derivedfrom": LinkKind.DERIVE.value,
        "satisfies": LinkKind.SATISFY.value,
        "verifies": LinkKind.VERIFY.value,
        "refines": LinkKind.REFINE.value,
        "traces": LinkKind.TRACE.value,
        "allocates": LinkKind.ALLOCATE.value,
        "includes": INCLUDE,
    }
)
_NAMESPACE = uuid.uuid5(uuid.NAMESPACE_URL, "https://www.omg.org/spec/ReqIF/rgss")


def identifier(*parts: str) -> str:
    """Identifier derived from some texts; an XML name that depends on these texts alone."""
    return f"_{uuid.uuid5(_NAMESPACE, chr(10).join(parts))}"


def long_name(attribute: Attribute) -> str:
    """Name of an attribute in ReqIF."""
    return _STANDARD.get(attribute.name, attribute.name)


def relation_name(long: str) -> str | None:
    """Relation in rgss for one of any tool; None if there is none."""
    plain = re.sub(r"[^a-z]", "", long.lower())
    known = {name.lower(): name for name in RELATIONS}
    return known.get(plain, _OTHER_RELATIONS.get(plain))


def is_string(attribute: Attribute) -> bool:
    """True if an attribute is a plain string in ReqIF, without line breaks."""
    return attribute.form in (Form.DETAIL, Form.DETAILS) or attribute.name in ("id", "threshold")


def is_relation(attribute: Attribute) -> bool:
    """True if an attribute is expressed by relations or by the hierarchy in ReqIF."""
    return attribute.holds_ids
