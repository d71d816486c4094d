"""What the watched trials decide: over several designs, and how much their own noise explains."""

from __future__ import annotations

import itertools
from dataclasses import replace

import pytest

from rgss.decision.choosing import choose
from rgss.guard import compare_with_baseline, make_baseline
from rgss.guard.decision import decision_of, explained_by_noise, measured_of
from rgss.guard.runs import guard_of, watched_trials

from .conftest import REASON, SECTION


def troubles(report):
    return [f"{one.trouble.value}: {one.text}" for one in report.failing]


def test_noise_of_verdicts_is_every_draw_of_the_seeds(project_of, record_of):
    """Against judging anew for each of the 27 ordered draws of three seeds."""
    project = project_of(SECTION.replace('"57", replicates: 4', '"57,60", replicates: 3'))
    (trials,) = [one for one in watched_trials(project, guard_of(project)) if one.run.id == "grasp"]
    # The requirement on the planning time asks for at most 15 s, and five moves are planned.
    times = {57: (0.2, 0.9, 0.4), 60: (0.3, 0.3, 0.32)}
    records = {
        variant: {
            spec.seed: record_of(spec, planning_s=times[variant][spec.seed - 1])
            for spec in trials.specs(3)
            if spec.variant == variant
        }
        for variant in times
    }
    now = decision_of(trials, records)
    assert (now.verdicts["57"]["SYS-033"], now.verdicts["60"]["SYS-033"]) == ("inconclusive", "met")
    was = {"57": {**now.verdicts["57"], "SYS-033": "met"}, "60": {**now.verdicts["60"], "SYS-033": "not_met"}}
    explained = explained_by_noise(trials, records, replace(now, verdicts=was), now)

    met = 0
    for draw in itertools.product((1, 2, 3), repeat=3):
        drawn = {
            variant: {place: replace(row[seed], seed=place) for place, seed in enumerate(sorted(draw), start=1)}
            for variant, row in records.items()
        }
        (first, _) = measured_of(trials, drawn)
        met += first.verdicts["SYS-033"].value == "met"
    assert 0 < met < 27
    assert explained == pytest.approx({"verdict 57 SYS-033": met / 27, "verdict 60 SYS-033": 0.0})


def test_the_decision_over_several_designs_is_guarded(compared):
    """A choice, a place on the front and verdicts that a slower planner of one design takes away."""
    section = SECTION.replace('"57", replicates: 4', '"28,31,57", replicates: 4')
    same = compared(section, before=section)
    assert (same.failing, same.notes) == ((), ())
    report = compared(section, before=section, slower_s=14.0, slower=lambda spec: spec.variant in (28, 57))
    said = troubles(report)
    assert "unstable: decision: variant 28 was chosen, now variant 31" in said
    assert "unstable: decision: variant 28 left the Pareto front" in said
    assert "unstable: variant 57: the verdict on SYS-005 was inconclusive and is not_met" in said
    assert not any("variant 31: the verdict" in text for text in said)


@pytest.mark.parametrize("replicates", [4, 8])
def test_no_seed_explains_a_decision_whose_values_are_those_of_the_baseline(compared, replicates):
    """As where a threshold or a weight was edited: here the baseline has the decision of another threshold."""
    section = SECTION.replace('"57", replicates: 4', f'"28,31,57", replicates: {replicates}').replace(
        "cap: 6", "cap: 8"
    )

    def of_another_threshold(baseline):
        verdicts = {**baseline.decision.verdicts, "57": {**baseline.decision.verdicts["57"], "SYS-005": "met"}}
        return replace(baseline, decision=replace(baseline.decision, chosen=57, verdicts=verdicts))

    report = compared(section, before=section, baseline_of=of_another_threshold)
    why = "; every value is that of the baseline, so that a requirement, a weight or what decides has changed"
    assert troubles(report) == [
        f"unstable: decision: variant 57 was chosen, now variant 28{why}",
        f"unstable: variant 57: the verdict on SYS-005 was met and is inconclusive{why}",
    ]


