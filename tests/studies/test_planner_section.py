"""The planners of a study, and parameters of planners that designs set."""

from __future__ import annotations

import math
import re

import pytest

from rgss.evidence import Fidelity
from rgss.motion import Objective, OnUnverified, PlannerSettings
from rgss.studies.expansion import trial_settings, trial_specs
from rgss.studies.project import load_project
from rgss.trials.code import versions
from rgss.trials.pieces import digests_of

STUDY, SPACE, CATALOGUE = "studies/pick_place.yaml", "designs/grasping_system.yaml", "designs/catalogue.yaml"
CLEARANCE = "  clearance: 8 mm\n"


def planning(edit, text):
    edit(STUDY, CLEARANCE, CLEARANCE + text)


def test_planners_of_a_study(edit, folder):
    planning(
        edit,
        """\
  verification_resolution: 5 mrad
  on_unverified: repair
  references: [RRTConnect, short, PRM]
  planners:
    RRT: {range: 600 mrad, goal_bias: 20 %, intermediate_states: true}
    TRRT: {objective: clearance, init_temperature: 50}
    STRIDE: {degree: 12}
    short: {planner: RRTConnect, range: 0.3 rad}
""",
    )
    project = load_project(folder)
    specs = {spec.planner: spec for spec in trial_specs(project, seeds=[1])}
    assert specs["RRT"].planner_settings == PlannerSettings(
        algorithm="RRT", parameters=(("goal_bias", 0.2), ("intermediate_states", 1.0), ("range", 0.6))
    )
    assert specs["TRRT"].planner_settings == PlannerSettings(
        algorithm="TRRT", parameters=(("init_temperature", 50.0),), objective=Objective.CLEARANCE
    )
    assert specs["STRIDE"].planner_settings.parameters == (("degree", 12.0),)
    settings = trial_settings(project).planning
    assert (settings.resolution_rad, settings.verified_every_rad) == (0.01, 0.005)
    assert settings.on_unverified is OnUnverified.REPAIR
    study = project.study.planning
    assert study.references == ("RRTConnect", "short", "PRM")
    assert study.planner_settings("short") == PlannerSettings(algorithm="RRTConnect", parameters=(("range", 0.3),))
    assert study.planner_settings("PRM") == PlannerSettings(algorithm="PRM")


def test_a_study_without_the_section_plans_as_ompl_does(folder):
    specs = {spec.planner: spec for spec in trial_specs(load_project(folder), seeds=[1])}
    assert {name: spec.planned_by for name, spec in specs.items()} == {
        name: PlannerSettings(algorithm=name) for name in ("RRT", "TRRT", "STRIDE")
    }


def test_the_digests_of_a_plan_follow_the_planner_and_not_its_name(edit, folder):
    before = {spec.planner: digests_of(spec, versions()) for spec in trial_specs(load_project(folder), seeds=[1])}
    planning(edit, "  planners:\n    RRT: {range: 0.6 rad}\n    STRIDE: {}\n")
    after = {spec.planner: digests_of(spec, versions()) for spec in trial_specs(load_project(folder), seeds=[1])}
    assert after["RRT"].plan != before["RRT"].plan
    assert (after["STRIDE"], after["TRRT"]) == (before["STRIDE"], before["TRRT"])


PLANNERS = [
    ("RTT: {}", "RTT", "unknown planner 'RTT' (did you mean 'RRT'? planners: ABITstar, "),
    ("SPARS: {}", "SPARS", "planner SPARS cannot be run: it looks for a solution in a second thread, by a wall clock"),
    ("long: {planner: RRTconnect}", "RRTconnect", "unknown planner 'RRTconnect' (did you mean 'RRTConnect'? "),
    ("RRT: {planner: PRM}", "RRT:", "RRT is a planner of OMPL, and cannot name PRM (choose another name, such as PRM-"),
    (
        "RRT: {goal_bais: 0.1}",
        "goal_bais",
        "RRT has no parameter 'goal_bais' (did you mean 'goal_bias'? parameters of RRT: goal_bias, intermediate_st",
    ),
    ("PRMstar: {range: 1 rad}", "range: 1 rad", "PRMstar has no parameter 'range' (parameters of PRMstar: none)"),
    ("RRT: {range: 0.6}", "0.6}", "'0.6' has no unit"),
    ("RRT: {range: 6 mm}", "6 mm", "unit 'mm' does not measure what 'rad' measures"),
    ("RRT: {range: -1 rad}", "-1 rad", "range must be at least 0 and at most 10000, got -1 (OMPL's default for RRT is"),
    (
        "RRT: {goal_bias: 1.5}",
        "1.5",
        "goal_bias must be at least 0 and at most 1, got 1.5 (OMPL's default for RRT is 0.0",
    ),
    ("RRT: {goal_bias: true}", "true", "goal_bias must be a number (write goal_bias: 0.05)"),
    ("RRT: {intermediate_states: 1}", "1}", "intermediate_states must be true or false, got '1'"),
    ("STRIDE: {degree: 2.5}", "2.5", "degree must be a whole number, got 2.5"),
    ("STRIDE: {degree: 21}", "21}", "degree must be at least 2 and at most 20, got 21"),
    (
        "TRRT: {range: 0.6 rad}",
        "TRRT:",
        "TRRT without a cost accepts every transition, as RRT does (write 'objective: cl",
    ),
    (
        "TRRT: {objective: clearence}",
        "clearence",
        "unknown objective 'clearence' (did you mean 'clearance'? objectives: path_length, clearance, mechani",
    ),
    ("RRT: {objective: clearance}", "clearance}", "RRT has no use for an objective (remove it)"),
    ("RRT: [1]", "[1]", "a planner must have its parameters by name (write {goal_bias: 0.05}, or {})"),
]


