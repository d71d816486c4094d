"""Choice of the inverse kinematics branch at each waypoint that minimises the joint travel of the task."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError

Vector = NDArray[np.float64]
Leg = tuple[int, int]

_NO_BOUNDS: Mapping[Leg, float] = MappingProxyType({})


def choose_branches(
    candidates: Sequence[Sequence[Vector]],
    *,
    legs: Sequence[Leg],
    weights: Sequence[float] | None = None,
    home: Sequence[float] | None = None,
    home_weight: float = 0.01,
    largest_travel_rad: Mapping[Leg, float] = _NO_BOUNDS,
) -> list[Vector] | None:
    """Choose one configuration for each waypoint that minimises the summed joint travel.

    The travel of a leg is the Euclidean length of the weighted joint differences. The legs form a
    chain, or a cycle when the last returns to the first waypoint. Solved by dynamic programming
    over the chain for every choice at its first waypoint at once; ties go to the earlier candidate.

    Args:
        candidates: For each waypoint, configurations, each of shape (n,).
        legs: Pairs (from, to) of waypoint indices; each starts where the one before ended, and the
            chain visits every waypoint.
        weights: Weight of each joint in the travel; 1 by default.
        home: Reference configuration; deviation from it decides between cycles that differ by whole turns.
        home_weight: Cost of one radian of deviation from home, relative to one radian of travel.
        largest_travel_rad: Greatest change of any joint along a leg, for some legs; small where the branch must not
            change.

    Returns:
        One configuration for each waypoint; None if no choice satisfies the bounds.

    Raises:
        DefinitionError: The legs are not a chain or a cycle over all waypoints.
    """
    _check_legs(legs, len(candidates))
    if any(len(choices) == 0 for choices in candidates):
        return None
    stacks = [np.asarray(choices, dtype=float) for choices in candidates]
    scale = np.ones(stacks[0].shape[1]) if weights is None else np.asarray(weights, dtype=float)
    stay = [_home_cost(stack, home, scale, home_weight) for stack in stacks]
    first = legs[0][0]
    closed = legs[-1][1] == first

    # cost[a, b]: cheapest way from choice a at the first waypoint to choice b at the current one
    cost = np.where(np.eye(len(stacks[first]), dtype=bool), stay[first][:, None], np.inf)
    came_from: list[NDArray[np.intp]] = []
    for leg in legs:
        start, end = leg
        travel = _travel(stacks[start], stacks[end], scale, largest_travel_rad.get(leg, np.inf))
        arrival = np.zeros(len(stacks[end])) if end == first else stay[end]
        cost, choice = _extend(cost, travel + arrival)
        came_from.append(choice)
    total = np.diag(cost)[:, None] if closed else cost
    # Rounded, so that rounding noise does not decide between equal costs.
    best = int(np.argmin(np.round(total, 9)))
    if not np.isfinite(total.flat[best]):
        return None
    origin, at = divmod(best, total.shape[1])
    at = origin if closed else at
    chosen = {first: origin}
    for leg, choice in zip(reversed(legs), reversed(came_from), strict=True):
        if not (closed and leg[1] == first):
            chosen[leg[1]] = at
        at = int(choice[origin, at])
    return [stacks[index][chosen[index]] for index in range(len(stacks))]


def _check_legs(legs: Sequence[Leg], waypoints: int) -> None:
    order = [legs[0][0], *(end for _, end in legs)] if legs else []
    chained = all(before[1] == after[0] for before, after in itertools.pairwise(legs))
    visited = order[:-1] if len(order) > 1 and order[-1] == order[0] else order
    if not chained or sorted(visited) != list(range(waypoints)):
        raise DefinitionError(
            f"the legs must form a chain or cycle over all {waypoints} waypoints, got {list(legs)}",
            hint="start each leg where the previous one ends, and visit every waypoint once",
        )


def _home_cost(stack: Vector, home: Sequence[float] | None, scale: Vector, weight: float) -> Vector:
    if home is None:
        return np.zeros(len(stack))
    distance: Vector = np.linalg.norm((stack - np.asarray(home, dtype=float)) * scale, axis=1)
    return weight * distance


def _travel(start: Vector, end: Vector, scale: Vector, bound: float) -> Vector:
    difference = start[:, None, :] - end[None, :, :]
    travel: Vector = np.linalg.norm(difference * scale, axis=2)
    return np.where(np.max(np.abs(difference), axis=2) <= bound, travel, np.inf)


def _extend(cost: Vector, step: Vector) -> tuple[Vector, NDArray[np.intp]]:
    """Min-plus product: the least cost over all intermediate choices, and the choice that attains it."""
    best = np.empty((len(cost), step.shape[1]))
    choice = np.empty(best.shape, dtype=np.intp)
    for row, reach in enumerate(cost):
        total = reach[:, None] + step
        choice[row] = np.argmin(np.round(total, 9), axis=0)
        best[row] = np.take_along_axis(total, choice[row][None, :], axis=0)[0]
    return best, choice
