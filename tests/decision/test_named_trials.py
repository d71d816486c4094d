"""Which trials the studies of a project name."""

import pytest

from rgss.decision.named_trials import asked_trials, naming_studies
from rgss.errors import DefinitionError, DocumentError
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.sweep.trial_keys import key_of
from rgss.trials.code.piece_versions import versions
from rgss.trials.pieces.input_digests import digests_of

STUDY = "studies/pick_place.yaml"


def keys(project, seeds=None):
    return {key_of(spec) for spec in trial_specs(project, seeds=seeds)}


def reference(studies):
    """The reference study among those of the project."""
    (found,) = (study for study in studies if study.file == STUDY)
    return found


def test_a_study_names_its_trials_and_their_pieces(folder):
    study = reference(naming_studies(folder, {}))
    project = load_project(folder)
    assert study.file == STUDY
    assert study.own.trials == keys(project)
    # 72 variants and 3 seeds: 6 plans, 12 timings and 24 executions a seed, a bench for each gripper, and the trials.
    digests = [digests_of(spec, versions()).as_mapping() for spec in trial_specs(project)]
    assert study.own.pieces == {digest for mapping in digests for digest in mapping.values()}
    assert len({mapping["plan"] for mapping in digests}) == 18
    assert len({mapping["execution"] for mapping in digests}) == 72


def test_other_fidelities_and_more_replicates_are_named_as_far_as_there_is_evidence(folder):
    study = reference(naming_studies(folder, {"contact": {1, 2, 9, 0, 10_001}, "kinematic": {4}}))
    project = load_project(folder)
    named = keys(project) | keys(project, seeds=[9])
    # Seed 0 is before the study's first, and seed 10001 beyond the greatest number of replicates.
    assert not study.all.trials & keys(project, seeds=[0, 10_001])
    assert named < study.all.trials
    assert keys(project.with_fidelity("kinematic"), seeds=[1, 2, 3, 4]) < study.all.trials
    assert not study.all.trials & keys(project.with_fidelity("kinematic"), seeds=[9])
    assert study.own.trials == keys(project)
    assert study.own.pieces < study.all.pieces


def test_what_a_study_adds_until_decided_is_its_own(folder, edit):
    edit(STUDY, "planning:\n", "until_decided: {cap: 20}\nplanning:\n")
    study = reference(naming_studies(folder, {"contact": {1, 9, 30}}))
    project = load_project(folder)
    assert study.own.trials == keys(project) | keys(project, seeds=[9])
    assert keys(project, seeds=[30]) < study.all.trials
    # Without evidence a sweep has the study's own trials to make, and no more is known.
    assert asked_trials(study, None) == keys(project)


def test_an_edit_changes_what_is_named(folder, edit):
    before = reference(naming_studies(folder, {}))
    edit("scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.26 kg")
    after = reference(naming_studies(folder, {}))
    assert not before.own.trials & after.own.trials
    # The plans know nothing of masses.
    assert len(before.own.pieces & after.own.pieces) > 0


def test_every_study_of_the_folder_is_asked(folder):
    text = (folder / STUDY).read_text(encoding="utf-8")
    other = text.replace("study: pick_place", "study: other").replace("seed: 1", "seed: 100")
    (folder / "studies/other.yaml").write_text(other, encoding="utf-8")
    studies = naming_studies(folder, {})
    files = sorted(path.relative_to(folder).as_posix() for path in (folder / "studies").glob("*.yaml"))
    assert [study.file for study in studies] == files
    (named,) = (study for study in studies if study.file == "studies/other.yaml")
    assert not named.own.trials & reference(studies).own.trials


def test_a_study_that_cannot_be_read_may_name_anything(folder, edit):
    text = (folder / STUDY).read_text(encoding="utf-8")
    (folder / "studies/other.yaml").write_text(text.replace("seed:", "sed:", 1), encoding="utf-8")
    edit(STUDY, "replicates: 3", "replicates: none")
    with pytest.raises(DocumentError) as caught:
        naming_studies(folder, {})
    assert {finding.file for finding in caught.value.findings} == {"studies/other.yaml", STUDY}


def test_a_project_without_a_study(folder):
    for path in (folder / "studies").glob("*.yaml"):
        path.unlink()
    with pytest.raises(DefinitionError) as caught:
        naming_studies(folder, {})
    assert str(caught.value) == "the project has no study (a study is a file studies/NAME.yaml)"
