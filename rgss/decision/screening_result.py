"""Outcome of screening: each design with its reason, and a summary."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum

from rgss.designs import DesignVariant
from rgss.studies import Screening

_MOST_SHOWN = 72
"""Most ids in a sentence."""


class ScreeningOutcome(str, Enum):
    """Outcome of screening for a design."""

    PROMOTED = "promoted"
    """It is promoted."""
    UNSCREENED = "unscreened"
    """It is promoted, since it lacks trials at the screening fidelity."""
    SPARED = "spared"
    """It misses a requirement, as every design does; it is promoted so that the decision can report the conflicts."""
    IMPOSSIBLE = "impossible"
    """It misses a requirement for any result of contact trials."""
    OUTRANKED = "outranked"
    """Others are better, even with all its unknown quantities at their best."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ScreenedVariant:
    """A design with its outcome in screening.

    Attributes:
        variant: Its id.
        outcome: The outcome.
        reason: The reason for it, in words.
        missed: The requirements that it cannot meet.
        best_value: The greatest value that it can have; None if it lacks trials.
    """

    variant: int
    outcome: ScreeningOutcome
    reason: str
    missed: tuple[str, ...] = ()
    best_value: float | None = None

    @property
    def goes_on(self) -> bool:
        """True if it is tried at the deciding fidelity."""
        return self.outcome in (ScreeningOutcome.PROMOTED, ScreeningOutcome.UNSCREENED, ScreeningOutcome.SPARED)


@dataclass(frozen=True, slots=True, kw_only=True)
class ScreeningResult:
    """Outcome of screening for every design.

    Attributes:
        screening: The study's screening.
        variants: The designs, in their order.
    """

    screening: Screening
    variants: tuple[ScreenedVariant, ...]

    @property
    def survivors(self) -> tuple[int, ...]:
        """The ids of the promoted designs."""
        return tuple(one.variant for one in self.variants if one.goes_on)

    def promoted(self, variants: Iterable[DesignVariant]) -> tuple[DesignVariant, ...]:
        """Those of some designs that are promoted."""
        survivors = set(self.survivors)
        return tuple(one for one in variants if one.id in survivors)

    @property
    def screened_out(self) -> tuple[ScreenedVariant, ...]:
        """The designs that are screened out."""
        return tuple(one for one in self.variants if not one.goes_on)


def screening_summary(result: ScreeningResult) -> str:
    """Sentences on the designs that were screened out, the evidence and the reasons."""
    out = result.screened_out
    screening = result.screening
    trials = f"{screening.fidelity.value} trials ({screening.promotion})"
    parts = [f"{len(out)} of {len(result.variants)} designs were screened out by {trials} and are not shown here."]
    missed: dict[str, list[int]] = {}
    for one in out:
        for requirement in one.missed:
            missed.setdefault(requirement, []).append(one.variant)
    parts += [f"{requirement} cannot be met by variants {_ids(ids)}." for requirement, ids in missed.items()]
    outranked = [one for one in out if one.outcome is ScreeningOutcome.OUTRANKED]
    if outranked:
        most = max(one.best_value for one in outranked if one.best_value is not None)
        parts.append(
            "Others are better, even if all that is unknown is at its best (a value of at most "
            f"{most:.4g}): variants {_ids([one.variant for one in outranked])}."
        )
    return " ".join(parts)


def _ids(ids: Sequence[int]) -> str:
    more = f" and {len(ids) - _MOST_SHOWN} more" if len(ids) > _MOST_SHOWN else ""
    return ", ".join(map(str, ids[:_MOST_SHOWN])) + more
