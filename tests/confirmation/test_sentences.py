"""What a confirmation says at its top."""

import dataclasses
import json

import pytest

from rgss.evidence import Failure
from rgss.measures import Verdict
from rgss.reports.confirmation import confirmation_lines, confirmation_to_json, confirmation_to_markdown
from rgss.reports.confirmation.sentences import ARM_IN_PYBULLET
from tests.fixtures.eight_states import Phase


def first_lines(confirmation, count=3):
    return list(confirmation_lines(confirmation))[:count]


def test_a_decision_that_holds(confirmation):
    found = confirmation(rankings=[(28, 31), (28, 31), (28, 31)])
    assert found.holds
    assert first_lines(found) == [
        "The decision does not depend on the step or the engine: variant 28 is first under all three settings.",
        "All 2 verdicts on 1 design are the same under every setting.",
        "The trial ends alike.",
    ]


def test_another_order_behind_the_first_is_no_other_decision(confirmation):
    assert confirmation(rankings=[(28, 31, 10), (28, 10, 31)]).holds


def test_a_decision_that_depends_on_the_engine(confirmation):
    found = confirmation(rankings=[(28, 31), (28, 31), (31, 28)])
    assert not found.holds
    assert first_lines(found)[0] == (
        "The decision depends on the engine: variant 28 is first under PyBullet 240 Hz, 20 iterations and "
        "PyBullet 1000 Hz, 20 iterations; variant 31 is first under MuJoCo 3.9, 2000 Hz."
    )


def test_a_decision_that_has_no_design_left(confirmation):
    found = confirmation(rankings=[(28,), ()])
    assert first_lines(found)[0] == (
        "The decision depends on the step: variant 28 is first under PyBullet 240 Hz, 20 iterations; "
        "no design is first under PyBullet 1000 Hz, 20 iterations."
    )


def test_no_design_under_any_setting(confirmation):
    assert first_lines(confirmation(rankings=[(), ()]), 1) == [
        "The decision does not depend on the step: no design meets every requirement under both settings."
    ]


def test_a_tie_that_another_setting_breaks_by_little_is_no_other_decision(confirmation):
    found = confirmation(rankings=[(28, 31), (31, 28)], ties=[(28, 31), (31,)], step=0.009)
    assert found.holds
    assert first_lines(found, 1) == [
        "The decision does not depend on the step: variant 28 (or 31, equally good) is first under both settings."
    ]


@pytest.mark.parametrize("under_step", [(31,), (31, 28)])
def test_a_tied_design_does_not_hide_that_the_first_is_infeasible_or_worse(confirmation, under_step):
    found = confirmation(rankings=[(28, 31), under_step], ties=[(28, 31), (31,)])
    assert not found.holds
    assert first_lines(found, 1)[0] == (
        "The decision depends on the step: variant 28 is first under PyBullet 240 Hz, 20 iterations; variant 31 is "
        "first under PyBullet 1000 Hz, 20 iterations."
    )


def test_a_design_that_is_equally_good_under_a_setting_is_no_other_decision(confirmation):
    assert confirmation(rankings=[(28, 31), (31, 28)], ties=[(28,), (31, 28)]).holds


def test_another_first_design_that_is_hardly_better_is_no_other_decision(confirmation):
    found = confirmation(rankings=[(28, 31), (31, 28)], step=0.009)
    assert found.holds
    assert first_lines(found, 1)[0] == (
        "The decision does not depend on the step: variant 28 (or 31, better within the practical margin) is first "
        "under both settings."
    )
    assert not confirmation(rankings=[(28, 31), (31, 28)], step=0.011).holds
    assert not confirmation(rankings=[(28, 31), (31,)], step=0.0).holds


def test_of_designs_that_are_not_confirmed_nothing_is_said(confirmation):
    """Another design may be infeasible by the study's physics alone."""
    found = confirmation(rankings=[(28, 31), (28, 31)], designs=72)
    assert first_lines(found, 1) == [
        "Among 2 of 72 designs the decision does not depend on the step: variant 28 is first under both settings."
    ]
    assert confirmation_to_json(found)["designs"] == 72
    found = confirmation(rankings=[(28, 31), (31, 28)], designs=72)
    assert first_lines(found, 1)[0].startswith("Among 2 of 72 designs the decision depends on the step: variant 28 is")


