"""Every mistake that a catalogue can have, with its place and its hint."""

import pytest

from rgss.designs import load_catalogue
from rgss.errors import DocumentError

CASES = {
    "duplicate component": (
        "id: large",
        "id: ¦small",
        "error: id 'small' is already in line 8 (use a unique id) [design.duplicate-id]",
    ),
    "duplicate role": (
        "  - id: planner\n    name: Planner\ncomponents",
        "  - id: planner\n    name: Planner\n  - id: ¦planner\n    name: Again\ncomponents",
        "error: id 'planner' is already in line 5 (use a unique id) [design.duplicate-id]",
    ),
    "unknown role": (
        "id: large\n    role: gripper",
        "id: large\n    role: ¦griper",
        "error: unknown role 'griper' (did you mean 'gripper'?) [design.unknown-role]",
    ),
    "role of no component": (
        "  - id: planner\n    name: Planner\ncomponents",
        "  - id: planner\n    name: Planner\n  - id: ¦arm\n    name: Arm\ncomponents",
        "error: no component has the role 'arm' (add one, or remove the role) [design.empty-role]",
    ),
    "role with a dot": (
        "  - id: planner\n    name: Planner\ncomponents:",
        (
            "  - id: planner\n    name: Planner\n  - id: ¦a.b\n    name: Arm\ncomponents:\n"
            "  - {id: x, role: a.b, name: X, manufacturer: M, cost: {value: 0 USD, source: S}}"
        ),
        "error: 'a.b' has a dot (write a_b) [design.dotted-id]",
    ),
    "property with a dot": (
        "{force: N}",
        "{force: N, ¦a.b: N}",
        "error: 'a.b' has a dot (write a_b) [design.dotted-id]",
    ),
    "unit out of SI": (
        "{force: N}",
        "{force: ¦kN}",
        "error: force: the unit must be SI, got 'kN' (write N) [design.unit]",
    ),
    "unit with an offset": (
        "{force: N}",
        "{force: N, heat: ¦degC}",
        "error: heat: unit 'degC' is not on a scale that starts at zero (use K) [design.unit]",
    ),
    "unit of what SI does not measure": (
        "{force: N}",
        "{force: N, dots: ¦pixel}",
        "error: dots: unit 'pixel' has no SI equivalent (use units such as mm, kg, s, N) [design.unit]",
    ),
    "cost as a property": (
        "{force: N}",
        "{force: N, ¦cost: USD}",
        "error: every component has a cost (remove 'cost') [design.reserved]",
    ),
    "property that is missing": (
        "properties:\n      force: {value: 5 N, source: A datasheet}",
        "properties: ¦{}",
        "error: small lacks the property 'force' of a gripper (add 'force', in N) [design.missing-property]",
    ),
    "property that the role does not have": (
        "force: {value: 5 N, source: A datasheet}",
        "force: {value: 5 N, source: A datasheet}\n      ¦forse: {value: 5 N, source: A datasheet}",
        "error: a gripper has no property 'forse' (did you mean 'force'?) [design.unknown-property]",
    ),
    "wrong unit": (
        "value: 5 N",
        "value: ¦5 kg",
        "error: force: unit 'kg' does not measure what 'N' measures (give it in N or a multiple of it) [design.value]",
    ),
    "missing unit": (
        "value: 5 N",
        "value: ¦5",
        "error: force: '5' has no unit (write \"5 N\") [design.value]",
    ),
    "negative cost": (
        "value: 1 USD",
        "value: ¦-1 USD",
        "error: cost must be at least 0, got '-1 USD' (write a cost of at least 0) [design.value]",
    ),
    "assumption without a rationale": (
        "assumption: true, rationale: Invented.",
        "¦assumption: true",
        "error: cost is assumed without a rationale (add a 'rationale') [design.unsourced]",
    ),
    "number without a source": (
        "cost: {value: 2 USD, source: A quotation}",
        "cost: ¦{value: 2 USD}",
        (
            "error: cost has neither a source nor the mark of an assumption "
            "(add a 'source', or 'assumption: true' with a 'rationale') [design.unsourced]"
        ),
    ),
    "geometry outside the project": (
        "geometry: scenes",
        "geometry: ¦../scenes",
        (
            "error: geometry '../scenes/grippers/small.yaml' is not a path inside the project "
            "(write it like scenes/grippers/kg-3.yaml) [design.geometry]"
        ),
    ),
    "absolute geometry": (
        "geometry: scenes",
        "geometry: ¦/scenes",
        (
            "error: geometry '/scenes/grippers/small.yaml' is not a path inside the project "
            "(write it like scenes/grippers/kg-3.yaml) [design.geometry]"
        ),
    ),
    "unknown key": (
        "geometry: scenes",
        "¦geometri: scenes",
        "error: unknown key 'geometri' (did you mean 'geometry'?) [document.unknown-key]",
    ),
    "match that is no value": (
        "matches: {d1: 100 g}",
        "matches: {d1: ¦{}}",
        'error: d1: a value is expected (write a quantity ("0.3 kg"), a number or a name) [document.value]',
    ),
    "match without values": (
        "[200 g, 0.3 kg]",
        "¦[]",
        "error: d1: at least one value is expected (write the allowed values) [document.value]",
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_a_mistake_is_found_at_its_place(project, case):
    old, new, finding = CASES[case]
    project.change(old, new)
    assert f"{project.marks()[0]}: {finding}" in project.findings()


def test_every_mistake_is_reported_at_once_in_the_order_of_the_file(project):
    project.change("{force: N}", "{force: ¦kN}")
    project.change("value: 1 USD", "value: ¦1 kg")
    project.change("id: large", "id: ¦small")
    project.change("matches: {d3: PRM}", "geometry: ¦a/../b")
    places = [finding.split(": error")[0] for finding in project.findings()]
    assert [place for place in places if place in project.marks()] == project.marks()
    assert len(project.marks()) == 4


def test_an_empty_catalogue_is_refused(tmp_path):
    path = tmp_path / "catalogue.yaml"
    path.write_text("", encoding="utf-8")
    with pytest.raises(DocumentError, match=r"^catalogue\.yaml:1:1: error: the file is empty"):
        load_catalogue(path, label="catalogue.yaml")


def test_roles_and_components_may_not_be_empty(tmp_path):
    path = tmp_path / "catalogue.yaml"
    path.write_text("roles: []\ncomponents: []\n", encoding="utf-8")
    with pytest.raises(DocumentError) as caught:
        load_catalogue(path, label="catalogue.yaml")
    assert [(finding.line, finding.column) for finding in caught.value.findings] == [(1, 8), (2, 13)]
