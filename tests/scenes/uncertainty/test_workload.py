"""Workload: which seed carries which case."""

from __future__ import annotations

from collections import Counter

import pytest

from rgss.scenes.uncertainty import ONE_WORKLOAD, Case, Workload


def workload(*replicates):
    return Workload(cases=tuple(Case(id=f"case_{index}", replicates=n) for index, n in enumerate(replicates)))


def test_without_cases_there_is_none():
    assert ONE_WORKLOAD.case_of(5) is None


@pytest.mark.parametrize("first", [0, 1, 6, 29])
def test_each_block_of_seeds_has_each_case_as_often_as_it_says(first):
    cases = workload(3, 1, 2)

    assert Counter(cases.case_of(seed).id for seed in range(first, first + 6)) == {
        "case_0": 3,
        "case_1": 1,
        "case_2": 2,
    }


def test_a_block_is_mixed():
    order = [workload(2, 1, 1).case_of(seed).id for seed in range(4)]

    assert order == ["case_0", "case_1", "case_2", "case_0"]


def test_any_number_of_seeds_is_within_one_of_its_share():
    cases = workload(5, 2, 1)

    for count in range(1, 40):
        found = Counter(cases.case_of(seed).id for seed in range(count))
        for index, share in enumerate((5, 2, 1)):
            assert abs(found[f"case_{index}"] - share / 8 * count) < 1.0
