"""Sweeps: each piece once, the same records however they are run, and nothing lost."""

from __future__ import annotations

import contextlib
import itertools
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path

import pytest

from rgss.errors import DefinitionError, EvidenceError
from rgss.evidence import EvidenceStore, Failure, RunFailure, RunFailureKind, record_digest
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.sweep import evidence_writer as keeping
from rgss.sweep.evidence_writer import Origin, origin_of
from rgss.sweep.results import LostTrials
from rgss.sweep.running import sweep
from rgss.sweep.trial_keys import key_of, trials_of
from rgss.sweep.workers import WorkerPool
from rgss.trials.code.piece_versions import versions
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.pieces.run import run_trial

DOUBLES = Path(__file__).parent / "doubles"
GIB = 1024**3


@pytest.fixture
def doubles(monkeypatch, tmp_path):
    marks = tmp_path / "marks"
    marks.mkdir()
    monkeypatch.setenv("WORKER_DOUBLES_FOLDER", str(marks))
    monkeypatch.syspath_prepend(DOUBLES)
    import worker_doubles

    return worker_doubles


@pytest.fixture
def marks(tmp_path):
    """How many tasks of each kind have left a mark."""
    return lambda: Counter(file.name.partition("-")[0] for file in (tmp_path / "marks").iterdir())


@pytest.fixture
def opened(tmp_path):
    """Opens stores by their names."""
    with contextlib.ExitStack() as stack:
        yield lambda name="evidence": stack.enter_context(EvidenceStore.open(tmp_path / f"{name}.sqlite"))


@pytest.fixture
def store(opened):
    return opened()


@pytest.fixture
def specs_of(shipped):
    """Makes the trials of some variants with some seeds."""

    def make(*variants, seeds=(1,), fidelity="contact"):
        chosen = [shipped.designs.variant(number) for number in variants]
        return trial_specs(shipped.with_fidelity(fidelity), variants=chosen, seeds=seeds)

    return make


@pytest.fixture
def run(doubles):
    """Sweeps in this process with quick doubles unless told otherwise; returns what was told and the result."""

    def go(specs, store, **options):
        finished = []
        options = {"jobs": 0, "maker": doubles.quick, **options}
        return finished, sweep(specs, store, on_finished=finished.append, **options)

    return go


def digests_in(store):
    return {trial.key: trial.content_digest for trial in store.all()}


def test_keys_are_distinct_and_stable(shipped, folder):
    specs = trial_specs(shipped)
    keys = [key_of(spec) for spec in specs]

    assert len(set(keys)) == 216
    assert [trial.key for trial in trials_of(specs)] == keys
    # The same project elsewhere has the same keys, and other replicates do not change them.
    elsewhere = load_project(folder).with_replicates(4)
    assert [key_of(spec) for spec in trial_specs(elsewhere) if spec.seed < 4] == keys


def test_a_change_of_the_scene_changes_the_keys(shipped, folder, edit):
    edit("scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.26 kg")
    before, after = ([key_of(spec) for spec in trial_specs(each)] for each in (shipped, load_project(folder)))

    assert not {*before} & {*after}


def test_what_is_kept_is_told_and_not_run(shipped, filled, record_of, run):
    store = filled(shipped, record_of)
    specs = trial_specs(shipped)
    finished, result = run(specs, store, maker=lambda *_: pytest.fail("something was made"))

    assert [trial.key for trial in finished] == [key_of(spec) for spec in specs]
    assert {trial.fresh for trial in finished} == {False}
    assert (result.made, result.reused, result.lost) == ({}, {}, ())


def test_a_trial_that_is_asked_for_twice_is_run_once(specs_of, run, store):
    finished, _ = run([*specs_of(65), *specs_of(65)], store)

    assert len(finished) == len(store) == 1


@pytest.mark.verifies("SYS-032")
def test_every_piece_is_made_once_and_kept(shipped, run, store, doubles):
    specs = trial_specs(shipped, seeds=[1])
    asked = []

    def counting(task, needed):
        asked.append(task.digest)
        return doubles.quick(task, needed)

    finished, result = run(specs, store, maker=counting)

    assert result.made == {"plan": 6, "timing": 12, "execution": 24, "bench": 4}
    assert len(asked) == len(set(asked)) == 46
    assert store.has_pieces(asked) == set(asked)
    assert len(finished) == len(store) == 72
    assert 0.0 < result.busy_s < result.elapsed_s


