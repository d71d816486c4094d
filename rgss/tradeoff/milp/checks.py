"""Independent checks of a solver's answer, as a certificate lists them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Agreement(str, Enum):
    """Outcome of comparing a decision with exhaustive enumeration; true only where the two agree."""

    AGREED = "agreed"
    DISAGREED = "disagreed"
    NOT_ENUMERATED = "not enumerated"

    def __bool__(self) -> bool:
        """Only an enumeration that was made and agrees counts as agreement."""
        return self is Agreement.AGREED


class CheckKind(str, Enum):
    """Method of a check."""

    ENUMERATION = "enumeration"
    SECOND_RUN = "second run"
    PRIMAL_SEARCH = "primal search"
    DUAL_BOUND = "dual bound"
    INDEPENDENT_SOLVER = "independent solver"


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """One independent check of the solver's answers.

    Attributes:
        kind: The method.
        agrees: False where it contradicted the solver. The better answer is then used.
        detail: What was compared, for people.
    """

    kind: CheckKind
    agrees: bool
    detail: str

    @property
    def text(self) -> str:
        """One line."""
        return f"{self.kind.value} {'agrees' if self.agrees else 'DISAGREES'}: {self.detail}"
