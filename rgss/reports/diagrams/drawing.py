"""Finished diagram, and the drawing of a graph."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from rgss.reports.diagrams.canvas import Canvas, Point
from rgss.reports.diagrams.crossings import edges_are_clear
from rgss.reports.diagrams.frame import ORIGIN, Heading
from rgss.reports.diagrams.graph import Edge, Graph, Shape
from rgss.reports.diagrams.labels import (
    FAR,
    FARTHEST,
    NEAR,
    Box,
    flattened,
    frame_lines,
    place_labels,
    place_titles,
    with_stubs,
)
from rgss.reports.diagrams.lanes import draw_lanes, lane_borders, lane_headers, widened
from rgss.reports.diagrams.layout import Layout, label_size, layout, require_graphviz
from rgss.reports.diagrams.nodes import Content, content_of, draw_node
from rgss.reports.diagrams.ports import draw_frame_port
from rgss.reports.diagrams.style import FONT, SMALL
from rgss.reports.diagrams.text import text_width, wrapped

_SPACINGS = (1.0, 1.4, 2.0, 3.0)
"""Distances between nodes that are tried, as multiples of the usual ones."""
_MARGIN = 14.0
_SHORT = 4.5
_NARROW = 110.0
"""Width in pixels of the lines of labels that find no free place otherwise."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawing:
    """Finished diagram.

    Attributes:
        name: Its name in file names and anchors, such as ``states-task``.
        title: Its title.
        description: Its content, in a sentence or two.
        text_alternative: Its content part by part, for those who do not see it; may be empty.
        heading: The header of its frame.
        inner: Width and height of what is within the frame, in pixels.
        canvas: What is within the frame, drawn from the frame's origin on.
    """

    name: str
    title: str
    description: str
    text_alternative: str
    heading: Heading
    inner: Point
    canvas: Canvas

    @property
    def width(self) -> float:
        """Its width in pixels."""
        return self.heading.size(*self.inner)[0]

    @property
    def height(self) -> float:
        """Its height in pixels."""
        return self.heading.size(*self.inner)[1]

    def to_svg(self, *, with_style: bool = True) -> str:
        """The diagram as SVG; the same diagram gives the same text.

        Args:
            with_style: True to include the style sheet, as a file needs it; a page has it once.
        """
        return self.canvas.document(
            name=self.name,
            title=self.title,
            description=" ".join(part for part in (self.description, self.text_alternative) if part),
            size=(self.width, self.height),
            with_style=with_style,
            behind=self.heading.draw((self.width, self.height)),
        )


def draw_graph(
    graph: Graph, *, heading: Heading, name: str, title: str, description: str, text_alternative: str = ""
) -> Drawing:
    """Lay out and draw a diagram of nodes and edges.

    Args:
        graph: The diagram.
        heading: The header of its frame.
        name: Its name in file names and anchors.
        title: Its title.
        description: Its content, in a sentence or two.
        text_alternative: Its content part by part.

    Raises:
        DefinitionError: The package ``pygraphviz`` is not installed.
    """
    # A layout that was made before would be drawn without the package, unlike the others of a page.
    require_graphviz()
    contents = _contents(graph)
    graph, placed = _free_labels(graph)
    canvas = Canvas(ORIGIN)
    if graph.lanes:
        draw_lanes(canvas, graph.lanes, placed.lanes)
    for cluster in graph.clusters:
        frame = placed.frames[cluster.id]
        width, height = frame.right - frame.left, frame.bottom - frame.top
        canvas.rectangle(frame.left, frame.top, width, height, "shape open", rounding=4)
        canvas.text(placed.titles[cluster.id], frame.top + 1.6 * FONT, cluster.title, "name", anchor="middle")
    for index, edge in enumerate(graph.edges):
        _draw_edge(canvas, edge, placed.curves[index])
    for node in graph.nodes:
        draw_node(canvas, node, contents[node.id], placed.nodes[node.id])
    # Last, so that no line crosses a label.
    for index, edge in enumerate(graph.edges):
        _draw_label(canvas, edge, placed.labels[index])
    inner = _extent(placed, graph)
    for node in graph.nodes:
        if node.shape is Shape.FREE:
            size = (contents[node.id].width, contents[node.id].height)
            draw_frame_port(canvas, node, size, placed.nodes[node.id], heading.inner_width(inner[0]))
    return Drawing(
        name=name,
        title=title,
        description=description,
        text_alternative=text_alternative,
        heading=heading,
        inner=inner,
        canvas=canvas,
    )


def _contents(graph: Graph) -> dict[str, Content]:
    return {node.id: content_of(node, graph.node_width, rightwards=graph.rightwards) for node in graph.nodes}


@lru_cache(maxsize=256)
def _free_labels(graph: Graph) -> tuple[Graph, Layout]:
    """The tightest layout whose labels nothing crosses, near their edges if they can be; else the widest.

    One in which edges run through no node is preferred. At each spacing the labels are tried as they
    are, then broken into short lines.
    """
    narrow = _with_narrow_labels(graph)
    attempts = _Attempts(_contents(graph))
    readable: tuple[Graph, Layout] | None = None
    far = _SPACINGS if graph.lanes else _SPACINGS[:2]
    for farthest, spacings in ((NEAR, _SPACINGS[:2]), (FAR, far), (FARTHEST, _SPACINGS)):
        for spacing in spacings:
            # Short lines also find a place in the layout for the long ones, whose edges may be clearer.
            ways = ((graph, graph), (narrow, narrow), *([(graph, narrow)] if graph.lanes else []))
            for laid_out, tried in dict.fromkeys(ways):
                placed, labels_free, edges_clear = attempts.placed(tried, laid_out, spacing, farthest)
                if labels_free and edges_clear:
                    return tried, placed
                readable = readable or ((tried, placed) if labels_free else None)
    if graph.lanes:
        # Curves between ranks that lanes push apart may run through nodes.
        for spacing in _SPACINGS:
            placed, labels_free, edges_clear = attempts.placed(narrow, narrow, spacing, FAR, orthogonal=True)
            if labels_free and edges_clear:
                return narrow, placed
    return readable or (tried, placed)


