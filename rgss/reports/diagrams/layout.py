"""Layout of the nodes and edges of a diagram, by Graphviz.

Graphviz gets sizes and links, and never a text: the layout does not depend on fonts, and no text of
a requirement reaches Graphviz. The same diagram has the same layout on every machine with the
same release of Graphviz, which the package pygraphviz contains.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from rgss.errors import DefinitionError
from rgss.reports.diagrams.canvas import Point
from rgss.reports.diagrams.graph import Edge, Graph, Shape
from rgss.reports.diagrams.labels import Box
from rgss.reports.diagrams.lanes import add_lanes, is_mirrored, read_lanes
from rgss.reports.diagrams.ports import port_of, table_of_ports
from rgss.reports.diagrams.style import FONT, LINE, SMALL
from rgss.reports.diagrams.text import text_width

Size = tuple[float, float]
"""Width and height in pixels."""

_POINTS_PER_INCH = 72.0
_MARGIN = 14.0
_ROUND = (Shape.INITIAL, Shape.FINAL)
_SHAPES = {Shape.ELLIPSE: "ellipse", Shape.DIAMOND: "diamond", Shape.INITIAL: "circle", Shape.FINAL: "circle"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Positions in a diagram, in pixels from the upper left corner.

    Attributes:
        width: Width of the diagram.
        height: Height of the diagram.
        nodes: The centre of each node, by its id.
        curves: For each edge, the points of its Bézier curves from source to target.
        labels: For each edge, the centre of its labels; None without one.
        frames: Position and size of each cluster, by its id.
        lanes: Where each lane is, by its id.
        titles: The middle of each cluster's title, by its id.
    """

    width: float
    height: float
    nodes: Mapping[str, Point]
    curves: tuple[tuple[Point, ...], ...]
    labels: tuple[Point | None, ...]
    frames: Mapping[str, Box]
    lanes: Mapping[str, Box] = field(default_factory=dict)
    titles: Mapping[str, float] = field(default_factory=dict)


def require_graphviz() -> None:
    """Check that Graphviz is available.

    Raises:
        DefinitionError: The package ``pygraphviz`` is not installed.
    """
    try:
        import pygraphviz  # noqa: F401
    except ImportError as error:
        raise DefinitionError(
            "diagrams need the package pygraphviz, which is not installed", hint="pip install 'pygraphviz>=2.0'"
        ) from error


def layout(graph: Graph, sizes: Mapping[str, Size], *, spacing: float = 1.0, orthogonal: bool = False) -> Layout:
    """Lay out a diagram.

    Args:
        graph: The diagram.
        sizes: Width and height of each node in pixels, by its id.
        spacing: Multiple of the usual distances between nodes.
        orthogonal: Edges are upright and level lines, with no room kept for their labels, whose centres
            are then the middles of the edges.

    Raises:
        DefinitionError: The package ``pygraphviz`` is not installed.
    """
    require_graphviz()
    import pygraphviz

    drawn = pygraphviz.AGraph(strict=False, directed=True)
    drawn.graph_attr.update(
        rankdir="LR" if graph.rightwards else "TB",
        nodesep=f"{0.3 * spacing:.2f}",
        ranksep=f"{0.5 * spacing:.2f}",
        splines="ortho" if orthogonal else "true",
        margin="0",
    )
    drawn.node_attr.update(shape="box", fixedsize="true", label="", margin="0")
    drawn.edge_attr.update(arrowhead="none", arrowtail="none")
    names = {node.id: f"n{index}" for index, node in enumerate(graph.nodes)}
    for node in graph.nodes:
        width, height = sizes[node.id]
        if node.ports:
            drawn.add_node(
                names[node.id], shape="plain", fixedsize="false", label=table_of_ports(node, (width, height))
            )
            continue
        drawn.add_node(
            names[node.id],
            # With a text above or below it, a circle needs a rectangular node.
            shape="box" if node.name and node.shape in _ROUND else _SHAPES.get(node.shape, "box"),
            width=f"{width / _POINTS_PER_INCH:.4f}",
            height=f"{height / _POINTS_PER_INCH:.4f}",
        )
    for index, cluster in enumerate(graph.clusters):
        within = [names[node.id] for node in graph.nodes if node.cluster == cluster.id]
        title = _blank(text_width(cluster.title, FONT, bold=True) + 16, LINE * FONT + 4)
        drawn.add_subgraph(within, name=f"cluster_{index}", label=title, margin="14")
    for rank in ("min", "max"):
        ranked = [names[node.id] for node in graph.nodes if node.rank == rank]
        if ranked:
            drawn.add_subgraph(ranked, name=f"rank_{rank}", rank="source" if rank == "min" else "sink")
    if graph.lanes:
        add_lanes(drawn, graph, names)
    edges = [_add_edge(drawn, names, graph, index, with_label=not orthogonal) for index in range(len(graph.edges))]
    drawn.layout(prog="dot")
    return _read(drawn, graph, names, edges)


