"""For each alternative, the exact region of weights where it wins."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from typing import TypeVar

import numpy as np

from rgss.tradeoff.problem import Array, Mask, checked_values, classes, nondominated
from rgss.tradeoff.weights.polytope import THINNEST, Polytope
from rgss.tradeoff.weights.sampling import Drawing, sample_weights
from rgss.tradeoff.weights.weight_set import WeightSet

Result = TypeVar("Result")

SHARE_SAMPLES = 1 << 16

WALKED_SAMPLES = 1 << 14
"""Of weights that a random walk draws; the standard errors of shares are below 0.004."""

ALL_RIVALS_TO = 200
"""Of more distinct alternatives only those count that none dominates; a region needs a program as large."""

_CLEARLY = 1e-6
"""Weights that are drawn where a volume cannot be computed from vertices."""


_MOST_WORTHS = 4_000_000
"""So many weighted values are in memory at once, 32 MB."""


class ShareBy(str, Enum):
    """Method of a region's share: from the volume of its corners, or by counting drawn weights."""

    VOLUME = "volume"
    INDEPENDENT = Drawing.INDEPENDENT.value
    HIT_AND_RUN = Drawing.HIT_AND_RUN.value


class RegionKind(str, Enum):
    """Share of the weights for which an alternative is best."""

    EMPTY = "empty"
    TIES = "ties"
    OPEN = "open"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WeightRegion:
    """Weight region of an alternative: the weights w with (v_i - v_j) w >= 0 for every j.

    Attributes:
        kind: Empty; without interior, so that it only ties; or open.
        centre: The centre of its largest ball (Chebyshev), shape (m,); None if it is empty.
        radius: The radius of that ball: greatest Euclidean distance from the centre at which the alternative certainly
        wins.
        low: The least value of each weight in it, shape (m,); None if it is empty.
        high: The greatest value of each weight in it, shape (m,); None if it is empty.
        share: Its volume as a share of that of all admitted weights.
        share_error: The standard error of the share; 0 where it was computed from vertices.
        share_by: Method of the share.
        vertices: Its vertices, shape (v, m); None if not computed.
    """

    kind: RegionKind
    centre: Array | None
    radius: float
    low: Array | None
    high: Array | None
    share: float
    share_error: float
    vertices: Array | None
    share_by: ShareBy = ShareBy.VOLUME


def winning_polytope(values: Array, row: int, weights: WeightSet, rivals: Array | None = None) -> Polytope:
    """The region of one alternative as a polytope.

    Args:
        values: The single values of the alternatives, shape (n, m).
        row: The alternative.
        weights: The admitted weights.
        rivals: The alternatives that it is compared with, from `rivals_of`; None for all others.
    """
    differences = (np.delete(values, row, axis=0) if rivals is None else rivals) - values[row]
    differences = differences[np.abs(differences).max(axis=1) > 0.0] if len(differences) else differences
    return Polytope.of(weights, differences, np.zeros(len(differences)))


def rivals_of(values: Array) -> Array | None:
    """Non-dominated alternatives, with which all others must be compared.

    A dominated alternative is never better than the dominating one, for any weights.

    Args:
        values: The single values of distinct alternatives, shape (n, m).

    Returns:
        The values of the non-dominated ones; None for up to `ALL_RIVALS_TO` alternatives, of which all are compared.
    """
    return None if len(values) <= ALL_RIVALS_TO else np.asarray(values[nondominated(values)], dtype=np.float64)


def never_best(values: Array, rivals: Array | None) -> Mask:
    """Mask of the alternatives that a rival clearly dominates, so that no weights make them best, shape (n,).

    Args:
        values: The single values of distinct alternatives, shape (n, m).
        rivals: What `rivals_of` gives for them; no statement if None.
    """
    beaten = np.zeros(len(values), dtype=np.bool_)
    for rival in () if rivals is None else rivals:
        beaten |= (rival - values > _CLEARLY).all(axis=1)
    return beaten


def shared_region_keys(values: Array, rivals: Array | None) -> tuple[bytes | None, ...]:
    """Keys of alternatives that can only tie: those with the same key win at the same weights.

    If a rival is equal in some measures and clearly better in all others, the alternative ties only at weights of 0 for
    these others. Such a region is determined by the set of measures with weight 0 and the alternative's values in the
    rest. Ten thousand designs with few distinct costs or success rates then have only a few regions.

    Args:
        values: The single values of distinct alternatives, shape (n, m).
        rivals: Result of `rivals_of`; no keys if None.

    Returns:
        A key for each alternative; None if unknown.
    """
    lost = np.zeros(values.shape, dtype=np.bool_)
    for rival in () if rivals is None else rivals:
        lead = rival - values
        better = lead > _CLEARLY
        ties = (better | (lead == 0.0)).all(axis=1) & better.any(axis=1)
        lost |= better & ties[:, None]
    kept = np.where(lost, np.nan, values)
    return tuple(kept[row].tobytes() if lost[row].any() else None for row in range(len(values)))


