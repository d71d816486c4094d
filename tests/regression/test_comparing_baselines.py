"""Completeness, behaviour and decision against the baseline."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.regression.comparing_baselines import (
    changed_trials,
    decision_changes,
    run_failings,
    schema_failings,
    schema_notes,
    unchanged_phases,
)
from rgss.regression.observing import first_difference
from tests.fixtures.eight_states import Phase

UNITS = {"success": "1", "time_s": "s"}
PHASES = tuple(phase.value for phase in Phase)


def texts(failings):
    return [f"{one.trouble.value}: {one.text}" for one in failings]


def test_nothing_changed(baseline):
    run = baseline.runs["planning"]
    assert texts(schema_failings(baseline, UNITS)) == []
    assert list(schema_notes(baseline, UNITS)) == []
    failings = run_failings("planning", run, fidelity="kinematic", variants=(9, 10), seeds=(1, 2, 3), first_look=2)
    assert texts(failings) == []


@pytest.mark.parametrize(
    ("units", "said"),
    [
        ({"success": "1"}, "missing metric: the baseline guards time_s, the study no longer does"),
        ({**UNITS, "time_s": "ms"}, "changed schema: time_s was in s and is in ms"),
        ({**UNITS, "slip_m": "m"}, "changed schema: the study guards slip_m, the baseline does not"),
    ],
)
def test_a_changed_schema(baseline, units, said):
    assert texts(schema_failings(baseline, units)) == [said]


@pytest.mark.parametrize(
    ("record", "change"),
    [
        (UNITS, "no longer have slip_m"),
        ({**UNITS, "slip_m": "mm"}, "have another unit for slip_m"),
        ({**UNITS, "slip_m": "m", "noise_db": "1"}, "newly have noise_db"),
    ],
)
def test_a_metric_that_is_not_guarded_fails_nothing(baseline, record, change):
    before = replace(baseline, record={**UNITS, "slip_m": "m"})

    assert list(schema_notes(before, record)) == [f"trials {change}, which the baseline does not guard"]
    assert texts(schema_failings(before, UNITS)) == []


def test_a_metric_that_is_guarded_is_no_note(baseline):
    assert list(schema_notes(baseline, {"success": "1", "time_s": "5 × s"})) == []


@pytest.mark.parametrize(
    ("fidelity", "variants", "seeds", "said"),
    [
        ("contact", (9, 10), (1, 2, 3), "changed schema: run r was kinematic and is contact"),
        ("kinematic", (9,), (1, 2, 3), "fewer replicates: run r no longer tries variant 10"),
        ("kinematic", (), (1, 2, 3), "fewer replicates: run r no longer tries variants 9, 10"),
        ("kinematic", (9, 10, 11), (1, 2, 3), "changed schema: run r newly tries variant 11"),
        ("kinematic", (9, 10), (1, 2), "fewer replicates: run r takes up to 2 seeds; the baseline has 3"),
        ("kinematic", (9, 10), (1, 2, 3, 4), "changed schema: run r takes other seeds than the baseline, which has 3"),
        ("kinematic", (9, 10), (2, 3, 4), "changed schema: run r takes other seeds than the baseline, which has 3"),
    ],
)
def test_a_run_that_is_another(baseline, fidelity, variants, seeds, said):
    failings = run_failings(
        "r", baseline.runs["planning"], fidelity=fidelity, variants=variants, seeds=seeds, first_look=2
    )
    assert texts(failings) == [said]


@pytest.mark.parametrize(("before", "now", "fewer"), [(3, 2, True), (3, 3, False), (3, 4, False), (0, 2, False)])
def test_fewer_seeds_at_the_first_look(baseline, before, now, fewer):
    """With the same cap; 0 is a baseline of an earlier schema, which does not have the number."""
    run = replace(baseline.runs["planning"], first_look=before)
    failings = run_failings("r", run, fidelity="kinematic", variants=(9, 10), seeds=(1, 2, 3), first_look=now)
    said = "fewer replicates: run r takes 2 seeds at the first look; the baseline took 3"
    assert texts(failings) == [said] * fewer


def test_a_run_that_is_new():
    failings = run_failings("r", None, fidelity="contact", variants=(1,), seeds=(1, 2), first_look=2)
    assert texts(failings) == ["changed schema: run r is not in the baseline"]


def test_changed_trials_and_the_phases_that_are_as_they_were(baseline):
    run = baseline.runs["planning"]
    now = {variant: dict(zip(run.seeds, run.fingerprints[str(variant)], strict=True)) for variant in run.variants}
    assert list(changed_trials("planning", run, now, (1, 2, 3), PHASES)) == []
    assert unchanged_phases(run, now, (1, 2), PHASES) == {"trial", *PHASES}
    parts = now[9][2].split()
    parts[0] = parts[2] = parts[5] = "ffff"
    now[9][2] = " ".join(parts)
    (changed,) = changed_trials("planning", run, now, (1, 2, 3), PHASES)
    assert (changed.variant, changed.seed, changed.phase) == (9, 2, "grasp")
    assert unchanged_phases(run, now, (1, 2), PHASES) == set(PHASES) - {"grasp", "move_to_place_approach"}
    # With the seeds that were not run, nothing is said of them.
    assert unchanged_phases(run, now, (1,), PHASES) == {"trial", *PHASES}
    # A trial without a record leaves nothing that is surely as it was.
    del now[10][1]
    assert unchanged_phases(run, now, (1,), PHASES) == frozenset()


def test_only_the_whole_differs():
    assert first_difference("a b b", "c b b", PHASES) == "trial"


def test_a_decision_that_moved(baseline):
    before = baseline.decision
    now = replace(before, chosen=10, pareto=(10,), verdicts={"9": {"SYS-1": "not_met"}, "10": {"SYS-1": "met"}})
    found = decision_changes(before, now, explained={}, error_rate=0.05)
    assert texts(found.failing) == [
        "unstable: decision: variant 9 was chosen, now variant 10",
        "unstable: decision: variant 9 left the Pareto front",
        "unstable: decision: variant 10 joined the Pareto front",
        "unstable: variant 9: the verdict on SYS-1 was met and is not_met",
    ]
    assert (found.undecided, found.notes) == ((), ("variant 10: the verdict on SYS-1 was not_met and is met",))


def test_noise_explains_a_move(baseline):
    before = baseline.decision
    now = replace(before, chosen=None, pareto=())
    found = decision_changes(before, now, explained={"chosen": 0.3, "pareto 9": 0.05}, error_rate=0.05)
    assert texts(found.failing) == ["unstable: decision: variant 9 left the Pareto front"]
    said = "within the noise, which has it as it was in 30 % of resamples"
    assert (found.undecided, found.notes) == ((f"decision: variant 9 was chosen, now no variant; {said}",), ())


@pytest.mark.parametrize(("share", "is_noise"), [(0.05, False), (0.051, True)])
def test_noise_explains_a_verdict(baseline, share, is_noise):
    now = replace(baseline.decision, verdicts={"9": {"SYS-1": "inconclusive"}, "10": {"SYS-1": "not_met"}})
    found = decision_changes(baseline.decision, now, explained={"verdict 9 SYS-1": share}, error_rate=0.05)
    text = "variant 9: the verdict on SYS-1 was met and is inconclusive"
    assert texts(found.failing) == ([] if is_noise else [f"unstable: {text}"])
    said = f"{text}; within the noise, which has it as it was in 5 % of resamples"
    assert found.undecided == ((said,) if is_noise else ())


def test_what_is_not_shown_to_differ_is_undecided(baseline):
    now = replace(baseline.decision, chosen=10, pareto=(10,), verdicts={"9": {"SYS-1": "not_met"}, "10": {}})
    by_luck = {"chosen": 0.05, "pareto": 0.2, "verdict 9 SYS-1": 0.06}
    found = decision_changes(baseline.decision, now, explained={}, by_luck=by_luck, error_rate=0.05)
    assert texts(found.failing) == [
        "unstable: decision: variant 9 was chosen, now variant 10",
        "unstable: variant 10: the verdict on SYS-1 was not_met and is none",
    ]
    said = "the seeds neither show nor exclude more than chance"
    assert found.notes == (
        f"decision: variant 9 left the Pareto front; {said} (p = 0.20)",
        f"decision: variant 10 joined the Pareto front; {said} (p = 0.20)",
    )
    assert found.undecided == (f"variant 9: the verdict on SYS-1 was met and is not_met; {said} (p = 0.06)",)


def test_a_verdict_that_is_gone(baseline):
    now = replace(baseline.decision, verdicts={"9": {}, "10": {"SYS-1": "not_met"}})
    found = decision_changes(baseline.decision, now, explained={}, error_rate=0.05)
    assert texts(found.failing) == ["unstable: variant 9: the verdict on SYS-1 was met and is none"]