@pytest.mark.verifies("SYS-026")
def test_only_what_is_missing_is_run(specs_of, store, run):
    first, _ = run(specs_of(1, 65), store)
    both, result = run(specs_of(1, 2, 65, seeds=(1, 2)), store)

    assert [trial.fresh for trial in first] == [True, True]
    assert [trial.record.variant for trial in both if not trial.fresh] == [1, 65]
    assert sorted((trial.record.variant, trial.record.seed) for trial in both if trial.fresh) == [
        (1, 2),
        (2, 1),
        (2, 2),
        (65, 2),
    ]
    assert len(store) == 6
    # Variant 2 is variant 1 with another planning limit, and a bench has no seed.
    assert result.made == {"plan": 2, "timing": 2, "execution": 2}
    assert result.reused == {"plan": 1, "timing": 1, "execution": 1, "bench": 2}


EDITS = {
    "the workpiece's mass": ("scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.26 kg", {"execution": 24}),
    "friction of the pads": (
        "designs/grasping_system.yaml",
        "d6: 0.7",
        "d6: 0.6",
        {"execution": 24, "bench": 4},
    ),
    "a planning limit": ("designs/grasping_system.yaml", "d9: 6 s", "d9: 5 s", {}),
    "a tool speed": ("designs/grasping_system.yaml", "d7: 1 m/s", "d7: 0.9 m/s", {"timing": 6, "execution": 12}),
    "the study's fidelity": ("studies/pick_place.yaml", "fidelity: contact", "fidelity: dynamic", {"execution": 24}),
}


@pytest.mark.verifies("SYS-026")
@pytest.mark.parametrize("name", EDITS)
def test_an_edit_makes_anew_what_depends_on_it_and_nothing_else(shipped, folder, edit, store, run, name):
    file, old, new, expected = EDITS[name]
    run(trial_specs(shipped, seeds=[1]), store)
    edit(file, old, new)
    finished, result = run(trial_specs(load_project(folder), seeds=[1]), store)

    assert result.made == expected
    changed = {trial.record.variant for trial in finished if trial.fresh}
    assert len(changed) == {"a planning limit": 24, "a tool speed": 36}.get(name, 72)


UNSEEN = {
    "a colour": ("scenes/restaurant.yaml", 'colour: "#6b625b"', 'colour: "#123456"'),
    "the price of a gripper": ("designs/catalogue.yaml", "      value: 5200 USD", "      value: 5300 USD"),
}


@pytest.mark.parametrize("name", UNSEEN)
def test_what_no_trial_sees_makes_nothing_anew(shipped, folder, edit, store, run, name):
    run(trial_specs(shipped, seeds=[1]), store)
    edit(*UNSEEN[name])
    changed = load_project(folder)
    finished, result = run(trial_specs(changed, seeds=[1]), store)

    assert (changed.scene, changed.designs) != (shipped.scene, shipped.designs)
    assert result.made == {}
    assert {trial.fresh for trial in finished} == {False}


def test_a_trial_says_where_it_comes_from(specs_of, store, run, shipped):
    run(specs_of(1, 65), store, origin=lambda: Origin(files={"a.yaml": "b" * 64}, revision="r", machine="m"))
    spec = specs_of(65)[0]
    provenance = store.get(key_of(spec)).provenance

    assert provenance.inputs == digests_of(spec, versions()).as_mapping()
    assert {*provenance.inputs} == {"plan", "timing", "execution", "bench", "trial"}
    assert provenance.versions == versions()
    assert (provenance.files, provenance.revision, provenance.machine) == ({"a.yaml": "b" * 64}, "r", "m")
    inputs = store.inputs(provenance.inputs_digest)
    assert inputs["scene"]["workpiece"]["mass_kg"] == spec.scene.workpiece.mass_kg
    assert inputs["planning_limit_s"] == spec.planning_limit_s


def test_the_origin_of_a_project_is_its_files_and_this_machine(folder):
    origin = origin_of(folder, "studies/pick_place.yaml")

    assert {"studies/pick_place.yaml", "scenes/restaurant.yaml"} <= {*origin.files}
    assert origin.machine
    assert origin.study == "studies/pick_place.yaml"


