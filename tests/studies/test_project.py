"""Finding and reading a project: all problems of all files at once."""

from __future__ import annotations

import pytest

from rgss.errors import DefinitionError
from rgss.findings import Severity
from rgss.studies import find_project
from rgss.studies.project import load_project

STUDY = "studies/pick_place.yaml"


def test_the_shipped_project_is_sound(shipped):
    assert len(shipped.designs.expand()) == 72
    assert shipped.scene.id == "restaurant"
    assert sorted(shipped.grippers) == ["scenes/grippers/kg-2.yaml", "scenes/grippers/kg-3.yaml"]
    assert {file.geometry.fingers for file in shipped.grippers.values()} == {2, 3}
    assert (shipped.study.id, shipped.study.label) == ("pick_place", STUDY)
    assert shipped.evidence == shipped.folder / ".rgss" / "evidence.sqlite"
    assert [finding for finding in shipped.check() if finding.severity is not Severity.INFO] == []


def test_a_project_is_found_by_name_and_from_within(folder, monkeypatch):
    assert find_project(folder) == folder
    monkeypatch.chdir(folder / "scenes" / "robots")
    assert find_project(None) == folder


def test_a_folder_that_is_no_project(tmp_path):
    (tmp_path / "requirements").mkdir()

    with pytest.raises(DefinitionError) as caught:
        find_project(tmp_path)
    assert caught.value.message == f"{str(tmp_path)!r} is not a project: it has no folder designs/"
    assert caught.value.hint == "a project has requirements/, designs/, scenes/, studies/"


def test_no_project_here_or_above(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    with pytest.raises(DefinitionError, match=r"no project here or above \(go into a project or name it"):
        find_project(None)


def test_a_name_that_no_folder_can_have(tmp_path):
    with pytest.raises(DefinitionError, match="is not a project"):
        find_project(tmp_path / ("x" * 5000))


@pytest.mark.verifies("SYS-027")
def test_problems_of_all_files_are_reported_at_once(edit, problems):
    edit("requirements/system/1-manipulator.yaml", "id: SYS-002", "id: SYS-001")
    edit("requirements/measures.yaml", "value: 48 mm", "value: 48 kg")
    edit("designs/catalogue.yaml", "components:", "spare: 1\ncomponents:")
    edit("designs/grasping_system.yaml", "d4: 0.04 m/s", "d4: 0.04")
    edit("scenes/restaurant.yaml", "radius: 35 mm", "radius: 35")
    edit("scenes/robots/ur10.yaml", "description: ur10.urdf", "description: ur11.urdf")
    edit("scenes/grippers/kg-2.yaml", "stroke: 48 mm", "stroke: 48 s")
    edit(STUDY, "seed: 1", "seed: -1")

    # The design space is matched with the catalogue, and grippers are those of the designs: both could not be read.
    assert [text.split(":")[0] for text in problems()] == [
        "designs/catalogue.yaml",
        "requirements/measures.yaml",
        "requirements/system/1-manipulator.yaml",
        "scenes/restaurant.yaml",
        STUDY,
    ]


@pytest.mark.verifies("SYS-027")
def test_what_a_study_names_is_read_even_if_the_study_is_wrong(edit, problems, place_of):
    edit("designs/grasping_system.yaml", "d4: 0.04 m/s", "d4: 0.04")
    edit("scenes/grippers/kg-2.yaml", "base:", "spare: 1\nbase:")
    edit("scenes/robots/ur10.yaml", "flange: flange", "flange: hand")
    edit(STUDY, "seed: 1", "sead: 1")

    # Grippers are those of the designs, which could not be read.
    assert [text.split(": ")[0] for text in problems()] == [
        place_of("designs/grasping_system.yaml", "0.04"),
        place_of("scenes/robots/ur10.yaml", "hand"),
        place_of(STUDY, "sead"),
    ]


@pytest.mark.verifies("SYS-027")
@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        (
            "requirements/system/1-manipulator.yaml",
            "measure: C_total, statistic",
            "measure: C_totl, statistic",
            "error: criterion of 'SYS-004' bounds 'C_totl', which is not a measure (known measures: P_max,",
        ),
        (
            "requirements/system/2-gripper.yaml",
            'threshold: "3 s"',
            'threshold: "3 kg"',
            "error: criterion of 'SYS-009' has the unit 'kg', but 't_gc_simulated' is measured in 's' (give the",
        ),
    ],
)
def test_a_criterion_that_no_evidence_can_decide(edit, problems, file, old, new, expected):
    edit(file, old, new)

    (problem,) = problems()
    assert problem.startswith(f"{file}:")
    assert expected in problem