def test_a_choice_that_is_not_the_first_by_the_confirmed_seeds(confirmation):
    found = confirmation(rankings=[(31, 28), (31, 28)])
    assert first_lines(found, 2) == [
        "The decision does not depend on the step: variant 31 is first under both settings.",
        "The study chooses variant 28; by the one seed of this confirmation variant 31 is first in it.",
    ]
    assert confirmation_to_json(found)["choice"] == first_lines(found, 2)[1]
    assert confirmation_to_json(confirmation(rankings=[(28,), (28,)]))["choice"] == ""


def test_the_choice_is_compared_where_another_is_first_by_little_and_it_is_infeasible_elsewhere(confirmation):
    found = confirmation(rankings=[(31, 28), (31,)], step=0.009)
    assert not found.holds
    assert first_lines(found, 2) == [
        (
            "The decision depends on the step: variant 28 is first under PyBullet 240 Hz, 20 iterations; variant 31 is "
            "first under PyBullet 1000 Hz, 20 iterations."
        ),
        (
            "The study chooses variant 28; by the one seed of this confirmation variant 31 is first in it, and variant "
            "28 is as good."
        ),
    ]


@pytest.mark.parametrize(
    ("planned", "told"),
    [
        ((True,), "No trial of these designs reaches physics, so that nothing of it is confirmed."),
        ((True, False, False), "1 of 3 trials of these designs ends before physics, which no setting changes."),
        ((True, True, False), "2 of 3 trials of these designs end before physics, which no setting changes."),
    ],
)
def test_trials_that_end_before_physics_confirm_nothing_of_it(confirmation, record, planned, told):
    rows = [
        [record(seed=seed, failure=Failure.UNREACHABLE_WAYPOINT if each else None, phase=Phase.MOVE_TO_PLACE)] * 2
        for seed, each in enumerate(planned, start=1)
    ]
    found = confirmation(rankings=[(28,), (28,)], records=rows)
    assert told in first_lines(found, 4)
    assert confirmation_to_json(found)["trials_before_physics"] == sum(planned)


def test_designs_without_a_verdict(confirmation):
    found = confirmation(rankings=[(28,), (28,)])
    results = tuple(dataclasses.replace(one, verdicts={28: {}}) for one in found.results)
    assert first_lines(dataclasses.replace(found, results=results), 2)[1] == (
        "No requirement has a criterion, so that there are no verdicts."
    )


def test_a_verdict_that_depends_on_the_setting(confirmation):
    found = confirmation(rankings=[(28,), (28,), (28,)], verdicts=[Verdict.MET, Verdict.MET, Verdict.NOT_MET])
    assert not found.holds
    assert first_lines(found, 2)[1] == (
        "1 of 2 verdicts depends on the setting: SYS-012 of variant 28 is met in the study and not met under "
        "MuJoCo 3.9, 2000 Hz."
    )
    assert any(
        line.split() == ["28", "SYS-012", "met", "the", "same", "not", "met"] for line in confirmation_lines(found)
    )


def test_outcomes_that_differ_are_told_with_their_numbers_and_fail_nothing(confirmation, record, dropped):
    rows = [[record(slip_m=1e-5), dropped, dropped], [record(seed=2, slip_m=1e-5)] * 3]
    found = confirmation(rankings=[(28,)] * 3, records=rows)
    assert found.holds
    assert first_lines(found)[2] == (
        "1 of 2 trials ends otherwise: variant 28, seed 1: success in the study, object_dropped at lift under "
        "PyBullet 1000 Hz, 20 iterations (the object slipped 20.1 mm) and object_dropped at lift under "
        "MuJoCo 3.9, 2000 Hz (the object slipped 20.1 mm)."
    )
    # A trial that ended otherwise says nothing of the metrics of one that did not.
    assert found.largest_difference("slip_m", 1) == 0.0
    assert found.extreme("slip_m", 1) == (1e-5, 0.0201)