@pytest.mark.parametrize(("text", "at", "expected"), PLANNERS)
def test_planners_that_cannot_be(edit, problems, place_of, text, at, expected):
    planning(edit, f"  planners:\n    {text}\n")
    (problem,) = problems()
    place, _, message = problem.partition(": error: ")
    assert expected in message, message
    assert place == place_of(STUDY, at) or text.split(":")[0] not in message


def test_trrt_without_a_cost_must_be_meant(edit, folder):
    planning(edit, "  planners:\n    TRRT: {objective: none}\n")
    settings = load_project(folder).study.planning.planner_settings("TRRT")
    assert settings.has_no_cost


@pytest.mark.parametrize(
    ("text", "at", "expected"),
    [
        ("  planner: RTT\n", "RTT", "unknown planner 'RTT' (did you mean 'RRT'? "),
        ("  references: [PRM, RTT]\n", "RTT", "unknown planner 'RTT' (did you mean 'RRT'? "),
        ("  verification_resolution: 0 rad\n", "0 rad\n", "verification_resolution must be greater than zero"),
        (
            "  verification_resolution: 0.02 rad\n",
            "0.02 rad",
            "a path cannot be verified more coarsely than it is searched for (make it at most 'resolution')",
        ),
        ("  on_unverified: ignore\n", "ignore", "'ignore' is not one of 'fail' or 'repair'"),
    ],
)
def test_planning_that_cannot_be(edit, problems, place_of, text, at, expected):
    planning(edit, text)
    (problem,) = problems()
    assert problem.startswith(f"{place_of(STUDY, at)}: error: ")
    assert expected in problem


def test_a_resolution_beyond_the_ranges_of_the_joints(edit, problems, place_of, folder):
    """OMPL takes it as a share of the diagonal, which must be less than one."""
    extent_rad = math.hypot(*(one.upper_rad - one.lower_rad for one in load_project(folder).scene.robot.joints))
    edit(STUDY, "  resolution: 0.01 rad\n", f"  resolution: {extent_rad + 0.1:.1f} rad\n")
    (problem,) = problems()
    assert problem.startswith(f"{place_of(STUDY, f'{extent_rad + 0.1:.1f} rad')}: error: resolution of ")
    assert "is not below the diagonal of the joints' ranges" in problem


RANGE = (
    "  - {id: d30, name: range, symbol: r, unit: rad, sets: planning.planner.range, "
    "description: Longest motion of a tree.}\n"
)


def designs(edit, levels):
    edit(SPACE, "parameters:\n", f"parameters:\n{RANGE}")
    edit(SPACE, "constants:\n", f"constants:\n  d30: {levels}\n")


def test_a_design_sets_a_parameter_of_its_planner(edit, folder):
    designs(edit, "40 deg")
    planning(edit, "  planners:\n    RRT: {range: 0.2 rad, goal_bias: 0.2}\n")
    project = load_project(folder)
    specs = {spec.planner: spec for spec in trial_specs(project, seeds=[1])}
    wanted = pytest.approx(0.6981317)
    assert dict(specs["RRT"].planned_by.parameters) == {"range": wanted, "goal_bias": 0.2}
    assert dict(specs["STRIDE"].planned_by.parameters) == {"range": wanted}


def test_a_parameter_out_of_range_in_a_design(edit, problems, place_of):
    designs(edit, "-1 rad")
    problem = next(one for one in problems() if "variant" in one)
    assert problem.startswith(
        f"{place_of(SPACE, '-1 rad')}: error: variant 1: range must be at least 0 and at most 10000, got -1 "
        "(OMPL's default for RRT is 0 rad) [design.planner-parameter]"
    )


def test_a_parameter_that_the_planner_of_a_design_does_not_have(edit, problems, place_of):
    designs(edit, "1 rad")
    edit(SPACE, "sets: {d8: TRRT}", "sets: {d8: PRM}")
    edit(CATALOGUE, "matches: {d8: TRRT}", "matches: {d8: PRM}")
    (problem,) = problems()
    assert re.fullmatch(
        re.escape(f"{place_of(SPACE, '1 rad')}: error: ")
        + r"variant \d+: PRM has no parameter 'range' \(parameters of PRM: max_nearest_neighbors\) \[design.planner-.*",
        problem,
    )


def test_a_parameter_of_no_planner(edit, problems):
    edit(SPACE, "sets: planning.planner\n", "sets: planning.planner.rnge\n")
    assert any(
        "unknown quantity 'planning.planner.rnge' (did you mean 'planning.planner.range'?)" in one for one in problems()
    )


def test_fidelities_share_the_plan(edit, folder):
    planning(edit, "  planners:\n    RRT: {range: 0.6 rad}\n")
    project = load_project(folder)
    one, other = (
        digests_of(trial_specs(project.with_fidelity(fidelity), seeds=[1])[0], versions())
        for fidelity in (Fidelity.KINEMATIC.value, Fidelity.CONTACT.value)
    )
    assert one.plan == other.plan
