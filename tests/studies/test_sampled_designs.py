"""A project whose designs are sampled: its trials, and what needs a table of levels."""

from __future__ import annotations

import pytest

from rgss.decision.level_structure import level_structure
from rgss.errors import DefinitionError
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project

SPACE = "designs/grasping_system.yaml"
LEVELS = """\
    levels:
      - id: slow
        sets: {d7: 0.5 m/s}
      - id: fast
        sets: {d7: 1 m/s}
"""
RANGE = "    parameter: d7\n    range: [0.4 m/s, 1 m/s]\n    resolution: 0.01 m/s\n"


@pytest.fixture
def sampled(folder, edit):
    edit(SPACE, LEVELS, RANGE)
    edit(SPACE, "rules:\n", "sample: {method: sobol, size: 16, seed: 1}\n\nrules:\n")
    return folder


def test_every_sampled_design_has_its_trials(sampled):
    project = load_project(sampled)
    specs = trial_specs(project)
    assert [spec.tool_speed_m_s for spec in specs[::3]] == [one.parameters["d7"] for one in project.designs.expand()]
    assert len({spec.tool_speed_m_s for spec in specs}) > 8


def test_a_range_that_no_trial_can_have_is_found_at_its_end(sampled, edit, place_of, problems):
    edit(SPACE, "[0.4 m/s, 1 m/s]", "[0 m/s, 1 m/s]")
    assert f"{place_of(SPACE, '0 m/s, 1')}: error: d7 must be greater than zero [design.not-positive]" in problems()


def test_samples_are_no_table_of_levels(sampled):
    project = load_project(sampled)
    with pytest.raises(DefinitionError, match="levels can be chosen only where designs are combinations of levels"):
        level_structure(project.designs, project.designs.expand())
