"""Which designs and failures are confirmed."""

from dataclasses import dataclass
from itertools import pairwise

import pytest

from rgss.confirmation import MOST_RIVALS, select, selected_by_id
from rgss.errors import DefinitionError
from rgss.evidence import Failure
from tests.fixtures.eight_states import Phase


@dataclass
class Ranked:
    variant: int


@dataclass
class Decided:
    """What is read of a decision."""

    chosen: int | None
    ranking: list
    ties: tuple = ()
    near_ties: tuple = ()
    runner_up: int | None = None


@dataclass
class Measured:
    records: tuple


def ranked(*variants):
    return [Ranked(variant) for variant in variants]


def ids(selection):
    return [variant.id for variant in selection.variants]


def test_rivals_are_the_ties_the_near_ties_and_the_runner_up_in_the_order_of_the_ranking(shipped):
    decision = Decided(28, ranked(28, 31, 10, 13, 40), ties=(28, 31), near_ties=(10,), runner_up=10)
    found = select(shipped, decision, (), failures=3)
    assert (ids(found), found.chosen, found.left_out, found.sample) == ([28, 31, 10], 28, (), ())


def test_the_runner_up_is_a_rival_however_far_it_is(shipped):
    assert ids(select(shipped, Decided(28, ranked(28, 31, 10), ties=(28,), runner_up=31), (), failures=0)) == [28, 31]


def test_rivals_beyond_the_most_are_named(shipped):
    near = tuple(range(2, 12))
    found = select(shipped, Decided(1, ranked(1, *near), ties=(1,), near_ties=near, runner_up=2), (), failures=0)
    assert ids(found) == [1, *near[:MOST_RIVALS]]
    assert found.left_out == near[MOST_RIVALS:]


def test_without_a_choice_there_is_nothing_to_confirm(shipped):
    with pytest.raises(DefinitionError, match=r"no variant meets every requirement.*\(name designs with --variants\)"):
        select(shipped, Decided(None, []), (), failures=0)


def test_a_design_that_is_not_there_is_refused(shipped):
    with pytest.raises(DefinitionError, match="unknown variant 73"):
        selected_by_id(shipped, [28, 73])


def test_designs_that_are_named_twice_are_confirmed_once(shipped):
    assert ids(selected_by_id(shipped, [31, 28, 31])) == [31, 28]


@pytest.fixture
def failed(record):
    """Variants with failures: many drops in the lift, two collisions of the object, and one planning limit each."""
    drop, push = (Failure.OBJECT_DROPPED, Phase.LIFT), (Failure.OBJECT_COLLISION, Phase.MOVE_TO_GRASP)
    entries = []
    for variant in range(1, 9):
        rows = [record(variant, seed, failure=drop[0], phase=drop[1]) for seed in range(1, 9)]
        rows.append(record(variant, 9, failure=Failure.PLANNING_LIMIT, phase=Phase.MOVE_TO_PLACE))
        rows.append(record(variant, 10))
        if variant > 6:
            rows.append(record(variant, 11, failure=push[0], phase=push[1]))
        entries.append(Measured(tuple(rows)))
    return entries


def test_the_sample_is_even_over_what_went_wrong(shipped, failed):
    found = selected_by_id(shipped, [28], failed, failures=6)
    assert (found.physical_failures, found.planned_failures) == (66, 8)
    assert [trial for trial in found.sample if trial[1] == 11] == [(7, 11), (8, 11)]
    drops = [trial for trial in found.sample if trial[1] != 11]
    # The first, the middle and the quarter of the drops by seed and variant.
    assert drops == [(1, 1), (1, 3), (1, 5), (1, 7)]


def test_the_sample_is_the_same_each_time_and_begins_alike_whatever_its_size(shipped, failed):
    sizes = [set(selected_by_id(shipped, [28], failed, failures=size).sample) for size in range(12)]
    assert all(small < large for small, large in pairwise(sizes))
    assert selected_by_id(shipped, [28], failed, failures=500).sample == tuple(
        sorted((entry.records[0].variant, r.seed) for entry in failed for r in entry.records if r.seed not in (9, 10))
    )


def test_failures_of_designs_that_are_confirmed_anyway_are_not_sampled(shipped, failed):
    assert {variant for variant, _ in selected_by_id(shipped, [7, 1], failed, failures=99).sample} == {2, 3, 4, 5, 6, 8}


@pytest.mark.parametrize(
    "failure",
    [Failure.MOVE_BLOCKED, Failure.MOVE_UNREACHABLE, Failure.UNREACHABLE_WAYPOINT, Failure.PATH_NOT_VERIFIED],
)
def test_a_move_that_cannot_be_made_is_the_same_in_every_engine(shipped, record, failure):
    rows = (record(1, 1, failure=failure, phase=Phase.LIFT), record(1, 2))
    found = selected_by_id(shipped, [28], [Measured(rows)], failures=6)
    assert (found.physical_failures, found.planned_failures) == (0, 1)
