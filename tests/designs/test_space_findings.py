"""Every mistake that a design space can have, alone or with a catalogue, with place and hint."""

import pytest

import rgss.designs.loading

CASES = {
    "duplicate parameter": (
        "{id: d2, name: fingers",
        "{id: ¦d1, name: fingers",
        "error: id 'd1' is already in line 2 (use a unique id) [design.duplicate-id]",
    ),
    "duplicate name": (
        "{id: d2, name: fingers",
        "{id: d2, name: ¦mass",
        "error: name 'mass' is already in line 2 (use a unique name) [design.duplicate-id]",
    ),
    "duplicate factor": (
        "id: fingers\n",
        "id: ¦mass\n",
        "error: id 'mass' is already in line 9 (use a unique id) [design.duplicate-id]",
    ),
    "duplicate level": (
        "{id: three,",
        "{id: ¦two,",
        "error: id 'two' is already in line 17 (use a unique id) [design.duplicate-id]",
    ),
    "parameter with a dot": (
        "{id: d4, name: force",
        "{id: ¦d.4, name: force",
        "error: 'd.4' has a dot (write d_4) [design.dotted-id]",
    ),
    "quantity without a unit": (
        "- {id: d4, name: force, symbol: F, unit: N,",
        "- ¦{id: d4, name: force, symbol: F,",
        "error: d4 has no unit (add 'unit', or 'kind: count' or 'kind: name') [design.unit]",
    ),
    "unit out of SI": (
        "unit: N, description",
        "unit: ¦km, description",
        "error: d4: the unit must be SI, got 'km' (write m) [design.unit]",
    ),
    "count with a unit": (
        "kind: count,",
        "kind: count, ¦unit: kg,",
        "error: d2 is a count with a unit (remove 'unit') [design.unit]",
    ),
    "names with a unit": (
        "kind: name, role: planner,",
        "kind: name, role: planner, ¦unit: kg,",
        "error: d3 has names and a unit (remove 'unit') [design.unit]",
    ),
    "names of no role": (
        "- {id: d3, name: planner, symbol: p, kind: name, role: planner,",
        "- ¦{id: d3, name: planner, symbol: p, kind: name,",
        "error: d3 has names of no role (add 'role': that of the components it names) [design.role]",
    ),
    "names of an unknown role": (
        "kind: name, role: planner,",
        "kind: name, role: ¦planer,",
        "error: unknown role 'planer' (did you mean 'planner'?) [design.unknown-role]",
    ),
    "role without names": (
        "kind: count,",
        "kind: count, ¦role: gripper,",
        "error: d2 has a role but no names (remove 'role', or write 'kind: name') [design.role]",
    ),
    "factor without levels": (
        "    levels:\n      - {id: two, sets: {d2: 2}}\n      - {id: three, sets: {d2: 3}}\n",
        "    levels: ¦[]\n",
        (
            "error: factor 'fingers' has no levels (add a level, or set the parameters under 'constants') "
            "[design.no-levels]"
        ),
    ),
    "level that sets nothing": (
        "sets: {d2: 3}",
        "sets: ¦{}",
        "error: level 'three' sets nothing (name a parameter and its value) [design.empty-level]",
    ),
    "unknown parameter in a level": (
        "sets: {d2: 3}",
        "sets: {d2: 3, ¦d22: 3}",
        "error: unknown design parameter 'd22' (did you mean 'd2'?) [design.unknown-parameter]",
    ),
    "unknown parameter among the constants": (
        "d4: 3 N",
        "d4: 3 N\n  ¦x: 3 N",
        "error: unknown design parameter 'x' (known parameters: d1, d2, d3, d4) [design.unknown-parameter]",
    ),
    "unknown parameter in the catalogue": (
        "matches: {d1: 100 g}",
        "matches: {¦dd: 100 g}",
        "error: unknown design parameter 'dd' (known parameters: d1, d2, d3, d4) [design.unknown-parameter]",
    ),
    "parameter of two factors": (
        "sets: {d2: 3}",
        "sets: {d2: 3, ¦d1: 0.1 kg}",
        "error: d1 is already set by factor 'mass' (set it in one place) [design.set-twice]",
    ),
    "parameter of a constant and a factor": (
        "sets: {d2: 3}",
        "sets: {d2: 3, ¦d4: 1 N}",
        "error: d4 is already set by the constants (set it in one place) [design.set-twice]",
    ),
    "parameter that other levels set": (
        "sets: {d2: 3}",
        "sets: ¦{d4: 1 N}",
        "error: level 'three' does not set d2, which other levels of its factor set (add d2) [design.level-incomplete]",
    ),
    "parameter that nothing sets": (
        "- {id: d4,",
        "- {id: ¦d5, name: idle, symbol: i, unit: s, description: Idle.}\n  - {id: d4,",
        "error: d5 is never set (set it under 'constants', or in every level of a factor) [design.never-set]",
    ),
    "two equal levels": (
        "{id: high, sets: {d1: 200 g}}",
        "¦{id: high, sets: {d1: 100 g}}",
        "error: level 'high' equals level 'low' (remove one of them) [design.equal-levels]",
    ),
    "missing unit": (
        "d4: 3 N",
        "d4: ¦3",
        "error: d4: '3' has no unit (write \"3 N\") [design.value]",
    ),
    "wrong unit in a level": (
        "sets: {d1: 200 g}",
        "sets: {d1: ¦200 mm}",
        "error: d1: unit 'mm' does not measure what 'kg' measures (give it in kg or a multiple of it) [design.value]",
    ),
    "wrong unit in the catalogue": (
        "[200 g, 0.3 kg]",
        "[200 g, ¦0.3 s]",
        "error: d1: unit 's' does not measure what 'kg' measures (give it in kg or a multiple of it) [design.value]",
    ),
    "broken count": (
        "sets: {d2: 3}",
        "sets: {d2: ¦2.5}",
        "error: d2: a whole number from 0 is expected, got 2.5 (write a count, such as 2) [design.value]",
    ),
    "negative count": (
        "sets: {d2: 3}",
        "sets: {d2: ¦-1}",
        "error: d2: a whole number from 0 is expected, got -1 (write a count, such as 2) [design.value]",
    ),
    "number for a name": (
        "sets: {d3: PRM}",
        "sets: {d3: ¦3}",
        "error: d3: 3 is not a name (write the name of a planner) [design.value]",
    ),
    "unknown planner": (
        "sets: {d3: PRM}",
        "sets: {d3: ¦PRMX}",
        "error: d3: no planner component is named 'PRMX' (did you mean 'PRM'?) [design.unknown-name]",
    ),
    "unknown planner as a constant": (
        "d4: 3 N\n",
        "d4: 3 N\n  d3: ¦spline\n",
        "error: d3: no planner component is named 'spline' (known planner names: PRM, RRT) [design.unknown-name]",
    ),
    "no component": (
        "sets: {d1: 200 g}",
        "sets: {d1: ¦250 g}",
        (
            "error: no gripper in the catalogue matches d1 = 0.25 kg "
            "(add a component, or a rule that excludes the combination) [design.no-component]"
        ),
    ),
    "several components": (
        "{d1: [200 g, 0.3 kg]}",
        "¦{d1: [100 g, 200 g]}",
        (
            "error: 2 components fill the role 'gripper' where d1 = 0.1 kg: small, large "
            "(make their 'matches' distinct) [design.several-components]"
        ),
    ),
    "several components in every design": (
        "components:\n",
        (
            "components:\n  - {id: a, role: arm, name: A, manufacturer: M, cost: {value: 0 USD, source: S}}\n"
            "  - {id: ¦b, role: arm, name: B, manufacturer: M, cost: {value: 0 USD, source: S}}\n"
        ),
        (
            "error: 2 components fill the role 'arm' in every design: a, b "
            "(make their 'matches' distinct) [design.several-components]"
        ),
    ),
    "value that is none": (
        "d4: 3 N",
        "d4: ¦true",
        'error: d4: a value is expected (write a quantity ("0.3 kg"), a number or a name) [document.value]',
    ),
    "unknown key": (
        "constants:",
        "¦constant:",
        "error: unknown key 'constant' (did you mean 'constants'?) [document.unknown-key]",
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_a_mistake_is_found_at_its_place(project, case):
    old, new, finding = CASES[case]
    if case == "several components in every design":
        project.change("roles:\n", "roles:\n  - {id: arm, name: Arm}\n")
    project.change(old, new)
    assert f"{project.marks()[0]}: {finding}" in project.findings()


def test_every_mistake_is_reported_at_once_in_the_order_of_the_files(project):
    project.change("matches: {d1: 100 g}", "matches: {d1: ¦100 s}")
    project.change("d4: 3 N", "¦d9: 3 N")
    project.change("sets: {d1: 200 g}", "sets: {d1: ¦200}")
    project.change("sets: {d2: 3}", "sets: {d2: ¦x}")
    project.change("sets: {d3: RRT}", "sets: {d3: ¦RRR}")
    project.change("sets: {d3: PRM}", "sets: {d3: PRM, ¦d1: 0.1 kg}")
    project.change("{id: d4,", "{id: ¦d4,")
    places = [finding.split(": error")[0] for finding in project.findings()]
    assert [place for place in places if place in project.marks()] == project.marks()
    assert len(project.marks()) == 7


def test_a_missing_component_is_found_beside_other_mistakes(project):
    project.change("sets: {d1: 200 g}", "sets: {d1: ¦250 g}").change("sets: {d2: 3}", "sets: {d2: ¦3 kg}")
    assert [finding.split(": error")[0] for finding in project.findings()] == project.marks()


def test_a_missing_component_is_reported_once_for_all_its_combinations(project):
    project.change("matches: {d1: 100 g}", "matches: {d1: 100 g, d2: 2}")
    project.change("sets: {d2: 3}", "sets: {d2: ¦3}")
    (finding,) = project.findings()
    assert finding.startswith(f"{project.marks()[0]}: error: no gripper in the catalogue matches d1 = 0.1 kg, d2 = 3 (")


def test_a_constant_that_no_component_matches_is_found_where_it_stands(project):
    project.change("matches: {d1: 100 g}", "matches: {d4: 8 N}").change("{d1: [200 g, 0.3 kg]}", "{d4: 9 N}")
    project.change("d4: 3 N", "d4: ¦3 N")
    (finding,) = project.findings()
    assert finding.startswith(f"{project.marks()[0]}: error: no gripper in the catalogue matches d4 = 3 N (")


def test_names_that_the_catalogue_does_not_have_at_all_are_found(project):
    project.change("matches: {d3: RRT}", "matches: {d2: 2}").change("matches: {d3: PRM}", "matches: {d2: 3}")
    assert [finding.split(": error: ")[1] for finding in project.findings()] == [
        "d3: no planner component is named 'RRT' (there are no known planner names) [design.unknown-name]",
        "d3: no planner component is named 'PRM' (there are no known planner names) [design.unknown-name]",
    ]


def test_a_space_too_large_to_expand_is_refused(project, monkeypatch):
    monkeypatch.setattr(rgss.designs.loading, "LARGEST_SPACE", 7)
    project.change("factors:", "¦factors:")
    assert project.findings() == [
        (
            f"{project.marks()[0]}: error: the factors make 8 combinations; at most 7 are expanded "
            "(study fewer at once, or add 'sample') [design.too-large]"
        )
    ]
