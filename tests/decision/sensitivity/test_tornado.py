"""The tornado, against the study decided anew under each supposition by the mixed-integer program."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose, trade_problem
from rgss.decision.robustness import robustness
from rgss.decision.sensitivity import RangeBasis, analyse_sensitivity
from rgss.decision.what_if import measured_in, suppose
from rgss.errors import DocumentError, TradeoffError
from rgss.reports.decision.sensitivity_sentences import bend_sentences, range_sentence
from rgss.tradeoff import ExponentialValue, Weighting
from rgss.tradeoff.programs import enumerate_alternatives

CHOICE = (
    "values:",
    "  - {measure: P_max, weight: 0.25, worst: 0.8 kg, best: 1.4 kg}",
    "  - {measure: C_total, weight: 0.25, worst: 44000 USD, best: 38000 USD}",
    "  - {measure: t_e_simulated, weight: 0.3, worst: {requirement: SYS-005}, best: 5 s}",
    "  - {measure: S, weight: 0.2, worst: 0.8, best: 1.0}",
)


UNREAD = ("winning_regions", "smaa2", "cost_box", "study_effects", "requirement_prices", "_reversals", "_stretched")
"""Parts of the robustness that the sensitivity does not read, and that take most of its time."""


def not_computed(*_, **__):
    raise TradeoffError("this part is not computed")


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    store = filled(
        shipped,
        lambda spec: record_of(
            spec, planning_s=0.5 + 0.01 * (spec.variant % 9) + 0.1 * spec.seed, path_m=0.4 + 0.02 * (spec.variant % 5)
        ),
    )
    return measure_variants(shipped, store)


@pytest.fixture(scope="module")
def analysed(shipped, measured, read_trade_off_of):
    """A study with other ranges and its sensitivity."""

    def analyse(*lines, choice=CHOICE, supposed=()):
        changed = bool(lines) or choice is not CHOICE
        project = replace(shipped, study=read_trade_off_of(*choice, *lines)) if changed else shipped
        entries = measured
        if supposed:
            scenario = suppose(project, supposed)
            project, entries = scenario.project, measured_in(scenario, measured)
        problem = trade_problem(project, entries)
        decision = choose(project, entries, problem=problem)
        with pytest.MonkeyPatch.context() as patch:
            for part in UNREAD:
                patch.setattr(robustness, part, not_computed)
            patch.setattr(robustness, "_posterior", lambda *_: None)
            found = robustness.analyse_robustness(project, entries, decision, problem=problem)
        return (
            project,
            decision,
            analyse_sensitivity(project, entries, decision, found, problem=problem, is_supposed=bool(supposed)),
        )

    return analyse


@pytest.fixture(scope="module")
def wide(analysed):
    """Ranges wide enough that much flips."""
    return analysed(
        "sensitivity:",
        "  {weights: 90 %, anchors: 40 %, thresholds: 30 %, assumptions: 60 %, risk_tolerance: 0.2, keep_within: 0.02}",
    )


@dataclass
class Anew:
    """What brute force over the variants finds."""

    ties: tuple
    values: dict


def decided_anew(project, measured, supposition):
    scenario = suppose(project, [supposition])
    there = measured_in(scenario, measured)
    return enumerated(trade_problem(scenario.project, there))


def enumerated(problem):
    """Every feasible variant with its value: enumeration of the variants, apart from the analysis."""
    found = enumerate_alternatives(problem)
    ids, rows = found.variants, range(len(found.variants))
    return Anew(
        ties=tuple(int(ids[row]) for row in rows if found.tied[row]),
        values={int(ids[row]): float(found.values[row]) for row in rows if found.feasible[row]},
    )


def lead_of(anew, chosen, tied):
    """The lead of a design over the best other; None if it is not feasible."""
    values = anew.values
    if chosen not in values:
        return None
    rivals = [value for one, value in values.items() if one not in tied or value > values[chosen] + 1e-9]
    return values[chosen] - max(rivals) if rivals else None


def assert_is_what_if(bar, end, project, decision, measured):
    """An end of a bar is the decision under the supposition of its value."""
    anew = decided_anew(project, measured, f"{bar.id}={end.value!r} {'' if bar.unit == '1' else bar.unit}")
    assert end.winners == anew.ties, bar.id
    lead = lead_of(anew, decision.chosen, decision.ties)
    assert (end.lead is None) == (lead is None), bar.id
    if lead is not None:
        assert end.lead == pytest.approx(lead, abs=1e-9), bar.id


def test_each_end_is_the_decision_under_that_supposition(wide, measured):
    project, decision, found = wide
    assert found.tornado.chosen == decision.chosen
    looked_at = 0
    for bar in found.tornado.bars:
        for end in (bar.low, bar.high):
            assert_is_what_if(bar, end, project, decision, measured)
            looked_at += 1
    assert looked_at > 40


RANGES = (
    "sensitivity: {ranges: [{input: weight.S, low: 0.1, high: 0.3}, {input: shape.C_total, low: 0, high: 2},"
    " {input: catalogue.ur10.cost, low: 30000 USD, high: 35000 USD}]}"
)


@pytest.mark.parametrize(
    "supposed",
    [
        "shape.S=3",
        "shape.C_total=4",
        "shape.all=-2",
        "weight.S=0.4",
        "catalogue.ur10.cost=36400 USD",
        "value.S.worst=0.7",
    ],
)
def test_under_a_supposition_each_end_is_the_decision_under_both(
    analysed, measured, shipped, read_trade_off_of, supposed
):
    """Of the same input, its value there takes the place of the supposed one; a stated range reaches to that one."""
    _, decision, found = analysed(RANGES, supposed=[supposed])
    study = replace(shipped, study=read_trade_off_of(*CHOICE, RANGES))
    input_, _, value = supposed.partition("=")
    for bar in found.tornado.bars:
        if bar.id == input_:
            assert bar.base == float(value.split()[0])
        assert bar.low.value <= bar.base <= bar.high.value
        if bar.id != input_ and bar.id.partition(".")[0] in ("shape", "weight") and bar.id[:5] == supposed[:5]:
            # Two suppositions cannot bend a function, and two weights both keep their supposed value.
            continue
        kept = [] if bar.id == input_ else [supposed]
        for end in (bar.low, bar.high):
            there = suppose(study, [*kept, f"{bar.id}={end.value!r} {'' if bar.unit == '1' else bar.unit}"])
            anew = enumerated(trade_problem(there.project, measured_in(there, measured)))
            assert end.winners == anew.ties, bar.id
            lead = lead_of(anew, decision.chosen, decision.ties)
            assert end.lead == pytest.approx(lead, abs=1e-9), bar.id


def test_sentences_state_the_curvature_that_was_examined(analysed):
    _, _, found = analysed(RANGES)
    said = list(bend_sentences([one for one in found.bends if not one.flips]))
    several = [line for line in said if "C_total" not in line]
    steady = {"C_total"} | {name for line in several for name in line.partition("choice: ")[2].rstrip(".").split(", ")}
    assert steady == {one.measure or "all together" for one in found.bends if not one.flips}
    assert [line for line in said if "C_total" in line] == [
        "Bent with a curvature from 0 to 2, the value function of C_total does not change the choice."
    ]
    assert all(
        "to a risk tolerance of 0.3 of the range, convex or concave" in line for line in said if "0 to 2" not in line
    )


@pytest.mark.parametrize("anchored", [False, True])
def test_with_a_tolerance_thresholds_are_those_that_are_required(analysed, measured, anchored):
    """The tolerance of the choice moves with the limit: each end is a what-if, and a stated range holds the limit."""
    choice = CHOICE if anchored else [line.replace("{requirement: SYS-005}", "25 s") for line in CHOICE]
    project, decision, found = analysed(
        "tolerance: 10 %",
        "sensitivity: {ranges: [{input: SYS-024.threshold, low: 0.85, high: 0.95}]}",
        choice=[*choice],
    )
    required = {one.id: one.criterion.threshold for one in project.requirements.system if one.criterion is not None}
    bars = [bar for bar in found.tornado.bars if bar.id.endswith(".threshold")]
    assert len(bars) > 4
    for bar in bars:
        assert bar.base == pytest.approx(required[bar.id.removesuffix(".threshold")]), bar.id
        for end in (bar.low, bar.high):
            assert_is_what_if(bar, end, project, decision, measured)


def test_an_end_beyond_which_no_value_is_defined_is_taken_nearer(analysed):
    """A tenth less than 43,000 USD is below the best of 39,000 USD: more cost would be worth more there."""
    _, _, found = analysed(
        choice=[
            "values:",
            "  - {measure: P_max, weight: 0.4, worst: 0.8 kg, best: 1.4 kg}",
            "  - {measure: C_total, weight: 0.6, worst: {requirement: SYS-004}, best: 39000 USD}",
        ]
    )
    (bar,) = [bar for bar in found.tornado.bars if bar.id == "SYS-004.threshold"]
    assert (bar.base, bar.high.value) == (43000.0, pytest.approx(47300.0))
    assert 39000.0 < bar.low.value < 43000.0
    assert bar.basis is RangeBasis.CUT_SHARE
    assert range_sentence(found.tornado).endswith(
        "Nearer, since beyond it a value function is not defined: SYS-004.threshold."
    )


def test_a_stated_end_beyond_which_no_value_is_defined_costs_no_other_bar(analysed):
    """At 1.3 kg the worst end lies beyond the point at 1 kg, which the study does not have out of order."""
    _, _, found = analysed(
        "sensitivity: {ranges: [{input: SYS-012.threshold, low: 0.4 kg, high: 1.3 kg, rationale: wider duties}]}",
        choice=[
            "values:",
            "  - {measure: C_total, weight: 0.6, worst: 43000 USD, best: 39000 USD}",
            "  - {measure: P_max_simulated, weight: 0.4, worst: {requirement: SYS-012}, best: 1.4 kg,",
            "     between: [{at: 1 kg, worth: 0.7}]}",
        ],
    )
    (bar,) = [bar for bar in found.tornado.bars if bar.id == "SYS-012.threshold"]
    assert (bar.low.value, bar.basis) == (pytest.approx(0.4), RangeBasis.CUT_STATED)
    assert 0.8 < bar.high.value < 1.0
    assert {"weight.P_max_simulated", "value.C_total.best"} <= {bar.id for bar in found.tornado.bars}
    assert "Of the ranges 1 is stated, " in range_sentence(found.tornado)
    assert range_sentence(found.tornado).endswith("not defined: SYS-012.threshold.")


def test_no_time_is_negative(analysed):
    """A tenth of 20 s, from the best to the worst, is more than the best of half a second."""
    other = [line.replace("best: 5 s", "best: 0.5 s") for line in CHOICE]
    _, _, found = analysed(choice=other)
    (bar,) = [bar for bar in found.tornado.bars if bar.id == "value.t_e_simulated.best"]

    assert (bar.base, bar.low.value, bar.basis) == (0.5, 0.0, RangeBasis.SHARE)
    assert bar.high.value > 1.0


def test_each_flip_is_where_the_choice_changes(wide, measured):
    project, decision, found = wide
    flips = 0
    for bar in found.tornado.bars:
        for end in (bar.low, bar.high):
            if end.flip is None:
                if end.flip is None and bar.exact:
                    assert decision.chosen in end.winners, bar.id
                continue
            unit = "" if bar.unit == "1" else bar.unit
            step = 1e-6 * (end.value - bar.base)
            inside = decided_anew(project, measured, f"{bar.id}={end.flip - step!r} {unit}")
            beyond = decided_anew(project, measured, f"{bar.id}={end.flip + step!r} {unit}")
            assert decision.chosen in inside.ties, bar.id
            assert decision.chosen not in beyond.ties, bar.id
            assert end.flip_winners == beyond.ties, bar.id
            flips += 1
    assert flips >= 5


def test_a_bent_linear_function_is_the_exponential_one(wide, measured):
    project, decision, found = wide
    problem = trade_problem(project, measured)
    for bend in found.bends:
        if not bend.measure:
            continue
        for end in (bend.convex, bend.concave):
            linear = problem.value_function(bend.measure)
            share = -math.log((1.0 + math.exp(-end.curvature)) / 2.0) / end.curvature
            halfway = linear.worst + share * (linear.best - linear.worst)
            bent = ExponentialValue(measure=bend.measure, worst=linear.worst, best=linear.best, halfway=halfway)
            functions = tuple(bent if one is linear else one for one in problem.value_functions)
            anew = enumerated(replace(problem, value_functions=functions))
            assert end.winners == anew.ties
            assert end.lead == pytest.approx(lead_of(anew, decision.chosen, decision.ties), abs=1e-6)
        if bend.concave.flip is not None:
            assert bend.concave.flip_tolerance == pytest.approx(1.0 / bend.concave.flip)


def test_the_largest_swing_comes_first_and_every_input_is_there(wide, shipped):
    _, _, found = wide
    swings = [bar.swing for bar in found.tornado.bars]
    names = {bar.id for bar in found.tornado.bars} | set(found.tornado.without_range)

    assert swings == pytest.approx(sorted(swings, reverse=True))
    assert {
        "weight.t_e_simulated",
        "value.t_e_simulated.best",
        "shape.all",
        "SYS-005.threshold",
        "catalogue.ur10.cost",
    } <= names
    # Anchored on a requirement: it moves with the threshold.
    assert "value.t_e_simulated.worst" not in names
    assert all(bar.basis is RangeBasis.SHARE for bar in found.tornado.bars)
    assert found.tornado.without_range == ("catalogue.rrt.cost", "catalogue.trrt.cost", "catalogue.stride.cost")


def test_stated_and_elicited_ranges_are_taken(analysed):
    _, _, found = analysed(
        "weight_order: [{heavier: C_total, lighter: S}]",
        "sensitivity:",
        "  ranges:",
        "    - {input: catalogue.rrt.cost, low: 0 USD, high: 1 kUSD, rationale: a licence}",
        "    - {input: weight.t_e_simulated, low: 25 %, high: 0.5}",
        "    - {input: shape.S, low: 0, high: 2}",
    )
    bars = {bar.id: bar for bar in found.tornado.bars}

    assert (bars["catalogue.rrt.cost"].low.value, bars["catalogue.rrt.cost"].high.value) == (0.0, 1000.0)
    assert bars["catalogue.rrt.cost"].basis is RangeBasis.STATED
    assert (bars["weight.t_e_simulated"].low.value, bars["weight.t_e_simulated"].high.value) == (0.25, 0.5)
    assert (bars["shape.S"].low.value, bars["shape.S"].high.value) == (0.0, 2.0)
    assert bars["weight.S"].basis is RangeBasis.ELICITED
    assert bars["weight.S"].high.value == pytest.approx(0.5)
    assert found.bounded_weights


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ("{input: catalogue.rtt.cost, low: 0 USD, high: 1 USD}", "unknown input 'catalogue.rtt.cost' of the decision"),
        (
            "{input: weight.t_e_simulated, low: 0.4, high: 0.5}",
            "weight.t_e_simulated is 0.3, outside of its range 0.4 to 0.5",
        ),
        ("{input: catalogue.ur10.cost, low: 1 kg, high: 1 USD}", "catalogue.ur10.cost: "),
    ],
)
def test_a_wrong_range_is_an_error_at_its_place(analysed, entry, message):
    with pytest.raises(DocumentError) as caught:
        analysed("sensitivity:", "  ranges:", f"    - {entry}")
    (finding,) = caught.value.findings
    assert (finding.file, finding.line, finding.column) == ("s", 9, 17)
    assert finding.message.startswith(message)


@pytest.mark.parametrize("supposed", [(), ("weight.C_total=0",), ("weight.S=1",)])
def test_stakeholders_choose_by_their_own_weights(analysed, measured, supposed):
    project, _, found = analysed(
        "accept_within: 0.1",
        "stakeholders:",
        "  buyer: {weights: {C_total: 0.9, S: 0.1}}",
        "  driver: {points: {t_e_simulated: 30, P_max: 10}, rationale: waits}",
        "  safety: {answers: [{swing_of: S, over: t_e_simulated, ratio: 3}]}",
        supposed=supposed,
    )
    problem = trade_problem(project, measured)
    for view, stakeholder in zip(found.agreement.views, project.study.trade_off.stakeholders, strict=True):
        mine = enumerated(replace(problem, weighting=Weighting(weights=stakeholder.weights)))
        assert tuple(found.variants[row] for row in view.best) == mine.ties
        assert view.best_value == pytest.approx(max(mine.values.values()), abs=1e-9)
    assert found.agreement.views[1].weights == pytest.approx(np.array([0.25, 0.0, 0.75, 0.0]))


def test_the_flat_weight_says_what_to_do(wide):
    _, _, found = wide
    flat = {one.measure: one for one in found.flat}

    assert flat["S"].remedy.value == "vary_the_world"
    assert sum(weight for _, weight in flat["S"].effective) == pytest.approx(1.0)
    assert "S" not in dict(flat["S"].effective)


def test_of_another_program_nothing_is_analysed(analysed):
    _, _, found = analysed("decide_by: {program: lexicographic, order: [{measure: C_total}]}")

    assert found.tornado is None
    assert found.kept is None
    assert found.refused == "the lexicographic program does not choose by weighted value"


@pytest.mark.parametrize("point", ["halfway: 28.5 s", "halfway: 8.2 s", "steepest: 28.5 s"])
def test_a_point_between_the_ends_stays_between_them(analysed, point):
    """A tenth of it leads beyond an end, where the function is not defined."""
    choice = [line for line in CHOICE if "t_e_simulated" not in line]
    _, _, found = analysed(
        choice=[*choice, f"  - {{measure: t_e_simulated, weight: 0.3, worst: 30 s, best: 8 s, {point}}}"]
    )
    key = point.partition(":")[0]
    (bar,) = [bar for bar in found.tornado.bars if bar.id == f"value.t_e_simulated.{key}"]
    assert 8.0 < bar.low.value < bar.base < bar.high.value < 30.0
