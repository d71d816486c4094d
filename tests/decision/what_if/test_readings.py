"""Readings of the source as suppositions, and where each of them leads."""

from __future__ import annotations

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose
from rgss.decision.robustness import robustness
from rgss.decision.study_decision import decide_study
from rgss.decision.study_decision.readings import reading_outcomes
from rgss.decision.what_if import deciding_readings, measured_in, suppose
from rgss.errors import DefinitionError
from rgss.reports.decision import decision_lines, decision_part, trade_document


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    store = filled(shipped, lambda spec: record_of(spec, planning_s=0.2 * (1 + spec.variant % 7), path_m=0.4))
    return measure_variants(shipped, store)


def estimate(scenario, measured, measure, variant=28):
    (entry,) = (one for one in measured_in(scenario, measured) if one.variant.id == variant)
    return entry.estimates[measure].value


def test_a_reading_takes_the_place_of_the_measures_own(shipped, measured):
    scenario = suppose(shipped, ["reading.t_e=without_planning"])
    (was,) = (one for one in measured if one.variant.id == 28)

    assert estimate(scenario, measured, "t_e") == pytest.approx(was.estimates["t_m"].value)
    assert estimate(scenario, measured, "t_p") == was.estimates["t_p"].value
    assert [one.supposition for one in scenario.readings] == ["reading.t_e=without_planning"]
    assert scenario.changes == ()


def test_a_reading_that_follows_from_the_design_takes_the_place_of_a_simulation(shipped, measured):
    scenario = suppose(shipped, ["reading.P_max_simulated=force_of_the_hand"])
    fingers = {entry.variant.id: entry.variant.parameters["d1"] for entry in measured}

    for entry in measured[:40:7]:
        now = estimate(scenario, measured, "P_max_simulated", entry.variant.id)
        assert now == pytest.approx(entry.estimates["P_max_g"].value / fingers[entry.variant.id])
    assert choose(scenario.project, measured_in(scenario, measured)).counts.feasible == 0


def test_only_readings_of_what_the_choice_reads_are_in_question(shipped):
    asked = {one.supposition for one in deciding_readings(shipped)}
    known = {f"reading.{measure.id}={one.id}" for measure in shipped.measures.measures for one in measure.alternatives}

    # The study values t_e, its requirements bound t_e_simulated; nothing reads the energy.
    assert known - asked == {"reading.E_cycle=recovered"}


def test_a_reading_goes_together_with_other_suppositions(shipped, measured):
    scenario = suppose(shipped, ["reading.S=share_of_states", "weight.S=0.5", "SYS-024=0.95"])

    assert scenario.project.study.trade_off.weighting.weights["S"] == pytest.approx(0.5)
    assert scenario.project.measures.measure("S").estimate.statistic.value == "mean"
    choose(scenario.project, measured_in(scenario, measured))


@pytest.mark.parametrize(
    ("texts", "message"),
    [
        (
            ["reading.S=share_of_stats"],
            r"unknown reading 'reading.S=share_of_stats' \(such as reading.S=share_of_states",
        ),
        (["reading.C_total=free"], r"unknown reading 'reading.C_total=free' \(such as reading"),
        (["reading.t_e=simulated", "reading.t_e=without_planning"], "reading.t_e is supposed twice"),
    ],
)
def test_an_unknown_reading_names_those_there_are(shipped, texts, message):
    with pytest.raises(DefinitionError, match=message):
        suppose(shipped, texts)


def test_the_page_lists_every_reading_with_the_choice_that_it_leads_to(shipped, measured):
    outcomes = reading_outcomes(shipped, measured)
    made = decide_study(shipped, measured, evidence="evidence.sqlite", analysed=False)
    shown = decide_study(
        shipped,
        measured,
        evidence="evidence.sqlite",
        analysed=False,
        scenario=suppose(shipped, ["reading.t_e=simulated"]),
    )

    assert [one.reading for one in outcomes] == list(deciding_readings(shipped))
    for outcome in outcomes:
        scenario = suppose(shipped, [outcome.reading.supposition])
        again = choose(scenario.project, measured_in(scenario, measured))
        assert (outcome.chosen, outcome.feasible) == (again.chosen, again.counts.feasible)
        assert outcome.reason == ""
    assert made.readings == ()
    assert "  reading.t_e=simulated: Equation 4.3" in "\n".join(decision_lines(shown))
    assert trade_document(shown)["what_if"]["readings"] == [{"measure": "t_e", "alternative": "simulated"}]


@pytest.mark.parametrize("analysed", [False, True])
def test_an_equation_that_the_simulation_contradicts_is_a_caution_with_both_figures(
    shipped, measured, monkeypatch, analysed
):
    monkeypatch.setattr(robustness, "ITERATIONS", 200)
    made = decide_study(shipped, measured, evidence="evidence.sqlite", analysed=analysed)
    gaps = {gap.measure: gap for gap in made.gaps}

    (entry,) = (one for one in measured if one.variant.id == made.decision.chosen)
    assert set(gaps) <= {"t_e", "P_max"}
    assert gaps["t_e"].by_equation == entry.estimates["t_e"].value
    assert gaps["t_e"].simulated == entry.estimates["t_e_simulated"].value
    cautions = [one for one in decision_part(made)["cautions"] if one.startswith("t_e is ")]
    assert len(cautions) == 1
    assert " s by the equation, " in cautions[0]
    assert " s simulated (t_e_simulated, " in cautions[0]
    assert trade_document(made)["model_gaps"][-1]["simulated_as"] == "t_e_simulated"
