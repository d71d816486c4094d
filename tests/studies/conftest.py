"""Copies of the shipped project that a test may spoil, and evidence made without a simulation."""

from __future__ import annotations

import random
import re
import shutil
import time
from dataclasses import replace
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
    RunFailureKind,
    TrialRecord,
)
from rgss.guard.guard import compare_with_baseline, make_baseline
from rgss.studies.expansion import trial_specs
from rgss.studies.project import FOLDERS, Project, load_project
from rgss.studies.study import read_study
from rgss.sweep.running import key_of
from rgss.sweep.workers import TaskError
from rgss.trials.metrics import METRICS

REPOSITORY = Path(__file__).parents[2]
STUDY = "studies/pick_place.yaml"
SECTION = """
regression:
  runs:
    - {id: planning, fidelity: kinematic, variants: "57,60", replicates: 4, batch: 4, cap: 12}
    - {id: grasp, fidelity: contact, variants: "57", replicates: 4, batch: 8, cap: 12}
  decision: grasp
  metrics:
    - {metric: success, better: higher, margin: 25 %}
    - {metric: success, phases: all, better: higher, margin: 25 %}
    - {metric: planning_time_s, runs: [planning], phases: all, better: lower, margin: 0.2 s}
    - {metric: motion_time_s, better: lower, margin: 0.5 s}
"""
REASON = "First baseline."


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


@pytest.fixture(scope="session")
def carried_out():
    """Carries out tasks on workers of any kind."""

    def carry_out(workers, tasks, *, patience_s=60.0):
        """Carry out tasks by their keys; return how each ended."""
        left, ended = dict(tasks), {}
        end = time.monotonic() + patience_s
        while len(ended) < len(tasks):
            assert time.monotonic() < end, f"no end of {set(tasks) - set(ended)}"
            workers.want(len(tasks) - len(ended))
            while workers.free and left:
                key = next(iter(left))
                workers.begin(key, left.pop(key))
            for each in workers.wait(1.0):
                assert each.key not in ended
                ended[each.key] = each
        return ended

    return carry_out


@pytest.fixture(scope="session")
def troubles_of_tasks() -> dict[str, TaskError]:
    """What becomes of the troubled tasks of `worker_doubles.act`, whoever carries them out within 5 s."""
    return {
        "die": TaskError(
            kind=RunFailureKind.CRASHED,
            detail="the worker was killed by SIGSEGV: free(): invalid next size",
            may_pass=True,
        ),
        "exit": TaskError(kind=RunFailureKind.CRASHED, detail="the worker ended with status 7", may_pass=True),
        "fail": TaskError(kind=RunFailureKind.RAISED, detail="ZeroDivisionError: division by zero", may_pass=True),
        "refuse": TaskError(
            kind=RunFailureKind.RAISED,
            detail="the workpiece cannot have the mass 0 (give it some)",
            may_pass=False,
        ),
        "hang": TaskError(kind=RunFailureKind.TIMED_OUT, detail="not done after 5 s", may_pass=True),
    }


def without_section(text):
    """The text of a study without what it guards."""
    return re.sub(r"(?ms)^(?:# What `rgss regress`[^\n]*\n(?:#[^\n]*\n)*)?regression:\n.*?(?=^\S|\Z)", "", text)


@pytest.fixture
def project_of(shipped, tmp_path):
    """The shipped project with another section."""

    def load(section=SECTION):
        path = tmp_path / "study.yaml"
        path.write_text(without_section((shipped.folder / STUDY).read_text(encoding="utf-8")) + section, "utf-8")
        study = read_study(
            path, shipped.measures, project=shipped.folder, label=STUDY, requirements=shipped.requirements
        )
        return replace(shipped, study=study)

    return load


@pytest.fixture
def stores(tmp_path):
    """Opens a new store each time."""
    opened = []

    def make():
        opened.append(EvidenceStore.open(tmp_path / f"{len(opened)}.sqlite"))
        return opened[-1]

    yield make
    for store in opened:
        store.close()


@pytest.fixture
def runner(record_of):
    """Runs trials without a simulation; each planning takes its time, and one may fail, or not be run at all."""

    def make(
        store,
        *,
        slower_s=0.0,
        slower=lambda spec: True,
        fails=lambda spec: False,
        lost=lambda spec: False,
        more_metrics=None,
        more_of_phases=False,
    ):
        def run(specs):
            rows = []
            for spec in specs:
                chance = random.Random(f"{spec.planner} {spec.seed}")  # noqa: S311 - a sample, no secret
                if lost(spec):
                    continue
                took_s = 0.5 + chance.random() + slower_s * slower(spec)
                record = record_of(spec, success=not fails(spec), planning_s=took_s)
                more = more_metrics or {}
                record = replace(record, metrics={**record.metrics, **more})
                if more_of_phases:
                    phases = tuple(replace(one, metrics={**one.metrics, **more}) for one in record.phases)
                    record = replace(record, phases=phases)
                rows.append((key_of(spec), record, Provenance(inputs={}, versions={})))
            store.put_many(trials=rows)

        return run

    return make


@pytest.fixture
def compared(project_of, stores, runner):
    """The report of a project whose trials changed since its baseline."""

    def compare(
        section=SECTION, baseline_of=lambda baseline: baseline, on_look=None, before=SECTION, accepted="", **changes
    ):
        project = project_of(before)
        first = stores()
        baseline = make_baseline(project, first, runner(first), before=None, reason=REASON)
        if section != before:
            project = project_of(section)
        now = stores()
        return compare_with_baseline(
            project,
            now,
            runner(now, **changes),
            baseline_of(baseline),
            label="b",
            on_look=on_look,
            accepted=accepted,
        )

    return compare