def label_size(edge: Edge) -> Size:
    """Width and height of the labels of an edge, in pixels."""
    width = max((text_width(label, SMALL) for label in edge.labels), default=0.0)
    return width + 6, LINE * SMALL * len(edge.labels) + 2


def _add_edge(drawn: Any, names: Mapping[str, str], graph: Graph, index: int, *, with_label: bool) -> Any:
    edge, rightwards = graph.edges[index], graph.rightwards
    nodes = {node.id: node for node in graph.nodes}
    source, target = names[edge.source], names[edge.target]
    attributes = {"label": _blank(*label_size(edge))} if edge.labels and with_label else {}
    first, last = nodes[edge.source], nodes[edge.target]
    # The text beside a small shape leaves two sides of it free.
    if first.name and first.shape in (Shape.INITIAL, Shape.BAR):
        attributes["headport" if edge.backwards else "tailport"] = "e" if rightwards else "s"
    if last.name and last.shape in (Shape.FINAL, Shape.BAR):
        attributes["tailport" if edge.backwards else "headport"] = "w" if rightwards else "n"
    for end, node, port in (("tailport", first, edge.source_port), ("headport", last, edge.target_port)):
        if port:
            attributes[end] = port_of(node, port)
    if edge.straight:
        attributes["weight"] = "20"
    if edge.backwards:
        source, target = target, source
    drawn.add_edge(source, target, key=f"e{index}", **attributes)
    return drawn.get_edge(source, target, key=f"e{index}")


def _blank(width: float, height: float) -> str:
    """Empty label that reserves the room of a text."""
    cell = f'<TD FIXEDSIZE="TRUE" WIDTH="{width:.0f}" HEIGHT="{height:.0f}"></TD>'
    return f'<<TABLE BORDER="0" CELLBORDER="0" CELLPADDING="0" CELLSPACING="0"><TR>{cell}</TR></TABLE>>'


def _read(drawn: Any, graph: Graph, names: Mapping[str, str], edges: Sequence[Any]) -> Layout:
    left, bottom, right, top = _floats(drawn.graph_attr["bb"])

    mirrored = bool(graph.lanes) and is_mirrored(drawn, graph)

    def corner(x: float, y: float) -> Point:
        return (right - x if mirrored else x - left) + _MARGIN, top - y + _MARGIN

    def place(text: str) -> Point:
        x, y = _floats(text)
        return corner(x, y)

    frames = {}
    for index, cluster in enumerate(graph.clusters):
        x, low, end, high = _floats(drawn.get_subgraph(f"cluster_{index}").graph_attr["bb"])
        (near, upper), (far, lower) = corner(x, high), corner(end, low)
        frames[cluster.id] = Box(left=near, top=upper, right=far, bottom=lower)
    curves = []
    for edge, made in zip(graph.edges, edges, strict=True):
        points = [place(point) for point in made.attr["pos"].split() if point[0] not in "se"]
        curves.append(tuple(reversed(points) if edge.backwards else points))
    return Layout(
        width=right - left + 2 * _MARGIN,
        height=top - bottom + 2 * _MARGIN,
        nodes={node.id: place(drawn.get_node(names[node.id]).attr["pos"]) for node in graph.nodes},
        curves=tuple(curves),
        labels=tuple(
            (place(made.attr["lp"]) if made.attr["lp"] else curve[len(curve) // 2]) if edge.labels else None
            for edge, made, curve in zip(graph.edges, edges, curves, strict=True)
        ),
        frames=frames,
        lanes=read_lanes(drawn, graph, corner, curves) if graph.lanes else {},
    )


def _floats(text: str) -> list[float]:
    return [float(part) for part in text.split(",")]
