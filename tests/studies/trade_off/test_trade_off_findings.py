"""Reading a study's trade-off: a finding at its place for each mistake."""

from __future__ import annotations

import pytest

from rgss.errors import DocumentError
from rgss.studies.project import load_project

PAYLOAD = "{measure: P_max, weight: 0.5, worst: 0.8 kg, best: 1.4 kg}"
TIME = "{measure: t_e, weight: 0.5, worst: 25 s, best: 5 s}"
BOTH = ("values:", f"  - {PAYLOAD}", f"  - {TIME}")


def values(*entries):
    return ("values:", *(f"  - {entry}" for entry in entries))


FINDINGS = [
    # values
    (
        values("{measure: P_max, weight: 1, best: 1.4 kg}"),
        "3:7: error: 'P_max' has no 'worst' (give 'worst' and 'best')",
    ),
    (values("{measure: t_e, weight: 1, target: 9 s, too_low: 5 s}"), "3:7: error: 't_e' has no 'too_high'"),
    (
        values("{measure: t_e, weight: 1, target: 9 s, too_low: 5 s, too_high: 25 s, best: 5 s}"),
        "3:82: error: 't_e' has a target and 'best' (keep one kind of value) [study.value]",
    ),
    (
        values("{measure: t_e, weight: 1, worst: 25 s, best: 5 s, halfway: 9 s, between: [{at: 9 s, worth: 0.5}]}"),
        "3:66: error: 't_e' has 'between' and 'halfway'",
    ),
    (
        values("{measure: t_e, weight: 1, worst: 25 s, best: 5 s, halfway: 30 s}"),
        "3:66: error: the value function of 't_e' has no half-way",
    ),
    (
        values("{measure: t_e, weight: 1, worst: 25 s, best: 5 s, between: [{at: 30 s, worth: 0.5}]}"),
        "3:66: error: the value function of 't_e' is out of order at (30, 0.5)",
    ),
    (
        values("{measure: t_e, weight: 1, worst: 25 s, best: 5 s, between: [{at: long, worth: 0.5}]}"),
        "3:72: error: 'long' is not a quantity",
    ),
    (
        values("{measure: t_e, weight: 1, target: 5 s, too_low: 9 s, too_high: 25 s}"),
        "3:41: error: the target 5 of 't_e' is not between",
    ),
    (
        values("{measure: t_e, weight: 1, worst: 5 s, best: 25 s}"),
        "3:51: error: less t_e is better, but this values more of it higher (exchange worst and best)",
    ),
    (values("{weight: 1, worst: 5 s, best: 25 s}"), "3:7: error: an entry is a measure or a criterion"),
    (
        values("{measure: t_e, criterion: x, weight: 1, worst: 25 s, best: 5 s}"),
        "3:7: error: an entry is a measure or a criterion",
    ),
    (
        values("{measure: t_e, weight: 1, worst: 25 s, best: 5 s, wrost: 3 s}"),
        "3:57: error: unknown key 'wrost' (did you mean 'worst'?)",
    ),
    (
        values("{measure: t_e, weight: 1, worst: [25 s], best: 5 s}"),
        "3:40: error: worst: a text is expected",
    ),
    (
        values("{measure: t_ee, weight: 1, worst: 25 s, best: 5 s}"),
        "3:17: error: no measure 't_ee' is defined (did you mean 't_e'?) [study.unknown-measure]",
    ),
    (
        values("{measure: happiness, weight: 1, worst: 0, best: 1}"),
        "3:17: error: no measure 'happiness' is defined (name one of the measures' file) [study.unknown-measure]",
    ),
    # anchors
    (
        values("{measure: t_e, weight: 1, worst: {requirement: SYS-999}, best: 5 s}"),
        "3:40: error: unknown system requirement 'SYS-999'",
    ),
    (
        values("{measure: t_e, weight: 1, worst: {requirement: SYS-001}, best: 5 s}"),
        "3:40: error: SYS-001 has no criterion, so no threshold",
    ),
    (
        values("{measure: t_e, weight: 1, worst: {requirement: SYS-004}, best: 5 s}"),
        "3:40: error: SYS-004 bounds C_total, not t_e (name a requirement on the same measure) [study.requirement]",
    ),
    (
        values("{measure: t_e, weight: 1, worst: {requirement: SYS-005, times: 0}, best: 5 s}"),
        "3:70: error: times must be greater than 0, got 0",
    ),
    (
        values("{measure: t_e, weight: 1, worst: {requiremnt: SYS-005}, best: 5 s}"),
        "3:41: error: unknown key 'requiremnt' (did you mean",
    ),
    (
        values("{measure: t_e_simulated, weight: 1, worst: {requirement: SYS-005}, best: 30 s}"),
        "3:80: error: less t_e_simulated is better, but this values more of it higher (a requirement's",
    ),
    # weights
    (
        values("{measure: t_e, worst: 25 s, best: 5 s}"),
        "3:7: error: 't_e' has no weight (give one of 'weight', 'points' and 'rank')",
    ),
    (values("{measure: t_e, weight: 1, rank: 1, worst: 25 s, best: 5 s}"), "3:7: error: 't_e' has 'weight' and 'rank'"),
    (
        values(PAYLOAD, "{measure: t_e, points: 5, worst: 25 s, best: 5 s}"),
        "3:5: error: 'P_max' has 'weight' and 't_e' has 'points' (weigh the members of a group alike)",
    ),
    (
        values("{measure: t_e, rank: 1, worst: 25 s, best: 5 s}"),
        "3:5: error: ranks need a rule (give 'rank_rule': rank_order_centroid",
    ),
    (("rank_rule: rank_sum", *BOTH), "2:14: error: a rank rule, but 'P_max' has no rank (take it out) [study.weights]"),
    (("rank_rule: magic", *BOTH), "2:14: error: rank_rule: 'magic' is not one of"),
    (
        values("{measure: t_e, rank_rule: rank_sum, weight: 1, worst: 25 s, best: 5 s}"),
        "3:33: error: 't_e' has a rank rule but no members",
    ),
    (
        ("rank_rule: rank_sum", *values("{measure: t_e, rank: 2, worst: 25 s, best: 5 s}")),
        "4:5: error: rank of 't_e' must be 1, got 2",
    ),
    (
        values("{measure: t_e, points: -5, worst: 25 s, best: 5 s}"),
        "3:30: error: points of 't_e' must be at least 0, got -5",
    ),
    (values("{measure: t_e, weight: 0.9, worst: 25 s, best: 5 s}"), "3:5: error: weights must sum to 1, got 0.9"),
    # groups
    (values("{criterion: time, weight: 1}"), "3:7: error: criterion 'time' has no members (list them in 'of')"),
    (values(f"{{criterion: time, weight: 1, of: [{TIME}]}}"), "3:40: error: weights must sum to 1, got 0.5"),
    (
        values(f"{{criterion: time, weight: 1, worst: 5 s, of: [{TIME.replace('0.5', '1')}]}}"),
        "3:43: error: criterion 'time' has members, not 'worst' of its own (value its members)",
    ),
    (values(f"{{measure: S, weight: 1, of: [{TIME.replace('0.5', '1')}]}}"), "3:35: error: measure 'S' has members"),
    (
        values(f"{{criterion: t_e, weight: 1, of: [{TIME.replace('0.5', '1')}]}}"),
        "3:50: error: measure 't_e' is valued twice",
    ),
    # bounds on weights
    (
        values("{measure: t_e, weight: 1, weight_between: [0.6, 0.4], worst: 25 s, best: 5 s}"),
        "3:49: error: the weight of 't_e' cannot lie between 0.6 and 0.4",
    ),
    (
        values("{measure: t_e, weight: 1, weight_between: [0.2, 0.4], worst: 25 s, best: 5 s}"),
        "3:5: error: the weight of 't_e' is 1, outside of its bounds 0.2 to 0.4",
    ),
    (
        (*BOTH, "weight_order:", "  - {heavier: P_max, lighter: x}"),
        "6:33: error: no criterion 'x' is valued (criteria: P_max, t_e)",
    ),
    (
        (*BOTH, "weight_order:", "  - {heavier: P_max, lighter: t_e, times: -1}"),
        "6:45: error: 'P_max' cannot weigh -1 times 't_e'",
    ),
    (
        (*BOTH, "weight_order:", "  - {heavier: P_max, lighter: t_e, times: 2}"),
        "6:5: error: the weight of 'P_max' is 0.5, below 2 times that of 't_e', 0.5",
    ),
    # programs
    ((*BOTH, "decide_by: {program: magic}"), "5:24: error: program: 'magic' is not one of 'additive', 'lexicographic'"),
    ((*BOTH, "decide_by: {over: weights}"), "5:14: error: key 'program' is missing"),
    ((*BOTH, "decide_by: {program: lexicographic}"), "5:14: error: key 'order' is missing"),
    (
        (*BOTH, "decide_by: {program: lexicographic, order: [{measure: t_e, absolute: 1 s, relative: 5 %}]}"),
        "5:47: error: 't_e' has two tolerances that contradict each other: 1 and 5 %",
    ),
    (
        (*BOTH, "decide_by: {program: lexicographic, order: [{measure: t_e, absolute: -1 s}]}"),
        "5:47: error: absolute tolerance of 't_e' must be at least 0, got -1",
    ),
    (
        (*BOTH, "decide_by: {program: lexicographic, order: [{measure: t_e, relative: 120 %}]}"),
        "5:47: error: relative tolerance of 't_e' must be below 100 %, got 120 %",
    ),
    (
        (*BOTH, "decide_by: {program: lexicographic, order: [{measure: t_e, absolute: 1 kg}]}"),
        "5:72: error: unit 'kg' does not measure what 's' measures",
    ),
    (
        (*BOTH, "decide_by: {program: lexicographic, order: [{measure: t_e}, {measure: t_e}]}"),
        "5:46: error: 't_e' occurs twice in a lexicographic program",
    ),
    ((*BOTH, "decide_by: {program: lexicographic, order: [{measure: x}]}"), "5:57: error: no measure 'x' is defined"),
    (
        (*BOTH, "decide_by: {program: lexicographic, order: [{measure: v_m_peak}]}"),
        "5:57: error: measure v_m_peak has no preferred direction",
    ),
    (
        (*BOTH, "decide_by: {program: epsilon_constraint, optimise: {measure: t_e}, limits: [{measure: t_p}]}"),
        "5:79: error: 't_p' has no bound (give 'at_most' or 'at_least') [study.bound]",
    ),
    (
        (*BOTH, "decide_by: {program: tchebycheff, reference: {t_p: 3 s}}"),
        "5:54: error: the reference names 't_p', which has no weight",
    ),
    (
        (*BOTH, "decide_by: {program: tchebycheff, augmentation: 0}"),
        "5:51: error: augmentation must be above 0 and at most 1, got 0",
    ),
    (
        (*BOTH, "decide_by: {program: minimax_regret, over: days}"),
        "5:46: error: over: 'days' is not one of 'weights' or 'replicates'",
    ),
    # margins
    ((*BOTH, "practical_margin: -0.1"), "5:21: error: practical_margin must be at least 0, got -0.1"),
    ((*BOTH, "tolerance: 100 %"), "5:14: error: tolerance must be from 0 to below 1, got 1"),
    ((*BOTH, "tolerance: -0.1"), "5:14: error: tolerance must be from 0 to below 1, got -0.1"),
    (
        (*BOTH, "practical_margin: 0.1", "decide_by: {program: lexicographic, order: [{measure: t_e}]}"),
        "5:21: error: the lexicographic program compares quantities, not values",
    ),
    # risks
    (
        (*BOTH, "chance: [{requirement: SYS-005, probability: 1}]"),
        "5:48: error: probability must be between 0 and 1, got 1 (such as 0.9)",
    ),
    (
        (*BOTH, "tail: [{requirement: SYS-005, worst_share: 0}]"),
        "5:46: error: worst_share must be between 0 and 1, got 0",
    ),
    ((*BOTH, "chance: [{probability: 0.5}]"), "5:12: error: a chance is of a requirement or of a measure"),
    ((*BOTH, "tail: [{requirement: SYS-001, worst_share: 0.5}]"), "5:24: error: SYS-001 has no criterion"),
    (
        (*BOTH, "chance: [{requirement: SYS-005, at_most: 3 s, probability: 0.5}]"),
        "5:44: error: SYS-005 has its own threshold",
    ),
    ((*BOTH, "chance: [{measure: t_e, probability: 0.5}]"), "5:12: error: 't_e' has no bound"),
    (
        (*BOTH, "chance: [{measure: t_e, at_most: 3 s, at_least: 1 s, probability: 0.5}]"),
        "5:12: error: 't_e' has two bounds",
    ),
    (
        (*BOTH, "chance: [{requirement: SYS-005, probability: 0.5}, {requirement: SYS-005, probability: 0.6}]"),
        "5:54: error: chance:SYS-005 is demanded twice",
    ),
    # levels and portfolios
    ((*BOTH, "choose: colours"), "5:11: error: choose: 'colours' is not one of 'variants' or 'levels'"),
    (
        (*BOTH, "portfolio: {at_most: 0, studies: [{study: a, weight: 1}]}"),
        "5:24: error: at_most: input should be greater",
    ),
    (
        (*BOTH, "portfolio: {at_most: 1, studies: [{study: a, weight: 0.5}]}"),
        "5:36: error: weights must sum to 1, got 0.5",
    ),
    (
        (*BOTH, "portfolio: {at_most: 1, studies: [{study: a, weight: 0.5}, {study: a, weight: 0.5}]}"),
        "5:70: error: study 'a' is named twice",
    ),
    (
        (*BOTH, "portfolio: {at_most: 1, studies: [{study: a, weight: 1}]}", "decide_by: {program: tchebycheff}"),
        "5:14: error: a portfolio is chosen by weighted value, not by the tchebycheff program",
    ),
]


