"""Lanes of an activity diagram: columns, one for each performer, that share their upper and lower edge."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from rgss.reports.diagrams.canvas import Canvas, Point
from rgss.reports.diagrams.graph import Cluster, Graph
from rgss.reports.diagrams.labels import Box, Segment, flattened
from rgss.reports.diagrams.style import FONT, LINE, SMALL
from rgss.reports.diagrams.text import text_width, wrapped

_TITLE_WIDTH = 170.0
_PAD = 8.0
_MARGIN = 12.0
_POINTS_PER_INCH = 72.0


def title_lines(lane: Cluster) -> tuple[str, ...]:
    """The title of a lane, broken into lines."""
    return wrapped(lane.title, _TITLE_WIDTH, FONT, bold=True)


def header_height(lanes: tuple[Cluster, ...]) -> float:
    """Height of the row of titles, in pixels: a stereotype and the longest title."""
    return LINE * (SMALL + FONT * max(len(title_lines(lane)) for lane in lanes)) + 2 * _PAD


def add_lanes(drawn: Any, graph: Graph, names: Mapping[str, str]) -> None:
    """Add the lanes to a layout by Graphviz.

    Each lane is a cluster from a head on the first rank to a foot on the last. Clusters do not
    overlap, so that they stand side by side, in the order in which the fewest edges cross.

    Args:
        drawn: The layout, with all its nodes.
        graph: The diagram.
        names: The name of each node in the layout, by its id.
    """
    drawn.graph_attr["newrank"] = "true"
    height = header_height(graph.lanes)
    for index, lane in enumerate(graph.lanes):
        width = max(text_width(line, FONT, bold=True) for line in title_lines(lane)) + 2 * _PAD
        size = {"width": f"{width / _POINTS_PER_INCH:.4f}", "height": f"{height / _POINTS_PER_INCH:.4f}"}
        drawn.add_node(f"head{index}", **size)
        drawn.add_node(f"foot{index}", width="0.01", height="0.01")
        within = [names[node.id] for node in graph.nodes if node.cluster == lane.id]
        drawn.add_subgraph([f"head{index}", *within, f"foot{index}"], name=f"cluster_{index}", margin=f"{_MARGIN:.0f}")
    count = range(len(graph.lanes))
    for end, rank in (("head", "min"), ("foot", "max")):
        drawn.add_subgraph([f"{end}{index}" for index in count], name=f"{end}s", rank=rank)
    reached, left = {edge.target for edge in graph.edges}, {edge.source for edge in graph.edges}
    lane_of = {lane.id: index for index, lane in enumerate(graph.lanes)}
    for node in graph.nodes:
        lane_index = lane_of[node.cluster]
        if node.id not in reached:
            drawn.add_edge(f"head{lane_index}", names[node.id], key=f"h{node.id}", style="invis", weight="0")
        if node.id not in left:
            drawn.add_edge(names[node.id], f"foot{lane_index}", key=f"f{node.id}", style="invis", weight="0")


def is_mirrored(drawn: Any, graph: Graph) -> bool:
    """True if the lane of the first node is nearer to the right edge; the reader begins at the left."""
    first = next(index for index, lane in enumerate(graph.lanes) if lane.id == graph.nodes[0].cluster)
    left, _, right, _ = _bounds(drawn.graph_attr["bb"])
    x, _, end, _ = _bounds(drawn.get_subgraph(f"cluster_{first}").graph_attr["bb"])
    return x + end > left + right


def read_lanes(
    drawn: Any, graph: Graph, corner: Callable[[float, float], Point], curves: Sequence[Sequence[Point]]
) -> dict[str, Box]:
    """The lanes of a finished layout, each as wide as leaves no gap to its neighbours.

    Args:
        drawn: The layout.
        graph: The diagram.
        corner: From a place in Graphviz's points to one in pixels from the upper left corner.
        curves: The edges, of which none should run along a border.
    """
    boxes: dict[str, Box] = {}
    for index, lane in enumerate(graph.lanes):
        x, low, end, high = _bounds(drawn.get_subgraph(f"cluster_{index}").graph_attr["bb"])
        (one, top), (other, bottom) = corner(x, high), corner(end, low)
        boxes[lane.id] = Box(left=min(one, other), top=top, right=max(one, other), bottom=bottom)
    names = sorted(boxes, key=lambda name: boxes[name].left)
    upright = [
        (x, u) for way in map(flattened, curves) for (x, y), (u, v) in pairwise(way) if abs(x - u) < 0.5 * abs(y - v)
    ]
    inner = [_border(boxes[one].right, boxes[other].left, upright) for one, other in pairwise(names)]
    borders = [boxes[names[0]].left, *inner, boxes[names[-1]].right]
    top, bottom = min(box.top for box in boxes.values()), max(box.bottom for box in boxes.values())
    return {
        name: Box(left=left, top=top, right=right, bottom=bottom)
        for name, (left, right) in zip(names, pairwise(borders), strict=True)
    }


def _border(left: float, right: float, upright: Sequence[tuple[float, float]]) -> float:
    """The place between two lanes, or in the margin of one, that is farthest from upright pieces of edges, up to 12."""
    middle = (left + right) / 2
    reach = (right - left) / 2 + _MARGIN - 4
    places = sorted((middle + reach * step / 8 for step in range(-8, 9)), key=lambda x: abs(x - middle))

    room = np.abs(np.array(places)[:, None] - np.array(upright).reshape(-1)).min(axis=1, initial=12.0)
    return places[int(np.argmax(room))]


def _bounds(text: str) -> tuple[float, ...]:
    return tuple(float(part) for part in text.split(","))


def lane_headers(lanes: tuple[Cluster, ...], boxes: Mapping[str, Box]) -> list[Box]:
    """The rectangles of the titles."""
    height = header_height(lanes) + _MARGIN if lanes else 0.0
    return [replace(box, bottom=box.top + height) for box in boxes.values()]


def lane_borders(boxes: Mapping[str, Box]) -> list[Segment]:
    """The lines between neighbouring lanes."""
    inner = sorted(box.right for box in boxes.values())[:-1]
    return [((x, box.top), (x, box.bottom)) for box in list(boxes.values())[:1] for x in inner]


def widened(boxes: Mapping[str, Box], ends: Iterable[tuple[float, float]]) -> dict[str, Box]:
    """The lanes with the outer ones so wide that everything is in a lane.

    Args:
        boxes: The lanes.
        ends: The left and right end of everything.
    """
    extents = list(ends)
    first = min(boxes, key=lambda name: boxes[name].left)
    last = max(boxes, key=lambda name: boxes[name].right)
    wide = dict(boxes)
    wide[first] = replace(wide[first], left=min([wide[first].left, *(left - 6 for left, _ in extents)]))
    wide[last] = replace(wide[last], right=max([wide[last].right, *(right + 6 for _, right in extents)]))
    return wide


def draw_lanes(canvas: Canvas, lanes: tuple[Cluster, ...], boxes: Mapping[str, Box]) -> None:
    """Draw the lanes with their titles; a title says that what is in the lane is allocated to the block."""
    height = header_height(lanes) + _MARGIN
    for lane in lanes:
        box = boxes[lane.id]
        canvas.rectangle(box.left, box.top, box.right - box.left, box.bottom - box.top, "shape open")
        with canvas.group(f"Lane of {lane.title} ({lane.id})"):
            canvas.rectangle(box.left, box.top, box.right - box.left, height, "shape")
            middle = (box.left + box.right) / 2
            lines = title_lines(lane)
            y = box.top + (height - LINE * (SMALL + FONT * len(lines))) / 2
            y = canvas.lines(middle, y, ["«allocate»"], SMALL, "soft", anchor="middle")
            canvas.lines(middle, y, lines, FONT, "name", anchor="middle")
