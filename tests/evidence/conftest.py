"""Records to keep, of every kind that a trial can leave."""

import pytest
from hypothesis import strategies as st

from rgss.evidence import (
    PLANNED_PHASES,
    Failure,
    Fidelity,
    Phase,
    PhaseOutcome,
    PhaseRecord,
    PlanningRecord,
    PlanOutcome,
    Provenance,
    TrialRecord,
)


def make_record(variant: int = 1, seed: int = 7, **changes: object) -> TrialRecord:
    values = {
        "variant": variant,
        "seed": seed,
        "fidelity": Fidelity.CONTACT,
        "success": False,
        "failure": Failure.OBJECT_DROPPED,
        "failed_phase": Phase.LIFT,
        "failure_detail": "slipped 31 mm",
        "phases": tuple(
            PhaseRecord(
                phase=phase,
                outcome=PhaseOutcome.COMPLETED if index < 2 else PhaseOutcome.NOT_RUN,
                duration_s=0.1 * index if index < 2 else None,
                metrics={"slip_m": 1e-3 / 7, "grip_margin_min": None},
            )
            for index, phase in enumerate(Phase)
        ),
        "planning": tuple(
            PlanningRecord(
                subtask=phase,
                outcome=PlanOutcome.SOLVED,
                checks=300 + variant,
                simplification_checks=1000,
                time_s=0.3,
                path_length_m=0.1 + 0.2,
            )
            for phase in PLANNED_PHASES
        ),
        "metrics": {"planning_time_s": (0.3, 0.3, None, 0.1, 2), "success": 0, "task_time_s": 12.5},
    }
    return TrialRecord(**{**values, **changes})


def random_records() -> st.SearchStrategy[TrialRecord]:
    number = st.floats(allow_nan=False, allow_infinity=False)
    scalar = st.none() | st.integers() | number
    metrics = st.dictionaries(st.text(), scalar | st.lists(scalar, max_size=5).map(tuple), max_size=5)
    optional_number = st.none() | number | st.integers(0, 9)
    phases = st.builds(
        PhaseRecord,
        phase=st.sampled_from(Phase),
        outcome=st.sampled_from(PhaseOutcome),
        duration_s=optional_number,
        metrics=metrics,
    )
    planning = st.builds(
        PlanningRecord,
        subtask=st.sampled_from(Phase),
        outcome=st.sampled_from(PlanOutcome),
        checks=st.integers(),
        simplification_checks=st.integers(),
        time_s=optional_number,
        path_length_m=optional_number,
    )
    return st.builds(
        TrialRecord,
        variant=st.integers(),
        seed=st.integers(),
        fidelity=st.sampled_from(Fidelity),
        success=st.booleans(),
        failure=st.none() | st.sampled_from(Failure),
        failed_phase=st.none() | st.sampled_from(Phase),
        failure_detail=st.text(),
        phases=st.lists(phases, max_size=2).map(tuple),
        planning=st.lists(planning, max_size=2).map(tuple),
        metrics=metrics,
    )


@pytest.fixture(scope="session")
def record():
    return make_record


@pytest.fixture(scope="session")
def records():
    return random_records()


@pytest.fixture
def provenance():
    inputs = {name: f"{index}" * 64 for index, name in enumerate(["plan", "timing", "execution", "variant"])}
    return Provenance(inputs=inputs, versions={"rgss": "0.1.0", "pybullet": "3.2.7"})
