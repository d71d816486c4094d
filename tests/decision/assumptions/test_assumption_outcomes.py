"""The table of the modelling assumptions: its questions, the choice under each, and what it says."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.assumptions import assumption_outcomes, missing_trials, questions_of
from rgss.decision.choosing import choose
from rgss.decision.study_decision import decide_study
from rgss.decision.what_if import model_settings, suppose
from rgss.errors import DefinitionError
from rgss.evidence import Failure, Fidelity
from rgss.reports.decision import decision_lines, decision_part, decision_section, trade_document
from rgss.reports.decision.assumption_rows import assumption_sentences
from rgss.reports.decision.text.conflicts import conflict_lines
from rgss.reports.decision.words import ids_text
from rgss.studies import load_project, trial_specs
from rgss.studies.assumptions_section import StudyAssumption
from rgss.sweep.trial_keys import key_of
from tests.fixtures.stored_trials import put_trials


def asked(project, *pairs):
    """The project with a list of assumptions and alternatives instead of the derived one."""
    listed = tuple(StudyAssumption(about=about, alternatives=others, places=()) for about, others in pairs)
    return replace(project, study=replace(project.study, assumptions=listed))


@pytest.fixture(scope="module")
def reference():
    """The reference study, whose planners have settings."""
    return load_project(Path(__file__).parents[3])


@pytest.fixture(scope="module")
def evidence(shipped, filled, record_of):
    """The shipped study without contact, and every trial of it; of fast arms, which are dearer to plan for."""

    def record(spec):
        return record_of(spec, planning_s=0.2 * (1 + spec.variant % 7), path_m=0.4)

    # One seed and no readings, which are rows of their own, so that the tests are quick.
    measures = tuple(replace(measure, alternatives=()) for measure in shipped.measures.measures)
    project = replace(
        shipped.with_fidelity("dynamic").with_replicates(1), measures=replace(shipped.measures, measures=measures)
    )
    store = filled(project, record)
    return project, store, measure_variants(project, store), record


def put(project, store, record):
    put_trials(store, trial_specs(project), record)


def outcome(project, measured, store, about):
    (found,) = (one for one in assumption_outcomes(project, measured, store) if one.question.about == about)
    return found


def test_the_derived_questions_follow_from_the_study(shipped):
    found = [question.supposition for question in questions_of(shipped)]
    charge_ms = 1e3 * shipped.study.planning.settings.clock.charge_s
    assert found[:2] == [f"planning.charge_per_check={factor * charge_ms:g} ms" for factor in (0.5, 2.0)]
    assert found[2:5] == [f"planning.time_limit={limit} s" for limit in (4, 6, 8)]
    assert "fidelity=kinematic" in found
    assert "prices=0" in found
    assert ("uncertainty.nominal=true" in found) is bool(shipped.uncertainty.values)
    assert found[-1].startswith("reading.")
    for text in found:
        suppose(shipped, [text])


def test_a_list_of_the_study_takes_their_place(shipped):
    project = asked(shipped, ("physics.rate", ("480 Hz", "960 Hz")), ("prices", ("0.5",)))
    found = [one.supposition for one in questions_of(project) if not one.about.startswith("reading.")]
    assert found == ["physics.rate=480 Hz", "physics.rate=960 Hz", "prices=0.5"]


def test_trials_that_nobody_ran_are_counted(evidence):
    project, store, measured, _ = evidence
    project = asked(project, ("physics.rate", ("480 Hz",)))
    found = outcome(project, measured, store, "physics.rate")
    trials = 72 * project.study.replicates
    assert (found.missing, found.trials, found.is_same, found.chosen) == (trials, trials, None, None)
    assert len(missing_trials(project, measured, store)) == trials


def test_trials_of_another_fidelity_are_decided_by_once_they_are_there(evidence, filled):
    project, _, _, record = evidence
    store = filled(project, record)
    measured = measure_variants(project, store)
    chosen = choose(project, measured).chosen
    kinematic = project.with_fidelity("kinematic")
    project = asked(project, ("fidelity", ("kinematic",)))
    assert outcome(project, measured, store, "fidelity").missing == 72 * project.study.replicates
    put(kinematic, store, lambda spec: replace(record(spec), success=spec.variant != chosen))
    found = outcome(project, measured, store, "fidelity")

    assert (found.missing, found.is_same, found.taken_as) == (0, True, "dynamic")
    assert found.otherwise == (0, project.study.replicates)
    assert found.otherwise_of_choice == project.study.replicates


TIMES = ("planning_time_s", "task_time_s", "attempt_time_s")


def test_trials_that_do_not_observe_a_valued_measure_decide_nothing(evidence, filled):
    """Nothing is infeasible then: what is asked of the trials is not in them."""
    project, _, _, record = evidence
    store = filled(project, record)
    measured = measure_variants(project, store)

    def blind(spec):
        made = record(spec)
        return replace(made, metrics={name: value for name, value in made.metrics.items() if name not in TIMES})

    put(project.with_fidelity("kinematic"), store, blind)
    project = asked(project, ("fidelity", ("kinematic",)))
    found = outcome(project, measured, store, "fidelity")
    assert (found.is_same, found.missing) == (None, 0)
    assert re.fullmatch(r"kinematic trials give no value of .*\bt_p\b.*", found.reason)
    made = decide_study(project, measured, evidence="", assumptions=(found,))
    (sentence,) = (one for one in assumption_sentences(made) if "kinematic" in one)
    assert sentence == f"Whether kinematic trials decide as dynamic trials do cannot be known: {found.reason}."
    assert not any("The choice depends on" in one for one in assumption_sentences(made))

    kinematic = project.with_fidelity("kinematic")
    alone = choose(kinematic, measure_variants(kinematic, store))
    (line,) = list(conflict_lines(alone))[:1]
    assert line.startswith("No variant can be chosen: the trials give no value of ")
    assert line.endswith(" for one.")


def test_an_alternative_under_which_the_choice_fails_changes_it(evidence, filled, record_of):
    project, _, _, record = evidence
    store = filled(project, record)
    measured = measure_variants(project, store)
    decision = choose(project, measured)
    put(
        project.with_fidelity("kinematic"),
        store,
        lambda spec: record_of(spec, success=False) if spec.variant in decision.ties else record(spec),
    )
    project = asked(project, ("fidelity", ("kinematic",)))
    found = outcome(project, measured, store, "fidelity")
    made = decide_study(
        project,
        measured,
        evidence="the store",
        assumptions=assumption_outcomes(project, measured, store),
    )
    text = "\n".join(decision_lines(made))

    assert found.is_same is False
    assert found.chosen not in {None, *decision.ties}
    # A design that fails every trial misses what is required of its success.
    missed = " and ".join(found.missed_by_choice)
    assert "SYS-024" in found.missed_by_choice
    assert f"yes, to variant {found.chosen}, as {decision.chosen} misses {missed}" in text
    assert f"Kinematic trials decide otherwise, and choose variant {found.chosen}" in text
    assert "The choice depends on “Fidelity of the trials” (fidelity)." in text
    rows = decision_part(made)["modelling"]["rows"]
    others = tuple(variant for variant in found.ties if variant != found.chosen)
    as_good = f", and {ids_text(others)} as good" if others else ""
    assert rows[0] == {
        "title": "Fidelity of the trials",
        "cells": ["fidelity", "dynamic", "kinematic", *rows[0]["cells"][3:]],
        "changes": True,
        "sentence": "Fidelity of the trials: kinematic instead of dynamic. "
        f"Then variant {found.chosen} is chosen{as_good}; variant {decision.chosen} misses {missed}.",
    }
    assert f"| `fidelity` | dynamic | kinematic | {rows[0]['cells'][3]} | {rows[0]['cells'][4]} |" in decision_section(
        made
    )
    entry = trade_document(made)["modelling_assumptions"][0]
    assert (entry["chosen"], entry["changes_choice"], entry["missing_trials"]) == (found.chosen, True, 0)


def test_missing_trials_are_said_with_what_runs_them(evidence):
    project, store, measured, _ = evidence
    project = asked(project, ("physics.rate", ("480 Hz",)))
    made = decide_study(
        project, measured, evidence="e", analysed=False, assumptions=assumption_outcomes(project, measured, store)
    )
    text = "\n".join(decision_lines(made))
    trials = 72 * project.study.replicates
    assert f"needs {trials} of {trials} trials" in text
    assert f"'{project.command('trade')}' with --what-if \"physics.rate=480 Hz\" --run runs those of one row" in text
    assert project.command("trade") == "rgss trade --fidelity dynamic --replicates 1"


def test_an_alternative_that_is_none_is_a_row_without_an_answer(evidence):
    project, store, measured, _ = evidence
    project = asked(project, ("planning.chargeper_check", ("1 ms",)))
    found = outcome(project, measured, store, "planning.chargeper_check")
    assert "unknown input 'planning.chargeper_check'" in found.reason


def test_the_example_of_each_setting_is_taken_and_changes_the_trials_or_nothing(shipped):
    """The value that is shown and the value that is read are one: supposing it leaves every trial as it is."""
    project = shipped.with_replicates(1)
    base = [key_of(spec) for spec in trial_specs(project)]
    for setting in model_settings(project).values():
        if any(word in setting.value for word in (" or ", ", ")) or setting.id.startswith(("uncertainty.", "workload")):
            continue
        if setting.id.startswith("planning.planners.") or setting.id == "planning.verification_resolution":
            continue  # A default that is set is another input than one that is left.
        same = setting.changed(setting.value)
        assert [key_of(spec) for spec in trial_specs(same)] == base, setting.id


@pytest.mark.parametrize(
    ("text", "message", "hint"),
    [
        ("planning.limit=5 s", "unknown input 'planning.limit'", "did you mean planning.time_limit"),
        ("planning.charge_per_check=3 m", "unit 'm' does not measure what 's' measures", ""),
        ("planning.charge_per_check=0 s", "planning.charge_per_check must be above 0 s, got '0 s'", ""),
        ("planning.clearance=-1 mm", "planning.clearance must be at least 0 m, got '-1 mm'", ""),
        ("planning.simplification_checks=1.5", "must be a whole number from 0 to 1000000, got '1.5'", ""),
        ("planning.on_unverified=ignore", "must be one of fail, repair, got 'ignore'", ""),
        ("fidelity=kinemati", "fidelity must be one of kinematic, dynamic, contact", "write fidelity=kinematic"),
        ("uncertainty.nominal=yes", "must be one of true, false, got 'yes'", ""),
        ("physics.rate=60 Hz", "contact physics needs at least", "240 Hz"),
        ("moves.move_to_grasp=curved", "must be one of planned, straight, joint", ""),
        ("prices=-1", "prices must be a factor of at least 0, got -1", ""),
        ("planning.verification_resolution=1 rad", "cannot be verified more coarsely", "too"),
    ],
)
def test_what_cannot_be_supposed_is_one_line(shipped, text, message, hint):
    with pytest.raises(DefinitionError) as caught:
        suppose(shipped, [text])
    assert message in caught.value.message
    assert hint in caught.value.hint


def test_a_parameter_is_supposed_alike_for_all_planners_that_have_it(reference):
    before, after = reference, suppose(reference, ["planning.planners.goal_bias=0.05"]).project
    biased = {name for name, one in before.study.planning.planners.items() if "goal_bias" in dict(one.parameters)}
    assert biased == {"RRT", "TRRT", "STRIDE"}
    for name, planner in after.study.planning.planners.items():
        given, was = dict(planner.parameters), dict(before.study.planning.planners[name].parameters)
        assert given == (was | {"goal_bias": 0.05} if name in biased else was)
    one_by_one = suppose(reference, [f"planning.planners.{name}.goal_bias=0.05" for name in sorted(biased)]).project
    seeds = [before.study.seed]
    together = [key_of(spec) for spec in trial_specs(after, seeds=seeds)]
    assert together == [key_of(spec) for spec in trial_specs(one_by_one, seeds=seeds)]
    assert set(together).isdisjoint(key_of(spec) for spec in trial_specs(before, seeds=seeds))


def test_a_parameter_that_differs_among_planners_shows_every_value(reference):
    settings = model_settings(reference)
    assert settings["planning.planners.goal_bias"].value == "0.2"
    ranges = {dict(one.parameters)["range"] for one in reference.study.planning.planners.values()}
    assert ranges == {1.0}
    assert settings["planning.planners.range"].value == "1 rad"
    with pytest.raises(DefinitionError, match=r"planning\.planners\.RRT: .*kg"):
        suppose(reference, ["planning.planners.range=1 kg"])
    other = suppose(reference, ["planning.planners.RRT.range=0.5 rad"]).project
    assert model_settings(other)["planning.planners.range"].value == "0.5 rad or 1 rad"


def test_one_setting_cannot_be_supposed_twice(shipped):
    with pytest.raises(DefinitionError, match="fidelity is supposed twice"):
        suppose(shipped, ["fidelity=kinematic", "fidelity=dynamic"])


def test_prices_are_multiplied_where_they_are_assumed(shipped):
    scenario = suppose(shipped, ["prices=0.5"])
    before = {one.id: one.cost.value for one in shipped.designs.catalogue.components if one.cost.assumption}
    after = {one.id: one.cost.value for one in scenario.project.designs.catalogue.components}
    assert before
    assert all(after[name] == 0.5 * value for name, value in before.items())


def test_settings_reach_the_trials(shipped):
    scenario = suppose(
        shipped,
        [
            "planning.time_limit=5 s",
            "planning.charge_per_check=0.5 ms",
            "physics.solver_iterations=40",
            "moves.move_to_grasp=straight",
            "fidelity=dynamic",
            "uncertainty.nominal=true",
        ],
    )
    spec = trial_specs(scenario.project)[0]
    assert (spec.planning_limit_s, spec.settings.planning.search_limit_s) == (5.0, 5.0)
    assert spec.settings.planning.clock.charge_s == 0.0005
    assert (spec.settings.physics.solver_iterations, spec.settings.physics.free_iterations) == (40, 40)
    assert spec.settings.planning.moves[0].value == "straight"
    assert spec.fidelity is Fidelity.DYNAMIC
    assert not spec.uncertainty.values
    assert {variant.parameters["d9"] for variant in scenario.project.designs.expand()} == {5.0}
    assert scenario.settings[0].before == "4 s, 6 s or 8 s"


def test_a_design_that_is_ahead_by_less_than_the_margin_is_no_change(evidence, filled, record_of):
    project, _, _, record = evidence
    store = filled(project, record)
    measured = measure_variants(project, store)
    former = choose(project, measured).chosen
    parameters = {one.id: one.parameters for one in project.designs.expand()}
    (rival, *_) = (
        one
        for one, levels in parameters.items()
        if one != former and {**levels, "d9": 0} == {**parameters[former], "d9": 0}
    )
    times_s = {former: 1.0, rival: 0.98}
    put(
        project.with_fidelity("kinematic"),
        store,
        lambda spec: record_of(
            spec, success=spec.variant in times_s, planning_s=times_s.get(spec.variant, 1.0), path_m=0.4
        ),
    )
    project = asked(project, ("fidelity", ("kinematic",)))
    found = outcome(project, measured, store, "fidelity")
    made = decide_study(project, measured, evidence="e", assumptions=assumption_outcomes(project, measured, store))

    assert (found.chosen, found.is_same, found.is_unseparated) == (rival, True, True)
    assert f"not shown: variant {rival} is not separated from the choice" in "\n".join(decision_lines(made))
    entry = trade_document(made)["modelling_assumptions"][0]
    assert (entry["changes_choice"], entry["unseparated"]) == (False, True)


def test_the_page_says_why_kinematic_trials_decide_alike_or_how_to_find_out(evidence, filled, record_of):
    """Half of the designs drop the object, among them none that is worth as much as the choice."""
    project, store, measured, record = evidence
    chosen = choose(project, measured).chosen
    worths = {one.variant: one.value for one in choose(project, measured).ranking}
    dropping = sorted(sorted(worths, key=lambda each: worths[each])[:20])

    def dropped(spec):
        failed = replace(record_of(spec, success=False), failure=Failure.OBJECT_DROPPED)
        return failed if spec.variant in dropping else record(spec)

    store = filled(project, dropped)
    measured = measure_variants(project, store)
    project = asked(project, ("fidelity", ("kinematic",)))

    def made():
        outcomes = assumption_outcomes(project, measured, store)
        return decide_study(project, measured, evidence="e", analysed=False, assumptions=outcomes)

    unknown = " ".join(assumption_sentences(made()))
    assert (
        "Whether kinematic trials decide as dynamic trials do is not known: 72 trials were not run; "
        "'rgss trade --fidelity dynamic --replicates 1' with --what-if \"fidelity=kinematic\" --run runs them."
    ) in unknown
    counted = f"Of the 72 dynamic trials 20 fail in motion (object dropped 20), none of them of variant {chosen};"
    assert counted in unknown

    put(project.with_fidelity("kinematic"), store, record)
    known = made()
    text = " ".join(assumption_sentences(known))
    best = max(dropping, key=lambda each: worths[each])
    gain = worths[best] - worths[chosen]
    assert counted in text
    assert (
        f"The best of the 20 designs that only kinematic trials admit, variant {best}, is worth {-gain:.4f} less"
        in text
    )
    entry = trade_document(known)["modelling_assumptions"][0]
    assert entry["failed_in_motion"] == {"object_dropped": 20}
    assert (entry["admitted"]["designs"], entry["admitted"]["best"]) == (20, best)
    assert entry["admitted"]["gain"] == pytest.approx(gain)
    assert text in decision_section(known)
    assert decision_part(known)["modelling"]["sentences"] == list(assumption_sentences(known))
