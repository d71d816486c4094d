"""The first screen says what is chosen, how it stands against its limits, what is open and what would change it."""

from __future__ import annotations

import copy

import pytest

from rgss.reports.study.first_screen import MOST_BULLETS, first_screen_content, worst_failure_in_words


def requirement(name, measure, comparison, threshold, verdict):
    return {
        "id": name,
        "text": f"{name} in words.",
        "measure": measure,
        "comparison": comparison,
        "threshold": threshold,
        "verdict": verdict,
    }


def measure(name, unit, weight, value, low=None, high=None):
    return {"id": name, "name": name.upper(), "unit": unit, "weight": weight, "value": value, "low": low, "high": high}


DOCUMENT = {
    "variants": {"id": [1, 2]},
    "trials": {
        "variant": [0, 1],
        "seed": [1, 4],
        "key": ["aa", "bb"],
        "worst": {"trial": 1, "why": "The only failed trial of variant 2."},
    },
    "measures": [
        measure("time", "s", 0.4, [30.0, 20.0], [25.0, 18.0], [35.0, 23.0]),
        measure("share", "1", 0.6, [0.5, 0.95], [0.3, 0.88], [0.7, 0.99]),
        measure("cost", "USD", None, 1000),
        measure("mass", "kg", None, [None, None]),
    ],
    "requirements": [
        requirement("R1", "time", "<=", 25.0, ["not_met", "met"]),
        requirement("R2", "share", ">=", 0.9, ["not_met", "inconclusive"]),
        requirement("R3", "cost", "<=", 1200, "met"),
        requirement("R4", "mass", "<", 3, "not_run"),
        {**requirement("R5", "", "<=", 0, "met"), "measure": None},
    ],
    "parameters": [
        {"name": "planner", "unit": "", "varies": True, "values": ["RRT", "TRRT"]},
        {"name": "speed", "unit": "m/s", "varies": True, "values": [0.5, 1.0]},
        {"name": "opening", "unit": "m", "varies": False, "values": 0.1},
    ],
    "decision": {
        "chosen": 2,
        "ties": [2],
        "near_ties": [1],
        "rivals": [],
        "rivals_by_margin": [],
        "failed_tests": [],
        "failed_records": [],
        "modelling": {
            "rows": [
                {
                    "changes": True,
                    "sentence": "All assumed prices of components: multiplied by 1.5 instead of as stated. Then none.",
                },
                {"changes": None, "sentence": ""},
                {"changes": False, "sentence": "Clock: 3 ms instead of 1 ms. Then variant 2 is chosen."},
            ]
        },
        "weight_ranges": [
            {"measure": "time", "weight": 0.4, "low": 0.0, "high": 0.75, "below": [], "above": [1]},
            {"measure": "share", "weight": 0.6, "low": 0.3, "high": 1.0, "below": [1, 3], "above": []},
        ],
    },
}


def changed(**decision):
    document = copy.deepcopy(DOCUMENT)
    document["decision"] |= decision
    return document


def test_what_is_open_comes_first_and_then_what_weighs_most():
    shown = first_screen_content(DOCUMENT)
    assert (shown["chosen"], shown["equal"], shown["tied"], shown["met"]) == (2, [], [], 2)
    assert [one["requirement"] for one in shown["bullets"]] == ["R2", "R1", "R3"]
    assert shown["open"] == [{"id": "R2", "text": "R2 in words."}, {"id": "R4", "text": "R4 in words."}]
    assert shown["missed"] == []
    assert shown["more_limits"] == 0


def test_a_requirement_whose_test_failed_is_missed_whatever_its_measure_says():
    shown = first_screen_content(changed(failed_tests=["R3", "R5"]))
    assert shown["missed"] == [
        {"id": "R3", "text": "R3 in words. Its test failed."},
        {"id": "R5", "text": "R5 in words. Its test failed."},
    ]
    assert shown["met"] == 1


