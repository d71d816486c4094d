"""What measures take their inputs from is there and measures the same."""

from __future__ import annotations

import pytest

MEASURES = "requirements/measures.yaml"

SOURCES = [
    (
        "v_d, source: design.d7",
        "v_d, source: design.d77",
        "design.d77",
        "v_d: the designs have no 'design.d77' (did you mean 'design.d7'?) [measures.unknown-source]",
    ),
    (
        "component.planner.cost",
        "component.planer.cost",
        "component.planer",
        "c_al: the designs have no 'component.planer.cost' (did you mean 'component.planner.cost'?)",
    ),
    (
        "N_f, source: design.d1",
        "N_f, source: design.number_of_fingers",
        "design.number_of_fingers",
        "N_f: the designs have no 'design.number_of_fingers' (sources: design.d1, design.d2, design.d3,",
    ),
    (
        "trial.slip_m",
        "trial.slipp_m",
        "trial.slipp_m",
        "slip_distance: the trials have no 'trial.slipp_m' (did you mean 'trial.slip_m'?)",
    ),
    (
        "trial.joint_work_j",
        "trial.energy",
        "trial.energy",
        "joint_work: the trials have no 'trial.energy' (did you mean 'trial.joint_work_j'",
    ),
    (
        "trial.peak_tool_speed_m_s",
        "trial.greatest_speed_of_grasp_centre",
        "trial.greatest_speed",
        "tool_speed: the trials have no 'trial.greatest_speed_of_grasp_centre' (did you mean",
    ),
    (
        "trial.success",
        "trial.zzz",
        "trial.zzz",
        "success: the trials have no 'trial.zzz' ('rgss check --explain measures.unknown-source' lists all)",
    ),
    (
        "N_f, source: design.d1",
        "N_f, source: design.d8",
        "design.d8",
        "N_f: 'design.d8' is a name, not a number [measures.source-unit]",
    ),
    (
        "v_d, source: design.d7,",
        "v_d, source: design.d6,",
        "m/s, definition: Largest speed of the tool.}",
        "v_d: 'design.d6' is measured in '1', not in 'm/s' (correct the source or the unit)",
    ),
    (
        "trial.slip_m,",
        "trial.place_tilt_rad,",
        "m, definition: Distance that the object slipped",
        "slip_distance: 'trial.place_tilt_rad' is measured in 'rad', not in 'm'",
    ),
    (
        "trial.task_time_s,",
        "trial.planning_time_s,",
        "{id: task_time,",
        "task_time: 'trial.planning_time_s' is a row of 5 (write 'length: 5') [measures.source-length]",
    ),
    (
        "trial.path_length_m,",
        "trial.slip_m,",
        "{id: path_length,",
        "path_length: 'trial.slip_m' is one number (remove 'length') [measures.source-length]",
    ),
]


@pytest.mark.parametrize(("old", "new", "at", "expected"), SOURCES)
def test_a_source_that_is_not_there_or_measures_something_else(edit, problems, place_of, old, new, at, expected):
    edit(MEASURES, old, new)

    (problem,) = problems()
    assert problem.startswith(f"{place_of(MEASURES, at)}: error: {expected}")


def test_sources_of_the_best_likeness_have_their_meaning(edit, problems):
    edit(MEASURES, "trial.joint_work_j", "trial.energy")

    (problem,) = problems()
    assert problem.endswith(
        "or 'trial.joint_net_work_j' (net work of the joints with full recuperation, the sum of ∫τ q̇ dt)? "
        "'rgss check --explain measures.unknown-source' lists all) [measures.unknown-source]"
    )
