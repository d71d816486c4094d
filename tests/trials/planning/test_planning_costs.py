"""Costs that a planner keeps low, and plans of planners with them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import PlanOutcome
from rgss.motion import Objective, OnUnverified, PlannerSettings, available_planners
from rgss.trials.code import versions
from rgss.trials.pieces import digests_of, plan_from_json
from rgss.trials.pieces.plan_json import plan_to_json
from rgss.trials.planning import plan_of, searches_of, state_cost
from rgss.trials.workcell import cell_of
from tests.fixtures.eight_states import PLANNED_PHASES

pytestmark = pytest.mark.engine

PARAMETERS = (("goal_bias", 0.2), ("range", 1.0))


def with_planner(spec, algorithm, objective=None, **changes):
    known = available_planners()[algorithm].parameters
    parameters = tuple(pair for pair in PARAMETERS if pair[0] in known)
    settings = PlannerSettings(algorithm=algorithm, parameters=parameters, objective=objective)
    planning = replace(
        spec.settings.planning,
        resolution_rad=0.05,
        verification_resolution_rad=0.01,
        on_unverified=OnUnverified.REPAIR,
        simplification_checks=0,
        **changes,
    )
    return replace(spec, planner_settings=settings, settings=replace(spec.settings, planning=planning))


def test_costs_of_a_state(spec_of):
    cell = cell_of(spec_of())
    phase = PLANNED_PHASES[0]
    q = np.array(cell.scene.robot.home_rad)
    assert state_cost(cell, phase, Objective.CLEARANCE)(q) == pytest.approx(1.0 / cell.planning[phase].clearance_m(q))
    raised = q + np.array([0.0, -0.3, 0.0, 0.0, 0.0, 0.0])
    energy_j = state_cost(cell, phase, Objective.MECHANICAL_WORK)
    lifted = cell.arm.tool_position(raised[None])[0, 2] > cell.arm.tool_position(q[None])[0, 2]
    assert (energy_j(raised) > energy_j(q)) == lifted
    assert state_cost(cell, phase, Objective.PATH_LENGTH) is None
    assert state_cost(cell, phase, None) is None


@pytest.mark.parametrize("objective", [Objective.CLEARANCE, Objective.MECHANICAL_WORK])
def test_trrt_with_a_cost_grows_another_tree_than_rrt(spec_of, objective):
    """At the same range, goal bias and seed: equal without a cost, different with one, as soon as a tree has grown."""
    rrt, free, costly = (
        searches_of(with_planner(spec_of(), algorithm, cost)).moves
        for algorithm, cost in (("RRT", None), ("TRRT", None), ("TRRT", objective))
    )
    grown = [phase for phase in PLANNED_PHASES if len(rrt[phase].path_rad) > 3]
    assert grown
    for phase in PLANNED_PHASES:
        assert free[phase].checks == rrt[phase].checks
        assert free[phase].path_rad.tobytes() == rrt[phase].path_rad.tobytes()
    for phase in grown:
        assert costly[phase].checks != rrt[phase].checks


@pytest.mark.parametrize("temperature", [100.0, 1.0])
def test_trrt_avoids_cost_from_a_temperature_at_which_transitions_are_rejected(spec_of, temperature):
    """Of paths that both planners find, TRRT's has less increase of the cost, unless it is RRT's."""
    parameters = (("goal_bias", 0.2), ("init_temperature", temperature), ("range", 1.0))
    trrt = PlannerSettings(algorithm="TRRT", parameters=parameters, objective=Objective.CLEARANCE)
    others, increases = 0, []
    for seed in (1, 2, 3, 4):
        rrt = with_planner(spec_of(seed=seed), "RRT")
        found = [searches_of(spec).moves for spec in (rrt, replace(rrt, planner_settings=trrt))]
        cell = cell_of(rrt)
        for phase in PLANNED_PHASES:
            paths = [moves[phase].path_rad for moves in found]
            if any(path is None for path in paths):
                continue
            others += paths[0].tobytes() != paths[1].tobytes()
            cost = state_cost(cell, phase, Objective.CLEARANCE)
            increases.append([np.maximum(np.diff([cost(q) for q in path]), 0.0).sum() for path in paths])
    without, with_cost = np.mean(increases, axis=0)
    if temperature == 1.0:
        assert others >= 3
        assert with_cost < 0.95 * without
    else:
        assert others <= 2


def test_a_plan_with_repairs_is_read_back(spec_of):
    plan = plan_of(with_planner(spec_of(), "RRTConnect"))
    assert all(move.outcome is PlanOutcome.SOLVED and move.verification_checks > 0 for move in plan.moves.values())
    text = plan_to_json(plan)
    assert plan_to_json(plan_from_json(text)) == text


def test_gravity_is_an_input_of_a_plan_that_works_against_it(spec_of):
    def plans(objective):
        spec = with_planner(spec_of(), "TRRT", objective)
        moon = replace(spec, scene=replace(spec.scene, gravity_m_s2=1.62))
        return {digests_of(one, versions()).plan for one in (spec, moon)}

    assert len(plans(Objective.CLEARANCE)) == 1
    assert len(plans(Objective.MECHANICAL_WORK)) == 2


def test_the_settings_of_the_planner_and_of_the_verification_are_inputs_of_a_plan(spec_of):
    spec = with_planner(spec_of(), "RRT")
    planning = spec.settings.planning
    changed = [
        replace(spec, planner_settings=spec.planned_by.with_parameter("range", 0.5)),
        with_planner(spec, "STRIDE"),
        *(
            replace(spec, settings=replace(spec.settings, planning=replace(planning, **change)))
            for change in ({"verification_resolution_rad": 0.02}, {"on_unverified": OnUnverified.FAIL})
        ),
    ]
    assert len({digests_of(one, versions()).plan for one in (spec, *changed)}) == 5


def test_searches_go_on_after_a_failure(spec_of):
    spec = with_planner(spec_of(), "RRT", search_limit_s=0.0)
    assert len(plan_of(spec).moves) == 1
    assert len(searches_of(spec).moves) == 5
