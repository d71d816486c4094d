"""Infeasibility explained by requirements."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from rgss.tradeoff.programs import Enumeration

MOST_CONFLICTS = 1_000
"""So many minimal conflicts are listed; there can be exponentially many."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RequirementCount:
    """Number of alternatives that one requirement excludes."""

    requirement: str
    excluded: int


@dataclass(frozen=True, slots=True, kw_only=True)
class NearestAlternative:
    """The alternative that violates the fewest requirements; of several, the smallest id."""

    variant: int
    requirements: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitChange:
    """A limit that would have to move.

    Attributes:
        requirement: The id of the requirement whose limit it is.
        demand: The present demand, such as ``P_max >= 0.8 kg``.
        limit: The limit now, as it is required; a tolerance of the choice moves with it.
        needed: The value that it would need.
        unit: The unit of both.
    """

    requirement: str
    demand: str
    limit: float
    needed: float
    unit: str

    @property
    def relative(self) -> float | None:
        """The change as a share of the limit; None where the limit is 0."""
        return None if self.limit == 0.0 else abs(self.needed - self.limit) / abs(self.limit)


@dataclass(frozen=True, slots=True, kw_only=True)
class Repair:
    """The smallest change of one requirement that makes something feasible, everything else as it is.

    Attributes:
        requirement: Its id.
        changes: The limits that would have to move; empty if no change of this requirement alone
            helps.
        unlocked: Number of alternatives that are then feasible.
        winner: The alternative that is then chosen; None if none.
    """

    requirement: str
    changes: tuple[LimitChange, ...]
    unlocked: int
    winner: int | None


@dataclass(frozen=True, slots=True, kw_only=True)
class JointRepair:
    """The smallest change of a correction's requirements that makes something feasible.

    Where there are several conflicts, no requirement mends them alone, but each correction does.

    Attributes:
        requirements: The correction.
        changes: The limits that would have to move together; empty if no change of limits helps,
            because evidence is missing.
        unlocked: Number of alternatives that are then feasible.
        winner: The alternative that is then chosen; None if none.
    """

    requirements: tuple[str, ...]
    changes: tuple[LimitChange, ...]
    unlocked: int
    winner: int | None