def test_of_several_trials_that_end_otherwise_each_has_a_line(confirmation, record, dropped):
    rows = [[record(seed=seed, slip_m=1e-5), dropped, dropped] for seed in (1, 2)] + [[record(seed=3)] * 3]
    found = confirmation(rankings=[(28,)] * 3, records=rows)
    count, *trials = first_lines(found, 5)[2:]
    assert count == "2 of 3 trials end otherwise:"
    expected = (
        "success in the study, object_dropped at lift under PyBullet 1000 Hz, 20 iterations (the object slipped 20.1 "
        "mm) and object_dropped at lift under MuJoCo 3.9, 2000 Hz (the object slipped 20.1 mm)."
    )
    assert trials == [f"  variant 28, seed {seed}: {expected}" for seed in (1, 2)]


def test_the_same_failure_elsewhere_is_another_outcome(confirmation, record):
    rows = [[record(failure=Failure.OBJECT_DROPPED, phase=phase) for phase in (Phase.LIFT, Phase.MOVE_TO_PLACE)]]
    assert [trial.differing for trial in confirmation(rankings=[(28,)] * 2, records=rows).differing_trials] == [(1,)]


def test_what_was_left_out_is_told(confirmation):
    found = confirmation(rankings=[(28,)] * 2, left_out=(10, 13), planned_failures=114, physical_failures=7)
    left_out, failures = first_lines(found, 5)[3:]
    assert left_out == "Rivals that were not confirmed: 10, 13 (name them with --variants)."
    assert failures == (
        "Failures of the study: 114 before physics, which no engine changes, and 7 in physics, of which 0 of designs "
        "that are not confirmed were run again."
    )


def test_json_and_markdown_say_the_same(confirmation, record, dropped):
    found = confirmation(rankings=[(28, 31), (31,)], records=[[record(slip_m=None), dropped]])
    document = confirmation_to_json(found)
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert (document["holds"], document["chosen"], document["variants"]) == (False, 28, [28, 31])
    assert [one["first"] for one in document["settings"]] == [28, 31]
    (trial,) = document["trials"]
    assert trial["differs"]
    assert [one["outcome"] for one in trial["settings"]] == ["success", "object_dropped at lift"]
    assert [one["metrics"]["slip_m"] for one in trial["settings"]] == [None, 0.0201]
    page = confirmation_to_markdown(found)
    assert page.startswith("# Confirmation of pick\\_place\n\nThe decision depends on the step: variant 28 is first")
    assert "| 28 | 1 | design | success | object\\_dropped at lift |" in page


def test_text_from_a_file_steers_neither_terminal_nor_page(confirmation, record):
    hostile = record(failure=Failure.OBJECT_DROPPED, phase=Phase.LIFT, detail="\x1b[31m<b>|`x`")
    found = confirmation(rankings=[(28,)] * 2, records=[[record(), hostile]])
    assert "\x1b" not in "\n".join(confirmation_lines(found))
    page = confirmation_to_markdown(found)
    assert "\x1b" not in page
    assert "\\<b\\>\\|\\`x\\`" in page


def test_an_arm_that_one_engine_moves_under_every_setting_is_told(confirmation):
    found = confirmation(rankings=[(28,)] * 3)
    told = dataclasses.replace(found, arm_is_pybullet=True)
    assert ARM_IN_PYBULLET not in first_lines(found, 9)
    assert first_lines(told, 4)[3] == ARM_IN_PYBULLET
    assert confirmation_to_json(told)["arm_is_pybullet"] is True
    of_steps = dataclasses.replace(confirmation(rankings=[(28,)] * 2), arm_is_pybullet=True)
    assert ARM_IN_PYBULLET not in first_lines(of_steps, 9)


def test_verdicts_that_are_open_under_every_setting_are_no_confirmation(confirmation):
    found = confirmation(rankings=[(28, 31), (28, 31)], verdicts=[Verdict.INCONCLUSIVE] * 2)
    assert first_lines(found)[1] == (
        "All 2 verdicts on 1 design are the same under every setting, but 1 of them is inconclusive by so few seeds."
    )
