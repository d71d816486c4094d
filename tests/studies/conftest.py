"""Copies of the shipped project that a test may spoil, and evidence made without a simulation."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from rgss.errors import DocumentError
from rgss.evidence import (
    PLANNED_PHASES,
    EvidenceStore,
    Failure,
    Phase,
    PhaseOutcome,
    PhaseRecord,
    PlanningRecord,
    PlanOutcome,
    Provenance,
    TrialRecord,
)
from rgss.studies.expansion import trial_specs
from rgss.studies.project import FOLDERS, Project, load_project
from rgss.studies.study import read_study
from rgss.studies.sweep import key_of
from rgss.trials.metrics import METRICS

REPOSITORY = Path(__file__).parents[2]
STUDY = "studies/pick_place.yaml"


@pytest.fixture(scope="session")
def shipped() -> Project:
    """The shipped project; it is only read."""
    return load_project(REPOSITORY)


@pytest.fixture
def folder(tmp_path) -> Path:
    """A copy of the shipped project."""
    copy = tmp_path / "project"
    for name in FOLDERS:
        shutil.copytree(REPOSITORY / name, copy / name)
    return copy


@pytest.fixture
def edit(folder):
    """Replaces the first place of a text in a file of the copy."""

    def change(file: str, old: str, new: str) -> None:
        text = (folder / file).read_text(encoding="utf-8")
        assert old in text
        (folder / file).write_text(text.replace(old, new, 1), encoding="utf-8")

    return change


@pytest.fixture
def place_of(folder):
    """Where a text first stands in a file of the copy, as findings show it."""

    def find(file: str, text: str) -> str:
        content = (folder / file).read_text(encoding="utf-8")
        before = content[: content.index(text)]
        return f"{file}:{before.count(chr(10)) + 1}:{len(before) - before.rfind(chr(10))}"

    return find


@pytest.fixture
def problems(folder):
    """What is found wrong in the copy, as texts."""

    def find(study: str | None = None) -> list[str]:
        with pytest.raises(DocumentError) as caught:
            load_project(folder, study)
        assert list(caught.value.findings) == sorted(caught.value.findings)
        return [str(finding) for finding in caught.value.findings]

    return find


@pytest.fixture(scope="session")
def record_of():
    """Makes the record of a trial that took what it is told to take, without a simulation."""

    def make(spec, *, success=True, planning_s=1.0, path_m=0.5, motion_s=8.0) -> TrialRecord:
        done = 8 if success else 3
        outcomes = [PhaseOutcome.COMPLETED] * done + [PhaseOutcome.FAILED, *[PhaseOutcome.NOT_RUN] * 4][: 8 - done]
        planned = 5 if success else 2
        metrics = dict.fromkeys(METRICS) | {
            "success": int(success),
            "phases_completed": done,
            "phases_total": 8,
            "planning_time_s": (planning_s,) * planned + (None,) * (5 - planned),
            "planning_checks": (100,) * planned + (None,) * (5 - planned),
            "path_length_m": (path_m,) * planned + (None,) * (5 - planned),
            "motion_time_s": motion_s,
            "task_time_s": motion_s + 5 * planning_s if success else None,
        }
        return TrialRecord(
            variant=spec.variant,
            seed=spec.seed,
            fidelity=spec.fidelity,
            success=success,
            failure=None if success else Failure.PLANNING_LIMIT,
            failed_phase=None if success else tuple(Phase)[done],
            failure_detail="" if success else "no path",
            phases=tuple(
                PhaseRecord(
                    phase=phase,
                    outcome=outcome,
                    duration_s=1.0 if outcome is PhaseOutcome.COMPLETED else None,
                    metrics={},
                )
                for phase, outcome in zip(Phase, outcomes, strict=True)
            ),
            planning=tuple(
                PlanningRecord(
                    subtask=phase,
                    outcome=PlanOutcome.SOLVED if index < planned else PlanOutcome.NOT_RUN,
                    checks=100 if index < planned else 0,
                    simplification_checks=0,
                    time_s=planning_s if index < planned else None,
                    path_length_m=path_m if index < planned else None,
                )
                for index, phase in enumerate(PLANNED_PHASES)
            ),
            metrics=metrics,
        )

    return make


@pytest.fixture(scope="session")
def filled(tmp_path_factory):
    """Opens a store with a made record for each trial of a project."""
    stores = []
    folder = tmp_path_factory.mktemp("evidence")

    def fill(project: Project, record_for) -> EvidenceStore:
        store = EvidenceStore.open(folder / f"{len(stores)}.sqlite")
        stores.append(store)
        for spec in trial_specs(project):
            record = record_for(spec)
            if record is not None:
                store.put(key_of(spec), record, Provenance(inputs={}, versions={}))
        return store

    yield fill
    for store in stores:
        store.close()


@pytest.fixture(scope="session")
def read_trade_off_of(shipped, tmp_path_factory):
    """Reads the shipped study with another trade-off, given as lines; the file is called s."""
    path = tmp_path_factory.mktemp("study") / "study.yaml"
    text = (shipped.folder / STUDY).read_text(encoding="utf-8")
    section = re.search(r"^trade_off:\n(?:[ #].*\n|\n)*", text, re.MULTILINE)[0]
    head, tail = text.split(section)

    def read(*lines):
        path.write_text("\n  ".join(["trade_off:", *lines]) + f"\n{head}{tail}", encoding="utf-8")
        return read_study(path, shipped.measures, project=shipped.folder, label="s", requirements=shipped.requirements)

    return read
