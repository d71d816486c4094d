"""Placement of edge labels without crossing lines or overlapping texts.

Graphviz reserves room for each label beside its edge, but other edges may pass through it. Such a
label moves along its edge to the nearest free place.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rgss.reports.diagrams.canvas import Point

Segment = tuple[Point, Point]

_STEPS = 16
"""Number of straight segments that approximate a Bézier curve."""
_BERNSTEIN = tuple(
    ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)
    for t in (step / _STEPS for step in range(1, _STEPS + 1))
)
_CLEARANCE = 2.0
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

    def is_crossed_by(self, segment: Segment) -> bool:
        """True if a part of a segment is within the rectangle."""
        (x, y), (u, v) = segment
        if max(x, u) <= self.left or min(x, u) >= self.right or max(y, v) <= self.top or min(y, v) >= self.bottom:
            return False
        # The corners are not all on one side of the line through the segment.
        sides = [
            (u - x) * (corner_y - y) - (v - y) * (corner_x - x)
            for corner_x in (self.left, self.right)
            for corner_y in (self.top, self.bottom)
        ]
        return min(sides) < 0 < max(sides)


def flattened(curve: Sequence[Point]) -> list[Point]:
    """Polyline that approximates Bézier curves."""
    points = [curve[0]]
    for index in range(0, len(curve) - 1, 3):
        (a, b), (c, d), (e, f), (g, h) = curve[index : index + 4]
        points += [(p * a + q * c + r * e + s * g, p * b + q * d + r * f + s * h) for p, q, r, s in _BERNSTEIN]
    return points


class Strokes:
    """Segments that labels must not be crossed by; those that are far away are sorted out together."""

    def __init__(self, segments: Iterable[Segment]) -> None:
        """Note the extents of the segments."""
        self._segments = list(segments)
        ends = np.array(self._segments, dtype=float).reshape(-1, 2, 2)
        self._lowest, self._highest = ends.min(axis=1), ends.max(axis=1)

    def cross(self, box: Box) -> bool:
        """True if any of them is partly within a rectangle."""
        near = (self._highest > (box.left, box.top)) & (self._lowest < (box.right, box.bottom))
        return any(box.is_crossed_by(self._segments[place]) for place in np.flatnonzero(near.all(axis=1)).tolist())


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
    strokes = Strokes([segment for way in ways for segment in pairwise(way)] + list(lines))
    placed: dict[int, Box] = {}
    centres: dict[int, Point] = {}
    crossed = []
    for index, centre in enumerate(wanted):
        if centre is None:
            continue
        box = _roomy(centre, sizes[index])
        if _is_free(box, strokes, nodes, placed.values()) and _is_beside(box, index, ways, lanes):
            placed[index], centres[index] = box, centre
        else:
            crossed.append(index)
    all_free = True
    for index in crossed:
        free = (
            place
            for place in _candidates(ways[index], sizes[index], farthest)
            if _is_free(_roomy(place, sizes[index]), strokes, nodes, placed.values())
            and _is_beside(_roomy(place, sizes[index]), index, ways, lanes)
        )
        found = next(free, None)
        all_free &= found is not None
        first = wanted[index]
        centre = found if found is not None else first
        if centre is not None:
            placed[index], centres[index] = _roomy(centre, sizes[index]), centre
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
        free = (box for box in boxes if not strokes.cross(box))
        found = next(free, None)
        all_free &= found is not None
        placed[name] = boxes[0] if found is None else found
    return placed, all_free


def frame_lines(frames: Iterable[Box]) -> list[Segment]:
    """The outlines of frames."""
    lines: list[Segment] = []
    for box in frames:
        corners = [(box.left, box.top), (box.right, box.top), (box.right, box.bottom), (box.left, box.bottom)]
        lines += pairwise([*corners, corners[0]])
    return lines


def _roomy(centre: Point, size: tuple[float, float]) -> Box:
    return Box.about(centre, (size[0] + _CLEARANCE, size[1] + _CLEARANCE))


def _is_free(box: Box, strokes: Strokes, nodes: Sequence[Box], others: Iterable[Box]) -> bool:
    if box.left < 0 or box.top < 0 or any(box.overlaps(node) for node in nodes):
        return False
    if any(box.overlaps(other) for other in others):
        return False
    return not strokes.cross(box)


def _is_beside(box: Box, index: int, ways: Sequence[Sequence[Point]], lanes: Sequence[Box]) -> bool:
    """Whether a label belongs to its edge: no other edge is nearer, and the edge beside it is in the same lane."""
    if not lanes:
        return True
    apart, (beside, _) = min((box.distance(point), point) for point in ways[index])
    middle = (box.left + box.right) / 2
    if any((lane.left <= middle <= lane.right) != (lane.left <= beside <= lane.right) for lane in lanes):
        return False
    others = (point for place, way in enumerate(ways) if place != index for point in way)
    return all(box.distance(point) >= apart for point in others)


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
