"""Exception hierarchy; exceptions are raised only if the caller cannot continue.

Expected outcomes (no path found, object dropped) are enum values in records, and errors in a user's files are findings.
Every deliberate exception derives from `RgssError` and has a hint on how to resolve it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.findings import Finding


class RgssError(Exception):
    """Base class of all deliberate errors of rgss.

    Attributes:
        message: The problem, in one line.
        hint: How to resolve it, in one line; may be empty.
    """

    def __init__(self, message: str, *, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint

    def __str__(self) -> str:
        return f"{self.message} ({self.hint})" if self.hint else self.message


class QuantityError(RgssError, ValueError):
    """A text is not a quantity in the expected unit."""


class DocumentError(RgssError):
    """A user's file cannot be used; with every problem found in it.

    Attributes:
        findings: The problems, in the order of their positions; never empty.
    """

    def __init__(self, findings: Sequence[Finding], *, hint: str = "") -> None:
        if not findings:
            raise ValueError("a DocumentError needs at least one finding")
        self.findings = tuple(findings)
        first = self.findings[0]
        rest = len(self.findings) - 1
        more = f" (and {rest} more)" if rest else ""
        super().__init__(f"{first}{more}", hint=hint)

    def __reduce__(self) -> tuple[type[DocumentError], tuple[tuple[Finding, ...]], dict[str, str]]:
        return type(self), (self.findings,), {"hint": self.hint}


class DefinitionError(RgssError):
    """Well-formed definitions contradict each other or refer to undefined names."""


class SimulationError(RgssError):
    """The physics engine cannot build or advance the world."""


class MotionError(RgssError):
    """A motion cannot be planned or timed because its problem is ill-posed."""


class DriverError(RgssError):
    """A robot cannot be connected, or its controller rejected a command."""


class EvidenceError(RgssError):
    """The evidence store is missing, damaged, or lacks what a decision needs."""


class StorageError(EvidenceError):
    """The disk is full or fails, or another process locks the store; data written and read before are valid."""


class TradeoffError(RgssError):
    """A trade-off is ill-posed, or its solver did not prove an optimum."""
