"""What a sweep has to make, in which order, and what is left when something cannot be made."""

from __future__ import annotations

import itertools
from collections import Counter

import pytest

from rgss.evidence import PieceKind
from rgss.studies.expansion import trial_specs
from rgss.sweep.durations import Durations
from rgss.sweep.task_queue import TaskQueue
from rgss.sweep.trial_keys import trials_of
from rgss.trials.pieces.pieces import TrialTask


@pytest.fixture
def trials(shipped):
    """The trials of all variants with one seed or more."""

    def make(*seeds, variants=range(1, 73), fidelity="contact"):
        chosen = [shipped.designs.variant(number) for number in variants]
        return trials_of(trial_specs(shipped.with_fidelity(fidelity), variants=chosen, seeds=seeds))

    return make


def taken(work, *, took_s=0.1):
    """Do everything that is left, one after another; return the tasks in their order and the trials in theirs."""
    tasks, complete = [], list(work.complete())
    while work.left:
        task = work.take()
        tasks.append(task)
        work.done(task.digest, took_s=took_s)
        complete += work.complete()
    assert work.ready == 0
    return tasks, complete


@pytest.mark.verifies("SYS-032")
@pytest.mark.parametrize(
    ("fidelity", "expected"),
    [
        ("contact", {"plan": 6, "timing": 12, "execution": 24, "bench": 4}),
        ("kinematic", {"plan": 6, "timing": 12, "execution": 24}),
    ],
)
def test_72_variants_and_a_seed_are_6_plans_12_timings_24_executions_and_4_benches(trials, fidelity, expected):
    tasks, complete = taken(TaskQueue(trials(1, fidelity=fidelity)))

    assert Counter(task.kind.value for task in tasks) == expected
    assert len({task.digest for task in tasks}) == len(tasks)
    assert sorted(trial.spec.variant for trial in complete) == list(range(1, 73))


def test_ten_seeds_cost_ten_times_as_much_and_the_same_benches(trials):
    tasks, complete = taken(TaskQueue(trials(*range(1, 11))))

    assert Counter(task.kind.value for task in tasks) == {"plan": 60, "timing": 120, "execution": 240, "bench": 4}
    assert len(complete) == 720


def test_nothing_is_begun_before_what_it_needs_is_done(trials):
    done = set()
    work = TaskQueue(trials(1, 2))
    while work.left:
        task = work.take()
        assert {*task.needs} <= done
        done.add(task.digest)
        work.done(task.digest, took_s=0.1)


def test_what_is_stored_is_not_made(trials):
    every = trials(1)
    plans = {trial.digests.plan for trial in every}
    tasks, complete = taken(TaskQueue(every, stored=plans))
    assert Counter(task.kind.value for task in tasks) == {"timing": 12, "execution": 24, "bench": 4}
    assert len(complete) == 72

    everything = {digest for trial in every for digest in trial.pieces.values()}
    work = TaskQueue(every, stored=everything)
    assert (work.left, work.ready) == (0, 0)
    assert len(list(work.complete())) == 72
    assert list(work.complete()) == []


def test_a_plan_that_is_missing_is_made_though_what_came_of_it_is_stored(trials):
    every = trials(1, variants=[65])
    stored = {*every[0].pieces.values()} - {every[0].digests.plan}
    tasks, complete = taken(TaskQueue(every, stored=stored))

    assert [task.kind for task in tasks] == [PieceKind.PLAN]
    assert len(complete) == 1


def test_without_sharing_every_trial_is_one_task(trials):
    every = trials(1)
    tasks, complete = taken(TaskQueue(every, share=False))

    assert {type(task) for task in tasks} == {TrialTask}
    assert {task.digest for task in tasks} == {trial.key for trial in every}
    assert len(complete) == 72


def test_trials_are_finished_all_the_time_and_few_pieces_are_held(trials):
    """Had all plans come first, 60 plans and 120 timings would be held when the first trial is done."""
    work = TaskQueue(trials(*range(1, 11)))
    held, most, done_at = set(), 0, []
    steps = 0
    while work.left:
        task = work.take()
        steps += 1
        work.done(task.digest, took_s=0.1)
        held.add(task.digest)
        for digest in task.needs:
            work.release(digest)
        for trial in work.complete():
            done_at.append(steps)
            for digest in trial.pieces.values():
                work.release(digest)
        held = {digest for digest in held if work.is_used(digest)}
        most = max(most, len(held))

    assert held == set()
    assert most <= 12
    assert done_at[0] <= 8
    assert max(later - earlier for earlier, later in itertools.pairwise(done_at)) <= 4


