"""Which trials a report shows: the deciding one, the worst failure, and one of each other kind of failure."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from rgss.evidence import Failure, PhaseOutcome
from rgss.reports.study.trials import notable_trials
from rgss.reports.study.worst_failure import worst_failure
from tests.fixtures.eight_states import Phase


def trial(variant, seed, failure=None, ended=8):
    """A record that says no more than how far it came."""
    phases = [
        SimpleNamespace(
            phase=phase,
            outcome=PhaseOutcome.COMPLETED
            if place < ended
            else PhaseOutcome.FAILED
            if place == ended
            else PhaseOutcome.NOT_RUN,
        )
        for place, phase in enumerate(Phase)
    ]
    return SimpleNamespace(variant=variant, seed=seed, success=failure is None, failure=failure, phases=phases)


def measured(*records):
    """Variants with these trials, by ascending id."""
    ids = sorted({record.variant for record in records})
    rows = {one: [record for record in records if record.variant == one] for one in ids}
    return [
        SimpleNamespace(
            variant=SimpleNamespace(id=one), records=tuple(found), trials=tuple(f"{one}/{r.seed}" for r in found)
        )
        for one, found in rows.items()
    ]


@pytest.mark.parametrize("later", [2, 7])
def test_a_failure_is_shown_by_the_first_trial_in_which_something_moved(later):
    found = notable_trials(
        measured(
            trial(1, 1, Failure.PLANNING_LIMIT, 0),
            trial(1, 2, Failure.OBJECT_DROPPED, 2),
            trial(2, 1, Failure.PLANNING_LIMIT, later),
            trial(2, 2, Failure.PLANNING_LIMIT, 5),
            trial(3, 1, Failure.OBJECT_DROPPED, 3),
            trial(3, 2),
        ),
        3,
    )
    assert [one.key for one in found] == ["3/2", "3/1", "2/1"]
    assert [one.why for one in found] == [
        "the deciding trial: the chosen variant",
        "the worst failure, object dropped",
        "a failure of the kind “planning limit”",
    ]
    assert [one.worst for one in found] == ["", "The only failed trial of variant 3.", ""]


def test_where_nothing_ever_moved_it_is_the_first():
    found = notable_trials(
        measured(
            trial(4, 1, Failure.INVALID_START, 0),
            trial(4, 2, Failure.INVALID_START, 0),
            trial(5, 1, Failure.NOT_UPRIGHT),
            trial(5, 2, Failure.NOT_UPRIGHT),
            trial(5, 3, Failure.NOT_UPRIGHT),
        ),
        None,
    )
    assert [one.key for one in found] == ["5/1", "4/1"]


def test_a_deciding_trial_that_failed_may_be_the_worst_failure_itself():
    found = notable_trials(measured(trial(4, 1, Failure.ARM_COLLISION), trial(5, 1, Failure.ARM_COLLISION)), 4)
    assert [(one.key, one.why) for one in found] == [("4/1", "the deciding trial: the chosen variant")]
    assert found[0].worst == "The only failed trial of variant 4."


def test_the_worst_failure_is_the_most_frequent_of_the_choice_that_is_no_planning_limit():
    found = worst_failure(
        measured(
            *(trial(1, seed, Failure.OBJECT_DROPPED) for seed in range(1, 9)),
            *(trial(2, seed, Failure.PLANNING_LIMIT) for seed in range(1, 5)),
            trial(2, 5, Failure.OBJECT_DROPPED),
            trial(2, 6, Failure.ARM_COLLISION),
            trial(2, 7, Failure.ARM_COLLISION),
        ),
        2,
    )
    assert found.key == "2/6"
    assert found.why == (
        "7 trials of variant 2 failed; the most frequent kind, apart from planning limits (4), is arm collision (2), "
        "and this is the one with the smallest seed."
    )


def test_equally_frequent_kinds_and_a_choice_that_never_failed():
    records = [
        trial(1, 3, Failure.OBJECT_DROPPED),
        trial(1, 4, Failure.ARM_COLLISION),
        trial(2, 2, Failure.ARM_COLLISION),
        trial(2, 5, Failure.OBJECT_DROPPED),
        trial(3, 1),
    ]
    found = worst_failure(measured(*records), 3)
    assert found.key == "2/2"
    assert found.why == (
        "No trial of variant 3 failed; 4 trials of all variants failed; one of the most frequent kinds is arm "
        "collision (2), and this is the one with the smallest seed."
    )
    assert worst_failure(measured(*records), None).why.startswith("4 trials of all variants failed; one of the")


def test_planning_limits_alone_have_a_worst_failure_too():
    found = worst_failure(measured(trial(2, 3, Failure.PLANNING_LIMIT), trial(2, 2, Failure.PLANNING_LIMIT)), 2)
    assert found.key == "2/2"
    assert found.why == (
        "2 trials of variant 2 failed; the most frequent kind is planning limit (2), and this is the one with the "
        "smallest seed."
    )
    assert worst_failure(measured(trial(1, 1)), 1) is None
