"""Robustness where designs, evidence or rules are other than the shipped ones."""

from __future__ import annotations

import json
import re
from dataclasses import replace

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose, trade_problem
from rgss.decision.robustness.assumptions import assumption_findings
from rgss.decision.robustness.effects import study_effects
from rgss.decision.robustness.remeasuring import Remeasuring
from rgss.decision.robustness.robustness import analyse_robustness
from rgss.decision.study_decision import decide_study
from rgss.decision.what_if import measured_in, suppose
from rgss.reports.decision.json.robustness import robustness_to_json
from rgss.reports.decision.report_part import decision_part
from rgss.reports.decision.text.robustness import robustness_lines
from rgss.reports.study.effects import effect_columns
from rgss.studies.project import load_project
from rgss.tradeoff.problem.evidence_table import tabulated
from rgss.tradeoff.robustness.prices import step_at


def test_effects_without_levels_that_never_succeed(shipped, filled, record_of):
    """TRRT never succeeds, so no time is known of it: the others are analysed, and it is said."""
    failing = measure_variants(shipped, filled(shipped, lambda spec: record_of(spec, success=spec.planner != "TRRT")))
    effects = {one.measure: one for one in study_effects(shipped, failing, None).measures}

    assert effects["t_e"].left_out == ("planner=trrt",)
    assert effects["t_e"].designs == 48
    assert effects["S"].left_out == ()
    assert effects["t_e"].analysis.effects[0].low is None


def test_one_replicate_tells_nothing_of_noise(shipped, filled, record_of):
    project = shipped.with_replicates(1)
    single = measure_variants(project, filled(project, lambda spec: record_of(spec, planning_s=0.1 * spec.variant % 1)))
    found = analyse_robustness(project, single, choose(project, single))

    assert found.refused == {
        "noise": "noise cannot be estimated from 1 replicate of each variant "
        "(run 'rgss sweep' with at least 2 replicates)"
    }
    assert not found.weighting.with_noise
    assert found.resamples == 0
    analyses = [one.analysis for one in found.effects.measures if one.analysis is not None]
    assert analyses
    assert all(effect.low is None for analysis in analyses for effect in analysis.effects)


SAMPLED = """\
factors:
  - {id: gripper_mass, name: Gripper weight, levels: [{id: standard, sets: {d2: 0.3 kg, d3: 0.4 kg}}, {id: light, sets: {d2: 0.2 kg, d3: 0.2 kg}}]}
  - {id: fingers, name: Fingers, levels: [{id: three, sets: {d1: 3}}, {id: two, sets: {d1: 2}}]}
  - {id: velocity, name: Manipulator velocity, parameter: d7, range: [0.5 m/s, 1 m/s], resolution: 0.01 m/s}
  - {id: planner, name: Planning algorithm, levels: [{id: rrt, sets: {d8: RRT}}, {id: trrt, sets: {d8: TRRT}}]}
  - {id: planning_time, name: Limit, parameter: d9, range: [4 s, 8 s], resolution: 0.1 s}
sample: {method: sobol, size: 64, seed: 3}
"""  # noqa: E501


def test_designs_that_are_a_sample(folder, filled, record_of):
    """Payload follows from the fingers alone, execution time mostly from the speed; nothing else is made up."""
    file = folder / "designs/grasping_system.yaml"
    text = file.read_text(encoding="utf-8")
    head, rest = text.split("factors:\n", 1)
    file.write_text(head + SAMPLED + "\nrules:" + rest.split("\nrules:", 1)[1], encoding="utf-8")
    project = load_project(folder)
    sampled = measure_variants(project, filled(project, lambda spec: record_of(spec, planning_s=0.2, path_m=1.0)))
    found = analyse_robustness(project, sampled, choose(project, sampled))
    effects = {one.measure: one for one in found.effects.measures}

    assert found.effects.constants == ("d4", "d5", "d6")
    assert [factor.parameters for factor in found.effects.factors] == [("d2", "d3"), ("d1",), ("d7",), ("d8",), ("d9",)]
    assert effects["P_max"].analysis is None
    assert effects["P_max"].sampled["fingers"].share == pytest.approx(1.0)
    assert effects["t_e"].sampled["velocity"].share > 0.9
    assert max(effects["t_e"].sampled, key=lambda factor: effects["t_e"].sampled[factor].share) == "velocity"
    assert json.loads(json.dumps(robustness_to_json(found), allow_nan=False))