def test_what_a_verification_record_says_is_not_met_is_missed_and_told_once():
    shown = first_screen_content(changed(failed_tests=["R3"], failed_records=["R3", "R5"]))
    assert shown["missed"] == [
        {"id": "R3", "text": "R3 in words. Its verification record says so."},
        {"id": "R5", "text": "R5 in words. Its verification record says so."},
    ]


def test_the_levels_of_the_choice_in_words():
    assert first_screen_content(DOCUMENT)["levels"] == [
        {"name": "planner", "value": "TRRT"},
        {"name": "speed", "value": "1 m/s"},
    ]


def test_designs_of_equal_value_and_designs_that_the_evidence_does_not_separate():
    shown = first_screen_content(changed(ties=[2, 5], rivals=[5, 1, 4], rivals_by_margin=[3]))
    assert (shown["equal"], shown["tied"], shown["near"]) == ([5], [1, 4], [3])


def test_limits_without_a_chart_are_counted():
    whole = copy.deepcopy(DOCUMENT)
    demanded = next(one for one in whole["requirements"] if one["id"] == "R1")
    whole["requirements"] += [{**demanded, "id": f"R9{number}"} for number in range(MOST_BULLETS)]
    shown = first_screen_content(whole)
    assert len(shown["bullets"]) == MOST_BULLETS
    assert shown["more_limits"] == 3


def test_the_worst_failure_with_its_reason_and_its_evidence():
    assert worst_failure_in_words(DOCUMENT) == {
        "title": "Variant 2, seed 4",
        "why": "The only failed trial of variant 2.",
        "to": "#variant-2/bb",
    }
    assert worst_failure_in_words(DOCUMENT | {"trials": {"worst": None}}) is None


def test_a_chart_is_to_scale():
    share, time, cost = first_screen_content(DOCUMENT)["bullets"]
    # The greatest of limit, value and interval is a little inside of the right end.
    assert share["at"] / share["limit"] == pytest.approx(0.95 / 0.9, abs=1e-3)
    assert share["interval"][1] / share["interval"][0] == pytest.approx(0.99 / 0.88, abs=1e-3)
    assert share["allowed"] == [share["limit"], 100.0]
    assert max(share["interval"]) < 100.0
    assert time["allowed"] == [0.0, time["limit"]]
    assert time["at"] / time["limit"] == pytest.approx(20 / 25, abs=1e-3)
    assert cost["interval"] is None
    assert [one["beyond"] for one in (share, time, cost)] == [[False, False]] * 3
    assert cost["label"] == "COST: 1000 USD, demanded at most 1200 USD: met"
    assert share["label"] == "SHARE: 0.95 (0.88 to 0.99), demanded at least 0.9: inconclusive"


def test_a_chart_of_a_share_ends_at_one():
    document = copy.deepcopy(DOCUMENT)
    document["measures"][1] |= {"value": [0.5, 1.0], "high": [0.7, 1.0], "least": 0.0, "most": 1.0}
    share = first_screen_content(document)["bullets"][0]
    assert (share["at"], share["limit"], share["interval"][1]) == (100.0, 90.0, 100.0)
    # A limit that nothing can reach is still in its chart.
    document["requirements"][1]["threshold"] = 1.25
    share = first_screen_content(document)["bullets"][0]
    assert (share["at"], share["limit"]) == (80.0, 100.0)


def test_an_interval_that_goes_far_is_cut_at_the_end_of_the_chart():
    document = copy.deepcopy(DOCUMENT)
    document["measures"][0]["high"] = [35.0, 900.0]
    time = first_screen_content(document)["bullets"][1]
    assert time["interval"][1] == 100.0
    assert time["beyond"] == [False, True]
    assert time["limit"] == pytest.approx(100 / 2 / 1.12, abs=0.01)


