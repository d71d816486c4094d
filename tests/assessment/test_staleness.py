"""Verdicts on evidence that is older than what it is evidence for."""

from __future__ import annotations

import fcntl
import os
from collections import Counter
from dataclasses import replace

import pytest

from rgss.assessment import recording
from rgss.assessment.measuring import measure_variants, record_of, require_complete
from rgss.assessment.recorded_verdicts import VerdictRecord, read_record, update_record, write_record
from rgss.assessment.recording import record_verdicts
from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, Provenance, inputs_digest
from rgss.measures import StaleCause, Verdict
from rgss.studies.expansion import trial_specs
from rgss.studies.input_names import CODE, named_inputs
from rgss.studies.project import load_project
from rgss.sweep.trial_keys import key_of
from rgss.trials.code.piece_versions import versions

REQUIREMENT, MEASURE, MODEL = StaleCause.REQUIREMENT, StaleCause.MEASURE, StaleCause.MODEL
CODE_CHANGED, ENGINES = StaleCause.CODE, StaleCause.ENGINES
OF_TRIALS = {"SYS-005", "SYS-009", "SYS-012", "SYS-024", "SYS-033", "SYS-040"}
"""Requirements whose measure is observed in trials; the others follow from the design alone."""


@pytest.fixture(scope="module")
def evidence(shipped, record_of, tmp_path_factory):
    """A store with a made record of each trial, with the provenance that a sweep would write."""
    path = tmp_path_factory.mktemp("staleness") / "evidence.sqlite"
    with EvidenceStore.open(path) as store:
        fill(store, shipped, record_of)
        yield store


def fill(store, project, record_for, *, key=key_of, found=None, code=None):
    now = versions()
    inputs, trials = {}, []
    for spec in trial_specs(project):
        values = dict(named_inputs(spec).values)
        if code is not None:
            values[CODE] = code
        digest = inputs_digest(values)
        inputs[digest] = values
        provenance = Provenance(inputs={}, versions=found if found is not None else now, inputs_digest=digest)
        trials.append((key(spec), record_for(spec), provenance))
    store.put_many(trials=trials, inputs=inputs.values())


def elsewhere(spec):
    """The key of a trial that had something else for an input."""
    return key_of(spec)[::-1]


def stale(measured):
    """The causes of each requirement's stale verdicts, and on how many variants."""
    found = {}
    for entry in measured:
        assert {name for name, verdict in entry.verdicts.items() if verdict is Verdict.STALE} == set(entry.causes)
        for name, causes in entry.causes.items():
            found.setdefault(name, Counter())[causes] += 1
    return found


def test_evidence_of_what_is_there_is_not_stale(shipped, evidence):
    measured = measure_variants(shipped, evidence)

    assert stale(measured) == {}
    assert {entry.outdated for entry in measured} == {0}


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.26 kg"),
        ("studies/pick_place.yaml", "clearance: 8 mm", "clearance: 9 mm"),
        ("designs/grasping_system.yaml", "d4: 0.04 m/s", "d4: 0.05 m/s"),
    ],
)
def test_another_model(folder, edit, evidence, file, old, new):
    edit(file, old, new)
    measured = measure_variants(load_project(folder), evidence)

    assert stale(measured) == {name: Counter({(MODEL,): 72}) for name in OF_TRIALS}
    assert {(entry.missing, entry.outdated, entry.records) for entry in measured} == {(3, 3, ())}
    with pytest.raises(EvidenceError) as caught:
        require_complete(measured)
    assert caught.value.message == (
        "216 of 216 trials have no evidence for the project as it is now; "
        "216 of them have evidence of an earlier model, code or engine"
    )


def test_a_model_that_some_variants_share_leaves_the_others(folder, edit, evidence):
    edit("designs/grasping_system.yaml", "d7: 0.5 m/s", "d7: 0.6 m/s")
    project = load_project(folder)
    slow = {variant.id for variant in project.designs.expand() if variant.parameters["d7"] == 0.6}
    measured = measure_variants(project, evidence)

    assert len(slow) == 36
    assert {entry.variant.id for entry in measured if entry.causes} == slow


@pytest.mark.parametrize(
    ("name", "cause"),
    [("rgss-plan", CODE_CHANGED), ("pybullet", ENGINES)],
)
def test_other_code_and_engines(shipped, record_of, tmp_path, name, cause):
    found = {**versions(), name: "another"}
    code = {"rgss.trials.planning.plan": "another"} if cause is CODE_CHANGED else None
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        fill(store, shipped, record_of, key=elsewhere, found=found, code=code)
        measured = measure_variants(shipped, store)

    assert stale(measured) == {requirement: Counter({(cause,): 72}) for requirement in OF_TRIALS}


