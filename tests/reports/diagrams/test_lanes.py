"""Lanes of activity diagrams: each action within its performer's, side by side, and no text crossed."""

from __future__ import annotations

import random
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from rgss.reports.diagrams.behaviour import activity_diagram, lanes_of
from rgss.reports.diagrams.labels import Box, place_labels
from rgss.reports.diagrams.style import STYLE
from rgss.requirements import Behaviour, BehaviourKind, Flow, FlowEdge, FlowNode, FlowNodeKind, load_requirements
from tests.fixtures.diagram_geometry import SVG, crossings, text_boxes

ROOT = Path(__file__).parents[3]
KINDS = {"initial": FlowNodeKind.INITIAL, "merge": FlowNodeKind.MERGE, "decision": FlowNodeKind.DECISION}


def made_activity(flow):
    return Behaviour(id="ACT-made", name="Made", kind=BehaviourKind.ACTIVITY, text="Made.", flow=flow)


def groups(drawing):
    """The first rectangle of each group of a drawing, by the group's title."""
    root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
    found = {}
    for group in root.iter(f"{SVG}g"):
        box = group.find(f"{SVG}rect")
        if box is not None:
            left, width = float(box.get("x")), float(box.get("width"))
            found[group.find(f"{SVG}title").text] = (left, left + width)
    return found


def test_each_action_of_the_shipped_model_is_in_the_lane_of_its_performer():
    architecture = load_requirements(ROOT / "requirements").architecture
    names = {block.id: block.name for block in architecture.blocks}
    checked = 0
    for activity in architecture.behaviours:
        if activity.flow is None:
            continue
        boxes = groups(activity_diagram(activity, names))
        lanes = {title: box for title, box in boxes.items() if title.startswith("Lane of ")}
        assert len(lanes) == len({node.performer for node in activity.flow.nodes if node.performer})
        for (_, right), (left, _) in pairwise(sorted(lanes.values())):
            assert abs(left - right) < 0.2, activity.id
        for node in activity.flow.nodes:
            if node.performer is not None:
                left, right = lanes[f"Lane of {names[node.performer]} ({node.performer})"]
                title = " ".join([node.text, *([f"calls {node.does}"] if node.does else [])])
                assert left <= boxes[title][0] < boxes[title][1] <= right, (activity.id, node.id)
                checked += 1
    assert checked > 40


def test_a_node_that_nobody_performs_stands_beside_its_action():
    nodes = (
        FlowNode(id="start", kind=FlowNodeKind.INITIAL),
        FlowNode(id="which", kind=FlowNodeKind.DECISION, text="Which?"),
        FlowNode(id="a", kind=FlowNodeKind.ACTION, text="A.", performer="BLK-a"),
        FlowNode(id="again", kind=FlowNodeKind.MERGE),
        FlowNode(id="b", kind=FlowNodeKind.ACTION, text="B.", performer="BLK-b"),
        FlowNode(id="good", kind=FlowNodeKind.DECISION, text="Good?"),
        FlowNode(id="failed", kind=FlowNodeKind.MERGE),
        FlowNode(id="end", kind=FlowNodeKind.FINAL),
    )
    ways = (
        "start which",
        "which a",
        "which failed",
        "a again",
        "again b",
        "b good",
        "good again",
        "good failed",
        "failed end",
    )
    edges = tuple(FlowEdge(source=way.split()[0], target=way.split()[1]) for way in ways)

    found = lanes_of(Flow(nodes=nodes, edges=edges))

    assert {name for name, lane in found.items() if lane == "BLK-a"} == {"start", "which", "a"}
    assert {name for name, lane in found.items() if lane == "BLK-b"} == {"again", "b", "good", "failed", "end"}