def test_effects_of_few_designs_are_not_computed_rather_than_absent(folder, filled, record_of):
    file = folder / "designs/grasping_system.yaml"
    head, rest = file.read_text(encoding="utf-8").split("factors:\n", 1)
    few = SAMPLED.replace("size: 64", "size: 4")
    file.write_text(head + few + "\nrules:" + rest.split("\nrules:", 1)[1], encoding="utf-8")
    project = load_project(folder)
    sampled = measure_variants(project, filled(project, lambda spec: record_of(spec, planning_s=0.2)))
    made = decide_study(project, sampled, evidence="evidence.sqlite")
    page = "\n".join(robustness_lines(made))

    effects = made.robustness.analysis.effects
    reason = {one.measure: one.not_computed for one in effects.measures}["P_max"]
    count = len(sampled)
    assert count < 8
    assert reason == f"{count} of the sampled designs have a value, of at least 8"
    assert f": {reason}." in page
    assert re.search("^P_max_simulated +not computed", page, re.MULTILINE)
    assert "no differences" not in page
    assert {one["measure"]: one["not_computed"] for one in effect_columns(effects)}["P_max"] == reason


def test_limits_on_which_a_value_is_anchored_are_named(folder, edit, filled, record_of):
    """The price list keeps the value of cost, which moves with its limit where the study is decided anew."""
    edit("studies/pick_place.yaml", "worst: 44000 USD", "worst: {requirement: SYS-004}")
    project = load_project(folder)
    measured = measure_variants(project, filled(project, lambda spec: record_of(spec, planning_s=0.2)))
    made = decide_study(project, measured, evidence="evidence.sqlite")

    assert {one.requirement: one.anchored for one in made.robustness.limits if one.anchored} == {
        "SYS-004": ("C_total",)
    }
    (price,) = [one for one in made.robustness.analysis.prices if one.anchored]
    kept = step_at(price.steps, 45000.0, at_least=False).value
    scenario = suppose(project, ["SYS-004.threshold=45000 USD"])
    moved = choose(scenario.project, measured_in(scenario, measured))
    assert moved.ranking[0].value > kept + 0.01
    sentence = "(SYS-004: C_total): rgss trade --what-if SYS-004.threshold=… answers for both."
    assert sentence in "\n".join(robustness_lines(made))
    assert any(one.endswith(sentence) for one in decision_part(made)["limit_sentences"])
    document = robustness_to_json(made.robustness.analysis)
    assert {one["requirement"]: one["values_kept"] for one in document["prices"] if one["values_kept"]} == {
        "SYS-004": ["C_total"]
    }


def test_limits_with_the_tolerance_say_what_a_supposition_takes(shipped, filled, record_of):
    """A limit of the table, taken as the requirement, changes nothing yet; its share without the tolerance does."""
    trade_off = replace(shipped.study.trade_off, tolerance=0.1)
    project = replace(shipped, study=replace(shipped.study, trade_off=trade_off))
    measured = measure_variants(
        project, filled(project, lambda spec: record_of(spec, planning_s=0.5 + 0.01 * spec.variant))
    )
    made = decide_study(project, measured, evidence="evidence.sqlite")
    sentence = "1.1 times an upper one and 0.9 times a lower one of the requirement, which is what --what-if takes."
    assert sentence in "\n".join(robustness_lines(made))
    assert any(one.endswith(sentence) for one in decision_part(made)["limit_sentences"])

    tolerated = {one.requirement: one for one in made.robustness.limits if one.is_tolerated}
    assert {"SYS-024", "SYS-033"} <= set(tolerated)
    assert not {"SYS-004", "SYS-012"} & set(tolerated)
    move = tolerated["SYS-033"].tighter
    within = (1.0 - 1e-6) * move.limit

    def chosen(threshold):
        scenario = suppose(project, [f"SYS-033.threshold={threshold} s"])
        return choose(scenario.project, measured_in(scenario, measured)).chosen

    assert chosen(within) == made.decision.chosen
    assert chosen(within / 1.1) != made.decision.chosen


def test_limits_without_anchors_have_no_such_sentence(shipped, filled, record_of):
    measured = measure_variants(shipped, filled(shipped, lambda spec: record_of(spec, planning_s=0.2)))
    made = decide_study(shipped, measured, evidence="evidence.sqlite")
    assert "moves as a demand alone" not in "\n".join(robustness_lines(made))


def test_a_constraint_on_an_assumed_number_is_followed_by_steps(folder, edit, filled, record_of):
    """Fingers of 10 N need an actuator of at least 12 N by this rule: its force may fall to that and no further."""
    edit(
        "designs/grasping_system.yaml",
        "rules:\n",
        "rules:\n  - id: reserve\n    rationale: A reserve of a fifth.\n"
        "    constraint: component.finger_actuator.force >= 1.2 * design.d5\n",
    )
    project = load_project(folder)
    measured = measure_variants(project, filled(project, record_of))
    problem = trade_problem(project, measured)
    remeasuring = Remeasuring.of(project, measured, tabulated(problem.alternatives))
    chosen = remeasuring.table.row_of(choose(project, measured).chosen)
    found = assumption_findings(remeasuring, problem, chosen)
    force = next(one for one in found if one.number.id == "catalogue.ka-58.force")

    assert force.range.low == pytest.approx(12.0)
    assert (force.range.exact, force.range.below) == (False, ())
