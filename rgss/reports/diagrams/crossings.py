"""Edges that run through a node at which they do not end."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rgss.reports.diagrams.canvas import Point
from rgss.reports.diagrams.graph import Graph, Node, Shape
from rgss.reports.diagrams.labels import flattened

_CLEARANCE = 3.0
"""Distance in pixels within which an edge seems to touch a node."""


def edges_are_clear(
    graph: Graph,
    curves: Sequence[Sequence[Point]],
    centres: Mapping[str, Point],
    sizes: Mapping[str, tuple[float, float]],
) -> bool:
    """True if no edge runs through a node at which it does not end.

    Args:
        graph: The diagram.
        curves: The points of the Bézier curves of each edge.
        centres: The centre of each node.
        sizes: Width and height of each node.
    """
    for edge, curve in zip(graph.edges, curves, strict=True):
        way = flattened(curve)
        lowest, highest = (tuple(map(end, zip(*way, strict=True))) for end in (min, max))
        for node in graph.nodes:
            if node.id in (edge.source, edge.target):
                continue
            centre, size = centres[node.id], sizes[node.id]
            # Most nodes are far away.
            reach = [max(one / 2 + _CLEARANCE, 1.0) + _CLEARANCE for one in size]
            if any(
                highest[axis] < centre[axis] - reach[axis] or lowest[axis] > centre[axis] + reach[axis]
                for axis in (0, 1)
            ):
                continue
            if any(_is_within(point, node, centre, size) for point in way):
                return False
    return True


def _is_within(point: Point, node: Node, centre: Point, size: tuple[float, float]) -> bool:
    across = abs(point[0] - centre[0]) / max(size[0] / 2 + _CLEARANCE, 1.0)
    down = abs(point[1] - centre[1]) / max(size[1] / 2 + _CLEARANCE, 1.0)
    if node.shape is Shape.DIAMOND:
        return across + down < 1
    if node.shape is Shape.ELLIPSE:
        return across**2 + down**2 < 1
    return max(across, down) < 1