@pytest.mark.parametrize(("lines", "expected"), FINDINGS, ids=[expected.split(": ")[2] for _, expected in FINDINGS])
def test_finding(read_trade_off_of, lines, expected):
    with pytest.raises(DocumentError) as caught:
        read_trade_off_of(*lines)
    (finding,) = caught.value.findings
    assert str(finding).startswith(f"s:{expected}")
    assert finding.hint or finding.rule.startswith("document.")


def test_several_findings_at_once(read_trade_off_of):
    with pytest.raises(DocumentError) as caught:
        read_trade_off_of(
            *values("{measure: P_max, weight: 0.5, worst: heavy, best: 1.4 kg}", TIME.replace("0.5", "0.6")),
            "chance: [{requirement: SYS-999, probability: 0.5}]",
        )
    assert [finding.line for finding in caught.value.findings] == [3, 3, 5]


def test_the_project_s_own_requirements_are_looked_up(folder, edit, problems, place_of):
    file = "studies/pick_place.yaml"
    edit(
        file,
        "{measure: P_max, weight: 0.25, worst: 0.8 kg,",
        "{measure: P_max_simulated, weight: 0.25, worst: {requirement: SYS-012},",
    )
    assert load_project(folder).study.values[0].worst == 0.8
    edit(file, "{requirement: SYS-012}", "{requirement: SYS-112}")
    (problem,) = problems()
    assert problem.startswith(f"{place_of(file, '{requirement')}: error: unknown system requirement 'SYS-112'")
    assert "(did you mean 'SYS-012'?)" in problem


def test_requirements_that_cannot_be_read_are_told_once(folder, edit, problems):
    edit("studies/pick_place.yaml", "worst: 0.8 kg", "worst: {requirement: SYS-012}")
    (folder / "requirements/stakeholder.yaml").write_text("requirements: 3\n", encoding="utf-8")
    (problem,) = problems()
    assert problem.startswith("requirements/stakeholder.yaml:1:")