@pytest.mark.parametrize("seed", range(16))
def test_no_text_of_a_generated_activity_is_crossed(seed):
    """Flows with loops through up to five lanes, with titles of up to three lines."""
    chosen = random.Random(seed)  # noqa: S311 - a made model
    blocks = {
        f"BLK-{index}": "A performer with a long name " * chosen.randint(1, 2) for index in range(chosen.randint(1, 5))
    }
    count = chosen.randint(2, 9)
    nodes, edges = [FlowNode(id="start", kind=FlowNodeKind.INITIAL)], []
    for index in range(count):
        nodes += [
            FlowNode(id=f"m{index}", kind=FlowNodeKind.MERGE),
            FlowNode(
                id=f"a{index}",
                kind=FlowNodeKind.ACTION,
                text="Do what comes next.",
                performer=chosen.choice(list(blocks)),
            ),
            FlowNode(id=f"d{index}", kind=FlowNodeKind.DECISION, text="Is it done?"),
        ]
        before = f"d{index - 1}" if index else "start"
        edges += [
            FlowEdge(source=before, target=f"m{index}", guard="it is" if index else None),
            FlowEdge(source=f"m{index}", target=f"a{index}"),
            FlowEdge(source=f"a{index}", target=f"d{index}"),
            FlowEdge(
                source=f"d{index}", target=f"m{chosen.randint(max(0, index - 2), index)}", guard="not within the time"
            ),
        ]
    nodes.append(FlowNode(id="end", kind=FlowNodeKind.FINAL, text="It is done."))
    edges.append(FlowEdge(source=f"d{count - 1}", target="end", guard="it is"))
    drawing = activity_diagram(made_activity(Flow(nodes=tuple(nodes), edges=tuple(edges))), blocks)

    assert crossings(drawing.to_svg(), STYLE) == []


def test_heads_of_edges_to_final_nodes_point_down():
    """Edges of upright and level lines end with pieces too short to have a direction."""
    architecture = load_requirements(ROOT / "requirements").architecture
    (activity,) = (one for one in architecture.behaviours if one.id == "ACT-pause-simulation")
    root = ET.fromstring(activity_diagram(activity, {}).to_svg())  # noqa: S314 - our own
    finals = {node.id for node in activity.flow.nodes if node.kind is FlowNodeKind.FINAL}
    checked = 0
    for group in root.iter(f"{SVG}g"):
        title = group.find(f"{SVG}title").text
        if "→" in title and title.split("→")[1].split()[0] in finals:
            tip, left, right = (
                tuple(map(float, place.split(","))) for place in group.find(f"{SVG}polygon").get("points").split()
            )
            assert max(left[1], right[1]) < tip[1] - 5, title
            assert abs((left[0] + right[0]) / 2 - tip[0]) < 1, title
            checked += 1
    assert checked == len(finals)


def test_a_guard_is_in_the_lane_of_its_edge_and_no_other_edge_is_nearer():
    lanes = (Box(left=0, top=0, right=100, bottom=300), Box(left=100, top=0, right=300, bottom=300))
    own = ((112, 20), (112, 80), (112, 140), (112, 200))
    other = ((160, 20), (160, 80), (160, 140), (160, 200))
    borders = [((100.0, 0.0), (100.0, 300.0))]

    def placed(wanted, within):
        (centre, _), free = place_labels(
            (own, other), (wanted, None), ((40, 12), (0, 0)), (), borders, farthest=50.0, lanes=within
        )
        assert free
        return centre

    # Free places, the first in the lane of another, the second beside another edge.
    for wanted in ((70.0, 100.0), (184.0, 100.0)):
        assert placed(wanted, ()) == wanted
        x, _ = placed(wanted, lanes)
        assert 100 < x - 20 < x + 20 < 160
        assert x - 20 - 112 <= 160 - x - 20


def test_the_long_guard_of_a_move_is_in_the_lane_of_its_decision():
    architecture = load_requirements(ROOT / "requirements").architecture
    names = {block.id: block.name for block in architecture.blocks}
    move = next(one for one in architecture.behaviours if one.id == "ACT-move")
    drawing = activity_diagram(move, names)
    boxes = groups(drawing)
    left, right = next(box for title, box in boxes.items() if title.startswith("Lane of Task program"))
    texts = {text.text: text for text in text_boxes(drawing.to_svg(), STYLE)}
    for line in ("[contact,", "the tool is off its"):
        assert left < texts[line].left < texts[line].right < right
