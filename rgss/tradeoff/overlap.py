"""Double counting: weighted measures of which one contains the other."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Overlap:
    """Two weighted measures that count the same thing twice.

    Attributes:
        whole: The measure whose expression contains the other, such as ``t_e``.
        part: The measure that is contained, such as ``t_p``.
    """

    whole: str
    part: str


def overlapping_measures(
    weights: Mapping[str, float], contains: Callable[[str], AbstractSet[str]]
) -> tuple[Overlap, ...]:
    """Report weighted measures that count the same thing twice.

    Args:
        weights: Weight by measure; a measure of weight 0 counts nothing.
        contains: All measures that the expression of a measure contains, directly or through
            other measures.

    Returns:
        The pairs, in the order of the weights: by the whole, then by the part.
    """
    weighted = [measure for measure, weight in weights.items() if weight > 0.0]
    return tuple(
        Overlap(whole=whole, part=part)
        for whole in weighted
        for part in weighted
        if part != whole and part in contains(whole)
    )