def test_the_longest_searches_come_first_and_the_shortest_last(trials):
    tasks, _ = taken(TaskQueue(trials(1, 2, 3)))
    planners = [task.spec.planner for task in tasks if task.kind is PieceKind.PLAN]

    assert planners == ["STRIDE"] * 6 + ["TRRT"] * 6 + ["RRT"] * 6


def test_the_order_follows_what_has_been_measured(trials):
    work = TaskQueue(trials(1, 2, 3, 4))
    planners = []
    while work.left:
        task = work.take()
        if task.kind is PieceKind.PLAN:
            planners.append(task.spec.planner)
        # Here RRT takes longest, which is learnt from the first one.
        work.done(task.digest, took_s={"RRT": 5.0}.get(task.spec.planner, 0.01))

    first = planners.index("RRT")
    assert planners[:4] == ["STRIDE"] * 4
    assert set(planners[first : first + 8]) == {"RRT"}


def test_of_executions_the_slow_ones_come_first(trials):
    tasks, _ = taken(TaskQueue(trials(1)))
    order = [task for task in tasks if task.kind is PieceKind.EXECUTION]
    pairs = [(task.spec.tool_speed_m_s, task.spec.planner) for task in order[:4]]

    assert pairs == [(0.5, "STRIDE")] * 2 + [(1.0, "STRIDE")] * 2


def test_giving_up_a_plan_loses_what_depends_on_it_and_nothing_else(trials):
    work = TaskQueue(trials(1))
    while True:
        task = work.take()
        if task.kind is PieceKind.PLAN:
            break
        work.done(task.digest, took_s=0.1)
    lost = work.give_up(task.digest)
    tasks, complete = taken(work)

    assert len(lost) == 12
    assert {trial.digests.plan for trial in lost} == {task.digest}
    assert Counter(task.kind.value for task in tasks) == {"plan": 5, "timing": 10, "execution": 20}
    assert len(complete) == 60


def test_giving_up_an_execution_loses_its_three_trials(trials):
    work = TaskQueue(trials(1))
    while True:
        task = work.take()
        if task.kind is PieceKind.EXECUTION:
            break
        work.done(task.digest, took_s=0.1)
    lost = work.give_up(task.digest)

    assert {trial.digests.execution for trial in lost} == {task.digest}
    assert len(lost) == 3
    # A trial is lost once, whatever else of it cannot be made.
    bench = next(trial for trial in lost).digests.bench
    assert work.give_up(bench) == ()
    assert len(taken(work)[1]) == 69


def test_a_task_that_is_given_back_is_taken_again(trials):
    work = TaskQueue(trials(1, variants=[65], fidelity="kinematic"))
    task = work.take()
    assert work.ready == 0
    work.give_back(task)
    assert (work.ready, work.left) == (1, 3)
    assert work.take() is task


def test_the_remaining_time_falls_to_nothing(trials):
    work = TaskQueue(trials(1))
    times = [work.remaining_s()]
    while work.left:
        work.done(work.take().digest, took_s=0.5)
        times.append(work.remaining_s())

    assert times[0] > 3.0
    assert times[-1] == 0.0
    assert times[-2] == pytest.approx(0.5, rel=0.1)


def test_a_guess_gives_way_to_what_is_measured(trials):
    (trial,) = trials(1, variants=[65])
    durations = Durations()
    work = TaskQueue([trial])
    task = work.take()
    tasks = durations.class_of(task)
    guess_s = durations.expected_s(tasks)
    durations.learn(tasks, 3.0)
    assert durations.expected_s(tasks) == pytest.approx((guess_s + 3.0) / 2)
    for _ in range(98):
        durations.learn(tasks, 3.0)
    assert durations.expected_s(tasks) == pytest.approx(3.0, rel=0.02)