def test_evidence_whose_inputs_nobody_wrote_down(shipped, record_of, tmp_path):
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        for spec in trial_specs(shipped)[:3]:
            store.put(elsewhere(spec), record_of(spec), Provenance(inputs={}, versions=versions()))
        measured = measure_variants(shipped, store)

    assert {entry.variant.id: entry.outdated for entry in measured if entry.outdated} == {1: 3}
    assert stale(measured) == {name: Counter({(MODEL,): 1}) for name in OF_TRIALS}
    assert measured[1].verdicts["SYS-005"] is Verdict.NOT_RUN


def test_one_outdated_trial_makes_a_verdict_stale(shipped, record_of, tmp_path):
    """What is decided by three trials is not decided by the two that were made anew."""
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        for spec in trial_specs(shipped)[:3]:
            key = elsewhere(spec) if spec.seed == 2 else key_of(spec)
            store.put(key, record_of(spec), Provenance(inputs={}, versions=versions()))
        (first, *_) = measure_variants(shipped, store)

    assert (first.missing, first.outdated, len(first.records)) == (1, 1, 2)
    assert {first.verdicts[name] for name in OF_TRIALS} == {Verdict.STALE}


def test_a_trial_that_was_never_run_is_missing_and_not_outdated(shipped, evidence):
    measured = measure_variants(shipped.with_replicates(4), evidence)

    assert {(entry.missing, entry.outdated) for entry in measured} == {(1, 0)}
    assert stale(measured) == {}


def test_without_a_store_nothing_is_run(shipped):
    measured = measure_variants(shipped, None)

    assert {entry.verdicts[name] for entry in measured for name in OF_TRIALS} == {Verdict.NOT_RUN}
    assert {entry.verdicts["SYS-004"] for entry in measured} <= {Verdict.MET, Verdict.NOT_MET}


def test_trials_that_give_no_value_leave_a_requirement_open(shipped, record_of, filled):
    measured = measure_variants(shipped, filled(shipped, lambda spec: record_of(spec, success=False)))

    assert {entry.verdicts["SYS-005"] for entry in measured} == {Verdict.INCONCLUSIVE}
    assert {entry.verdicts["SYS-024"] for entry in measured} == {Verdict.NOT_MET}


@pytest.fixture(scope="module")
def recorded(shipped, evidence):
    return record_of(shipped, measure_variants(shipped, evidence), VerdictRecord())


def test_what_was_recorded_is_not_stale(shipped, evidence, recorded):
    assert stale(measure_variants(shipped, evidence, recorded=recorded)) == {}


@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        ("6-script", "threshold: 0.9", "threshold: 0.8", {"SYS-024": (REQUIREMENT,)}),
        ("6-script", "statistic: value, comparison", "statistic: low, comparison", {"SYS-024": (REQUIREMENT,)}),
        ("1-manipulator", "execute the task within", "finish the task within", {"SYS-005": (REQUIREMENT,)}),
        ("measures", "value: 145 mm", "value: 146 mm", {"SYS-012": (MEASURE,)}),
        ("measures", "Distance along the tool axis", "Distance", {"SYS-012": (MEASURE,)}),
        ("measures", "definition: Time of closing on", "definition: Time of gripping", {"SYS-009": (MEASURE,)}),
        ("1-manipulator", "owner: systems engineer", "owner: owner", {}),
        (
            "measures",
            "    definition: Time of the simulated task, planning",
            "    definition: Its time, planning",
            {"SYS-005": (MEASURE,)},
        ),
        ("measures", "name: Task execution time", "name: Time of the task", {}),
    ],
)
def test_another_requirement_or_measure(folder, edit, evidence, recorded, file, old, new, expected):
    path = "requirements/measures.yaml" if file == "measures" else f"requirements/system/{file}.yaml"
    edit(path, old, new)
    if file == "6-script" and "threshold" in new:
        edit(path, "at least 0.9", "at least 0.8")
    project = load_project(folder)

    assert stale(measure_variants(project, evidence)) == {}
    found = stale(measure_variants(project, evidence, recorded=recorded))
    assert found == {name: Counter({causes: 72}) for name, causes in expected.items()}


def test_another_price_makes_the_cost_stale(folder, edit, evidence, recorded):
    """No trial depends on a price, yet the recorded verdict was on another model."""
    edit("designs/catalogue.yaml", "34000 USD", "34001 USD")
    found = stale(measure_variants(load_project(folder), evidence, recorded=recorded))

    assert found.keys() == {"SYS-004"}
    assert found["SYS-004"].keys() == {(MODEL,)}


def test_recording_anew_accepts_what_changed(folder, edit, evidence, recorded):
    edit("requirements/system/6-script.yaml", "threshold: 0.9", "threshold: 0.99")
    edit("requirements/system/6-script.yaml", "at least 0.9", "at least 0.99")
    project = load_project(folder)
    measured = measure_variants(project, evidence, recorded=recorded)
    some = record_of(project, measured, recorded, variants={1, 2})
    everything = record_of(project, measured, recorded)

    assert {entry.variant.id for entry in measure_variants(project, evidence, recorded=some) if entry.causes} == set(
        range(3, 73)
    )
    assert stale(measure_variants(project, evidence, recorded=everything)) == {}


