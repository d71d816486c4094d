"""Pairwise answers, stakeholders and ranges: weights where they are right, findings at their place where not."""

from __future__ import annotations

import pytest

from rgss.errors import DocumentError

PLAIN = (
    "values:",
    "  - {measure: P_max, worst: 0.8 kg, best: 1.4 kg}",
    "  - {measure: t_e, worst: 25 s, best: 5 s}",
    "  - {measure: S, worst: 0.8, best: 1}",
)
WEIGHED = (
    "values:",
    "  - {measure: P_max, weight: 0.5, worst: 0.8 kg, best: 1.4 kg}",
    "  - {measure: t_e, weight: 0.5, worst: 25 s, best: 5 s}",
)


def answers(*entries):
    return ("elicitation:", *(f"  - {entry}" for entry in entries))


def test_answers_give_the_weights_and_their_bounds_cut_those_that_are_admitted(read_trade_off_of):
    found = read_trade_off_of(
        *PLAIN,
        *answers(
            "{swing_of: P_max, over: t_e, ratio: 2}",
            "{swing_of: S, over: t_e, between: [1, 3], rationale: said so}",
            "{swing_of: P_max, over: S}",
        ),
    ).trade_off

    weights = found.weighting.weights
    assert weights["P_max"] == pytest.approx(2 * weights["t_e"])
    assert weights["S"] == pytest.approx(3**0.5 * weights["t_e"])
    assert {(one.heavier, one.lighter, one.times) for one in found.weight_bounds.orders} == {
        ("S", "t_e", 1.0),
        ("t_e", "S", 1.0 / 3.0),
        ("P_max", "S", 1.0),
    }
    assert found.elicited[0].weights == pytest.approx(dict(weights))


def test_answers_weigh_the_groups_that_have_no_weights(read_trade_off_of):
    found = read_trade_off_of(
        "values:",
        "  - criterion: time",
        "    weight: 0.4",
        "    of:",
        "      - {measure: t_e, worst: 25 s, best: 5 s}",
        "      - {measure: t_p, worst: 15 s, best: 1 s}",
        "  - {measure: S, weight: 0.6, worst: 0.8, best: 1}",
        *answers("{swing_of: t_e, over: t_p, ratio: 3}"),
    ).trade_off

    assert dict(found.weighting.weights) == pytest.approx({"t_e": 0.3, "t_p": 0.1, "S": 0.6})


def test_stakeholders_have_weights_of_the_measures_that_weigh(read_trade_off_of):
    found = read_trade_off_of(
        *WEIGHED,
        "accept_within: 2 %",
        "stakeholders:",
        "  one: {weights: {t_e: 1}}",
        "  two: {points: {t_e: 1, P_max: 3}, rationale: carries}",
        "  three: {answers: [{swing_of: t_e, over: P_max, ratio: 4}]}",
    ).trade_off

    assert [dict(one.weights) for one in found.stakeholders] == [
        {"P_max": 0.0, "t_e": 1.0},
        {"P_max": 0.75, "t_e": 0.25},
        pytest.approx({"P_max": 0.2, "t_e": 0.8}),
    ]
    assert list(found.elicited_by) == ["three"]
    assert found.accept_within == pytest.approx(0.02)