def _with_narrow_labels(graph: Graph) -> Graph:
    edges = (
        replace(edge, labels=tuple(line for label in edge.labels for line in wrapped(label, _NARROW, SMALL)))
        for edge in graph.edges
    )
    return replace(graph, edges=tuple(edges))


class _Attempts:
    """Placements of the labels of a diagram in its layouts, each of which Graphviz makes once."""

    def __init__(self, contents: Mapping[str, Content]) -> None:
        self._contents = contents
        self._sizes = {name: (content.width, content.height) for name, content in contents.items()}
        self._layouts: dict[tuple[Graph, float, bool], Layout] = {}

    def placed(
        self, graph: Graph, laid_out: Graph, spacing: float, farthest: float, *, orthogonal: bool = False
    ) -> tuple[Layout, bool, bool]:
        """A layout, whether every label and title of it is free, and whether its edges run through no node.

        Args:
            graph: The diagram.
            laid_out: The same diagram with the lines of labels for which room is kept.
            spacing: Multiple of the usual distances between nodes.
            farthest: Largest distance of a label from its edge, in pixels.
            orthogonal: Edges are upright and level lines.
        """
        placed, sizes = self._layout(laid_out, spacing, orthogonal=orthogonal), self._sizes
        titles, titles_free = place_titles(
            placed.frames,
            {cluster.id: text_width(cluster.title, FONT, bold=True) for cluster in graph.clusters},
            2 * FONT,
            placed.curves,
        )
        labels, all_free = place_labels(
            placed.curves,
            placed.labels,
            [label_size(edge) for edge in graph.edges],
            [
                *(Box.about(placed.nodes[node.id], sizes[node.id]) for node in graph.nodes),
                *titles.values(),
                *lane_headers(graph.lanes, placed.lanes),
            ],
            [*frame_lines(placed.frames.values()), *lane_borders(placed.lanes)],
            farthest=farthest,
            # A label far from its edge, in a dense diagram, is better than one that a line crosses.
            lanes=() if orthogonal or farthest >= FARTHEST else tuple(placed.lanes.values()),
        )
        middles = {name: (title.left + title.right) / 2 for name, title in titles.items()}
        lanes = widened(placed.lanes, _ends(placed.curves, labels, graph)) if placed.lanes else placed.lanes
        is_clear = edges_are_clear(graph, placed.curves, placed.nodes, sizes)
        return replace(placed, labels=labels, titles=middles, lanes=lanes), all_free and titles_free, is_clear

    def _layout(self, graph: Graph, spacing: float, *, orthogonal: bool) -> Layout:
        """The layout by Graphviz, with edges that reach the symbols within the nodes."""
        key = (graph, spacing, orthogonal)
        if key not in self._layouts:
            placed = layout(graph, self._sizes, spacing=spacing, orthogonal=orthogonal)
            curves = tuple(
                with_stubs(
                    curve,
                    self._contents[edge.source].stub,
                    self._contents[edge.target].stub,
                    rightwards=graph.rightwards,
                )
                for edge, curve in zip(graph.edges, placed.curves, strict=True)
            )
            self._layouts[key] = replace(placed, curves=curves)
        return self._layouts[key]


def _ends(
    curves: Sequence[Sequence[Point]], labels: Sequence[Point | None], graph: Graph
) -> Iterator[tuple[float, float]]:
    """The left and right end of every edge and label."""
    for curve in curves:
        xs = [x for x, _ in flattened(curve)]
        yield min(xs), max(xs)
    for edge, centre in zip(graph.edges, labels, strict=True):
        if centre is not None:
            half = label_size(edge)[0] / 2
            yield centre[0] - half, centre[0] + half


def _draw_edge(canvas: Canvas, edge: Edge, points: tuple[Point, ...]) -> None:
    with canvas.group(f"{edge.source} → {edge.target} {' '.join(edge.labels)}".strip()):
        canvas.curve(points, "line dashed" if edge.dashed else "line")
        canvas.arrow(points[-1], _behind(points), edge.head)
        if edge.flows:
            way = flattened(points)
            middle = len(way) // 2
            canvas.arrow(way[middle], way[middle - 1], "filled")


def _behind(points: tuple[Point, ...]) -> Point:
    """Point from which an edge comes, as its head shows it; a last piece shorter than half a head has no direction."""
    tip = points[-1]
    if math.dist(tip, points[-2]) >= _SHORT:
        return points[-2]
    far = (point for point in reversed(flattened(points)) if math.dist(tip, point) >= _SHORT)
    return next(far, points[0])


def _draw_label(canvas: Canvas, edge: Edge, centre: Point | None) -> None:
    if centre is not None:
        top = centre[1] - label_size(edge)[1] / 2
        canvas.lines(centre[0], top, edge.labels, SMALL, "label", anchor="middle")


def _extent(placed: Layout, graph: Graph) -> tuple[float, float]:
    """The size of the diagram; labels and arrow heads may extend beyond the layout."""
    width, height = placed.width, placed.height
    for edge, centre in zip(graph.edges, placed.labels, strict=True):
        if centre is not None:
            width = max(width, centre[0] + label_size(edge)[0] / 2 + 4)
            height = max(height, centre[1] + label_size(edge)[1] / 2 + 4)
    for lane in placed.lanes.values():
        width = max(width, lane.right + _MARGIN)
    return width, height
