"""Links between elements of the model, with the relations of SysML."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class LinkKind(str, Enum):
    """SysML relations of links, read from source to target."""

    CONTAINMENT = "containment"
    """The source is contained in the target."""
    DERIVE = "deriveReqt"
    """The source requirement derives from the target requirement."""
    REFINE = "refine"
    """The source refines the target."""
    SATISFY = "satisfy"
    """The source element satisfies the target requirement."""
    VERIFY = "verify"
    """The source verifies the target requirement."""
    TRACE = "trace"
    """The source traces to the target."""
    ALLOCATE = "allocate"
    """The source behaviour is allocated to the target block."""


@dataclass(frozen=True, slots=True, kw_only=True, order=True)
class TraceLink:
    """Directed link from an element to one that it depends on.

    Attributes:
        source: Id of the source element.
        target: Id of the target element.
        kind: The relation.
    """

    source: str
    target: str
    kind: LinkKind
