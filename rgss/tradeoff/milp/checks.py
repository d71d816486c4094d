"""Independent checks of a solver's answer, as a certificate lists them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Agreement(str, Enum):
    """Outcome of comparing the solver's answers with exhaustive enumeration; true only where the two agree.

    Not compared: everything was enumerated, but a run of the solver was ended before it had an answer.
    """

    AGREED = "agreed"
    DISAGREED = "disagreed"
    NOT_COMPARED = "not compared"
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
    """Independent check of the solver's results.

    Attributes:
        kind: The method.
        agrees: False if it contradicted the solver, in which case the better result is used; None if a limit ended the
        check without a result.
        detail: Readable description of the comparison.
    """

    kind: CheckKind
    agrees: bool | None
    detail: str

    @property
    def text(self) -> str:
        """One line."""
        word = "not finished" if self.agrees is None else "agrees" if self.agrees else "DISAGREES"
        return f"{self.kind.value} {word}: {self.detail}"
