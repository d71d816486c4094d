"""Which trials a report shows: the deciding one, and of each kind of failure one with something to see."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from rgss.evidence import Failure, PhaseOutcome
from rgss.reports.study.trials import notable_trials
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
    assert [one.key for one in found] == ["3/2", "2/1", "1/2"]
    assert [one.why for one in found] == [
        "the deciding trial: the chosen variant",
        "a failure of the kind “planning limit”",
        "a failure of the kind “object dropped”",
    ]


def test_where_nothing_ever_moved_it_is_the_first():
    found = notable_trials(
        measured(trial(4, 1, Failure.INVALID_START, 0), trial(4, 2, Failure.INVALID_START, 0), trial(5, 1)), None
    )
    assert [one.key for one in found] == ["4/1"]