def test_with_enough_seeds_only_what_all_of_them_show_makes_a_decision_unstable(compared):
    """A slow planner is seen with every seed; searches that were slow with one are luck."""
    section = SECTION.replace('"57", replicates: 4', '"28,31,57", replicates: 8').replace("cap: 6", "cap: 8")
    report = compared(section, before=section, slower_s=14.0, slower=lambda spec: spec.variant in (28, 57))
    said = troubles(report)
    assert "unstable: decision: variant 28 was chosen, now variant 31" in said
    assert "unstable: variant 57: the verdict on SYS-005 was inconclusive and is not_met" in said

    report = compared(
        section, before=section, slower_s=15.0, slower=lambda spec: spec.variant in (28, 57) and spec.seed == 3
    )
    assert not [text for text in troubles(report) if text.startswith("unstable")]
    said = "the seeds neither show nor exclude more than chance (p = 1.00)"
    assert [text for text in report.undecided if "28" in text and said in text]
    assert report.is_inconclusive


def test_noise_is_every_draw_of_the_seeds(project_of, record_of):
    """Against deciding anew for each of the 27 ordered draws of three seeds."""
    section = SECTION.replace('"57", replicates: 4', '"57,60", replicates: 3')
    project = project_of(section)
    (trials,) = [one for one in watched_trials(project, guard_of(project)) if one.run.id == "grasp"]
    times = {57: (0.2, 0.9, 0.4), 60: (0.3, 0.3, 0.32)}
    records = {
        variant: {seed: record_of(spec, planning_s=times[variant][seed - 1]) for seed, spec in specs.items()}
        for variant, specs in {
            variant: {spec.seed: spec for spec in trials.specs(3) if spec.variant == variant} for variant in times
        }.items()
    }
    now = decision_of(trials, records)
    before = replace(now, chosen=60 if now.chosen == 57 else 57, pareto=())
    explained = explained_by_noise(trials, records, before, now)

    margin = project.study.trade_off.practical_margin
    chosen, on_front = 0, dict.fromkeys(now.pareto, 0)
    for draw in itertools.product((1, 2, 3), repeat=3):
        drawn = {
            variant: {place: replace(row[seed], seed=place) for place, seed in enumerate(draw, start=1)}
            for variant, row in records.items()
        }
        values = {one.variant: one.value for one in choose(trials.project, measured_of(trials, drawn)).ranking}
        chosen += before.chosen in values and values[before.chosen] >= max(values.values()) - margin
        for variant in on_front:
            on_front[variant] += variant not in decision_of(trials, drawn).pareto
    assert 0 < chosen < 27
    assert explained["chosen"] == pytest.approx(chosen / 27)
    assert {variant: explained[f"pareto {variant}"] for variant in on_front} == pytest.approx(
        {variant: count / 27 for variant, count in on_front.items()}
    )


def with_last_level_first(project, factor):
    """The project with the last level of a factor before the others, which numbers the designs anew."""
    factors = tuple(
        replace(one, levels=(one.levels[-1], *one.levels[:-1])) if one.id == factor else one
        for one in project.designs.factors
    )
    return replace(project, designs=replace(project.designs, factors=factors))


def test_designs_are_paired_by_their_levels(project_of, stores, runner):
    """Variants 57 and 60 with the long planning time are 55 and 58 when that is the first level."""
    first, now = stores(), stores()
    baseline = make_baseline(project_of(), first, runner(first), before=None, reason=REASON)
    section = SECTION.replace('"57,60"', '"55,58"').replace('"57"', '"55"')
    report = compare_with_baseline(
        with_last_level_first(project_of(section), "planning_time"), now, runner(now), baseline, label="b"
    )
    assert (report.verdict, report.failing, report.behaviour.changed) == ("same", (), ())
    assert report.inputs == ()
    assert report.notes == (
        "designs have other numbers than in the baseline and are paired by their levels: 57 is 55, 60 is 58",
    )

    report = compare_with_baseline(
        with_last_level_first(project_of(), "planning_time"), now, runner(now), baseline, label="b"
    )
    assert "fewer replicates: run planning no longer tries variants 55, 58" in troubles(report)
    assert "changed schema: run planning newly tries variants 57, 60" in troubles(report)
