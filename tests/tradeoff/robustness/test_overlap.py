from __future__ import annotations

from rgss.tradeoff import Overlap, SharedPart, overlapping_measures, shared_parts

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


def test_what_could_be_valued_instead():
    contained = CONTAINED | {"t_m": {"t_gc", "L"}, "other": {"t_gc", "L"}, "none": set()}
    (overlap,) = overlapping_measures(
        {"t_p": 0.5, "t_e": 0.5},
        contained.__getitem__,
        candidates=["none", "other", "t_m"],
        alike=lambda one, other: one != "other",
    )
    assert overlap == Overlap(whole="t_e", part="t_p", instead="t_m")


def test_parts_that_two_measures_share():
    contained = {"x": ("a", "b"), "y": ("b", "c", "a"), "z": ("x", "a"), "w": ()}
    weights = {"x": 0.4, "y": 0.3, "z": 0.2, "w": 0.1}
    assert shared_parts(weights, contained.__getitem__) == (
        SharedPart(first="x", second="y", parts=("a", "b")),
        SharedPart(first="y", second="z", parts=("a",)),
    )
    assert shared_parts({"x": 1.0, "y": 0.0}, contained.__getitem__) == ()
