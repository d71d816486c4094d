"""Links between elements of the model, with the relations of SysML."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class LinkKind(str, Enum):
    """The relations of SysML that links use; each reads from source to target."""

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
    """One directed link; it points from the later element to the one that it depends on.

    Attributes:
        source: Id of the element that states or makes the link.
        target: Id of the element that it points at.
        kind: The relation.
    """

    source: str
    target: str
    kind: LinkKind
