"""The evidence of a study as traceability shows it."""

from __future__ import annotations

from statistics import mean

import pytest

from rgss.assessment.evidence_status import trial_verdicts
from rgss.assessment.measuring import measure_variants
from rgss.decision.tracing import trace_evidence
from rgss.errors import DefinitionError
from rgss.evidence import EvidenceStore
from rgss.measures import Verdict
from rgss.trace.evidence.evidence_state import EvidenceState


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    """Each replicate takes longer; seed 2 of every fifth variant fails."""
    store = filled(
        shipped,
        lambda spec: record_of(
            spec, success=not (spec.seed == 2 and spec.variant % 5 == 0), planning_s=0.1 * spec.seed, path_m=0.4
        ),
    )
    return measure_variants(shipped, store)


@pytest.fixture(scope="module")
def state(shipped, measured):
    return EvidenceState(trials=trial_verdicts(shipped, measured))


def test_the_chosen_variant_is_shown(shipped, measured, state):
    evidence = trace_evidence(shipped, measured, state)

    assert evidence.shown.variant in {entry.variant.id for entry in measured}
    assert evidence.choice == f"variant {evidence.shown.variant}, which the trade-off chooses"
    assert evidence.variants == 72


def test_only_trials_that_an_estimate_counts_decide_it(shipped, measured, state):
    shown = trace_evidence(shipped, measured, state, variant=10).shown

    assert [trial.seed for trial in shown.trials] == [1, 2, 3]
    assert shown.trials[1].outcome == "planning_limit in move_to_grasp_departure"
    assert [trial.seed for trial in shown.deciding_trials("t_p")] == [1, 3]
    assert [trial.seed for trial in shown.deciding_trials("S")] == [1, 2, 3]
    assert shown.deciding_trials("C_total") == ()
    assert shown.deciding_trials("nothing") == ()
    for measure in shipped.measures.measures:
        if measure.from_trials:
            assert len(shown.deciding_trials(measure.id)) == shown.estimates[measure.id].n


def test_the_value_of_each_trial_is_its_share_of_the_estimate(shipped, measured, state):
    shown = trace_evidence(shipped, measured, state, variant=10).shown
    values = [trial.values["t_p"] for trial in shown.trials]

    assert values == [pytest.approx(0.5), None, pytest.approx(1.5)]
    assert shown.estimates["t_p"].value == pytest.approx(mean([0.5, 1.5]))


def test_verdicts_are_those_of_the_measuring(shipped, measured, state):
    evidence = trace_evidence(shipped, measured, state, variant=10)
    (entry,) = [entry for entry in measured if entry.variant.id == 10]

    for requirement in shipped.requirements.system:
        if requirement.criterion is not None:
            assert evidence.verdict(requirement) is entry.verdicts[requirement.id]
            assert sum(count for _, count in evidence.tally(requirement.id)) == 72
        else:
            assert evidence.verdict(requirement) is Verdict.NOT_RUN


def test_without_evidence_there_is_no_choice(shipped, tmp_path):
    with EvidenceStore.open(tmp_path / "empty.sqlite") as store:
        measured = measure_variants(shipped, store)
    evidence = trace_evidence(shipped, measured, EvidenceState())
    asked = trace_evidence(shipped, measured, EvidenceState(), variant=3)

    assert evidence.shown is None
    assert evidence.choice == (
        "no variant is chosen: 216 of 216 trials have no evidence for the project as it is now (run 'rgss sweep' first)"
    )
    assert asked.choice == "variant 3, as requested; 3 of its trials were not run"


def test_when_none_meets_every_requirement_there_is_no_choice(shipped, filled, record_of):
    measured = measure_variants(shipped, filled(shipped, lambda spec: record_of(spec, motion_s=80.0, path_m=50.0)))
    evidence = trace_evidence(shipped, measured, EvidenceState())

    assert (evidence.shown, evidence.choice) == (
        None,
        "no variant is chosen, since none meets every requirement by its estimates",
    )


def test_a_variant_that_is_not_there(shipped, measured, state):
    with pytest.raises(DefinitionError, match="99"):
        trace_evidence(shipped, measured, state, variant=99)
