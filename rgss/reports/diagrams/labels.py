"""Placement of edge labels without crossing lines or overlapping texts.

Graphviz reserves room for each label beside its edge, but other edges may pass through it. Such a
label moves along its edge to the nearest free place.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise

import numpy as np
from numpy.typing import NDArray

from rgss.reports.diagrams.canvas import Point

Segment = tuple[Point, Point]
Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_STEPS = 16
"""Number of straight segments that approximate a Bézier curve."""
_BERNSTEIN = tuple(
    ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)
    for t in (step / _STEPS for step in range(1, _STEPS + 1))
)
_CLEARANCE = 2.0
_AT_ONCE = 48
"""Number of places that are tried together."""
_ROUNDED = 1.0 + 1e-9
_PLACES = 24
"""Number of positions along an edge that are tried."""
_DISTANCES = (4.0, 10.0, 18.0, 30.0, 50.0, 80.0)
"""Distances of a label from its edge that are tried, in pixels."""
NEAR, FAR, FARTHEST = 30.0, 50.0, 80.0
"""Distances within which a label is seen to belong to its edge, may still be, and beyond which none is tried."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """Axis-aligned rectangle in pixels."""

    left: float
    top: float
    right: float
    bottom: float

    @classmethod
    def about(cls, centre: Point, size: tuple[float, float]) -> Box:
        """The rectangle of a width and height about a centre."""
        (x, y), (width, height) = centre, size
        return cls(left=x - width / 2, top=y - height / 2, right=x + width / 2, bottom=y + height / 2)

    def overlaps(self, other: Box) -> bool:
        """True if the two share an area."""
        across = min(self.right, other.right) > max(self.left, other.left)
        return across and min(self.bottom, other.bottom) > max(self.top, other.top)

    def distance(self, point: Point) -> float:
        """Distance of a point; 0 within."""
        x, y = point
        return math.hypot(max(self.left - x, 0.0, x - self.right), max(self.top - y, 0.0, y - self.bottom))


def flattened(curve: Sequence[Point]) -> list[Point]:
    """Polyline that approximates Bézier curves."""
    points = [curve[0]]
    for index in range(0, len(curve) - 1, 3):
        (a, b), (c, d), (e, f), (g, h) = curve[index : index + 4]
        points += [(p * a + q * c + r * e + s * g, p * b + q * d + r * f + s * h) for p, q, r, s in _BERNSTEIN]
    return points


class Strokes:
    """Segments that no label may be crossed by."""

    def __init__(self, segments: Iterable[Segment]) -> None:
        """Note the extents of the segments."""
        self._ends = np.array(list(segments), dtype=float).reshape(-1, 2, 2)
        self._boxes = np.hstack([self._ends.min(axis=1), self._ends.max(axis=1)])

    def cross(self, boxes: Array) -> Mask:
        """True where any of them is partly within a rectangle, shape (k,).

        Args:
            boxes: Left, top, right and bottom of each rectangle, shape (k, 4).
        """
        box, segment = np.nonzero(_overlaps(boxes, self._boxes))
        (x, y), (u, v) = self._ends[segment, 0].T, self._ends[segment, 1].T
        # The corners are not all on one side of the line through the segment.
        sides = np.array(
            [
                (u - x) * (boxes[box, down] - y) - (v - y) * (boxes[box, across] - x)
                for across in (0, 2)
                for down in (1, 3)
            ]
        )
        found = np.zeros(len(boxes), dtype=np.bool_)
        found[box[(sides.min(axis=0) < 0) & (sides.max(axis=0) > 0)]] = True
        return found


class Room:
    """Room for labels in a diagram: off its boxes, and where no segment crosses them."""

    def __init__(self, strokes: Strokes, boxes: Iterable[Box]) -> None:
        """Note what labels must keep off."""
        self._strokes = strokes
        self._boxes = np.empty((0, 4))
        for box in boxes:
            self.take(box)

    def take(self, box: Box) -> None:
        """Keep further labels off a box."""
        if box.right > box.left and box.bottom > box.top:
            self._boxes = np.vstack([self._boxes, (box.left, box.top, box.right, box.bottom)])

    def free(self, centres: Iterable[Point], size: tuple[float, float]) -> Iterator[Point]:
        """Those centres of a label that leave it free, in their order.

        Args:
            centres: The centres.
            size: Width and height of the label.
        """
        left = iter(centres)
        while some := list(islice(left, _AT_ONCE)):
            middles, half = np.array(some), np.array([(size[0] + _CLEARANCE) / 2, (size[1] + _CLEARANCE) / 2])
            boxes = np.hstack([middles - half, middles + half])
            is_free = (boxes[:, :2].min(axis=1) >= 0.0) & ~_overlaps(boxes, self._boxes).any(axis=1)
            free = np.flatnonzero(is_free)
            yield from (some[place] for place in free[~self._strokes.cross(boxes[free])].tolist())


def place_labels(
    curves: Sequence[Sequence[Point]],
    wanted: Sequence[Point | None],
    sizes: Sequence[tuple[float, float]],
    nodes: Sequence[Box],
    lines: Sequence[Segment],
    *,
    farthest: float,
    lanes: Sequence[Box] = (),
) -> tuple[tuple[Point | None, ...], bool]:
    """Move each crossed or overlapped label to a free place beside its edge.

    Args:
        curves: The points of each edge.
        wanted: The centre of each edge's label; None without one.
        sizes: Width and height of each label.
        nodes: The rectangles of the nodes.
        lines: Other straight lines that no label may cross, such as those of frames.
        farthest: Largest distance of a label from its edge, in pixels.
        lanes: Lanes of which a label must be in the one that its edge passes through beside it; with them no other
            edge may be nearer to it.

    Returns:
        The centres, and True if every label is free. A label without a free place keeps its centre.
    """
    ways = [flattened(curve) for curve in curves]
    room = Room(Strokes([segment for way in ways for segment in pairwise(way)] + list(lines)), nodes)
    beside = _Sides(ways, lanes)
    centres: dict[int, Point] = {}

    def place(index: int, candidates: Iterable[Point]) -> bool:
        free = room.free(candidates, sizes[index])
        centre = next((each for each in free if beside.is_of(_roomy(each, sizes[index]), index)), None)
        if centre is None:
            return False
        centres[index] = centre
        room.take(_roomy(centre, sizes[index]))
        return True

    crossed = [index for index, centre in enumerate(wanted) if centre is not None and not place(index, [centre])]
    all_free = True
    for index in crossed:
        centre = wanted[index]
        if not place(index, _candidates(ways[index], sizes[index], farthest)) and centre is not None:
            all_free = False
            centres[index] = centre
            room.take(_roomy(centre, sizes[index]))
    return tuple(centres.get(index) for index in range(len(wanted))), all_free


def with_stubs(curve: Sequence[Point], first: float, last: float, *, rightwards: bool) -> tuple[Point, ...]:
    """A curve with straight pieces at its ends, from the border of a node to the symbol within it.

    Args:
        curve: The points of its Bézier curves.
        first: Length of the piece before it, in pixels; 0 for none.
        last: Length of the piece behind it.
        rightwards: The pieces lead to the right; otherwise downwards.
    """
    across, down = (1.0, 0.0) if rightwards else (0.0, 1.0)
    points = list(curve)
    if first:
        x, y = points[0]
        points[:0] = [(x - across * first * part, y - down * first * part) for part in (1.0, 2 / 3, 1 / 3)]
    if last:
        x, y = points[-1]
        points += [(x + across * last * part, y + down * last * part) for part in (1 / 3, 2 / 3, 1.0)]
    return tuple(points)


def place_titles(
    frames: Mapping[str, Box], widths: Mapping[str, float], height: float, curves: Sequence[Sequence[Point]]
) -> tuple[dict[str, Box], bool]:
    """Place the title of each frame along its upper edge, where no edge crosses it.

    Args:
        frames: The frames.
        widths: Width of each title, in pixels.
        height: Height of the strip below the upper edge that titles stand in.
        curves: The points of each edge.

    Returns:
        The boxes of the titles, nearest to the middle of the frame, and whether every title is free.
    """
    strokes = Strokes(segment for curve in curves for segment in pairwise(flattened(curve)))
    placed, all_free = {}, True
    for name, frame in frames.items():
        room = max(frame.right - frame.left - widths[name] - 2 * _CLEARANCE, 0.0)
        places = (
            Box.about(
                ((frame.left + frame.right) / 2 + room * share, frame.top + height / 2),
                (widths[name] + _CLEARANCE, height - _CLEARANCE),
            )
            for share in sorted((step / _PLACES - 0.5 for step in range(_PLACES + 1)), key=abs)
        )
        boxes = list(places)
        crossed = strokes.cross(np.array([(box.left, box.top, box.right, box.bottom) for box in boxes]))
        all_free &= not crossed.all()
        placed[name] = boxes[0] if crossed.all() else boxes[int(np.argmin(crossed))]
    return placed, all_free


def frame_lines(frames: Iterable[Box]) -> list[Segment]:
    """The outlines of frames."""
    lines: list[Segment] = []
    for box in frames:
        corners = [(box.left, box.top), (box.right, box.top), (box.right, box.bottom), (box.left, box.bottom)]
        lines += pairwise([*corners, corners[0]])
    return lines


def _overlaps(boxes: Array, others: Array) -> Mask:
    """True where rectangles share an area with others, or with the rectangles about segments; shape (k, n)."""
    left, top, right, bottom = boxes.T[:, :, None]
    return np.asarray((right > others[:, 0]) & (left < others[:, 2]) & (bottom > others[:, 1]) & (top < others[:, 3]))


def _roomy(centre: Point, size: tuple[float, float]) -> Box:
    return Box.about(centre, (size[0] + _CLEARANCE, size[1] + _CLEARANCE))


class _Sides:
    """Edge that a label is beside, in diagrams with lanes."""

    def __init__(self, ways: Sequence[Sequence[Point]], lanes: Sequence[Box]) -> None:
        self._ways, self._lanes = ways, lanes
        self._points = np.array([point for way in ways for point in way]).reshape(-1, 2)
        self._edges = np.repeat(np.arange(len(ways)), [len(way) for way in ways])

    def is_of(self, box: Box, index: int) -> bool:
        """True if a label belongs to its edge: no other edge is nearer, and the edge beside it is in the same lane."""
        if not self._lanes:
            return True
        apart, (beside, _) = min((box.distance(point), point) for point in self._ways[index])
        middle = (box.left + box.right) / 2
        if any((lane.left <= middle <= lane.right) != (lane.left <= beside <= lane.right) for lane in self._lanes):
            return False
        # Of most points one coordinate alone is as far away.
        off = np.maximum(self._points - (box.right, box.bottom), (box.left, box.top) - self._points).max(axis=1)
        near = self._points[(off <= apart * _ROUNDED) & (self._edges != index)].tolist()
        return all(box.distance((x, y)) >= apart for x, y in near)


def _candidates(way: Sequence[Point], size: tuple[float, float], farthest: float) -> Iterator[Point]:
    """Centres beside an edge: near ones first, and of these those at the middle of the edge first."""
    last = len(way) - 1
    steps = sorted({round(index * last / _PLACES) for index in range(1, _PLACES)}, key=lambda at: abs(at - last / 2))
    width, height = size
    for distance in (each for each in _DISTANCES if each <= farthest):
        for at in steps:
            x, y = way[at]
            for across, down in ((1, 0), (-1, 0), (0, -1), (0, 1), (1, -1), (-1, -1), (1, 1), (-1, 1)):
                yield x + across * (width / 2 + distance), y + down * (height / 2 + distance)