def of_each_region(
    values: Array, weights: WeightSet, evaluate: Callable[[Polytope], Result], never: Result
) -> list[Result]:
    """Result of a function of the region of each alternative, made once for those that share a region.

    Args:
        values: The single values of distinct alternatives, shape (n, m).
        weights: The admitted weights.
        evaluate: The function.
        never: The result for an alternative that no weights make best, as a rival clearly dominates it.
    """
    rivals = rivals_of(values)
    beaten = never_best(values, rivals)
    shared: dict[bytes, Result] = {}
    found = []
    for row, key in enumerate(shared_region_keys(values, rivals)):
        if beaten[row]:
            found.append(never)
        elif key is None:
            found.append(evaluate(winning_polytope(values, row, weights, rivals)))
        else:
            if key not in shared:
                shared[key] = evaluate(winning_polytope(values, row, weights, rivals))
            found.append(shared[key])
    return found


def winning_regions(
    values: Array, feasible: Mask, weights: WeightSet, *, generator: np.random.Generator
) -> tuple[WeightRegion, ...]:
    """The region of each alternative among the feasible ones.

    Alternatives with the same values share a region. Regions of different values overlap in ties
    alone, so that the shares of distinct ones sum to 1.

    Args:
        values: The single values, shape (n, m), from 0 to 1; rows that are not feasible may hold NaN.
        feasible: Mask of the alternatives that can be chosen, shape (n,).
        weights: The admitted weights.
        generator: For shares that cannot be computed from vertices; otherwise it is not used.

    Returns:
        One region for each row; those of rows that are not feasible are empty.

    Raises:
        TradeoffError: A value of a feasible alternative is not a number from 0 to 1, or the
            admitted weights are empty or without interior.
    """
    regions = [_EMPTY] * len(values)
    if not feasible.any():
        return tuple(regions)
    distinct, membership = classes(checked_values(values[feasible]))
    whole = _whole(weights)
    found = of_each_region(distinct, weights, lambda polytope: _region(polytope, whole), _EMPTY)
    if any(math.isnan(region.share) for region in found):
        found = _sampled_shares(found, distinct, weights, generator)
    for row, kind in zip(np.flatnonzero(feasible), membership, strict=True):
        regions[row] = found[kind]
    return tuple(regions)


_EMPTY = WeightRegion(
    kind=RegionKind.EMPTY,
    centre=None,
    radius=0.0,
    low=None,
    high=None,
    share=0.0,
    share_error=0.0,
    vertices=None,
)


def _whole(weights: WeightSet) -> float:
    """The volume of all admitted weights; NaN where it cannot be computed from vertices."""
    polytope = Polytope.of(weights)
    vertices = polytope.vertices(polytope.interior_point())
    volume = None if vertices is None else polytope.volume(vertices)
    return math.nan if volume is None else volume


def _region(polytope: Polytope, whole: float) -> WeightRegion:
    ball = polytope.largest_ball()
    if ball is None:
        return _EMPTY
    centre, radius = ball
    if radius <= THINNEST and polytope.weights.directions().shape[1]:
        low, high = polytope.extent()
        return replace(_EMPTY, kind=RegionKind.TIES, centre=centre, low=low, high=high)
    vertices = polytope.vertices(centre)
    volume = None if vertices is None else polytope.volume(vertices)
    low, high = polytope.extent() if vertices is None else (vertices.min(axis=0), vertices.max(axis=0))
    return WeightRegion(
        kind=RegionKind.OPEN,
        centre=centre,
        radius=radius,
        low=low,
        high=high,
        share=math.nan if volume is None else volume / whole,
        share_error=0.0,
        vertices=vertices,
    )


def _sampled_shares(
    regions: list[WeightRegion], values: Array, weights: WeightSet, generator: np.random.Generator
) -> list[WeightRegion]:
    """The regions with every share counted among random weights."""
    sample = sample_weights(weights, SHARE_SAMPLES, generator, most_walks=WALKED_SAMPLES)
    number = len(sample.weights)
    at_once = max(1, _MOST_WORTHS // len(values))
    blocks = (sample.weights[start : start + at_once] for start in range(0, number, at_once))
    firsts = np.concatenate([(block @ values.T).argmax(axis=1) for block in blocks])
    winners = np.bincount(firsts, minlength=len(values)) / number
    return [
        replace(
            region,
            share=float(share),
            share_error=math.sqrt(float(share) * (1.0 - float(share)) / number),
            share_by=ShareBy(sample.drawn_by.value),
        )
        for region, share in zip(regions, winners, strict=True)
    ]
