"""A stored trial run again: the same bits, or what changed and where the record differs."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.errors import DefinitionError, EvidenceError
from rgss.evidence import EvidenceStore, Fidelity, PhaseRecord, Provenance, record_digest
from rgss.studies.expansion import trial_specs
from rgss.studies.input_names import named_inputs
from rgss.studies.project import load_project
from rgss.sweep.input_changes import Change
from rgss.sweep.replaying import find_trial, replay
from rgss.sweep.trial_keys import key_of
from rgss.trials.code.piece_versions import versions
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.pieces.run import run_trial

NOTHING = Provenance(inputs={}, versions={})


def spec_of(project, variant=65, seed=2):
    (spec,) = trial_specs(project, variants=[project.designs.variant(variant)], seeds=[seed])
    return spec


@pytest.fixture
def store(tmp_path):
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as opened:
        yield opened


@pytest.fixture
def stored(store):
    """Runs a trial of a project and stores it, with versions that may be others than they are."""

    def run(project, *, changed_versions=None):
        spec = spec_of(project)
        record = run_trial(spec)
        were = dict(versions()) if changed_versions is None else changed_versions
        inputs = digests_of(spec, were).as_mapping()
        key = key_of(spec)
        store.put(key, record, Provenance(inputs=inputs, versions=were))
        return store.get(key)

    return run


@pytest.fixture
def kinematic(shipped):
    return shipped.with_fidelity("kinematic")


@pytest.mark.engine
@pytest.mark.parametrize("fidelity", ["kinematic", "dynamic", "contact"])
def test_a_trial_run_again_gives_the_same_bits(shipped, stored, fidelity):
    trial = stored(shipped.with_fidelity(fidelity))
    # The fidelity is the trial's own, whatever the study's is.
    result = replay(shipped, trial)
    assert result.same
    assert (result.differences, result.versions, result.inputs) == ((), (), ())
    assert result.stored is trial
    assert record_digest(result.record) == trial.content_digest
    assert result.record.fidelity is Fidelity(fidelity)


@pytest.mark.engine
def test_a_changed_design_names_the_pieces_and_every_value_that_differs(kinematic, stored, folder, edit):
    trial = stored(kinematic)
    edit("designs/grasping_system.yaml", "d4: 0.04 m/s", "d4: 0.05 m/s")
    result = replay(load_project(folder), trial)
    assert not result.same
    assert result.versions == ()
    assert result.inputs == ("execution", "trial")
    assert [change.name for change in result.differences] == [
        "phases[grasp].duration_s",
        "phases[place].duration_s",
        "phases[place].metrics.opening_s",
        "metrics.attempt_time_s",
        "metrics.grasp_cycle_time_s",
        "metrics.motion_time_s",
        "metrics.task_time_s",
    ]
    then, now = trial.record.phases[1].duration_s, result.record.phases[1].duration_s
    assert result.differences[0] == Change(name="phases[grasp].duration_s", then=repr(then), now=repr(now))
    # 35 mm at either speed.
    assert then - now == pytest.approx(0.035 / 0.04 - 0.035 / 0.05)


@pytest.mark.engine
@pytest.mark.parametrize(
    ("file", "old", "new", "inputs"),
    [
        ("studies/pick_place.yaml", "0.25 ms", "0.30 ms", ("plan", "timing", "execution", "trial")),
        ("designs/grasping_system.yaml", "d7: 1 m/s", "d7: 0.9 m/s", ("timing", "execution", "trial")),
        ("designs/grasping_system.yaml", "d9: 6 s", "d9: 5 s", ("trial",)),
    ],
)
def test_the_first_piece_whose_inputs_changed_is_named_with_those_after_it(
    kinematic, stored, folder, edit, file, old, new, inputs
):
    trial = stored(kinematic)
    edit(file, old, new)
    assert replay(load_project(folder), trial).inputs == inputs


@pytest.mark.engine
def test_inputs_that_the_store_has_kept_are_told_by_their_names(kinematic, stored, folder, edit):
    trial = stored(kinematic)
    then = named_inputs(spec_of(kinematic)).values
    edit("designs/grasping_system.yaml", "d4: 0.04 m/s", "d4: 0.05 m/s")
    changed = load_project(folder)

    assert replay(changed, trial, inputs=then).changes == (
        Change(name="gripper.finger_velocity_m_s", then="0.04", now="0.05"),
    )
    assert replay(changed, trial).changes == ()
    assert replay(kinematic, trial, inputs={**then, "code": {}}).changes == ()


@pytest.mark.engine
def test_versions_that_name_one_source_for_all_pieces_say_nothing_of_a_piece(kinematic, stored):
    were = {"ompl": versions()["ompl"], "rgss-source": "a" * 64}
    result = replay(kinematic, stored(kinematic, changed_versions=were))

    assert (result.same, result.inputs) == (True, ())
    assert Change(name="rgss-source", then="a" * 64, now="–") in result.versions


@pytest.mark.engine
def test_inputs_that_do_not_matter_to_the_result_are_named_all_the_same(kinematic, stored, folder, edit):
    trial = stored(kinematic)
    edit("scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.20 kg")
    result = replay(load_project(folder), trial)
    assert result.same
    assert result.inputs == ("execution", "trial")


@pytest.mark.engine
def test_versions_that_differ_are_named(kinematic, stored):
    were = {**versions(), "ompl": "1.6.0", "an-engine-of-old": "0.1"}
    coal = were.pop("coal")
    result = replay(kinematic, stored(kinematic, changed_versions=were))
    assert result.versions == (
        Change(name="an-engine-of-old", then="0.1", now="–"),
        Change(name="coal", then="–", now=coal),
        Change(name="ompl", then="1.6.0", now=versions()["ompl"]),
    )
    # Apart from the versions everything is as it was.
    assert (result.same, result.inputs) == (True, ())


@pytest.mark.engine
def test_a_difference_is_found_wherever_it_is(kinematic, stored, monkeypatch):
    trial = stored(kinematic)
    record = trial.record
    monkeypatch.setattr("rgss.sweep.replaying.run_trial", lambda spec: record)
    first, *others = record.phases
    emptied = PhaseRecord(phase=first.phase, outcome=first.outcome, duration_s=first.duration_s, metrics={})
    planned = (replace(record.planning[0], checks=record.planning[0].checks + 1), *record.planning[1:])
    variations = {
        "failure_detail": replace(record, failure_detail="something"),
        "planning[move_to_grasp].checks": replace(record, planning=planned),
        "phases[move_to_grasp].metrics.tracking_error_m": replace(record, phases=(emptied, *others)),
        "metrics.slip_m": replace(record, metrics={**record.metrics, "slip_m": -0.0}),
        "metrics.motion_time_s": replace(
            record, metrics={**record.metrics, "motion_time_s": record.metrics["motion_time_s"] * (1 + 2e-16)}
        ),
        "metrics.extra": replace(record, metrics={**record.metrics, "extra": ()}),
    }
    for name, other in variations.items():
        result = replay(kinematic, replace(trial, record=other, content_digest=record_digest(other)))
        assert not result.same, name
        assert name in [change.name for change in result.differences]


def test_a_variant_that_is_gone_is_refused(kinematic, record_of, store):
    record = replace(record_of(spec_of(kinematic)), variant=99)
    store.put("a" * 64, record, NOTHING)
    with pytest.raises(DefinitionError) as caught:
        replay(kinematic, store.get("a" * 64))
    assert str(caught.value) == "unknown variant 99 (ids of variants: from 1 to 72)"


def put(store, record, key, provenance=NOTHING):
    store.put(key, record, provenance)


def test_a_trial_is_found_by_the_beginning_of_its_key(shipped, record_of, store):
    put(store, record_of(spec_of(shipped)), "ab" * 32)
    put(store, record_of(spec_of(shipped, seed=3)), "abcdef" + "0" * 58)
    assert find_trial(shipped, store, "ababab").key == "ab" * 32
    assert find_trial(shipped, store, "abcdef0").record.seed == 3
    assert find_trial(shipped, store, "ab" * 32).record.seed == 2


def test_a_trial_is_found_by_its_variant_and_seed(shipped, record_of, store):
    for variant, seed, key in ((28, 1, "a"), (28, 11, "b"), (2, 81, "c")):
        put(store, record_of(spec_of(shipped, variant, seed)), key * 64)
    assert find_trial(shipped, store, "28/1").key == "a" * 64
    assert find_trial(shipped, store, "28/11").key == "b" * 64
    assert find_trial(shipped, store, "2/81").key == "c" * 64


def test_the_fidelity_is_the_studys(shipped, kinematic, record_of, store):
    put(store, record_of(spec_of(shipped)), "a" * 64)
    put(store, record_of(spec_of(kinematic)), "b" * 64)
    assert find_trial(shipped, store, "65/2").key == "a" * 64
    assert find_trial(kinematic, store, "65/2").key == "b" * 64


def test_evidence_of_the_present_versions_comes_first(shipped, record_of, store):
    record = record_of(spec_of(shipped))
    old = Provenance(inputs={}, versions={**versions(), "ompl": "1.6.0"})
    put(store, record, "a" * 64, old)
    assert find_trial(shipped, store, "65/2").key == "a" * 64
    put(store, record, "b" * 64, Provenance(inputs={}, versions=versions()))
    assert find_trial(shipped, store, "65/2").key == "b" * 64


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("28/", "'28/' names no trial (write a variant and a seed, such as 28/1)"),
        ("/1", "'/1' names no trial (write a variant and a seed, such as 28/1)"),
        ("x/1", "'x/1' names no trial (write a variant and a seed, such as 28/1)"),
        ("28/-1", "'28/-1' names no trial (write a variant and a seed, such as 28/1)"),
        ("28/1/2", "'28/1/2' names no trial (write a variant and a seed, such as 28/1)"),
        ("", "'' names no trial (give 6 digits of its key or more, or 28/1)"),
        ("abcde", "'abcde' names no trial (give 6 digits of its key or more, or 28/1)"),
        ("66/2", "there is no trial '66/2' in the evidence (run 'rgss sweep' first)"),
        ("65/3", "there is no trial '65/3' in the evidence (run 'rgss sweep' first)"),
        ("ffffff", "there is no trial 'ffffff' in the evidence (run 'rgss sweep' first)"),
        ("ABABAB", "there is no trial 'ABABAB' in the evidence (run 'rgss sweep' first)"),
        ("65/2", "2 trials go by '65/2' (name one by its key: abababababab, ababcdcdcdcd)"),
    ],
)
def test_what_names_no_trial_or_several_is_refused(shipped, record_of, store, name, text):
    put(store, record_of(spec_of(shipped)), "ab" * 6 + "c" * 52)
    put(store, record_of(spec_of(shipped)), "abab" + "cd" * 30)
    with pytest.raises(EvidenceError) as caught:
        find_trial(shipped, store, name)
    assert str(caught.value) == text


def test_a_key_that_begins_several_is_refused_with_some_of_them(shipped, record_of, store):
    for digit in "012345":
        put(store, record_of(spec_of(shipped)), "abcdef" + digit * 58)
    with pytest.raises(EvidenceError) as caught:
        find_trial(shipped, store, "abcdef")
    shown = ", ".join("abcdef" + digit * 6 for digit in "0123")
    assert str(caught.value) == f"6 trials go by 'abcdef' (name one by its key: {shown})"
