"""Compatibility rules: what they exclude, and the mistakes in them."""

import pytest

RULES = "rules:\n  - id: r\n    rationale: Because.\n"

EXCLUSIONS = {
    "exclude a combination": ("    exclude: {d1: 0.1 kg, d2: 3}\n", {3, 4}),
    "exclude any of several values": ("    exclude: {d2: [2, 3], d3: PRM}\n", {2, 4, 6, 8}),
    "exclude a component": ("    exclude: {component.gripper: large}\n", {5, 6, 7, 8}),
    "require where": ("    when: {d2: 3}\n    require: {d3: PRM}\n", {3, 7}),
    "require everywhere": ("    require: {d3: [PRM], component.planner: prm}\n", {1, 3, 5, 7}),
    "require a component": ("    when: {d3: RRT}\n    require: {component.gripper: [large]}\n", {1, 3}),
    "limit a product": (
        "    limit: {product_of: [design.d2, design.d4], at_most: component.gripper.force}\n",
        {1, 2, 3, 4},
    ),
    "limit where": (
        "    when: {d2: 3}\n    limit: {product_of: [design.d2, design.d4], at_most: component.gripper.force}\n",
        {3, 4},
    ),
    "exclude a level": ("    exclude: {fingers: three}\n", {3, 4, 7, 8}),
    "exclude levels of factors": ("    exclude: {fingers: [two, Three], planner: prm}\n", {2, 4, 6, 8}),
    "exclude what a level or an id chooses": ("    exclude: {gripper: [low, large], d2: 3}\n", {3, 4, 7, 8}),
    "two names of one role": ("    exclude: {gripper: low, component.gripper: large}\n", set()),
    "limit by other names": (
        "    limit: {product_of: [fingers, d4], at_most: component.gripper.force}\n",
        {1, 2, 3, 4},
    ),
    "limit that nothing exceeds": ("    limit: {product_of: [design.d4], at_most: component.gripper.force}\n", set()),
}

MISTAKES = {
    "says nothing": (
        "",
        (
            "error: rule 'r' must have exactly one form "
            "(write 'exclude', or 'require', 'limit' or 'constraint' with or without 'when') [design.rule]"
        ),
    ),
    "says two things": (
        "    require: {d2: 2}\n    exclude: {d2: 3}\n",
        (
            "error: rule 'r' must have exactly one form "
            "(write 'exclude', or 'require', 'limit' or 'constraint' with or without 'when') [design.rule]"
        ),
    ),
    "exclude with when": (
        "    when: {d2: 2}\n    exclude: {d2: 3}\n",
        (
            "error: rule 'r' must have exactly one form "
            "(write 'exclude', or 'require', 'limit' or 'constraint' with or without 'when') [design.rule]"
        ),
    ),
    "names nothing": (
        "    exclude: ¦{}\n",
        "error: exclude names nothing (name a parameter, or remove 'exclude') [design.rule]",
    ),
    "unknown parameter": (
        "    exclude: {¦d22: 3}\n",
        "error: unknown design parameter 'd22' (did you mean 'd2'?) [design.unknown-parameter]",
    ),
    "wrong unit": (
        "    exclude: {d1: [0.1 kg, ¦3 N]}\n",
        "error: d1: unit 'N' does not measure what 'kg' measures (give it in kg or a multiple of it) [design.value]",
    ),
    "unknown planner": (
        "    exclude: {d3: ¦RRS}\n",
        "error: d3: no planner component is named 'RRS' (did you mean 'RRT'?) [design.unknown-name]",
    ),
    "value that never is": (
        "    exclude: {d1: ¦0.3 kg}\n",
        "error: d1 is never 0.3 kg (its values: 0.1 kg, 0.2 kg) [design.never-holds]",
    ),
    "unknown role": (
        "    exclude: {¦component.griper: large}\n",
        "error: unknown role 'griper' (did you mean 'gripper'?) [design.unknown-role]",
    ),
    "unknown component": (
        "    require: {component.gripper: [large, ¦huge]}\n",
        (
            "error: no gripper component has the id 'huge' (known gripper components: large, small) "
            "[design.unknown-component]"
        ),
    ),
    "unknown level": (
        "    exclude: {fingers: ¦tree}\n",
        "error: fingers is never 'tree' (did you mean 'three'?) [design.never-holds]",
    ),
    "unknown level of a role": (
        "    exclude: {gripper: [low, ¦hihg]}\n",
        "error: gripper is never 'hihg' (did you mean 'high'?) [design.never-holds]",
    ),
    "unknown name": (
        "    exclude: {¦griper: low}\n",
        "error: unknown design parameter 'griper' (did you mean 'gripper'?) [design.unknown-parameter]",
    ),
    "a parameter by two names": (
        "    exclude: {d4: 3 N, ¦force: 3 N}\n",
        "error: force refers to d4, which is listed already (name it once) [design.named-twice]",
    ),
    "unknown number": (
        "    limit: {product_of: [design.d4], at_most: ¦component.gripper.forse}\n",
        (
            "error: the design has no number 'component.gripper.forse' (did you mean 'component.gripper.force'?) "
            "[design.unknown-source]"
        ),
    ),
    "name as a number": (
        "    limit: {product_of: [design.d4, ¦design.d3], at_most: component.gripper.force}\n",
        "error: the design has no number 'design.d3' (did you mean 'design.d4'?) [design.unknown-source]",
    ),
    "units that differ": (
        "    limit: ¦{product_of: [design.d1, design.d4], at_most: component.gripper.force}\n",
        (
            "error: a product in kg·N is compared with component.gripper.force in N "
            "(compare values with the same dimension) [design.unit]"
        ),
    ),
    "limit without factors": (
        "    limit: {product_of: ¦[], at_most: component.gripper.force}\n",
        "error: product_of: at least 1 entry is expected",
    ),
}


