"""Multiplicities and values of blocks, internal block diagrams, and parametric diagrams."""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from rgss.measures import MeasureKind, load_measures
from rgss.reports.diagrams.internal_blocks import internal_block_diagrams
from rgss.reports.diagrams.parametric import parametric_diagrams
from rgss.reports.diagrams.style import STYLE
from rgss.reports.diagrams.trees import block_definition_diagrams
from rgss.requirements import Block, BlockLevel, ValueProperty, load_requirements
from tests.fixtures.diagram_geometry import SVG, crossings

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def blocks():
    return load_requirements(ROOT / "requirements").architecture.blocks


@pytest.fixture(scope="module")
def measures():
    return load_measures(ROOT / "requirements/measures.yaml")


def texts(drawing):
    root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
    return ["".join(text.itertext()) for text in root.iter(f"{SVG}text")]


def squares(drawing):
    """Centres of the ports."""
    root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
    boxes = [box for box in root.iter(f"{SVG}rect") if "open-port" in box.get("class")]
    return [(float(box.get("x")) + 6, float(box.get("y")) + 6) for box in boxes]


def ends(drawing):
    """Where curves begin and end."""
    root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
    courses = [path.get("d") for path in root.iter(f"{SVG}path") if "C" in path.get("d")]
    for course in courses:
        numbers = [float(part) for part in course.replace("M", "").replace("C", " ").split()]
        yield tuple(numbers[:2])
        yield tuple(numbers[-2:])


def test_values_and_multiplicities_stand_in_block_definition_diagrams(blocks):
    shown = [text for drawing in block_definition_diagrams(blocks) for text in texts(drawing)]

    for block in blocks:
        assert block.multiplicity is None or block.multiplicity in shown, block.id
        for value in block.values:
            kind = "Real" if value.unit == "1" else value.unit
            fixed = f" = {value.value}" if value.value else ""
            assert f"{value.id} : {kind}{fixed}" in shown, (block.id, value.id)


def test_each_block_with_connectors_has_an_internal_block_diagram(blocks):
    drawings = {drawing.name: drawing for drawing in internal_block_diagrams(blocks)}
    owners = [block for block in blocks if block.connectors]

    assert sorted(drawings) == sorted(f"internal-{block.id}" for block in owners)
    assert len(owners) >= 4
    for owner in owners:
        drawing = drawings[f"internal-{owner.id}"]
        words = "".join(texts(drawing)).replace(" ", "")
        for connector in owner.connectors:
            for name, port in ((connector.source, connector.source_port), (connector.target, connector.target_port)):
                assert name == owner.id or name in words
                assert port in words
        places = squares(drawing)
        frame = [place for place in places if place[0] in (8.0, drawing.width - 8.0)]
        outer = [end for each in owner.connectors for end in (each.source, each.target) if end == owner.id]
        assert len(frame) == len(outer)
        assert crossings(drawing.to_svg(), STYLE) == []


def test_connections_meet_the_squares_of_their_ports(blocks):
    """Every end of an edge is at a port on the border of a part, or on the line of one of the frame's."""
    for drawing in internal_block_diagrams(blocks):
        heights = {round(y) for _, y in squares(drawing)}
        for x, y in ends(drawing):
            near = any(abs(x - u) <= 7 and abs(y - v) <= 1.5 for u, v in squares(drawing))
            assert near or any(abs(y - height) <= 1.5 for height in heights), drawing.name


def test_every_measure_is_a_constraint_of_a_parametric_diagram(blocks, measures):
    drawings = parametric_diagrams(measures, blocks)
    words = ["".join(texts(drawing)).replace(" ", "") for drawing in drawings]

    for measure in measures.measures:
        written = f"{{{measure.id}={measure.expression.text}}}".replace(" ", "")
        assert any(written in text for text in words), measure.id
    for measure in measures.of_kind(MeasureKind.EFFECTIVENESS):
        (drawing,) = (one for one in drawings if one.name == f"parametric-{measure.id}")
        shown = "".join(texts(drawing)).replace(" ", "")
        for other in measures.dependencies(measure.id):
            assert f"{{{other}=" in shown, (measure.id, other)
    for drawing in drawings:
        assert crossings(drawing.to_svg(), STYLE) == [], drawing.name


def test_bindings_of_parameters_follow_from_the_expressions(blocks, measures):
    """The payload: its equation's parameters are bound to the results of the others, and these to values."""
    (drawing,) = (one for one in parametric_diagrams(measures, blocks) if one.name == "parametric-P_max")
    root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
    bound = {group.find(f"{SVG}title").text for group in root.iter(f"{SVG}g")}

    assert {"P_max_m → P_max", "M_g → P_max", "P_max_g → P_max", "P_max → result P_max"} <= bound
    assert {"N_f → M_g", "M_f → M_g", "N_f → F_max", "F_max → P_max_g", "g → P_max_g", "g → P_max_m"} <= bound
    assert "Gripper fingers.friction, design.d6" in texts(drawing)


def test_a_measure_of_ones_own_has_its_diagram(blocks, measures):
    """Nothing but the measure itself is stated."""
    time = measures.measure("t_e")
    mine = replace(measures.measure("t_m"), id="mine", name="Time of mine", expression=time.expression, equation=None)
    changed = replace(
        measures, measures=(*measures.measures, mine), used={**measures.used, "mine": measures.used["t_e"]}
    )
    (drawing,) = (one for one in parametric_diagrams(changed, blocks) if one.name == "parametric-mine")

    assert "Time of mine" in texts(drawing)
    assert f"{{mine={time.expression.text}}}".replace(" ", "") in "".join(texts(drawing)).replace(" ", "")


def test_blocks_without_connectors_have_no_internal_block_diagram(blocks):
    assert internal_block_diagrams(tuple(replace(block, connectors=()) for block in blocks)) == ()


@pytest.mark.parametrize("seed", range(20))
def test_blocks_of_any_height_do_not_overlap(seed):
    """Wholes that are taller than all their parts together, too."""
    chosen = random.Random(seed)  # noqa: S311 - a made model
    blocks = []
    for index in range(chosen.randint(2, 25)):
        parent = f"BLK-{chosen.randrange(index)}" if index else None
        values = tuple(ValueProperty(id=f"v{number}", unit="kg") for number in range(chosen.choice((0, 0, 1, 12))))
        blocks.append(
            Block(id=f"BLK-{index}", name="Made", level=BlockLevel.ELEMENT, parent=parent, text="T.", values=values)
        )
    (drawing,) = block_definition_diagrams(blocks)
    root = ET.fromstring(drawing.to_svg())  # noqa: S314 - our own
    boxes = [
        tuple(float(box.get(key)) for key in ("x", "y", "width", "height"))
        for box in root.iter(f"{SVG}rect")
        if box.get("x") and "open" not in box.get("class")
    ]

    assert len(boxes) == len(blocks)
    for (x, y, width, height), (u, v, breadth, length) in combinations(boxes, 2):
        assert x + width <= u or u + breadth <= x or y + height < v - 2 or v + length < y - 2
    assert crossings(drawing.to_svg(), STYLE) == []
