"""Path simplification by shortcuts, with its own limit."""

from __future__ import annotations

import contextlib
import itertools
import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rgss.motion.paths import coarse_to_fine, path_length, segment_states
from rgss.motion.validity import StateValidity, first_invalid_between

Vector = NDArray[np.float64]

_ROPE_STRETCHES = 20
_SMALLEST_ROPE_GAIN = 0.05
_SMALLEST_RANDOM_GAIN = 0.001
_LARGEST_FRUITLESS_RUN = 60
_FINAL_DENSITY = 4
_CHECKS_BETWEEN_LOOKS = 32
"""Termination predicate by a wall clock; reading it takes a fraction of a check."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ShortenedPath:
    """Result of a simplification.

    Attributes:
        corners: The corners in rad, shape (n, joints).
        checks: Number of validity checks, including the final check.
        unlimited_from: Least limit in checks that does not change the result; None if the limit of this run did.
    """

    corners: Vector
    checks: int
    unlimited_from: int | None


def shorten(
    points: Vector,
    validity: StateValidity,
    *,
    generator: np.random.Generator,
    budget_checks: int,
    resolution_rad: float,
    limit_checks: int | None = None,
    is_over: Callable[[], bool] | None = None,
) -> ShortenedPath:
    """Shorten a valid polyline by replacing stretches of it with straight segments.

    Three stages run in sequence while the budget lasts. First each corner is connected with the furthest corner that it
    can be connected with. Then the path is cut into equal stretches, and the two points are connected that save most.
    Then random pairs of points are tried until many in a row have saved nothing. The result depends only on the path,
    the generator's state and the budget.

    Shortcuts pass close to obstacles. The result is therefore checked again, four times as densely; if it collides
    between the states checked before, the shortcuts are reverted one by one. The checks that this final check needs are
    reserved from the limit. A path that cannot be checked completely within the limit is not used: the longer one
    before it is, and finally the path as found, which the planner has checked.

    Args:
        points: Corners of a valid path in rad, shape (n, joints).
        validity: State-validity checker.
        generator: Random generator.
        budget_checks: Greatest number of validity checks of the search for shortcuts.
        resolution_rad: Greatest distance between the states that are checked.
        limit_checks: Greatest number of validity checks altogether, the final check included; None for no limit.
        is_over: Termination predicate of a wall clock; results of checks after it holds are not used.
    """
    check = _CheckBudget(validity, budget_checks, limit_checks, is_over)
    paths = [points]
    # Shortcuts found before the budget is spent are kept.
    with contextlib.suppress(_BudgetSpentError):
        for path in _improvements(points, check, generator, resolution_rad):
            paths.append(path)
            check.keep_back(1 + sum(map(len, _dense_segments(path, resolution_rad).values())))
    corners = _last_valid(paths, check, resolution_rad)
    return ShortenedPath(corners=corners, checks=check.spent, unlimited_from=check.unlimited_from)


def _last_valid(paths: Sequence[Vector], check: _CheckBudget, resolution_rad: float) -> Vector:
    """Last path that passes the dense check within the rest of the limit; the first needs no check."""
    check.search_is_over()
    # Paths share most of their segments; each is checked once.
    valid: set[tuple[bytes, bytes]] = set()
    touching: set[tuple[bytes, bytes]] = set()
    with contextlib.suppress(_BudgetSpentError):
        if len(paths) > 1:
            check.are_valid(paths[0][:1])
        for path in reversed(paths[1:]):
            segments = _dense_segments(path, resolution_rad)
            due = {key: states for key, states in segments.items() if key not in valid}
            if not touching.isdisjoint(segments) or not check.affords(sum(map(len, due.values()))):
                continue
            for key, states in due.items():
                if not check.are_valid(states):
                    touching.add(key)
                    break
                valid.add(key)
            else:
                return path
    return paths[0]


def _dense_segments(path: Vector, resolution_rad: float) -> dict[tuple[bytes, bytes], Vector]:
    """The states of the final check by the segment on which they lie."""
    return {
        (start.tobytes(), end.tobytes()): segment_states(start, end, resolution_rad, density=_FINAL_DENSITY)
        for start, end in itertools.pairwise(path)
    }


class _BudgetSpentError(Exception):
    """The next check would exceed the budget."""


class _CheckBudget:
    """Counter of validity checks that refuses those beyond a budget or a time limit.

    The search for shortcuts has its own budget within the total limit. From the total it reserves the checks of the
    cheapest final check, as soon as one fits.
    """

    def __init__(
        self, validity: StateValidity, budget: int, limit: int | None, is_over: Callable[[], bool] | None
    ) -> None:
        self._first_invalid = first_invalid_between(validity)
        self._limit = math.inf if limit is None else limit
        self._own_budget: float = budget
        self._search_budget = min(budget, self._limit)
        self._budget: float = self._search_budget
        self._kept_back: float = math.inf
        self._is_over = is_over
        self._needed = 0
        self._was_limited = False
        self.spent = 0

    @property
    def unlimited_from(self) -> int | None:
        """Least limit that covers all checks so far and the reserve; None if the limit refused a check.

        Under any greater limit the same checks are made: none is refused, and the reserve is the same.
        """
        return None if self._was_limited else self._needed

    def keep_back(self, checks: int) -> None:
        """Reserve a number of checks of the limit for the final check of a path."""
        self._kept_back = min(self._kept_back, checks)
        self._need(self.spent + checks)
        if self.spent + self._kept_back <= self._limit:
            self._budget = min(self._search_budget, self._limit - self._kept_back)

    def search_is_over(self) -> None:
        """Release the reserved checks."""
        self._budget = self._limit
        self._own_budget, self._kept_back = math.inf, 0

    def affords(self, checks: int) -> bool:
        """True if a number of checks is left."""
        self._need(self.spent + checks)
        is_left = self.spent + checks <= self._budget
        self._was_limited |= not is_left
        return is_left

    def are_valid(self, states: Vector) -> bool:
        """True if all states, which lie between valid ones, are valid; checked in order up to the first invalid one.

        Raises:
            _BudgetSpentError: The budget or the time ends before the result is known.
        """
        affordable = int(min(len(states), self._budget - self.spent))
        size = max(1, affordable) if self._is_over is None else _CHECKS_BETWEEN_LOOKS
        for first in range(0, affordable, size):
            part = states[first : min(first + size, affordable)]
            index = self._first_invalid(part)
            self.spent += len(part) if index is None else index + 1
            self._need(self.spent + (0 if self._kept_back == math.inf else self._kept_back))
            if self._is_over is not None and self._is_over():
                raise _BudgetSpentError
            if index is not None:
                return False
        if affordable < len(states):
            self._was_limited |= self._budget < self._own_budget
            raise _BudgetSpentError
        return True

    def _need(self, checks: float) -> None:
        self._needed = max(self._needed, int(checks))


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
        # Rounded, so that rounding noise does not decide between equal gains.
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
    """Arc length of each corner from the first one along the path."""
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1).tolist()
    return list(itertools.accumulate(steps, initial=0.0))


@lru_cache(maxsize=1024)
def _coarse_to_fine(count: int) -> NDArray[np.int64]:
    """`coarse_to_fine` as a read-only index array."""
    return np.array(coarse_to_fine(count), dtype=np.int64)


def _at(path: Vector, along: Sequence[float], segment: int, distance: float) -> Vector:
    fraction = (distance - along[segment]) / (along[segment + 1] - along[segment])
    point: Vector = path[segment] + fraction * (path[segment + 1] - path[segment])
    return point


def _subdivided(path: Vector, stretches: int) -> Vector:
    """The path with added corners, so that no segment is longer than a fraction of the path."""
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
