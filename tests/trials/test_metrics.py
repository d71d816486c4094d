"""Descriptors of metrics: what records, the guard and frames make of them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.evidence import Fidelity
from rgss.regression import observed
from rgss.trials import record
from rgss.trials.metrics import METRICS, PHASE_METRICS, Aggregation, Direction, MetricDescriptor, PhaseValue
from rgss.trials.metrics.choice_metrics import CHOICE_METRICS
from rgss.trials.metrics.descriptor import WITH_CONTACT
from rgss.trials.pieces import Pieces

from .test_record import EXECUTION, plan_of


@pytest.fixture(scope="module")
def recorded(spec_of):
    """A successful record of each fidelity."""
    pieces = Pieces()
    return {one: pieces.record(replace(spec_of(28), fidelity=one)) for one in Fidelity}


def test_every_metric_has_a_value_somewhere_and_a_meaning():
    for name, metric in {**METRICS, **PHASE_METRICS}.items():
        assert name == metric.name
        assert metric.meaning
        assert metric.unit
        assert metric.fidelities
        assert (metric.trial in (Aggregation.AT_GRASP, Aggregation.OF_GREATEST)) == bool(metric.source)
    assert {one.source for one in METRICS.values() if one.source} <= {*PHASE_METRICS}


def test_what_is_the_worst_has_a_preferred_direction():
    worst = [one for one in METRICS.values() if one.trial is Aggregation.WORST_CARRIED]

    assert len(worst) == 22
    assert all(one.better is not Direction.NEITHER for one in worst)


def test_the_guard_reads_the_metrics_that_are_fields_of_a_phases_record(recorded):
    trial = recorded[Fidelity.KINEMATIC]
    recorded_ones = {name for name, metric in PHASE_METRICS.items() if metric.phase is PhaseValue.RECORDED}
    phases = [one.phase for one in trial.phases]
    found = {name for name in recorded_ones if any(observed(trial, name, phase) is not None for phase in phases)}

    assert recorded_ones
    assert found == recorded_ones


@pytest.mark.parametrize("fidelity", list(Fidelity))
def test_a_phase_observes_what_its_fidelity_does(recorded, fidelity):
    found = {name for phase in recorded[fidelity].phases for name in phase.metrics}
    stated = {
        name
        for name, metric in PHASE_METRICS.items()
        if metric.phase is PhaseValue.OBSERVED and fidelity in metric.fidelities
    }

    # The variant has two fingers, whose polygon has no irregularity, in some fidelities it is another.
    # A stated grasp has none of the metrics of a chosen one (tests/trials/objects/test_objects.py).
    chosen = {metric.name for metric in CHOICE_METRICS}
    assert found | {"grasp_q_gpri_1"} | chosen >= stated
    assert found <= stated


@pytest.mark.parametrize("fidelity", list(Fidelity))
def test_a_trial_has_what_its_fidelity_observes(recorded, fidelity):
    found = {name for name, value in recorded[fidelity].metrics.items() if value is not None}
    stated = {name for name, metric in METRICS.items() if fidelity in metric.fidelities}

    assert found | {"grasp_q_gpri_1", "at_grasp_q_gpri_1"} >= stated
    assert found <= stated


def entries(value):
    return value if isinstance(value, tuple) else (value,)


@pytest.mark.parametrize("fidelity", list(Fidelity))
def test_values_are_within_the_ranges_of_their_metrics(recorded, fidelity):
    record = recorded[fidelity]
    found = [(METRICS[name], value) for name, value in record.metrics.items()]
    found += [(PHASE_METRICS[name], value) for phase in record.phases for name, value in phase.metrics.items()]
    values = [(metric, entry) for metric, value in found for entry in entries(value) if entry is not None]

    assert len({metric.name for metric, _ in values}) > 10
    for metric, entry in values:
        assert metric.least is None or entry >= metric.least, metric.name
        assert metric.most is None or entry <= metric.most, metric.name


def test_what_has_a_sign_has_no_least_value():
    signed = {name for name, metric in METRICS.items() if metric.least is None}
    assert signed == {"joint_net_work_j", "path_clearance_min_m", "contact_gap_min_m", "at_grasp_contact_gap_min_m"}


def test_a_new_metric_is_one_descriptor(spec_of, monkeypatch):
    new = MetricDescriptor(
        name="noise_n", unit="N", meaning="noise", better=Direction.HIGHER, trial=Aggregation.WORST_CARRIED
    )
    monkeypatch.setattr(record, "METRICS", {**METRICS, "noise_n": new})
    phases = [
        replace(one, metrics={**one.metrics, "noise_n": float(number)}) for number, one in enumerate(EXECUTION, start=1)
    ]

    made = record.assemble_record(
        replace(spec_of(65), planning_limit_s=2.0, fidelity=WITH_CONTACT[0]), plan_of(*(1000,) * 5), {}, phases
    )

    assert made.metrics["noise_n"] == 3.0
