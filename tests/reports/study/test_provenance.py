"""What the report says of the control of the joints: that of the designs, where it acts."""

from __future__ import annotations

from rgss.reports.study.provenance import _control
from rgss.studies import load_project
from tests.fixtures.shipped_project import REPOSITORY


def test_the_control_is_that_of_each_design_where_it_moves_the_arm():
    lite6 = load_project(REPOSITORY, "studies/lite6_cubes.yaml")
    assert _control(lite6) == [["control of the joints", "velocity, position, tool tracking"]]
    yumi = load_project(REPOSITORY, "studies/yumi_widget.yaml")
    assert _control(yumi) == [["control of the joints", "computed torque"]]
    assert _control(load_project(REPOSITORY, "studies/pick_place.yaml")) == []