FINDINGS = [
    (
        (*PLAIN, *answers("{swing_of: P_max, over: t_e, ratio: 2}")),
        "7:5: error: no answer names 'S' (compare each criterion with another, or drop it) [study.elicitation]",
    ),
    (
        (*PLAIN, *answers("{swing_of: P_max, over: t_e, ratio: 2, between: [1, 2]}")),
        "7:55: error: an answer is a ratio or a range of ratios (keep 'ratio' or 'between')",
    ),
    (
        (*PLAIN, *answers("{swing_of: P_max, over: t_e, between: [2, 2]}")),
        "7:45: error: a range of ratios needs two different numbers, got 2 twice (write 'ratio: 2' for a judgement)",
    ),
    (
        (*PLAIN, *answers("{swing_of: P_max, over: t_e, ratio: 0}")),
        "7:43: error: the ratio of 'P_max' and 't_e' cannot lie between 0 and 0",
    ),
    (
        (*PLAIN, *answers("{swing_of: P_max, over: t_e, ratio: 1e160}")),
        "7:43: error: the ratio of 'P_max' and 't_e' must be from 1e-09 to 1e+09, got 1e+160",
    ),
    (
        (*PLAIN, *answers("{swing_of: S, over: S}")),
        "7:18: error: 'S' is compared with itself",
    ),
    (
        (
            *PLAIN,
            *answers(
                "{swing_of: P_max, over: t_e, ratio: 3}",
                "{swing_of: P_max, over: t_e, between: [2, 3]}",
                "{swing_of: S, over: P_max}",
                "{swing_of: t_e, over: S}",
            ),
        ),
        "8:7: error: P_max = 2 to 3 × t_e, S ≥ P_max, t_e ≥ S cannot hold together: around the circle the product is 2",
    ),
    (
        (*WEIGHED, *answers("{swing_of: P_max, over: speed}")),
        "6:31: error: no criterion 'speed' is valued (criteria: P_max, t_e)",
    ),
    (
        (*WEIGHED, *answers("{swing_of: P_max, over: t_e}")),
        "6:7: error: 'P_max' and 't_e' are not members of one group without weights",
    ),
    (
        (*WEIGHED, "stakeholders: {me: {rationale: all}}"),
        "5:22: error: stakeholder 'me' has no weights (give one of 'weights', 'points' and 'answers')",
    ),
    (
        (*WEIGHED, "stakeholders: {me: {weights: {t_e: 1}, points: {t_e: 1}}}"),
        "5:22: error: stakeholder 'me' has 'weights' and 'points'",
    ),
    ((*WEIGHED, "stakeholders: {me: {weights: {t_e: 0.6}}}"), "error: weights must sum to 1, got 0.6"),
    ((*WEIGHED, "stakeholders: {me: {weights: {t_p: 1}}}"), "error: measure 't_p' has no weight in the study"),
    ((*WEIGHED, "accept_within: 2"), "5:18: error: accept_within must be from 0 to 1, got 2"),
    ((*WEIGHED, "sensitivity: {weights: 1}"), "5:26: error: weights must be from 0 to below 1, got 1"),
    ((*WEIGHED, "sensitivity: {risk_tolerance: 0}"), "5:33: error: risk_tolerance must be at least 0.02, got 0"),
    (
        (*WEIGHED, "sensitivity: {priced_in: C_total}"),
        "5:28: error: priced_in: 'C_total' has no weight (name one of P_max, t_e)",
    ),
    (
        (
            *WEIGHED[:2],
            "  - {measure: t_e, weight: 0.5, target: 15 s, too_low: 5 s, too_high: 25 s}",
            "sensitivity: {priced_in: t_e}",
        ),
        "5:28: error: priced_in: 't_e' has a target (name one of P_max)",
    ),
    ((*WEIGHED, "sensitivity: {keep_within: 2}"), "5:30: error: keep_within must be from 0 to 1, got 2"),
    (
        (
            *WEIGHED,
            "sensitivity:",
            "  ranges:",
            "    - {input: weight.t_e, low: 0, high: 1}",
            "    - {input: weight.t_e, low: 0, high: 1}",
        ),
        "error: 'weight.t_e' has two ranges (keep one)",
    ),
]


@pytest.mark.parametrize(("lines", "message"), FINDINGS, ids=[message[:60] for _, message in FINDINGS])
def test_finding(read_trade_off_of, lines, message):
    with pytest.raises(DocumentError) as caught:
        read_trade_off_of(*lines)

    assert any(message in str(finding) for finding in caught.value.findings), [*map(str, caught.value.findings)]
