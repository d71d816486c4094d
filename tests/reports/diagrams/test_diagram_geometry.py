"""Legibility of diagrams by their geometry: sizes of texts, and texts that a line or another text crosses."""

from __future__ import annotations

import random
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from rgss.reports.diagrams.diagrams import diagrams_of
from rgss.reports.diagrams.drawing import draw_graph
from rgss.reports.diagrams.frame import Heading
from rgss.reports.diagrams.graph import Cluster, Edge, Graph, Node, Shape
from rgss.reports.diagrams.sequence import sequence_diagram
from rgss.reports.diagrams.style import STYLE
from rgss.requirements import Behaviour, BehaviourKind, load_requirements
from rgss.requirements.behaviour import Interaction, Message, TimingConstraint
from tests.fixtures.diagram_geometry import SVG, crossings, font_sizes, text_boxes

ROOT = Path(__file__).parents[3]
LEAST_SIZE = 12.0
HEADING = Heading(kind="act", element="Activity", subject="Made")
WORDS = (
    "move",
    "grasp",
    "the object",
    "is held firmly?",
    "within the time limit",
    "Küchenhöhe",
    "ACT-detect-collisions",
)


def drawn(parts: str) -> str:
    return f'<svg xmlns="http://www.w3.org/2000/svg">{parts}</svg>'


@pytest.mark.parametrize(
    ("stroke", "is_crossing"),
    [
        ('<path d="M0 48 L200 48"/>', True),
        ('<path d="M0 20 L200 80"/>', True),
        ('<path d="M0 30 C60 30 60 70 200 70"/>', True),
        ('<polygon points="0,48 200,48 100,300"/>', True),
        ('<rect x="60" y="10" width="300" height="200"/>', True),
        ('<ellipse cx="50" cy="48" rx="8" ry="8"/>', True),
        ('<text x="55" y="52">word</text>', True),
        ('<path d="M0 54 L200 54"/>', False),
        ('<path d="M0 30 L30 60"/>', False),
        ('<rect x="40" y="30" width="100" height="30"/>', False),
        ('<text x="50" y="70">word</text>', False),
        ('<rect class="paper" x="55" width="300" height="200"/>', False),
    ],
)
def test_the_oracle_finds_what_crosses_a_text(stroke, is_crossing):
    found = crossings(drawn(f'<text x="50" y="50">word</text>{stroke}'), STYLE)

    assert bool(found) is is_crossing


def test_no_text_of_the_shipped_models_is_small_or_crossed():
    for folder in ("requirements", "requirements/yumi", "requirements/lite6"):
        for drawing in diagrams_of(load_requirements(ROOT / folder)):
            svg = drawing.to_svg()
            assert crossings(svg, STYLE) == [], drawing.name
            assert min(box.size for box in text_boxes(svg, STYLE)) >= LEAST_SIZE, drawing.name


def test_no_rule_of_the_style_makes_a_text_smaller():
    assert min(font_sizes(STYLE).values()) >= LEAST_SIZE


@pytest.mark.parametrize("seed", range(12))
def test_no_text_of_a_generated_graph_is_crossed(seed):
    """Graphs of 3 to 30 nodes, denser and with longer labels than any of a shipped model."""
    chosen = random.Random(seed)  # noqa: S311 - a made model
    graph = made_graph(chosen, chosen.choice((3, 6, 10, 16, 22, 30)), rightwards=seed % 2 == 0, framed=seed % 3 == 0)
    drawing = draw_graph(graph, heading=HEADING, name="made", title="Made", description="")

    assert crossings(drawing.to_svg(), STYLE) == []
    for box in text_boxes(drawing.to_svg(), STYLE):
        assert box.left >= 0
        assert box.right <= drawing.width
        assert box.bottom <= drawing.height


@pytest.mark.parametrize("seed", [*range(12), 24, 52])
def test_no_text_of_a_generated_flow_is_crossed(seed):
    """The same graphs with initial nodes, final nodes and bars, of which most have a text."""
    chosen = random.Random(seed)  # noqa: S311 - a made model
    count = chosen.choice((3, 6, 10, 16, 22, 30))
    graph = with_small_shapes(made_graph(chosen, count, rightwards=seed % 2 == 0, framed=seed % 3 == 0), chosen)
    drawing = draw_graph(graph, heading=HEADING, name="made", title="Made", description="")

    assert {Shape.INITIAL, Shape.FINAL} & {node.shape for node in graph.nodes}
    assert crossings(drawing.to_svg(), STYLE) == []


