"""Diagrams: of the shipped model all, each complete and well formed, the same every time, with nothing overlapping."""

from __future__ import annotations

import builtins
import re
import subprocess
import sys
from collections import Counter
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from rgss.errors import DefinitionError
from rgss.measures import load_measures
from rgss.reports.diagrams import diagrams
from rgss.reports.diagrams import requirements as diagram_requirements
from rgss.reports.diagrams import trees as diagram_trees
from rgss.reports.diagrams.diagrams import diagrams_of, file_stem, missing_diagrams, write_diagrams
from rgss.reports.diagrams.drawing import draw_graph
from rgss.reports.diagrams.frame import Heading
from rgss.reports.diagrams.graph import Cluster, Edge, Graph, Node, Shape
from rgss.reports.diagrams.layout import layout
from rgss.reports.diagrams.style import FONT, SMALL
from rgss.reports.diagrams.text import text_width
from rgss.requirements import BehaviourKind, load_requirements

ROOT = Path(__file__).parents[3]
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def shipped():
    return load_requirements(ROOT / "requirements")


@pytest.fixture(scope="module")
def measures():
    return load_measures(ROOT / "requirements/measures.yaml")


@pytest.fixture(scope="module")
def drawings(shipped, measures):
    return {drawing.name: drawing for drawing in diagrams_of(shipped, measures)}


def words_of(drawing) -> str:
    """Every text that a reader sees, with one blank where a line breaks."""
    root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
    return " ".join("".join(text.itertext()) for text in root.iter(f"{SVG}text"))


def squeezed(text: str) -> str:
    return "".join(text.split())


def test_all_kinds_of_diagrams_are_there(shipped, drawings):
    behaviours = shipped.architecture.behaviours
    kinds = Counter(name.split("-")[0] for name in drawings)

    assert {"containment", "use-cases"} <= set(drawings)
    assert kinds["requirements"] == len({requirement.group for requirement in shipped.system})
    assert kinds["internal"] == sum(bool(block.connectors) for block in shipped.architecture.blocks) >= 4
    assert kinds["parametric"] >= 5
    assert kinds["states"] == sum(one.machine is not None for one in behaviours) >= 1
    assert kinds["activity"] == sum(one.flow is not None for one in behaviours) >= 8
    assert kinds["sequence"] == sum(one.interaction is not None for one in behaviours) >= 8
    assert missing_diagrams(shipped) == ""


def test_every_element_is_named(shipped, drawings):
    words = {name: squeezed(words_of(drawing)) for name, drawing in drawings.items()}

    for element in (*shipped.stakeholder, *shipped.system):
        assert element.id in words["containment"], element.id
    for requirement in shipped.system:
        mine = words[f"requirements-{requirement.group.value}"]
        named = [
            requirement.id,
            requirement.text,
            *requirement.derived_from,
            *requirement.traces,
            *requirement.satisfied_by,
        ]
        named += [requirement.parent] if requirement.parent else []
        named += [requirement.criterion.measure, str(requirement.criterion)] if requirement.criterion else []
        assert [text for text in named if squeezed(text) not in mine] == [], requirement.id
    for behaviour in shipped.architecture.behaviours:
        for target in {item.id for item in shipped.system} & set(behaviour.refines):
            mine = words[f"requirements-{shipped.requirement(target).group.value}"]
            assert behaviour.id in mine.split("refinedby", 1)[1], behaviour.id
    structure = "".join(text for name, text in words.items() if name.startswith("blocks-"))
    for block in shipped.architecture.blocks:
        assert block.id in structure, block.id
        assert squeezed(block.name) in structure, block.id


def test_every_behaviour_is_drawn_with_all_that_it_has(shipped, drawings):
    words = {name: squeezed(words_of(drawing)) for name, drawing in drawings.items()}
    for one in shipped.architecture.behaviours:
        if one.kind is BehaviourKind.USE_CASE:
            assert all(squeezed(text) in words["use-cases"] for text in (one.id, one.name, *one.actors)), one.id
        if one.flow is not None:
            named = [said for node in one.flow.nodes for said in (node.text, node.does) if said]
            named += [edge.guard for edge in one.flow.edges if edge.guard]
            assert [text for text in named if squeezed(text) not in words[f"activity-{one.id}"]] == [], one.id
        if one.interaction is not None:
            named = [*one.interaction.lifelines, *(message.text for message in one.interaction.messages)]
            named += [timing.criterion_of for timing in one.interaction.timings]
            named += [timing.text for timing in one.interaction.timings]
            assert [text for text in named if squeezed(text) not in words[f"sequence-{one.id}"]] == [], one.id
        if one.machine is not None:
            named = [state.name for state in one.machine.states if state.name]
            named += [state.does for state in one.machine.states if state.does]
            named += [said for way in one.machine.transitions for said in (way.guard, way.failure) if said]
            assert [text for text in named if squeezed(text) not in words[f"states-{one.id}"]] == [], one.id


