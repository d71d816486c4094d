"""Why nothing is feasible, in the language of requirements."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from rgss.tradeoff.enumeration import Enumeration


@dataclass(frozen=True, slots=True, kw_only=True)
class RequirementCount:
    """How many alternatives one requirement excludes.

    Attributes:
        requirement: Its id.
        excluded: The number of alternatives that violate it.
    """

    requirement: str
    excluded: int


@dataclass(frozen=True, slots=True, kw_only=True)
class NearestAlternative:
    """The alternative that violates the fewest requirements; of several, the smallest id.

    Attributes:
        variant: Its id.
        requirements: What it violates.
    """

    variant: int
    requirements: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Conflicts:
    """Why no alternative is feasible.

    Attributes:
        excluded_by: For each requirement how many alternatives it excludes, zero included.
        minimal_conflict: Requirements that no alternative meets together, whereas without any one
            of them some alternative meets the rest. There may be other such sets.
        nearest: The alternative that violates the fewest requirements.
    """

    excluded_by: tuple[RequirementCount, ...]
    minimal_conflict: tuple[str, ...]
    nearest: NearestAlternative


def find_conflicts(enumeration: Enumeration) -> Conflicts | None:
    """Explain infeasibility.

    Args:
        enumeration: Every alternative evaluated.

    Returns:
        The conflicts; None if some alternative is feasible.
    """
    if enumeration.best_value is not None:
        return None
    # Rows are by ascending id, so the first of the fewest violations has the smallest id.
    nearest = int(enumeration.variants[int(enumeration.violated.sum(axis=1).argmin())])
    return Conflicts(
        excluded_by=excluded_counts(enumeration, ~enumeration.feasible),
        minimal_conflict=_deletion_filter(enumeration),
        nearest=NearestAlternative(variant=nearest, requirements=enumeration.violated_by(nearest)),
    )


def excluded_counts(enumeration: Enumeration, among: NDArray[np.bool_]) -> tuple[RequirementCount, ...]:
    """Count for each requirement the alternatives that it excludes.

    Args:
        enumeration: Every alternative evaluated.
        among: Which alternatives count, shape (n,).

    Returns:
        One count for each requirement, in the problem's order.
    """
    counts = enumeration.violated[among].sum(axis=0)
    return tuple(
        RequirementCount(requirement=requirement, excluded=int(count))
        for requirement, count in zip(enumeration.requirements, counts, strict=True)
    )


def _deletion_filter(enumeration: Enumeration) -> tuple[str, ...]:
    """Try to do without each requirement in turn; whatever then still conflicts need not have it.

    Chinneck and Dravnieks, "Locating minimal infeasible constraint sets in linear programs", 1991.
    """
    kept = list(range(len(enumeration.requirements)))
    for candidate in tuple(kept):
        rest = [column for column in kept if column != candidate]
        if enumeration.violated[:, rest].any(axis=1).all():
            kept = rest
    return tuple(enumeration.requirements[column] for column in kept)