@pytest.mark.parametrize(
    ("value", "low", "high", "limit", "ends"),
    [
        (-91.0, -91.7, -89.4, -80.0, (-91.7, 0.0)),
        (-3.0, -12.0, 4.0, 2.0, (-4.0, 4.0)),
        (5.0, 1.0, 9.0, -4.0, (-4.0, 8.0)),
    ],
)
def test_a_chart_of_negative_quantities_is_to_scale(value, low, high, limit, ends):
    document = copy.deepcopy(DOCUMENT)
    document["measures"][0] |= {"value": value, "low": low, "high": high}
    document["requirements"][0] |= {"threshold": limit}
    chart = next(one for one in first_screen_content(document)["bullets"] if one["requirement"] == "R1")
    bottom, top = (1.12 * end for end in ends)

    def place(quantity):
        return pytest.approx(min(max(100.0 * (quantity - bottom) / (top - bottom), 0.0), 100.0), abs=0.01)

    assert (chart["at"], chart["limit"]) == (place(value), place(limit))
    assert chart["interval"] == [place(low), place(high)]
    assert chart["beyond"] == [low < bottom, high > top]
    assert chart["allowed"] == [0.0, place(limit)]


def test_the_weight_at_which_the_choice_changes_is_rounded_so_that_it_does():
    one = {"measure": "time", "weight": 0.4, "low": 0.1486, "high": 0.5514, "below": [1], "above": [3]}
    for low, high, wanted in ((0.1486, 1.0, "below 0.148"), (0.0, 0.5514, "above 0.552")):
        ends = {"low": low, "high": high, "below": [1] if low else [], "above": [3] if high < 1.0 else []}
        (sentence,) = first_screen_content(changed(modelling={"rows": []}, weight_ranges=[one | ends]))["changes"]
        assert f"Weight of TIME: {wanted} instead of 0.4." in sentence


def test_what_would_change_it():
    shown = first_screen_content(DOCUMENT)
    assert shown["changes"] == [
        "All assumed prices of components: multiplied by 1.5 instead of as stated. Then none.",
        "Weight of SHARE: below 0.3 instead of 0.6. Then variants 1, 3 come first.",
    ]
    assert shown["other_changes"] == "3 assumptions with alternatives (1 without trials)"
    tiny = [{"measure": "time", "weight": 0.4, "low": 4.46e-5, "high": 1.0, "below": [1, 2, 3], "above": []}]
    shown = first_screen_content(changed(modelling={"rows": []}, weight_ranges=tiny))
    assert shown["changes"] == ["Weight of TIME: nearly 0 instead of 0.4. Then variants 1–3 come first."]
    free = [{"measure": "time", "weight": 0.4, "low": 0.0, "high": 1.0, "below": [], "above": []}]
    shown = first_screen_content(changed(modelling={"rows": []}, weight_ranges=free))
    assert shown["changes"] == ["No weight: a single measure is valued."]
    shown = first_screen_content(changed(modelling={"rows": []}, weight_ranges=free * 2))
    assert shown["changes"] == ["No weight by itself: each can have any value while the others keep their proportions."]
    shown = first_screen_content(changed(modelling={"rows": []}, weight_ranges=[]))
    assert (shown["changes"], shown["other_changes"]) == ([], "")


def test_only_some_of_many_changes_are_named_and_the_others_counted():
    rows = [{"changes": True, "sentence": f"Change {number}."} for number in range(5)]
    shown = first_screen_content(changed(modelling={"rows": rows}, weight_ranges=[]))
    assert shown["changes"] == ["Change 0.", "Change 1."]
    assert shown["other_changes"] == "5 assumptions with alternatives (3 more change it)"


def test_without_a_choice_there_is_none():
    assert first_screen_content(changed(chosen=None)) is None


def test_a_missed_requirement_of_the_choice_comes_first():
    shown = first_screen_content(changed(chosen=1, ties=[1, 2]))
    assert [one["id"] for one in shown["missed"]] == ["R1", "R2"]
    assert shown["equal"] == [2]
    assert [one["requirement"] for one in shown["bullets"]] == ["R2", "R1", "R3"]
    assert shown["bullets"][0]["verdict"] == "not_met"


def test_only_so_many_charts():
    document = copy.deepcopy(DOCUMENT)
    document["requirements"] += [requirement(f"X{n}", "cost", "<=", 2000 + n, "met") for n in range(9)]
    assert len(first_screen_content(document)["bullets"]) == MOST_BULLETS