def test_many_failures_stand_in_the_state_that_they_leave(shipped, drawings):
    (machine,) = (one.machine for one in shipped.architecture.behaviours if one.id == "STM-task")
    root = ET.fromstring(drawings["states-STM-task"].to_svg())  # noqa: S314 - our own
    boxes = [" ".join(group.find(f"{SVG}title").text.split()) for group in root.iter(f"{SVG}g")]
    counts = Counter(way.source for way in machine.transitions if way.failure)

    assert max(counts.values()) > 4
    for state in machine.states:
        failures = [way.failure for way in machine.transitions if way.source == state.id and way.failure]
        if len(failures) > 4:
            assert any(box.startswith(state.name) and f"failures: {', '.join(failures)}" in box for box in boxes)
            assert f"any of its {len(failures)} failures" in words_of(drawings["states-STM-task"])


def test_each_is_well_formed_and_says_what_it_is(drawings):
    for drawing in drawings.values():
        root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
        title, description = root.find(f"{SVG}title"), root.find(f"{SVG}desc")
        ids = [element.get("id") for element in root.iter() if element.get("id")]
        assert root.get("role") == "img"
        assert root.get("aria-labelledby").split() == [title.get("id"), description.get("id")]
        assert (title.text, len(ids)) == (drawing.title, 2)
        assert description.text.startswith(drawing.description)
        assert not re.search(r"<(script|image|foreignObject|use|a)\b|href|url\(", drawing.to_svg())


def test_nothing_reaches_beyond_the_paper(drawings):
    for drawing in drawings.values():
        root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
        for text in root.iter(f"{SVG}text"):
            bold = text.get("class") == "name"
            width = text_width(text.text, FONT if bold else SMALL, bold=bold)
            x = float(text.get("x"))
            left = {"middle": x - width / 2, "end": x - width}.get(text.get("text-anchor"), x)
            assert left >= -0.5, (drawing.name, text.text)
            assert left + width <= drawing.width + 0.5, (drawing.name, text.text)
            assert 0 <= float(text.get("y")) <= drawing.height, (drawing.name, text.text)


def test_no_two_boxes_overlap(drawings):
    for drawing in drawings.values():
        root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
        boxes = [
            tuple(float(box.get(key)) for key in ("x", "y", "width", "height"))
            for box in root.iter(f"{SVG}rect")
            if box.get("x") and "open" not in box.get("class")
        ]
        for (x, y, width, height), (u, v, breadth, length) in combinations(boxes, 2):
            apart = x + width <= u + 0.2 or u + breadth <= x + 0.2 or y + height <= v + 0.2 or v + length <= y + 0.2
            assert apart, drawing.name


def test_texts_stay_within_their_boxes(drawings):
    for drawing in drawings.values():
        root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
        for group in root.iter(f"{SVG}g"):
            box, texts = group.find(f"{SVG}rect"), group.findall(f"{SVG}text")
            if box is None or drawing.name == "containment":
                continue
            left, width = float(box.get("x")), float(box.get("width"))
            for text in texts:
                bold = text.get("class") == "name"
                room = text_width(text.text, FONT if bold else SMALL, bold=bold)
                start = float(text.get("x")) - (room / 2 if text.get("text-anchor") == "middle" else 0)
                assert left <= start + 0.2, (drawing.name, text.text)
                assert start + room <= left + width + 0.2, (drawing.name, text.text)


def test_the_same_model_gives_the_same_drawings_in_another_process(shipped, drawings):
    script = (
        "import hashlib, sys; from pathlib import Path\n"
        "from rgss.reports.diagrams.diagrams import diagrams_of; from rgss.requirements import load_requirements\n"
        "from rgss.measures import load_measures; folder = Path(sys.argv[1])\n"
        "measures = load_measures(folder / 'measures.yaml')\n"
        "for one in diagrams_of(load_requirements(folder), measures): sys.stdout.write(one.to_svg())"
    )
    environment = {"PYTHONHASHSEED": "7", "PATH": "", "FONTCONFIG_FILE": "none", "LANG": "C"}
    command = [sys.executable, "-c", script, str(ROOT / "requirements")]
    run = subprocess.run(command, capture_output=True, check=True, env=environment)

    assert run.stdout.decode("utf-8") == "".join(drawing.to_svg() for drawing in drawings.values())
    assert run.stderr == b""