@dataclass(frozen=True, slots=True, kw_only=True)
class ConflictSurvival:
    """Share of resamples of the replicates in which a conflict persists.

    Attributes:
        resamples: Number of draws that were evaluated.
        exact: Whether these are all distinct draws, each with its probability, so that nothing is
            left to chance; otherwise they are a sample.
        nothing_feasible: The probability that nothing is feasible in a draw.
        conflicts: For each minimal conflict, the probability that no alternative meets its
            requirements together, in the order of the conflicts.
    """

    resamples: int
    exact: bool
    nothing_feasible: float
    conflicts: tuple[float, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Conflicts:
    """Explanation of infeasibility.

    Attributes:
        excluded_by: Number of alternatives excluded by each requirement, including zero.
        minimal_conflict: The first of the minimal conflicts.
        minimal_conflicts: All minimal sets of requirements that no alternative satisfies jointly, the smallest first.
        complete: False if there are more than `MOST_CONFLICTS`.
        corrections: All minimal sets of requirements whose removal makes an alternative feasible: each contains an
        element of every conflict.
        nearest: The alternative that violates the fewest requirements.
        repairs: For each requirement, the limit that alone would make an alternative feasible.
        joint_repairs: The limits for each of the `corrections`, in their order.
        survival: Stability of the conflict under the noise of the replicates; None if no measure has more than one.
        unmeasured: Requirements whose statistic is unknown for every alternative: none is shown to violate them.
        unvalued: Weighted measures that are unknown for every alternative, so that none has a weighted value.
    """

    excluded_by: tuple[RequirementCount, ...]
    minimal_conflict: tuple[str, ...]
    minimal_conflicts: tuple[tuple[str, ...], ...]
    complete: bool
    corrections: tuple[tuple[str, ...], ...]
    nearest: NearestAlternative
    repairs: tuple[Repair, ...] = ()
    joint_repairs: tuple[JointRepair, ...] = ()
    survival: ConflictSurvival | None = None
    unmeasured: tuple[str, ...] = ()
    unvalued: tuple[str, ...] = ()


def find_conflicts(enumeration: Enumeration) -> Conflicts | None:
    """Explain infeasibility.

    An alternative is feasible without a set of requirements if it violates no others. A set is a conflict if and only
    if every alternative violates one of its requirements: the minimal conflicts are the minimal hitting sets of the
    alternatives' violations (Reiter, "A theory of diagnosis from first principles", 1987).

    Returns:
        The conflicts, without repairs and survival; None if some alternative is feasible.
    """
    if enumeration.feasible.any():
        return None
    # Rows are by ascending id, so the first of the fewest violations has the smallest id.
    nearest = int(enumeration.variants[int(enumeration.violated.sum(axis=1).argmin())])
    violated = smallest_sets(violation_sets(enumeration.violated))
    hitting, complete = minimal_hitting_sets(violated, MOST_CONFLICTS)
    names = enumeration.requirements
    conflicts = tuple(tuple(names[place] for place in places) for places in hitting)
    return Conflicts(
        excluded_by=excluded_counts(enumeration, ~enumeration.feasible),
        minimal_conflict=conflicts[0],
        minimal_conflicts=conflicts,
        complete=complete,
        corrections=tuple(tuple(names[place] for place in places) for places in violated),
        nearest=NearestAlternative(variant=nearest, requirements=enumeration.violated_by(nearest)),
    )


def excluded_counts(enumeration: Enumeration, among: NDArray[np.bool_]) -> tuple[RequirementCount, ...]:
    """Count for each requirement the alternatives that it excludes.

    Args:
        enumeration: Every alternative evaluated.
        among: Mask of the alternatives that count, shape (n,).

    Returns:
        One count for each requirement, in the problem's order.
    """
    counts = enumeration.violated[among].sum(axis=0)
    return tuple(
        RequirementCount(requirement=requirement, excluded=int(count))
        for requirement, count in zip(enumeration.requirements, counts, strict=True)
    )


def violation_sets(violated: NDArray[np.bool_]) -> list[tuple[int, ...]]:
    """Distinct sets of demands that alternatives violate, as columns in ascending order.

    Args:
        violated: True where an alternative violates a requirement, shape (n, r).
    """
    import numpy as np

    patterns = np.unique(violated, axis=0)
    return [tuple(np.flatnonzero(pattern).tolist()) for pattern in patterns]


def smallest_sets(sets: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """The sets that contain no other, the smallest first, then in lexicographic order."""
    kept: list[frozenset[int]] = []
    for candidate in sorted({frozenset(each) for each in sets}, key=lambda each: (len(each), sorted(each))):
        if not any(smaller <= candidate for smaller in kept):
            kept.append(candidate)
    return [tuple(sorted(each)) for each in kept]


def minimal_hitting_sets(sets: list[tuple[int, ...]], most: int) -> tuple[list[tuple[int, ...]], bool]:
    """All minimal hitting sets of a family of sets, by Berge's algorithm.

    For each further set, a hitting set of the previous ones either hits it or is extended by each of its elements;
    supersets of others are removed (Berge, *Hypergraphs*, 1989).

    Args:
        sets: The sets, none of which is empty.
        most: Greatest number of intermediate sets; the smallest are kept.

    Returns:
        The hitting sets, the smallest first, then in lexicographic order; and True if they are complete.
    """
    found: list[tuple[int, ...]] = [()]
    complete = True
    for each in sets:
        extended: list[tuple[int, ...]] = []
        for hitting in found:
            if set(hitting) & set(each):
                extended.append(hitting)
            else:
                extended += [tuple(sorted((*hitting, element))) for element in each]
        found = smallest_sets(extended)
        if len(found) > most:
            found, complete = found[:most], False
    return found, complete
