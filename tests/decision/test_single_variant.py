"""Sentences on a study of a single variant, which has no rivals."""

from __future__ import annotations

import re

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.study_decision import decide_study
from rgss.reports.decision import decision_lines, decision_section
from rgss.reports.decision.report_part import decision_part
from rgss.studies.project import load_project
from tests.fixtures.shipped_project import copy_project

OTHERS = (
    "gripper_mass: light",
    "fingers: two",
    "velocity: slow",
    "planner: rrt",
    "planner: stride",
    "planning_time: short",
    "planning_time: medium",
)
OF_SEVERAL = re.compile(
    r"\d of 1\b|are shown to meet|[Nn]o other variant is tied|No requirement excludes|Rank reversal|Pareto front|"
    r"[Oo]f the variants|1 variants|1 of them|in nothing|runner-up|every variant|worth keeping|0 are stated|"
    r"that no variant is feasible|all 1 "
)
"""Phrases that compare variants."""


@pytest.fixture(scope="module")
def decide(tmp_path_factory, filled, record_of):
    """The decision of the shipped study with a single variant; its planning takes some seconds."""
    folder = copy_project(tmp_path_factory.mktemp("single") / "project")
    with (folder / "designs" / "grasping_system.yaml").open("a", encoding="utf-8") as file:
        for place, level in enumerate(OTHERS):
            file.write(f"\n  - {{id: leave-{place}, rationale: One is enough., exclude: {{{level}}}}}\n")
    project = load_project(folder)

    def decided(planning_s: float):
        store = filled(project, lambda spec: record_of(spec, planning_s=planning_s + 0.1 * spec.seed))
        return decide_study(project, measure_variants(project, store), evidence="evidence.sqlite")

    return decided


def test_a_single_variant_is_compared_with_no_other(decide):
    made = decide(0.5)
    assert made.is_alone
    chosen = made.decision.chosen
    assert chosen is not None
    lines = list(decision_lines(made))
    section = decision_section(made)
    part = decision_part(made)
    for text in ("\n".join(lines), section, "\n".join((part["headline"], *part["standing"], *part["reasons"]))):
        assert not OF_SEVERAL.search(text), OF_SEVERAL.search(text)
        assert f"Variant {chosen}, the only one compared, is chosen" in text
        assert re.search(rf"Probability that variant {chosen} is feasible: [<>\d. ]+ %\.", text)
        assert re.search("Rule: the variant is chosen if its estimates (meet|miss) ", text)
    assert (
        f"Variant {chosen} is the only one compared, and meets every requirement by the estimates" in part["reasons"][0]
    )
    assert "Weights: none changes the choice, as no other variant is compared." in lines
    assert "No other variant is compared, so that no weight changes the choice." in section
    assert part["certificate"]["enumeration"] == "enumeration of the one variant agrees"


def test_a_single_variant_that_misses_a_limit(decide):
    made = decide(10.0)
    assert made.is_alone
    assert made.decision.chosen is None
    text = "\n".join(decision_lines(made))
    assert not OF_SEVERAL.search(text), OF_SEVERAL.search(text)
    assert "No variant is chosen: the only one compared does not meet every requirement by its estimates" in text
    assert re.search(r"^Variant \d+ (violates|has no value)", text, re.MULTILINE)
    assert "Nearest" not in text
    assert "the only one compared does not meet every requirement" in decision_section(made)
