"""Shortening a path by shortcuts, within a budget of validity checks of its own."""

from __future__ import annotations

import contextlib
import itertools
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rgss.motion.paths import coarse_to_fine, path_length, path_states, segment_states
from rgss.motion.validity import StateValidity, first_invalid_between

Vector = NDArray[np.float64]

_ROPE_STRETCHES = 20
_SMALLEST_ROPE_GAIN = 0.05
_SMALLEST_RANDOM_GAIN = 0.001
_LARGEST_FRUITLESS_RUN = 60
_FINAL_DENSITY = 4


def shorten(
    points: Vector,
    validity: StateValidity,
    *,
    generator: np.random.Generator,
    budget_checks: int,
    resolution_rad: float,
) -> tuple[Vector, int]:
    """Shorten a valid polyline by replacing stretches of it with straight segments.

    Three stages follow each other while the budget lasts. Each corner is joined with the furthest corner
    that it can be joined with. Then the path is cut into equal stretches and the two points are joined
    that save most. Then random pairs of points are tried, until many in a row have saved nothing. The
    result depends on the path, the generator's state and the budget alone.

    Shortcuts pass close by what is in the way. The result is therefore checked once more, four times as
    densely; where it touches something between the states that were checked before, the shortcuts are
    taken back one by one.

    Args:
        points: Corners of a valid path in rad, shape (n, joints).
        validity: Tells valid states from invalid ones.
        generator: Source of the random choices.
        budget_checks: Greatest number of validity checks; those of the final check come on top.
        resolution_rad: Greatest distance between the states that are checked.

    Returns:
        The corners of the shorter path and the number of checks that it took.
    """
    check = _CheckBudget(validity, budget_checks)
    paths = [points]
    # What is found before the budget is spent is kept.
    with contextlib.suppress(_BudgetSpentError):
        paths.extend(_improvements(points, check, generator, resolution_rad))
    final = _CheckBudget(validity, None)
    while len(paths) > 1 and not final.are_valid(path_states(paths[-1], resolution_rad, density=_FINAL_DENSITY)):
        paths.pop()
    return paths[-1], check.spent + final.spent


class _BudgetSpentError(Exception):
    """The next check would exceed the budget."""


class _CheckBudget:
    """Counts validity checks and refuses those beyond a budget."""

    def __init__(self, validity: StateValidity, budget: int | None) -> None:
        self._first_invalid = first_invalid_between(validity)
        self._budget = budget
        self.spent = 0

    def are_valid(self, states: Vector) -> bool:
        """Whether all states are valid, which lie between valid ones; checked in order up to the first that is not.

        Raises:
            _BudgetSpentError: The budget ends before that is known.
        """
        affordable = len(states) if self._budget is None else min(len(states), self._budget - self.spent)
        index = self._first_invalid(states[:affordable])
        if index is not None:
            self.spent += index + 1
            return False
        self.spent += affordable
        if affordable < len(states):
            raise _BudgetSpentError
        return True


def _improvements(
    points: Vector, check: _CheckBudget, generator: np.random.Generator, resolution_rad: float
) -> Iterator[Vector]:
    def joined(start: Vector, end: Vector) -> bool:
        states = segment_states(start, end, resolution_rad)
        return check.are_valid(states[_coarse_to_fine(len(states))])

    path = points
    for stage in (_skip_corners, _pull_rope):
        for shorter in stage(path, joined):
            path = shorter
            yield path
    yield from _random_shortcuts(path, joined, generator)


def _skip_corners(path: Vector, joined: Callable[[Vector, Vector], bool]) -> Iterator[Vector]:
    corner = 0
    while corner < len(path) - 2:
        for far in range(len(path) - 1, corner + 1, -1):
            if joined(path[corner], path[far]):
                path = np.vstack([path[: corner + 1], path[far:]])
                yield path
                break
        corner += 1


def _pull_rope(path: Vector, joined: Callable[[Vector, Vector], bool]) -> Iterator[Vector]:
    while True:
        rope = _subdivided(path, _ROPE_STRETCHES)
        along = np.array(_arc_lengths(rope))
        direct = np.linalg.norm(rope[:, None] - rope[None], axis=2)
        starts, ends = np.triu_indices(len(rope), 2)
        gains = (along[ends] - along[starts]) - direct[starts, ends]
        # Rounded, so that noise in the last digit cannot choose between equal gains.
        order = np.argsort(-np.round(gains, 9), kind="stable")
        worth = order[gains[order] > _SMALLEST_ROPE_GAIN * along[-1]]
        pairs = ((int(starts[index]), int(ends[index])) for index in worth)
        best = next(((start, end) for start, end in pairs if joined(rope[start], rope[end])), None)
        if best is None:
            return
        path = _without_straight_corners(np.vstack([rope[: best[0] + 1], rope[best[1] :]]))
        yield path


def _random_shortcuts(
    path: Vector, joined: Callable[[Vector, Vector], bool], generator: np.random.Generator
) -> Iterator[Vector]:
    fruitless, along = 0, _arc_lengths(path)
    while fruitless < _LARGEST_FRUITLESS_RUN:
        fruitless += 1
        first, last = sorted(part * along[-1] for part in generator.random(2).tolist())
        start, stop = bisect_right(along, first), bisect_left(along, last)
        if start >= stop:
            continue
        entry, leave = _at(path, along, start - 1, first), _at(path, along, stop - 1, last)
        gain = (last - first) - float(np.linalg.norm(leave - entry))
        if gain > _SMALLEST_RANDOM_GAIN * along[-1] and all(
            joined(one, other) for one, other in ((entry, leave), (path[start - 1], entry), (leave, path[stop]))
        ):
            path = _without_straight_corners(np.vstack([path[:start], entry, leave, path[stop:]]))
            fruitless, along = 0, _arc_lengths(path)
            yield path


def _arc_lengths(path: Vector) -> list[float]:
    """How far each corner is from the first along the path."""
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1).tolist()
    return list(itertools.accumulate(steps, initial=0.0))


@lru_cache(maxsize=1024)
def _coarse_to_fine(count: int) -> NDArray[np.int64]:
    """`coarse_to_fine` as what picks rows; not to be written to."""
    return np.array(coarse_to_fine(count), dtype=np.int64)


def _at(path: Vector, along: Sequence[float], segment: int, distance: float) -> Vector:
    fraction = (distance - along[segment]) / (along[segment + 1] - along[segment])
    point: Vector = path[segment] + fraction * (path[segment + 1] - path[segment])
    return point


def _subdivided(path: Vector, stretches: int) -> Vector:
    """The path with corners added so that no segment is longer than a fraction of the whole."""
    longest = path_length(path) / stretches
    points = [path[:1]]
    for start, end in itertools.pairwise(path):
        if np.any(start != end):
            points.append(segment_states(start, end, longest))
    return np.vstack(points)


def _without_straight_corners(path: Vector) -> Vector:
    """Drop corners at which the path does not turn."""
    kept = [path[0]]
    for corner, following in itertools.pairwise(path[1:]):
        before, after = corner - kept[-1], following - corner
        if not np.any(before):
            continue
        sideways = after - before * (before @ after) / (before @ before)
        if np.linalg.norm(sideways) > 1e-9 or before @ after < 0.0:
            kept.append(corner)
    return np.array([*kept, path[-1]])
