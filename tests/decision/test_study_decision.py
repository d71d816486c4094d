"""The decision of a study as one value: its pages show the same figures in the same words."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import trade_problem
from rgss.decision.robustness import robustness
from rgss.decision.robustness.parts import NotComputed, Part
from rgss.decision.study_decision import decide_study
from rgss.decision.study_decision.findings import robustness_findings
from rgss.decision.study_decision.reasons import closest_limits
from rgss.decision.what_if import suppose
from rgss.reports.decision import decision_lines, decision_part, decision_section, reasons, trade_document
from rgss.reports.decision.words import score
from rgss.reports.study.variants import weight_columns
from rgss.tradeoff import Comparison, Threshold
from rgss.tradeoff.robustness import Support


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    store = filled(shipped, lambda spec: record_of(spec, planning_s=0.5 + 0.01 * spec.variant + 0.1 * spec.seed))
    return measure_variants(shipped, store)


@pytest.fixture(scope="module")
def made(shipped, measured):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(robustness, "ITERATIONS", 200)
        return decide_study(shipped, measured, evidence="evidence.sqlite")


def test_the_terminal_and_the_report_word_reasons_and_cautions_once(made):
    lines, part = list(decision_lines(made)), decision_part(made)

    assert part["reasons"]
    for reason in part["reasons"]:
        assert any(reason.startswith(line) for line in lines if line), reason
    assert [f"Caution: {caution}" for caution in part["cautions"]] == [
        one for one in lines if one.startswith("Caution")
    ]


@pytest.mark.parametrize(
    ("apart", "words"),
    [(0.0, "."), (0.02, ", with other contributions: {first} +0.0200, {second} -0.0200.")],
)
def test_over_a_tied_runner_up_there_is_no_lead(made, apart, words):
    decision = made.decision
    first, second, *others = made.gains
    gains = (
        dataclasses.replace(first, amount=apart),
        dataclasses.replace(second, amount=-apart),
        *(dataclasses.replace(one, amount=0.0) for one in others),
    )
    tied = dataclasses.replace(decision, ties=(decision.chosen, decision.runner_up))
    said = [one.text for one in reasons(dataclasses.replace(made, decision=tied, gains=gains))]
    assert not [text for text in said if "leads the runner-up" in text]
    same = f"The runner-up {decision.runner_up} has the same value"
    assert same + words.format(first=first.measure, second=second.measure) in said


def test_a_variant_that_is_tied_at_the_weights_of_the_study_alone_is_no_distant_rival(shipped, made):
    """The nearest move is of those that are not tied, and is not said to be the smallest that changes the choice."""
    found = made.robustness.analysis
    shifts = found.weighting.shifts
    own = next(shift for shift in shifts if made.decision.chosen in [found.variants[row] for row in shift.rows])
    other = next(shift for shift in shifts if shift is not own)
    tied = dataclasses.replace(other, distance=0.0, sum_distance=0.0, nearest=own.nearest, nearest_in_sum=own.nearest)
    rest = [shift for shift in shifts if shift not in (own, other)]
    weighting = dataclasses.replace(found.weighting, shifts=(tied, own, *rest))
    findings = robustness_findings(
        shipped, dataclasses.replace(found, weighting=weighting), chosen=made.decision.chosen
    )
    names = tuple(found.variants[row] for row in other.rows)

    assert findings.tied_by_weights == names
    assert findings.nearest_move.winners != names
    told = dataclasses.replace(made, robustness=dataclasses.replace(made.robustness, tied_by_weights=names))
    for text in ("\n".join(decision_lines(told)), decision_section(told)):
        assert "At these weights alone variant" in text
        assert "no smaller move" not in text
        assert "no other variant wins" not in text


def test_what_is_best_alone_for_no_weights_does_not_win_by_moving_them(shipped, made):
    """A dominated variant may be tied where the others have no weight: though the nearest, it is passed over."""
    found = made.robustness.analysis
    ids = {found.variants[row] for shift in found.weighting.shifts for row in shift.rows}
    plain = robustness_findings(shipped, found, chosen=made.decision.chosen)
    points = tuple(
        dataclasses.replace(point, support=Support.WEAKLY_SUPPORTED)
        if found.variants[point.row] in plain.nearest_move.winners
        else point
        for point in found.front.points
    )
    front = dataclasses.replace(found.front, points=points)
    other = robustness_findings(shipped, dataclasses.replace(found, front=front), chosen=made.decision.chosen)

    assert set(plain.nearest_move.winners) <= ids
    assert other.nearest_move is None or other.nearest_move.winners != plain.nearest_move.winners
    assert other.nearest_move is None or other.nearest_move.moved > plain.nearest_move.moved


def test_a_near_tie_without_a_margin_is_one_of_the_programs_tolerance(made):
    near = dataclasses.replace(made.decision, near_ties=(3,))
    for margin, told in (
        (0.0, "As good within the program's tolerance: "),
        (0.01, "Within the practical margin of 0.01"),
    ):
        other = dataclasses.replace(made, decision=near, practical_margin=margin)
        assert sum(reason.startswith(told) for reason in decision_part(other)["reasons"]) == 1


def test_every_page_has_the_same_figures(made):
    text, part, document = "\n".join(decision_lines(made)), decision_part(made), trade_document(made)
    section = decision_section(made)
    move = made.robustness.nearest_move
    nearest = min(
        (one for one in document["robustness"]["weight_changes"]["nearest"] if one["distance"] > 0.0),
        key=lambda one: one["moved"],
    )

    assert move.moved == nearest["moved"]
    assert f"moving {move.moved:.3f} of weight" in text
    assert f"Moving {move.moved:.3f} of weight" in section
    assert f"| **value** | | {' | '.join(map(score, made.comparison.values))} |" in section
    shares = {
        one["variant"]: one["first"]
        for one in document["robustness"]["weight_changes"]["acceptability"]["alternatives"]
    }
    for one in part["acceptability"]["variants"]:
        assert one["first"] == pytest.approx(shares[one["variant"]], rel=1e-6)
    assert [one["requirement"] for one in part["limits"]] == [one.requirement for one in made.robustness.limits]


def test_suppositions_change_the_decision_and_keep_the_former(shipped, measured, made):
    scenario = suppose(shipped, ["weight.t_e=0.9"])
    other = decide_study(shipped, measured, evidence="evidence.sqlite", analysed=False, scenario=scenario)

    assert other.robustness is None
    assert other.what_if.before.decision == made.decision
    assert other.what_if.after.decision == other.decision
    assert other.what_if.before.lead == pytest.approx(sum(gain.amount for gain in made.gains))


def test_of_another_program_the_pages_give_its_objectives_and_no_lead_in_value(shipped, measured, read_trade_off_of):
    study = read_trade_off_of(
        "values:",
        "  - {measure: S, weight: 0.5, worst: 0.8, best: 1.0}",
        "  - {measure: P_max, weight: 0.5, worst: 0.8 kg, best: 1.4 kg}",
        "decide_by: {program: lexicographic, order: [{measure: t_p}, {measure: C_total}]}",
    )
    project = dataclasses.replace(shipped, study=study)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(robustness, "ITERATIONS", 200)
        found = decide_study(project, measured, evidence="evidence.sqlite")
    assert found.gains == ()
    assert "It leads the runner-up" not in "\n".join(decision_lines(found))
    section = decision_section(found)
    rows = found.comparison.objectives
    assert [row.name for row in rows] == ["t_p", "C_total"]
    assert "*What decides it.* The objectives of the program, in turn: `t_p` " in section
    assert section.count("| **1. t_p** | | ") == section.count("| **2. C_total** | | ") == 1
    scenario = suppose(project, ["SYS-012.threshold=0.7 kg"])
    other = decide_study(project, measured, evidence="evidence.sqlite", analysed=False, scenario=scenario)
    assert other.what_if.before.lead is other.what_if.after.lead is None


def test_a_measure_with_weight_zero_is_named_where_it_has_no_part(shipped, measured, read_trade_off_of):
    study = read_trade_off_of(
        "values:",
        "  - {measure: S, weight: 1.0, worst: 0.8, best: 1.0}",
        "  - {measure: t_p, weight: 0, worst: 15 s, best: 1 s}",
    )
    project = dataclasses.replace(shipped, study=study)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(robustness, "ITERATIONS", 200)
        found = decide_study(project, measured, evidence="evidence.sqlite")
    assert found.unweighted == ("t_p",)
    # The quantities of t_p differ, and do not break the tie.
    assert len(found.decision.ties) > 1
    assert found.decision.chosen == min(found.decision.ties)
    assert not found.decision.surpassed
    columns = weight_columns(project, found.robustness.analysis)
    assert ([one["id"] for one in columns["measures"]], columns["unweighted"]) == (["S"], ["t_p"])


def test_a_target_has_an_end_on_each_side(shipped, read_trade_off_of):
    study = read_trade_off_of(
        "values:",
        "  - {measure: S, weight: 0.5, worst: 0.8, best: 1.0}",
        "  - {measure: t_p, weight: 0.5, target: 5 s, too_low: 1 s, too_high: 15 s}",
    )
    analysis = SimpleNamespace(
        measures=("S", "t_p"), weights=np.full(2, 0.5), more_is_better=(True, None), values=np.ones((1, 2))
    )
    columns = weight_columns(dataclasses.replace(shipped, study=study), analysis)["measures"]
    ends = [(one["worst"], one["best"], one["too_high"]) for one in columns]
    assert ends == [(0.8, 1, None), (1, 5, 15)]


def test_a_missing_part_is_not_final(made):
    analysis = dataclasses.replace(
        made.robustness.analysis, not_computed={Part.PRICES: NotComputed(reason="no memory", remedy="")}
    )
    less = dataclasses.replace(made, robustness=dataclasses.replace(made.robustness, analysis=analysis))

    assert made.is_final
    assert not less.is_final


@pytest.mark.parametrize(
    ("share", "margin", "words"),
    [
        (1.05, -0.05, "5.0 % outside of what is required, within the tolerance"),
        (0.9, 0.1, "10.0 % inside what is required"),
    ],
)
def test_the_closest_limit_is_the_required_one(shipped, measured, made, share, margin, words):
    """With a tolerance a choice may be well within the limit of the choice and at, or short of, the required one."""
    problem = trade_problem(shipped, measured)
    chosen = made.decision.chosen
    (quantity,) = (one.measures["t_e_simulated"] for one in problem.alternatives if one.variant == chosen)
    required = Threshold(
        requirement="R", measure="t_e_simulated", comparison=Comparison.AT_MOST, value=quantity / share, unit="s"
    )
    (found,) = closest_limits(dataclasses.replace(problem, thresholds=(required.tolerated(0.1),)), chosen)

    assert (found.requirement, found.margin) == ("R", pytest.approx(margin))
    said = [reason.text for reason in reasons(dataclasses.replace(made, closest_limits=(found,)))]
    assert said[-1].endswith(f" at {quantity:.4g} s, {words}.")
