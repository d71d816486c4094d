"""A finished diagram, and the drawing of one that is a graph."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from rgss.reports.diagrams.canvas import Canvas, Point
from rgss.reports.diagrams.graph import Edge, Graph
from rgss.reports.diagrams.labels import Box, frame_lines, place_labels, place_titles, with_stubs
from rgss.reports.diagrams.layout import Layout, label_size, layout
from rgss.reports.diagrams.nodes import Content, content_of, draw_node
from rgss.reports.diagrams.style import FONT, SMALL
from rgss.reports.diagrams.text import text_width, wrapped

_SPACINGS = (1.0, 1.4, 2.0, 3.0)
"""Distances between nodes that are tried, as multiples of the usual ones."""
_NARROW = 110.0
"""Width in pixels of the lines of labels that find no free place otherwise."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawing:
    """A diagram that is drawn.

    Attributes:
        name: Its name in file names and anchors, such as ``states-task``.
        title: What it is called.
        description: What it shows, in a sentence or two.
        text_alternative: What it shows part by part, for those who do not see it; may be empty.
        width: Its width in pixels.
        height: Its height in pixels.
        canvas: Its parts.
    """

    name: str
    title: str
    description: str
    text_alternative: str
    width: float
    height: float
    canvas: Canvas

    def to_svg(self, *, with_style: bool = True) -> str:
        """The diagram as SVG; the same diagram gives the same text.

        Args:
            with_style: Whether the style is in it, as a file needs it. A page has it once for all.
        """
        return self.canvas.document(
            name=self.name,
            title=self.title,
            description=" ".join(part for part in (self.description, self.text_alternative) if part),
            width=self.width,
            height=self.height,
            with_style=with_style,
        )


def draw_graph(graph: Graph, *, name: str, title: str, description: str, text_alternative: str = "") -> Drawing:
    """Place and draw a diagram of nodes and edges.

    Args:
        graph: The diagram.
        name: Its name in file names and anchors.
        title: What it is called.
        description: What it shows.
        text_alternative: What it shows part by part.

    Raises:
        DefinitionError: The package ``pygraphviz`` is not installed.
    """
    contents = {node.id: content_of(node, graph.node_width, rightwards=graph.rightwards) for node in graph.nodes}
    graph, placed = _free_labels(graph, contents)
    canvas = Canvas()
    for cluster in graph.clusters:
        frame = placed.frames[cluster.id]
        canvas.rectangle(frame.x, frame.y, frame.width, frame.height, "shape open", rounding=4)
        canvas.text(placed.titles[cluster.id], frame.y + 1.6 * FONT, cluster.title, "name", anchor="middle")
    for index, edge in enumerate(graph.edges):
        _draw_edge(canvas, edge, placed.curves[index])
    for node in graph.nodes:
        draw_node(canvas, node, contents[node.id], placed.nodes[node.id])
    # Last, so that no line crosses a label.
    for index, edge in enumerate(graph.edges):
        _draw_label(canvas, edge, placed.labels[index])
    width, height = _extent(placed, graph)
    return Drawing(
        name=name,
        title=title,
        description=description,
        text_alternative=text_alternative,
        width=width,
        height=height,
        canvas=canvas,
    )


def _free_labels(graph: Graph, contents: Mapping[str, Content]) -> tuple[Graph, Layout]:
    """The tightest layout whose labels nothing crosses, with their labels as they are or broken; else the widest."""
    for tried in (graph, _with_narrow_labels(graph)):
        for spacing in _SPACINGS:
            placed, all_free = _laid_out(tried, contents, spacing)
            if all_free:
                return tried, placed
    return tried, placed


def _with_narrow_labels(graph: Graph) -> Graph:
    edges = (
        replace(edge, labels=tuple(line for label in edge.labels for line in wrapped(label, _NARROW, SMALL)))
        for edge in graph.edges
    )
    return replace(graph, edges=tuple(edges))


def _laid_out(graph: Graph, contents: Mapping[str, Content], spacing: float) -> tuple[Layout, bool]:
    """A layout, and whether every label and title of it is free."""
    sizes = {name: (content.width, content.height) for name, content in contents.items()}
    placed = layout(graph, sizes, spacing=spacing)
    curves = tuple(
        with_stubs(curve, contents[edge.source].stub, contents[edge.target].stub, rightwards=graph.rightwards)
        for edge, curve in zip(graph.edges, placed.curves, strict=True)
    )
    frames = {
        name: Box(left=frame.x, top=frame.y, right=frame.x + frame.width, bottom=frame.y + frame.height)
        for name, frame in placed.frames.items()
    }
    widths = {cluster.id: text_width(cluster.title, FONT, bold=True) for cluster in graph.clusters}
    titles, titles_free = place_titles(frames, widths, 2 * FONT, curves)
    labels, all_free = place_labels(
        curves,
        placed.labels,
        [label_size(edge) for edge in graph.edges],
        [*(Box.about(placed.nodes[node.id], sizes[node.id]) for node in graph.nodes), *titles.values()],
        frame_lines(frames),
    )
    middles = {name: (title.left + title.right) / 2 for name, title in titles.items()}
    return replace(placed, labels=labels, curves=curves, titles=middles), all_free and titles_free


def _draw_edge(canvas: Canvas, edge: Edge, points: tuple[Point, ...]) -> None:
    with canvas.group(f"{edge.source} → {edge.target} {' '.join(edge.labels)}".strip()):
        canvas.curve(points, "line dashed" if edge.dashed else "line")
        canvas.arrow(points[-1], points[-2], edge.head)


def _draw_label(canvas: Canvas, edge: Edge, centre: Point | None) -> None:
    if centre is not None:
        top = centre[1] - label_size(edge)[1] / 2
        canvas.lines(centre[0], top, edge.labels, SMALL, "label", anchor="middle")


def _extent(placed: Layout, graph: Graph) -> tuple[float, float]:
    """The size of the diagram; labels and heads of arrows may reach beyond what was laid out."""
    width, height = placed.width, placed.height
    for edge, centre in zip(graph.edges, placed.labels, strict=True):
        if centre is not None:
            width = max(width, centre[0] + label_size(edge)[0] / 2 + 4)
            height = max(height, centre[1] + label_size(edge)[1] / 2 + 4)
    return width, height