def test_a_sweep_with_nothing_to_run_asks_for_no_origin(shipped, filled, record_of, run):
    run(trial_specs(shipped), filled(shipped, record_of), origin=lambda: pytest.fail("asked"))


@pytest.mark.verifies("SYS-026")
def test_what_was_finished_before_an_interrupt_is_kept(specs_of, store, run, doubles):
    made = []

    def breaks_after_nine(task, needed):
        if len(made) == 9:
            raise KeyboardInterrupt
        made.append(task.digest)
        return doubles.quick(task, needed)

    # Two plans, three timings, three executions, two benches.
    specs = specs_of(1, 2, 3, 10, 19)
    with pytest.raises(KeyboardInterrupt):
        run(specs, store, maker=breaks_after_nine)

    assert store.has_pieces(made) == set(made)
    assert len(store) >= 3
    finished, result = run(specs, store)
    assert 9 + sum(result.made.values()) == 10
    assert len(finished) == len(store) == 5


def test_another_result_for_the_same_piece_is_an_error(specs_of, opened, run, doubles, monkeypatch):
    store = opened()
    run(specs_of(65), store)
    monkeypatch.setattr(EvidenceStore, "has", lambda *_: set())
    monkeypatch.setattr(EvidenceStore, "has_pieces", lambda *_: set())

    with pytest.raises(EvidenceError, match=r"^non-determinism: bench [0-9a-f]{12} has another result than before"):
        run(specs_of(65), store, maker=doubles.changed_result)


def test_a_limit_beyond_the_search_is_refused_before_anything_is_run(specs_of, store, run):
    good, bad = specs_of(1, 65)

    with pytest.raises(DefinitionError, match=r"the planning limit of 8.5 s exceeds the search of 8 s"):
        run([good, replace(bad, planning_limit_s=8.5)], store, maker=lambda *_: pytest.fail("something was made"))


def test_a_piece_that_vanishes_is_an_error(specs_of, store, run, monkeypatch):
    run(specs_of(1), store)
    monkeypatch.setattr(EvidenceStore, "piece", lambda *_: None)

    with pytest.raises(
        EvidenceError, match=r"^piece [0-9a-f]{12} was removed from the store during the sweep \(run the"
    ):
        run(specs_of(2), store)


def test_results_are_on_disk_within_a_second_or_so(specs_of, store, run, doubles, monkeypatch):
    """Told by a clock that moves by a fifth of a second with every task."""
    now = [0.0]
    monkeypatch.setattr(keeping.time, "monotonic", lambda: now[0])
    flushed = []
    put_many = EvidenceStore.put_many

    def noted(self, *, trials, pieces, inputs):
        flushed.append((now[0], len(list(pieces)), len(list(trials))))
        return put_many(self, trials=trials, pieces=pieces, inputs=inputs)

    def slow(task, needed):
        now[0] += 0.2
        return doubles.quick(task, needed)

    monkeypatch.setattr(EvidenceStore, "put_many", noted)
    run(specs_of(*range(1, 25)), store, maker=slow)

    assert len(flushed) > 1
    assert sum(trials for _, _, trials in flushed) == 24
    times = [0.2, *(moment for moment, _, _ in flushed)]
    assert max(later - earlier for earlier, later in itertools.pairwise(times)) <= keeping.LONGEST_S + 0.4


def test_progress_counts_down(specs_of, store, run):
    states = []
    run(specs_of(1, 2, 3), store, on_state=states.append)

    assert [state.tasks_left for state in states] == [3, 2, 1, 0]
    assert states[-1].made == {"plan": 1, "timing": 1, "execution": 1, "bench": 1}
    assert states[-1].remaining_s == 0.0
    # Three trials of four pieces each, of which four were made.
    assert states[-1].saved == 8
    assert all(earlier.elapsed_s <= later.elapsed_s for earlier, later in itertools.pairwise(states))


def test_without_sharing_nothing_is_taken_from_the_store_or_kept_for_others(specs_of, opened, run):
    shared, apart = opened("shared"), opened("apart")
    specs = specs_of(1, 2, 3, 65)
    run(specs[:1], apart)
    kept = len(apart.has_pieces(digest for trial in trials_of(specs) for digest in trial.pieces.values()))
    run(specs, shared)
    finished, result = run(specs, apart, share=False)

    assert result.made == {"trial": 3}
    assert (result.reused, kept) == ({}, 4)
    assert len(apart.has_pieces(digest for trial in trials_of(specs) for digest in trial.pieces.values())) == 4
    assert len(finished) == 4
    assert digests_in(apart) == digests_in(shared)


