"""Verdicts that sweeps record, also those that were interrupted: the evidence decides, not the run."""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import replace

import pytest

from rgss.assessment import read_record, record_after_sweep, record_verdicts
from rgss.assessment.evidence_status import trial_verdicts
from rgss.assessment.measuring import measure_variants
from rgss.decision import sweep_in_stages
from rgss.evidence import EvidenceStore, Provenance
from rgss.evidence.store import trial_names
from rgss.measures import StaleCause, Verdict
from rgss.studies import load_project, named_inputs, trial_specs
from rgss.sweep import keys_of
from rgss.trials.code.piece_versions import versions
from tests.fixtures.shipped_project import with_few_designs

REQUIREMENT, MODEL = StaleCause.REQUIREMENT, StaleCause.MODEL
LIGHTER = ("scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.24 kg")
DESIGNS = 8
REWORDED = ("requirements/system/1-manipulator.yaml", "execute the task within", "finish the task within")


@pytest.fixture
def folder(folder):
    """A copy of the shipped project with few designs, since each sweep and each look is of all."""
    return with_few_designs(folder)


@pytest.fixture
def store(folder):
    with EvidenceStore.open(load_project(folder).evidence) as store:
        yield store


@pytest.fixture
def sweep(folder, store, record_of):
    """A sweep of the project as it is, with made records; an interrupted one ends after some of the missing trials."""

    def run(*, interrupted_after=None):
        project = load_project(folder)

        def fill(specs):
            keys = keys_of(specs)
            there = store.has(keys)
            due = [(key, spec) for key, spec in zip(keys, specs, strict=True) if key not in there]
            for key, spec in due[:interrupted_after]:
                inputs = named_inputs(spec)
                origin = Provenance(inputs={}, versions=versions(), inputs_digest=inputs.digest)
                store.put_many(trials=[(key, record_of(spec), origin)], inputs=[inputs.values])
            if interrupted_after is not None:
                raise KeyboardInterrupt

        sweep_in_stages(project, project.designs.expand(), store, fill)

    return run


@pytest.fixture
def interrupted(sweep):
    def run(trials):
        with pytest.raises(KeyboardInterrupt):
            sweep(interrupted_after=trials)

    return run


@pytest.fixture
def stale(folder, store):
    """The causes of the stale verdicts on one requirement, each with the number of its variants."""

    def found(requirement):
        measured = measure_variants(load_project(folder), store, recorded=read_record(folder))
        return Counter(entry.causes[requirement] for entry in measured if requirement in entry.causes)

    return found


def test_a_resumed_sweep_records_the_variants_that_were_run_before_its_interrupt(
    folder, edit, sweep, interrupted, stale
):
    sweep()
    edit(*LIGHTER)
    edit(*REWORDED)
    assert sum(stale("SYS-005").values()) == DESIGNS

    interrupted(3 * 3)
    # The three have new evidence, of which the record knows nothing.
    assert sum(stale("SYS-005").values()) == DESIGNS - 3
    sweep()
    assert stale("SYS-005") == {}
    (book,) = read_record(folder).studies.values()
    assert len({one.basis.requirement for one in book["SYS-005"].values()}) == 1


def test_a_verdict_on_newer_evidence_does_not_contradict_the_recorded_one(folder, edit, store, sweep, interrupted):
    sweep()
    project = load_project(folder)
    measured = measure_variants(project, store, recorded=read_record(folder))
    opposite = Verdict.NOT_MET if measured[0].verdicts["SYS-024"] is Verdict.MET else Verdict.MET
    other = replace(measured[0], verdicts={**measured[0].verdicts, "SYS-024": opposite})
    contradicted = trial_verdicts(project, [other], recorded=read_record(folder))["SYS-024"].contradicted
    assert contradicted == (1,)

    edit(*LIGHTER)
    interrupted(3)
    other = replace(other, trials=measure_variants(load_project(folder), store)[0].trials)
    assert trial_verdicts(project, [other], recorded=read_record(folder))["SYS-024"].contradicted == ()


def test_new_trials_that_the_study_does_not_need_change_no_verdict(folder, edit, store, sweep, stale):
    """With fewer replicates than are stored, all that is read was there before the requirement changed."""
    sweep()
    edit(*REWORDED)
    assert stale("SYS-005") == {(REQUIREMENT,): DESIGNS}

    fewer = load_project(folder).with_replicates(2)
    recorded = read_record(folder)
    assert sum("SYS-005" in entry.causes for entry in measure_variants(fewer, store, recorded=recorded)) == DESIGNS
    record_verdicts(fewer, store)
    edit(REWORDED[0], REWORDED[2], REWORDED[1])
    # The third trial of each variant was not read for the record, but it is no newer.
    assert stale("SYS-005") == {(REQUIREMENT,): DESIGNS}


def test_a_sweep_that_makes_nothing_accepts_no_change_of_a_requirement(edit, sweep, stale):
    sweep()
    edit(*REWORDED)
    sweep()
    assert stale("SYS-005") == {(REQUIREMENT,): DESIGNS}


def test_a_sweep_that_makes_removed_trials_again_records_their_verdicts(edit, store, sweep, interrupted, stale):
    """The keys are the same, so that only the record shows that they were gone."""
    sweep()
    edit(*REWORDED)
    store.database.change("DELETE FROM trials")
    interrupted(3)
    assert stale("SYS-005") == {(REQUIREMENT,): DESIGNS - 1}
    sweep()
    assert stale("SYS-005") == {}


def test_the_evidence_before_a_change_of_a_requirement_is_older_when_the_model_is_changed_back(edit, sweep, stale):
    sweep()
    edit(*LIGHTER)
    sweep()
    edit(*REWORDED)
    assert stale("SYS-005") == {(REQUIREMENT,): DESIGNS}
    edit(LIGHTER[0], LIGHTER[2], LIGHTER[1])
    assert stale("SYS-005") == {(REQUIREMENT,): DESIGNS}


def test_a_record_that_does_not_name_its_trials_gets_those_that_are_stored(folder, edit, store, sweep, stale):
    sweep()
    path = folder / ".rgss" / "verdicts.json"
    document = json.loads(path.read_text(encoding="ascii"))
    document["schema"] = 1
    del document["evidence"]
    for book in document["studies"].values():
        for verdicts in book.values():
            for one in verdicts.values():
                del one["evidence"]
    path.write_text(json.dumps(document), encoding="ascii")
    edit(*REWORDED)
    assert stale("SYS-005") == {(REQUIREMENT,): DESIGNS}

    edit(*LIGHTER)
    sweep()
    assert stale("SYS-005") == {}
    stored = {name.key for name in trial_names(store.database)}
    found = {
        key for book in read_record(folder).studies.values() for one in book["SYS-005"].values() for key in one.evidence
    }
    assert found == stored


def test_a_sweep_after_one_that_was_killed_before_it_recorded_verdicts_records_them(folder, store, record_of):
    project = load_project(folder)
    specs = trial_specs(project)
    store.put_many(
        trials=[
            (key, record_of(spec), Provenance(inputs={}, versions=versions()))
            for key, spec in zip(keys_of(specs), specs, strict=True)
        ]
    )
    recorded = record_after_sweep(project, store)
    assert read_record(folder) == recorded
    assert {len(variants) for book in recorded.studies.values() for variants in book.values()} == {DESIGNS}
