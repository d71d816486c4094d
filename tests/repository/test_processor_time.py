"""The rule by which `make fast` leaves tests out: what a test costs, and its share of what it uses with others."""

from __future__ import annotations

from tests.processor_time import LONGEST_S, Measured, long_files, longest_first, slow_names

SHORT_S = 0.1 * LONGEST_S


def test_many_quick_tests_of_a_file_are_quick():
    tests = [Measured(name=f"test_a.py::test_{number}", own_s=SHORT_S, shared=()) for number in range(1000)]

    assert slow_names(tests, {}) == set()


def test_parameters_count_by_their_mean():
    tests = [Measured(name="a", own_s=own_s, shared=()) for own_s in (SHORT_S, 1.5 * LONGEST_S)]
    tests += [Measured(name="b", own_s=own_s, shared=()) for own_s in (SHORT_S, 3.0 * LONGEST_S)]

    assert slow_names(tests, {}) == {"b"}


def test_what_tests_share_is_divided_among_them():
    def users(count):
        return [Measured(name=str(number), own_s=SHORT_S, shared=("fixture",)) for number in range(count)]

    assert slow_names(users(100), {"fixture": 10.0 * LONGEST_S}) == set()
    assert slow_names(users(5), {"fixture": 10.0 * LONGEST_S}) == {"0", "1", "2", "3", "4"}


def test_who_is_left_out_pays_for_nothing():
    tests = [Measured(name="quick", own_s=SHORT_S, shared=("fixture",))]
    tests += [Measured(name="slow", own_s=2.0 * LONGEST_S, shared=("fixture",))]
    tests += [Measured(name="engine", own_s=SHORT_S, shared=None)]

    assert slow_names(tests, {"fixture": 1.5 * LONGEST_S}) == {"quick", "slow"}
    assert slow_names(tests, {"fixture": 0.5 * LONGEST_S}) == {"slow"}


def test_the_longest_files_come_first():
    assert longest_first({"b": 20.0, "a": 20.0, "c": 30.0, "short": 1.0}) == ["c", "a", "b"]


def test_each_long_file_exists(repository):
    assert [file for file in long_files() if not (repository / file).is_file()] == []
