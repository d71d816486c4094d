"""``rgss measure --case``: the trials of one case of the workload."""

from __future__ import annotations

import pytest

from rgss.assessment import measure_variants, measured_in_case, success_by_case
from rgss.errors import DefinitionError
from rgss.studies import load_project

WORKLOAD = """
workload:
  - {case: cup, replicates: 2, rationale: as it is}
  - {case: full, mass: 0.6 kg, rationale: with water}
"""


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    from tests.fixtures.shipped_project import copy_project

    folder = copy_project(tmp_path_factory.mktemp("cases"))
    path = folder / "studies" / "pick_place.yaml"
    text = path.read_text(encoding="utf-8").partition("\nworkload:")
    rest = text[2].partition("\ntrade_off:")
    path.write_text(text[0] + (rest[1] + rest[2] if text[1] else "") + WORKLOAD, encoding="utf-8")
    return load_project(folder).with_replicates(3)


@pytest.fixture(scope="module")
def measured(project, filled, record_of):
    """Full cups succeed with odd designs alone."""
    from dataclasses import replace

    def record(spec):
        case = spec.workload.case_of(spec.seed).id
        return replace(record_of(spec, success=case == "cup" or bool(spec.variant % 2)), workload=case)

    return measure_variants(project, filled(project, record))


def test_the_success_of_each_case(project, measured):
    found = {one.case: (one.trials, one.successes) for one in success_by_case(project, measured)}
    assert found == {"cup": (144, 144), "full": (72, 36)}


def test_estimates_are_of_the_trials_of_the_case(project, measured):
    share = "S"
    for case, expected in (("cup", {1: 2, 2: 2}), ("full", {1: 1, 2: 1})):
        entries = {entry.variant.id: entry for entry in measured_in_case(project, measured, case)}
        for variant, trials in expected.items():
            entry = entries[variant]
            assert len(entry.records) == len(entry.trials) == trials
            assert {record.workload for record in entry.records} == {case}
    full = {entry.variant.id: entry for entry in measured_in_case(project, measured, "full")}
    assert full[1].estimates[share].value > full[2].estimates[share].value
    assert full[1].verdicts.keys() == measured[0].verdicts.keys()


def test_a_case_that_is_not_there(project, measured):
    with pytest.raises(DefinitionError, match="the workload has no case 'bowl'") as caught:
        measured_in_case(project, measured, "bowl")
    assert caught.value.hint == "cases: cup, full"


def test_a_study_without_a_workload(project, measured):
    with pytest.raises(DefinitionError, match="the study has no workload"):
        measured_in_case(project.nominal(), measured, "cup")


def test_verdicts_of_one_case_are_not_recorded(rgss, folder):
    told = rgss("measure", "--case", "cup", "--record", "--project", folder)
    assert (told.status, told.output) == (2, "")
    assert "--record needs all trials" in told.errors
