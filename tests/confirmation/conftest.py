"""Confirmations that were never run: records and verdicts as a test wants them."""

from __future__ import annotations

import pytest

from rgss.confirmation import (
    Aspect,
    Confirmation,
    ConfirmationSetting,
    ConfirmedTrial,
    Selection,
    SettingResult,
)
from rgss.evidence import Failure, Fidelity, PhaseOutcome, PhaseRecord, TrialRecord
from rgss.measures import Verdict
from rgss.physics import PhysicsSettings
from rgss.physics.mujoco import MujocoSettings
from rgss.tradeoff import DecisionStatus
from tests.fixtures.eight_states import Phase

SETTINGS = (
    ConfirmationSetting(aspect=Aspect.STUDY, physics=PhysicsSettings(solver_iterations=20)),
    ConfirmationSetting(aspect=Aspect.STEP, physics=PhysicsSettings(rate_hz=1000.0, solver_iterations=20)),
    ConfirmationSetting(aspect=Aspect.ENGINE, physics=MujocoSettings(version="3.9", code="c")),
)


def not_run(phase: Phase) -> PhaseRecord:
    return PhaseRecord(phase=phase.value, outcome=PhaseOutcome.NOT_RUN, duration_s=None, metrics={})


def a_record(variant=28, seed=1, *, failure=None, phase=None, detail="", **metrics) -> TrialRecord:
    return TrialRecord(
        variant=variant,
        seed=seed,
        fidelity=Fidelity.CONTACT,
        success=failure is None,
        failure=failure,
        failed_phase=phase,
        failure_detail=detail,
        phases=tuple(map(not_run, Phase)),
        planning=(),
        metrics=metrics,
    )


@pytest.fixture
def record():
    return a_record


@pytest.fixture
def dropped():
    """A record of a trial whose object was dropped in the lift."""
    return a_record(
        failure=Failure.OBJECT_DROPPED, phase=Phase.LIFT, detail="the object slipped 20.1 mm", slip_m=0.0201
    )


@pytest.fixture
def confirmation(shipped):
    """A confirmation of variants 28 and 31; by setting, the ranking, the verdict on SYS-012, and the records."""

    def make(*, rankings, step=0.05, verdicts=None, records=None, ties=None, designs=2, **selection) -> Confirmation:
        count = len(rankings)
        verdicts = verdicts or [Verdict.MET] * count
        rows = records or [[a_record(slip_m=1.0e-5)] * count]
        return Confirmation(
            study="pick_place",
            evidence="evidence.sqlite",
            selection=Selection(variants=tuple(map(shipped.designs.variant, (28, 31))), **{"chosen": 28, **selection}),
            seeds=(1,),
            practical_margin=0.01,
            results=tuple(
                SettingResult(
                    setting=SETTINGS[index],
                    status=DecisionStatus.OPTIMAL if ranking else DecisionStatus.INFEASIBLE,
                    ranking=tuple((variant, 0.6 - step * place) for place, variant in enumerate(ranking)),
                    ties=tuple((ties or [ranking[:1]] * count)[index]),
                    verdicts={28: {"SYS-012": verdicts[index], "SYS-005": Verdict.MET}},
                )
                for index, ranking in enumerate(rankings)
            ),
            trials=tuple(
                ConfirmedTrial(variant=row[0].variant, seed=row[0].seed, is_sample=False, records=tuple(row))
                for row in rows
            ),
            made=3,
            designs=designs,
        )

    return make