def test_a_study_is_named_relative_to_the_project_or_to_here(folder, edit, monkeypatch, tmp_path):
    edit(STUDY, "study: pick_place", "study: other")
    (folder / STUDY).rename(folder / "studies" / "other.yaml")

    assert load_project(folder, "studies/other.yaml").study.id == "other"
    monkeypatch.chdir(folder / "studies")
    assert load_project(folder, "other.yaml").study.label == "studies/other.yaml"
    (folder / "studies" / "deep").mkdir()
    (folder / "studies" / "other.yaml").rename(folder / "studies" / "deep" / "other.yaml")
    assert load_project(folder, "studies/deep/other.yaml").study.id == "other"
    (folder / "studies" / "deep" / "other.yaml").rename(tmp_path / "elsewhere.yaml")
    assert load_project(folder, str(tmp_path / "elsewhere.yaml")).study.label == str(tmp_path / "elsewhere.yaml")


def test_the_default_study_is_that_of_the_project_wherever_one_stands(folder, problems, shipped, monkeypatch):
    for path in (folder / "studies").glob("*.yaml"):
        path.unlink()
    monkeypatch.chdir(shipped.folder)

    assert problems() == [f"{STUDY}:1:1: error: no such file (check the name and --project) [document.missing]"]


@pytest.mark.parametrize("name", ["studies/nothing.yaml", "x" * 5000, "a\0b"])
def test_a_study_that_is_not_there(problems, name):
    (problem,) = problems(name)

    assert ":1:1: error: " in problem


def test_another_number_of_replicates(shipped):
    more = shipped.with_replicates(5)

    assert more.study.seeds == (1, 2, 3, 4, 5)
    assert shipped.study.replicates == 3


def test_measures_are_traced_to_where_they_stand(shipped):
    lines = (shipped.folder / "requirements/measures.yaml").read_text(encoding="utf-8").splitlines()

    assert [trace.id for trace in shipped.measure_traces] == [measure.id for measure in shipped.measures.measures]
    for trace in shipped.measure_traces:
        assert trace.file == "requirements/measures.yaml"
        assert lines[trace.line - 1][trace.column - 1 :].startswith(trace.id)


@pytest.mark.parametrize(
    ("file", "named_in", "expected"),
    [
        ("scenes/restaurant.yaml", "studies/pick_place.yaml", "'scenes/restaurant.yaml' lies outside the project"),
        ("scenes/robots/ur10.yaml", "scenes/restaurant.yaml", "'robots/ur10.yaml' leads out of the project"),
        ("scenes/robots/ur10.urdf", "scenes/robots/ur10.yaml", "'ur10.urdf' leads out of the project"),
        ("scenes/grippers/kg-2.yaml", "designs/catalogue.yaml", "geometry 'scenes/grippers/kg-2.yaml' leads out of"),
    ],
)
def test_a_link_that_leads_out_of_the_project_is_found_where_it_is_named(
    folder, problems, tmp_path, file, named_in, expected
):
    (folder / file).rename(tmp_path / "away")
    (folder / file).symlink_to(tmp_path / "away")
    found = [finding for finding in problems() if expected in finding]
    assert found
    assert all(finding.startswith(f"{named_in}:") for finding in found)


def test_a_project_that_is_itself_reached_by_a_link_is_sound(folder, tmp_path):
    (tmp_path / "link").symlink_to(folder)
    assert load_project(tmp_path / "link").scene.id == "restaurant"


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("symbol: tau_w}", "symbol: tau_v}", "symbol: 'tau_v' is not a constant, an input or a measure (did you mean"),
        ("unit: N*m, symbol: tau_w}", "unit: kg, symbol: tau_w}", "unit: 'wrist_torque' is in 'kg', but 'tau_w' is in"),
    ],
)
def test_a_value_is_bound_to_a_symbol_of_its_dimension(edit, problems, old, new, expected):
    edit("requirements/architecture/structure.yaml", old, new)
    (problem,) = problems()

    assert problem.startswith("requirements/architecture/structure.yaml:")
    assert expected in problem
    assert problem.endswith("[requirements.symbol]")
