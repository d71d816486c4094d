"""What the report says of a study: the control of the joints, and the rate of the physics, where they act."""

from __future__ import annotations

from rgss.evidence import Fidelity
from rgss.reports.study.provenance import _control, provenance_of
from rgss.studies import load_project
from tests.fixtures.shipped_project import REPOSITORY


def test_the_control_is_that_of_each_design_where_it_moves_the_arm():
    lite6 = load_project(REPOSITORY, "studies/lite6_cubes.yaml")
    assert _control(lite6) == [["control of the joints", "velocity, position, tool tracking"]]
    yumi = load_project(REPOSITORY, "studies/yumi_widget.yaml")
    assert _control(yumi) == [["control of the joints", "computed torque"]]
    assert _control(load_project(REPOSITORY, "studies/pick_place.yaml")) == []


def test_a_study_without_physics_has_no_rate_of_its_steps():
    project = load_project(REPOSITORY, "studies/pick_place.yaml")
    for fidelity in Fidelity:
        found = provenance_of(project.with_fidelity(fidelity), [], None, evidence="the store")
        assert ("physics steps" in dict(found["study"])) == (fidelity is not Fidelity.KINEMATIC)
