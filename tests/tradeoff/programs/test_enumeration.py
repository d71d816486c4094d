from __future__ import annotations

import numpy as np

from rgss.tradeoff.programs.enumeration import enumerate_alternatives


def test_hand_worked_values_and_violations(payload_and_time):
    enumeration = enumerate_alternatives(payload_and_time)
    assert enumeration.variants.tolist() == [1, 2, 3, 4, 5]
    assert enumeration.values.tolist() == [0.5, 0.8, 0.4375, 0.7625, 0.075]
    assert enumeration.requirements == ("R-1", "R-2", "evidence:t")
    assert enumeration.violated.tolist() == [
        [False, False, False],
        [True, False, False],
        [False, False, False],
        [False, True, False],
        [True, True, False],
    ]
    assert enumeration.best_row == 0
    assert enumeration.ordering.at(0) == (0.5,)
    assert enumeration.tied.tolist() == [True, False, False, False, False]
    assert enumeration.value_of(4) == 0.7625
    assert enumeration.violated_by(5) == ("R-1", "R-2")


def test_unknown_measures(build_problem):
    enumeration = enumerate_alternatives(
        build_problem(
            {
                1: {"a": None, "b": 0.0, "c": None},
                2: {"a": 0.5, "b": None, "c": None},
                3: {"a": 0.5, "b": 1.0, "c": None},
            },
            thresholds=[("R", "b", ">=", 0.0)],
            values={"a": (0.0, 1.0), "b": (0.0, 1.0), "c": (0.0, 1.0)},
            weights={"a": 0.5, "b": 0.5, "c": 0.0},
        )
    )
    assert enumeration.requirements == ("R", "evidence:a")
    assert [enumeration.violated_by(variant) for variant in (1, 2, 3)] == [("evidence:a",), ("R",), ()]
    assert [enumeration.value_of(variant) for variant in (1, 2, 3)] == [None, None, 0.75]


def test_a_requirement_with_two_thresholds_is_violated_by_either(build_problem):
    enumeration = enumerate_alternatives(
        build_problem(
            {1: {"a": 0.1}, 2: {"a": 0.5}, 3: {"a": 0.9}},
            thresholds=[("R", "a", ">=", 0.2), ("R", "a", "<=", 0.8)],
        )
    )
    assert enumeration.violated.tolist() == [[True], [False], [True]]


def test_nothing_feasible(build_problem):
    enumeration = enumerate_alternatives(build_problem({1: {"a": 0.1}}, thresholds=[("R", "a", ">=", 0.2)]))
    assert enumeration.best_row is None
    assert not np.any(enumeration.tied)


def test_sums_that_are_equal_on_paper_are_equal(build_problem):
    """0.1 + 0.2 + 0.3 and 0.3 + 0.2 + 0.1 differ in floating point, the decision must not."""
    weights = {"a": 0.1, "b": 0.2, "c": 0.3, "d": 0.4}
    enumeration = enumerate_alternatives(
        build_problem(
            {1: dict.fromkeys("abc", 1.0) | {"d": 0.0}, 2: {"a": 0.0, "b": 1.0, "c": 0.0, "d": 1.0}},
            values=dict.fromkeys("abcd", (0.0, 1.0)),
            weights=weights,
        )
    )
    assert enumeration.values.tolist() == [0.6, 0.6]