@pytest.fixture
def one_worker(tmp_path):
    """Workers, of whom there is one, whose time goes on only when a task is known to hang."""

    def clock():
        return 1000.0 * len([*(tmp_path / "marks").glob("hanging-*")])

    return lambda maker: WorkerPool(maker, size=1, time_limit_s=3.0, memory_limit_bytes=1 * GIB, clock=clock)


def test_every_kind_of_trouble_is_recorded_and_the_sweep_goes_on(specs_of, store, run, doubles, one_worker):
    """Seed 1 is well; 2 crashes, 3 hangs, 4 eats memory, 5 is refused, 6 dies once, the execution of 7 raises."""
    specs = specs_of(1, 2, seeds=range(1, 8), fidelity="kinematic")
    finished, result = run(specs, store, maker=doubles.troubled, workers_for=one_worker)
    plans = {trial.spec.seed: trial.digests.plan for trial in trials_of(specs)}
    execution = next(trial.digests.execution for trial in trials_of(specs) if trial.spec.seed == 7)

    def lost(seed, kind, detail, *, attempts=2, what="plan", key=None):
        failure = RunFailure(key=key or plans[seed], what=what, kind=kind, detail=detail, attempts=attempts)
        return LostTrials(failure=failure, trials=((1, seed), (2, seed)))

    crashed = "the worker was killed by SIGSEGV: free(): invalid next size"
    expected = [
        lost(2, RunFailureKind.CRASHED, crashed),
        lost(3, RunFailureKind.TIMED_OUT, "not done after 3 s"),
        lost(4, RunFailureKind.OUT_OF_MEMORY, "MemoryError"),
        lost(5, RunFailureKind.RAISED, "the mass of the workpiece must be positive, got 0 (give it some)", attempts=1),
        lost(7, RunFailureKind.RAISED, "ZeroDivisionError: division by zero", what="execution", key=execution),
    ]
    assert sorted(result.lost, key=lambda each: each.trials) == expected
    assert sorted((trial.record.variant, trial.record.seed) for trial in finished) == [(1, 1), (1, 6), (2, 1), (2, 6)]
    assert store.failures(plans.values()) == {each.failure.key: each.failure for each in expected[:4]}
    assert store.failures([execution]) == {execution: expected[4].failure}
    # Another sweep tries again, and what is made then has not failed.
    again, result = run(specs, store)
    assert len(again) == 14
    assert result.lost == ()
    assert store.failures([*plans.values(), execution]) == {}


@pytest.mark.engine
@pytest.mark.verifies("SYS-021")
def test_records_depend_on_neither_processes_nor_order_nor_sharing(specs_of, opened, run, doubles, marks):
    """Trials of six designs, with contact, from one worker, from two, and each by itself."""
    from rgss.trials.pieces.run import make

    specs = specs_of(1, 2, 3, 10, 65, 66)
    stores = {name: opened(name) for name in ("one", "two", "apart")}
    # In workers: another test may have used the collision engine in this process before `rgss` did.
    _, alone = run(specs, stores["one"], jobs=1, maker=make)
    _, together = run(specs[::-1], stores["two"], jobs=2, maker=doubles.noted)
    _, apart = run(specs[4:5], stores["apart"], jobs=1, share=False, maker=make)
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        direct = pool.submit(run_trial, specs[4]).result()

    assert alone.made == together.made == {"plan": 2, "timing": 3, "execution": 3, "bench": 2}
    assert marks() == alone.made
    assert apart.made == {"trial": 1}
    assert digests_in(stores["one"]) == digests_in(stores["two"])
    assert len(digests_in(stores["one"])) == 6
    assert digests_in(stores["apart"]).items() <= digests_in(stores["one"]).items()
    assert record_digest(direct) == digests_in(stores["one"])[key_of(specs[4])]
    pieces = {digest for trial in trials_of(specs) for digest in trial.pieces.values()}
    assert all(stores["one"].piece(digest) == stores["two"].piece(digest) for digest in pieces)
    # Read from the store, the same again.
    everything = opened("one")
    found, result = run(specs, everything, maker=lambda *_: pytest.fail("something was made"))
    assert result.made == {}
    assert {trial.record.failure for trial in found} <= {None, *Failure}