def test_files_are_written_whole(drawings, tmp_path):
    files = write_diagrams(list(drawings.values()), tmp_path / "new" / "folder")

    assert [file.name for file in files] == [f"{name}.svg" for name in drawings]
    assert sorted(path.name for path in (tmp_path / "new" / "folder").iterdir()) == sorted(file.name for file in files)
    assert files[0].read_text(encoding="utf-8") == drawings["containment"].to_svg()


def test_a_name_that_no_file_may_have(drawings):
    from dataclasses import replace

    assert file_stem(replace(drawings["containment"], name="../a b/ä")) == ".._a_b__"


def test_hostile_texts_are_texts(tmp_path, story):
    hostile = "'</text><script>alert(1)</script> & \"x\" ]]> 🤖'"
    folder = story.write(
        tmp_path / "hostile",
        {
            "system.yaml": {"The gripper shall open.": hostile},
            "architecture.yaml": {"name: Finger": f"name: {hostile}", "name: Serve": f"name: {hostile}"},
        },
    )
    for drawing in diagrams_of(load_requirements(folder)):
        root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
        assert not [element.tag for element in root.iter() if "script" in element.tag]
    assert "🤖" in words_of(drawing)


def test_a_large_model_is_drawn_in_parts(shipped, monkeypatch):
    monkeypatch.setattr(diagram_trees, "MOST_IN_MAP", 10)
    monkeypatch.setattr(diagram_requirements, "MOST_IN_GROUP", 5)
    monkeypatch.setattr(diagrams, "MOST_IN_GROUP", 5)
    names = [drawing.name for drawing in diagrams_of(shipped)]
    counts = Counter(requirement.group.value for requirement in shipped.system)

    large = [group for group, count in counts.items() if count > 5]
    assert large
    assert not {f"requirements-{group}" for group in large} & set(names)
    assert missing_diagrams(shipped) == (
        f"These groups have more than 5 requirements and no diagram: {', '.join(large)}."
    )
    containment = words_of(diagram_trees.containment_map(shipped))
    assert "SYS-001" not in containment
    assert all(f"{group} {count}" in containment for group, count in counts.items())


def test_of_a_huge_model_the_map_alone_is_drawn(shipped, monkeypatch):
    monkeypatch.setattr(diagrams, "MOST_ELEMENTS", 50)

    assert [drawing.name for drawing in diagrams_of(shipped)] == ["containment"]
    assert "the containment map alone is drawn" in missing_diagrams(shipped)


def test_edges_begin_and_end_at_their_nodes():
    """Whatever the shapes are, and whichever end is laid out first."""
    shapes = list(Shape)
    nodes = tuple(Node(id=shape.value, shape=shape) for shape in shapes)
    edges = tuple(
        Edge(source=one.value, target=other.value, backwards=index % 2 == 1, labels=("label",) * (index % 3))
        for index, (one, other) in enumerate(combinations(shapes, 2))
    )
    sizes = {node.id: (30.0 if node.shape in (Shape.INITIAL, Shape.FINAL) else 60.0, 30.0) for node in nodes}
    placed = layout(Graph(nodes=nodes, edges=edges), sizes)

    for edge, curve in zip(edges, placed.curves, strict=True):
        assert len(curve) % 3 == 1
        for end, name in ((curve[0], edge.source), (curve[-1], edge.target)):
            x, y = placed.nodes[name]
            assert abs(end[0] - x) <= 31.5
            assert abs(end[1] - y) <= 16.5


def test_what_stands_in_a_cluster_is_within_its_frame():
    nodes = tuple(Node(id=name, shape=Shape.BOX, name=name, cluster="c" if name in "ab" else "") for name in "abxy")
    edges = (Edge(source="x", target="a"), Edge(source="b", target="y"))
    graph = Graph(nodes=nodes, edges=edges, clusters=(Cluster(id="c", title="A title that is long"),))
    frame = (placed := layout(graph, {node.id: (50.0, 20.0) for node in nodes})).frames["c"]

    for node in nodes:
        x, y = placed.nodes[node.id]
        within = frame.left <= x - 25 and x + 25 <= frame.right and frame.top <= y - 10 <= frame.bottom
        assert within == (node.cluster == "c")


def test_without_pygraphviz_one_line_says_what_to_do(monkeypatch):
    original = builtins.__import__

    def refuse(name, *arguments, **options):
        if name == "pygraphviz":
            raise ImportError(name)
        return original(name, *arguments, **options)

    monkeypatch.setattr(builtins, "__import__", refuse)
    graph = Graph(nodes=(Node(id="a", shape=Shape.BOX),), edges=())
    heading = Heading(kind="bdd", element="Block", subject="a")
    with pytest.raises(DefinitionError) as caught:
        draw_graph(graph, heading=heading, name="n", title="t", description="d")

    assert str(caught.value) == (
        "diagrams need the package pygraphviz, which is not installed (pip install 'pygraphviz>=2.0')"
    )