def test_what_is_outdated_or_not_run_is_not_recorded(folder, edit, evidence, recorded, shipped):
    nothing = record_of(shipped, measure_variants(shipped, None), VerdictRecord())
    (book,) = nothing.studies.values()
    assert not OF_TRIALS & book.keys()
    assert "SYS-004" in book

    edit("scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.26 kg")
    project = load_project(folder)
    there = {entry.variant.id: frozenset(entry.trials) for entry in measure_variants(shipped, evidence)}
    again = record_of(project, measure_variants(project, evidence, recorded=recorded), recorded, stored=there)
    assert again == recorded


def test_records_of_studies_and_fidelities_are_kept_apart(shipped, evidence, recorded):
    other = replace(shipped, study=replace(shipped.study, label="studies/other.yaml"))
    both = record_of(other, measure_variants(other, evidence), recorded)

    assert sorted(both.studies) == [
        f"studies/{name}.yaml at fidelity {shipped.study.fidelity.value}" for name in ("other", "pick_place")
    ]
    kinematic = shipped.with_fidelity("kinematic")
    assert stale(measure_variants(kinematic, evidence, recorded=recorded)) == {}


def test_a_record_survives_its_file(tmp_path, recorded):
    assert read_record(tmp_path) == VerdictRecord()
    path = write_record(tmp_path, recorded)
    content = path.read_bytes()

    assert read_record(tmp_path) == recorded
    write_record(tmp_path, read_record(tmp_path))
    assert path.read_bytes() == content
    assert [each.name for each in path.parent.iterdir()] == ["verdicts.json"]


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        ("", "is not a record of verdicts"),
        ("[]", "is not a record of verdicts"),
        ('{"schema": 1}', "is not a record of verdicts"),
        ('{"schema": 3, "studies": {}}', "has schema 3; this rgss reads 2"),
        ('{"schema": 2, "studies": {}}', "is not a record of verdicts"),
        ('{"schema": 2, "studies": {}, "evidence": {"x": []}}', "is not a record of verdicts"),
        ('{"schema": 1, "studies": {"s": {"SYS-1": {"x": {}}}}}', "is not a record of verdicts"),
        ('{"schema": 1, "studies": {"s": {"SYS-1": {"1": {"verdict": "met"}}}}}', "is not a record of verdicts"),
        (
            '{"schema":1,"studies":{"s":{"A":{"1":{"verdict":"met","requirement":"x","measure":"x","design":"x"}}}}}',
            "is not a record of verdicts",
        ),
        ("[" * 100_000, "is not a record of verdicts"),
        ("\x00", "is not a record of verdicts"),
    ],
)
def test_records_that_cannot_be_read(tmp_path, content, problem):
    path = tmp_path / ".rgss" / "verdicts.json"
    path.parent.mkdir()
    path.write_text(content, encoding="utf-8")
    with pytest.raises(EvidenceError) as caught:
        read_record(tmp_path)
    assert str(caught.value) == f".rgss/verdicts.json {problem} (remove it and run 'rgss measure --record')"


def test_a_record_that_cannot_be_written(tmp_path, recorded):
    (tmp_path / ".rgss").write_text("a file", encoding="utf-8")
    with pytest.raises(EvidenceError, match=r"\.rgss/verdicts\.json cannot be written: File exists"):
        write_record(tmp_path, recorded)


@pytest.fixture
def swept(folder, record_of):
    """A copy with the evidence of all trials, as after a sweep."""
    project = load_project(folder)
    with EvidenceStore.open(project.evidence) as store:
        fill(store, project, record_of)
        yield store


def test_recording_the_same_again_writes_nothing(folder, swept):
    project = load_project(folder)
    record_verdicts(project, swept)
    path = folder / ".rgss" / "verdicts.json"
    before = path.stat().st_mtime_ns, path.stat().st_ino

    assert record_verdicts(project, swept) == read_record(folder)
    assert (path.stat().st_mtime_ns, path.stat().st_ino) == before


def test_verdicts_that_another_process_records_meanwhile_are_kept(folder, swept, recorded, monkeypatch):
    project = load_project(folder)
    other = VerdictRecord(studies={"studies/other.yaml at fidelity contact": next(iter(recorded.studies.values()))})

    def measured_beside_another(project, store):
        write_record(folder, other)
        return measure_variants(project, store)

    monkeypatch.setattr(recording, "measure_variants", measured_beside_another)
    again = record_verdicts(project, swept)
    assert again == read_record(folder)
    assert len(again.studies) == 2
    assert other.studies.items() <= again.studies.items()


def test_two_processes_do_not_record_at_once(tmp_path, recorded):
    def change(before):
        assert before == VerdictRecord()
        descriptor = os.open(tmp_path / ".rgss", os.O_RDONLY)
        with pytest.raises(BlockingIOError):
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        os.close(descriptor)
        return recorded

    assert update_record(tmp_path, change) == recorded
    assert read_record(tmp_path) == recorded