@pytest.mark.parametrize("case", EXCLUSIONS)
def test_a_rule_excludes_what_it_says_and_ids_stay(project, case):
    text, excluded = EXCLUSIONS[case]
    project.space_text += RULES + text
    space = project.load()
    assert {variant.id for variant in space.expand()} == set(range(1, 9)) - excluded
    assert {combination.id for combination in space.excluded()} == excluded
    assert all(combination.rules == ("r",) for combination in space.excluded())


def test_every_rule_against_a_combination_is_named(project):
    project.space_text += RULES + "    exclude: {d2: 3}\n  - {id: s, rationale: So., exclude: {d3: PRM}}\n"
    excluded = {combination.id: (combination.rules, combination.levels) for combination in project.load().excluded()}
    assert excluded[4] == (("r", "s"), {"mass": "low", "fingers": "three", "planner": "prm"})
    assert excluded[3][0] == ("r",)
    assert excluded[2][0] == ("s",)


@pytest.mark.parametrize("case", MISTAKES)
def test_a_mistake_in_a_rule_is_found_at_its_place(project, case):
    text, expected = MISTAKES[case]
    project.space_text += (RULES if "¦" in text else RULES.replace("- id", "- ¦id")) + text
    if case == "limit without factors":
        assert expected in _first_of(project)
        return
    assert project.findings() == [f"{project.marks()[0]}: {expected}"]


def _first_of(project):
    with pytest.raises(Exception, match="product_of") as caught:
        project.load()
    return str(caught.value)


def test_duplicate_rules_are_found(project):
    project.space_text += RULES + "    exclude: {d2: 3}\n  - {id: ¦r, rationale: So., exclude: {d3: PRM}}\n"
    assert project.findings() == [
        f"{project.marks()[0]}: error: id 'r' is already in line 25 (use a unique id) [design.duplicate-id]"
    ]


def _nothing_left(project, rules):
    project.space_text += "rules:\n" + "".join(
        f"  - {'¦' if last else ''}id: {name}\n    rationale: So.\n    exclude: {exclude}\n"
        for name, exclude, last in rules
    )
    (finding,) = project.findings()
    place, _, message = finding.partition(": error: ")
    assert place == project.marks()[0]
    return message


def test_a_rule_that_excludes_everything_is_named(project):
    rules = [("light", "{d3: PRM}", False), ("any", "{d2: [2, 3]}", True), ("dear", "{d3: RRT}", False)]
    assert _nothing_left(project, rules) == (
        "the rule 'any' alone excludes every combination "
        "(loosen it, or add levels that it allows) [design.nothing-left]"
    )


def test_a_pair_of_rules_that_exclude_everything_is_named(project):
    rules = [("heavy", "{d1: 0.2 kg}", False), ("two", "{d2: 2}", False), ("three", "{d2: 3}", True)]
    assert _nothing_left(project, rules) == (
        "the rules 'two' and 'three' together exclude every combination "
        "(loosen one of them, or add levels that they allow) [design.nothing-left]"
    )


def test_of_many_rules_that_exclude_everything_those_that_are_needed_are_named(project):
    rules = [
        ("two-rrt", "{d2: 2, d3: RRT}", False),
        ("two-prm", "{d2: 2, d3: PRM}", False),
        ("three", "{d2: 3}", True),
        ("heavy", "{d1: 0.2 kg}", False),
    ]
    assert _nothing_left(project, rules).startswith(
        "the rules 'two-rrt', 'two-prm' and 'three' together exclude every combination ("
    )


def test_a_combination_without_a_component_may_be_excluded(project):
    project.change("matches: {d1: 100 g}", "matches: {d1: 100 g, d2: 2}")
    project.space_text += RULES + "    exclude: {d1: 0.1 kg, d2: 3}\n"
    assert [variant.id for variant in project.load().expand()] == [1, 2, 5, 6, 7, 8]


def test_a_broken_rule_does_not_make_its_combinations_look_broken(project):
    project.change("matches: {d1: 100 g}", "matches: {d1: 100 g, d2: 2}")
    project.space_text += RULES + "    exclude: {d1: 0.1 kg, ¦dd2: 3}\n"
    (finding,) = project.findings()
    assert "unknown design parameter 'dd2'" in finding


def test_conditions_on_roles_that_no_component_fills_do_not_hold(project):
    project.change("matches: {d1: 100 g}", "matches: {d1: 100 g, d2: 2}")
    project.space_text += RULES + "    exclude: {component.gripper: small}\n"
    (finding,) = project.findings()
    assert "no gripper in the catalogue matches d1 = 0.1 kg, d2 = 3" in finding


def test_limits_hold_where_a_role_has_no_component(project):
    project.change("matches: {d1: 100 g}", "matches: {d1: 100 g, d2: 2}")
    project.space_text += RULES + "    limit: {product_of: [design.d4], at_most: component.gripper.force}\n"
    (finding,) = project.findings()
    assert "no gripper in the catalogue matches" in finding


@pytest.mark.parametrize("written", ["{d2: three}", "{d2: [Three]}", "{d2: 3}"])
def test_a_rule_names_a_level_of_a_factor_with_the_id_of_its_parameter(project, written):
    project.change("- id: fingers\n", "- id: d2\n")
    project.space_text += f"{RULES}    exclude: {written}\n"
    space = project.load()
    assert {one.id for one in space.excluded()} == {3, 4, 7, 8}