@pytest.mark.parametrize("rightwards", [False, True])
def test_edges_reach_the_symbol_beside_its_text(rightwards):
    """Not only the border of the room that symbol and text take together."""
    shapes = {"a": Shape.INITIAL, "b": Shape.BAR, "c": Shape.FINAL}
    nodes = tuple(Node(id=name, shape=shape, name=some_words(random.Random(3), 9)) for name, shape in shapes.items())  # noqa: S311 - a made model
    edges = (Edge(source="a", target="b", head=""), Edge(source="b", target="c", head=""))
    graph = Graph(nodes=nodes, edges=edges, rightwards=rightwards, node_width=90.0)
    svg = draw_graph(graph, heading=HEADING, name="made", title="Made", description="").to_svg()

    root = ET.fromstring(svg)  # noqa: S314 - our own
    (bar,) = (box for box in root.iter(f"{SVG}rect") if box.get("class") == "solid")
    left, top, width, height = (float(bar.get(key)) for key in ("x", "y", "width", "height"))
    first, second = (path.get("d") for path in root.iter(f"{SVG}path"))
    arrival = [float(number) for number in first.replace("C", " ").split()[-2:]]
    departure = [float(number) for number in second.removeprefix("M").replace("C", " ").split()[:2]]
    near, far = (
        ((left, top + height / 2), (left + width, top + height / 2))
        if rightwards
        else ((left + width / 2, top), (left + width / 2, top + height))
    )
    assert arrival == pytest.approx(near, abs=0.3)
    assert departure == pytest.approx(far, abs=0.3)


@pytest.mark.parametrize("seed", range(24))
def test_no_text_of_a_generated_sequence_is_crossed(seed):
    chosen = random.Random(seed)  # noqa: S311 - a made model
    lifelines = tuple(f"BLK-{index}" for index in range(chosen.randint(2, 7)))
    messages = tuple(
        Message(
            id=f"m{index}",
            source=chosen.choice(lifelines),
            target=chosen.choice(lifelines),
            text=some_words(chosen, 9),
            does=chosen.choice((None, "ACT-detect-collisions")),
            reply=chosen.random() < 0.3,
        )
        for index in range(chosen.randint(1, 20))
    )
    ends = [sorted(chosen.sample(range(len(messages)), 2)) for _ in range(chosen.randint(0, 4)) if len(messages) > 1]
    timings = tuple(
        TimingConstraint(first=f"m{a}", last=f"m{b}", criterion_of="SYS-001", text=some_words(chosen, 8))
        for a, b in ends
    )
    behaviour = Behaviour(
        id="SEQ-made",
        name="Made",
        kind=BehaviourKind.SEQUENCE,
        text="Made.",
        interaction=Interaction(lifelines=lifelines, messages=messages, timings=timings),
    )
    drawing = sequence_diagram(behaviour, {"BLK-0": "A name that takes more than one line"}, {"SYS-001": "t <= 4 s"})

    assert crossings(drawing.to_svg(), STYLE) == []
    assert all(box.right <= drawing.width for box in text_boxes(drawing.to_svg(), STYLE))


def some_words(chosen: random.Random, most: int) -> str:
    return " ".join(chosen.choice(WORDS) for _ in range(chosen.randint(1, most)))


def made_graph(chosen: random.Random, count: int, *, rightwards: bool, framed: bool) -> Graph:
    """A path through all nodes, with as many further edges as 4 in 10 nodes, any way round."""
    shapes = (Shape.BOX, Shape.ROUND, Shape.DIAMOND, Shape.ELLIPSE)
    nodes = [
        Node(
            id=f"n{index}",
            shape=chosen.choice(shapes),
            name=some_words(chosen, 6),
            texts=("calls ACT-move",) * chosen.randint(0, 1),
            cluster="c" if framed and index < count // 2 else "",
        )
        for index in range(count)
    ]
    ends = [(index, index + 1) for index in range(count - 1)]
    ends += [tuple(chosen.sample(range(count), 2)) for _ in range(int(0.4 * count))]
    edges = [
        Edge(
            source=f"n{first}",
            target=f"n{second}",
            backwards=chosen.random() < 0.2,
            labels=tuple(chosen.choice(("[yes]", "«verify»", "[not within the time limit]")) for _ in range(lines)),
        )
        for first, second in ends
        for lines in (chosen.randint(0, 2),)
    ]
    clusters = (Cluster(id="c", title="System of interest"),) if framed else ()
    return Graph(nodes=tuple(nodes), edges=tuple(edges), clusters=clusters, rightwards=rightwards)


def with_small_shapes(graph: Graph, chosen: random.Random) -> Graph:
    """The graph with its sources as initial nodes, its sinks as final ones, and bars between them."""
    reached, left = {edge.target for edge in graph.edges}, {edge.source for edge in graph.edges}
    nodes = []
    for node in graph.nodes:
        shape = Shape.BAR if chosen.random() < 0.35 else node.shape
        shape = Shape.INITIAL if node.id not in reached else Shape.FINAL if node.id not in left else shape
        small = shape in (Shape.INITIAL, Shape.FINAL, Shape.BAR)
        name = "" if small and chosen.random() < 0.2 else node.name
        nodes.append(replace(node, shape=shape, name=name, texts=() if small else node.texts))
    small_ones = {node.id for node in nodes if node.shape in (Shape.INITIAL, Shape.FINAL, Shape.BAR)}
    edges = (
        replace(edge, backwards=edge.backwards and not {edge.source, edge.target} & small_ones) for edge in graph.edges
    )
    return replace(graph, nodes=tuple(nodes), edges=tuple(edges))
