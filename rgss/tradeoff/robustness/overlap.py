"""Double counting: weighted measures of which one contains the other, or that have parts in common."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from itertools import combinations


@dataclass(frozen=True, slots=True, kw_only=True)
class Overlap:
    """Two weighted measures that count the same effect twice.

    Attributes:
        whole: The measure whose expression contains the other, such as ``t_e``.
        part: The measure that is contained, such as ``t_p``.
        instead: A measure with the dependencies of the whole except the part, which could be valued instead; None if
        there is none.
    """

    whole: str
    part: str
    instead: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class SharedPart:
    """Two weighted measures, neither of which contains the other, that depend on the same measures.

    Attributes:
        first: The one measure.
        second: The other.
        parts: Parts that both contain.
    """

    first: str
    second: str
    parts: tuple[str, ...]


def overlapping_measures(
    weights: Mapping[str, float],
    contains: Callable[[str], AbstractSet[str]],
    *,
    candidates: Iterable[str] = (),
    alike: Callable[[str, str], bool] = lambda one, other: True,  # noqa: ARG005
) -> tuple[Overlap, ...]:
    """Report weighted measures that count the same thing twice.

    Args:
        weights: Weight by measure; a measure of weight 0 counts nothing.
        contains: All measures that the expression of a measure contains, directly or through
            other measures.
        candidates: Measures that could be valued in place of others.
        alike: Predicate: True if two measures are in the same unit.

    Returns:
        The pairs, in the order of the weights: by the whole, then by the part.
    """
    weighted = _weighted(weights)
    offered = tuple(candidates)

    def instead(whole: str, part: str) -> str | None:
        rest = set(contains(whole)) - {part} - set(contains(part))
        return next((other for other in offered if rest and contains(other) == rest and alike(other, whole)), None)

    return tuple(
        Overlap(whole=whole, part=part, instead=instead(whole, part))
        for whole in weighted
        for part in weighted
        if part != whole and part in contains(whole)
    )


def shared_parts(weights: Mapping[str, float], contains: Callable[[str], Sequence[str]]) -> tuple[SharedPart, ...]:
    """Report weighted measures that have parts in common although neither contains the other.

    Args:
        weights: Weight by measure; a measure of weight 0 counts nothing.
        contains: All measures that the expression of a measure contains, in a fixed order.

    Returns:
        The pairs, in the order of the weights.
    """
    found = []
    for first, second in combinations(_weighted(weights), 2):
        one, other = contains(first), contains(second)
        parts = tuple(part for part in one if part in other)
        if parts and first not in other and second not in one:
            found.append(SharedPart(first=first, second=second, parts=parts))
    return tuple(found)


def _weighted(weights: Mapping[str, float]) -> list[str]:
    return [measure for measure, weight in weights.items() if weight > 0.0]
