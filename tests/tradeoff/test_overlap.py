from __future__ import annotations

from rgss.tradeoff import Overlap, overlapping_measures

CONTAINED = {"t_e": {"t_p", "t_gc", "L", "t_sp"}, "t_p": {"t_sp"}, "C": set(), "t_sp": set()}


def test_time_contains_planning_time():
    weights = {"C": 0.2, "t_p": 0.4, "t_e": 0.4}
    assert overlapping_measures(weights, CONTAINED.__getitem__) == (Overlap(whole="t_e", part="t_p"),)


def test_measures_without_weight_count_nothing():
    assert overlapping_measures({"t_e": 1.0, "t_p": 0.0}, CONTAINED.__getitem__) == ()


def test_pairs_in_the_order_of_the_weights():
    weights = {"t_sp": 0.2, "t_p": 0.4, "t_e": 0.4}
    assert overlapping_measures(weights, CONTAINED.__getitem__) == (
        Overlap(whole="t_p", part="t_sp"),
        Overlap(whole="t_e", part="t_sp"),
        Overlap(whole="t_e", part="t_p"),
    )


def test_a_measure_does_not_overlap_itself():
    assert overlapping_measures({"a": 1.0}, lambda measure: {measure}) == ()
