"""The command line on copies of the shipped project."""

from __future__ import annotations

import io
import json
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

import pytest

from rgss.cli.main import main
from rgss.evidence import (
    EvidenceStore,
    Failure,
    PhaseOutcome,
    PhaseRecord,
    PlanningRecord,
    PlanOutcome,
    TrialRecord,
)
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.trials.metrics import METRICS
from tests.fixtures.eight_states import PLANNED_PHASES, Phase
from tests.fixtures.made_once import made_once
from tests.fixtures.shipped_project import copy_project, with_few_designs
from tests.fixtures.stored_trials import put_trials


@dataclass(frozen=True, kw_only=True)
class Told:
    """What a command said and how it ended."""

    status: int
    output: str
    errors: str

    @property
    def document(self):
        """Standard output as the one JSON document that it is."""
        return json.loads(self.output)

    @property
    def complaint(self) -> str:
        """The one line on standard error."""
        (line,) = self.errors.splitlines()
        return line


@pytest.fixture
def rgss(capsys):
    """Runs the command line in this process."""

    def run(*words: object) -> Told:
        try:
            status = main([str(word) for word in words])
        except SystemExit as end:  # argparse ends the program itself
            status = end.code
        captured = capsys.readouterr()
        return Told(status=status, output=captured.out, errors=captured.err)

    return run


@pytest.fixture(scope="session")
def rgss_process():
    """Runs the command line in a process of its own."""

    def run(*words: object, **options) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "rgss.cli.main", *map(str, words)]
        return subprocess.run(command, capture_output=True, text=True, check=False, **options)

    return run


@pytest.fixture(scope="session")
def untouched(tmp_path_factory) -> Path:
    """A copy of the shipped project that no test changes."""
    return copy_project(tmp_path_factory.mktemp("untouched"))


@pytest.fixture(scope="session")
def with_evidence(tmp_path_factory) -> Path:
    """A copy of the shipped project with a made record for each of its trials; no test changes it."""
    return _filled(copy_project(tmp_path_factory.mktemp("with-evidence")))


@pytest.fixture(scope="session")
def with_little_evidence(tmp_path_factory) -> Path:
    """The same with 8 designs, of which a page is made in a third of the time; no test changes it."""
    return _filled(with_few_designs(copy_project(tmp_path_factory.mktemp("with-little-evidence"))))


@pytest.fixture(scope="session")
def trade_as_json(with_evidence, tmp_path_factory) -> Told:
    """What ``rgss trade --json`` says of the project with evidence; made once for all processes of a run."""
    with made_once(tmp_path_factory, "trade of made evidence.json") as path:
        if not path.exists():
            with redirect_stdout(io.StringIO()) as output, redirect_stderr(io.StringIO()) as errors:
                status = main(["trade", "--json", "--project", str(with_evidence)])
            said = {"status": status, "output": output.getvalue(), "errors": errors.getvalue()}
            path.write_text(json.dumps(said), encoding="utf-8")
        return Told(**json.loads(path.read_text(encoding="utf-8")))


def _filled(folder: Path) -> Path:
    project = load_project(folder)
    with EvidenceStore.open(project.evidence) as store:
        put_trials(store, trial_specs(project), made_record)
    return folder


def made_record(spec) -> TrialRecord:
    """A trial that was never run: STRIDE fails, the others take longer the higher their id."""
    success = spec.planner != "STRIDE"
    planned = 5 if success else 0
    time_s = 0.3 + 0.01 * spec.variant + 0.001 * spec.seed
    metrics = dict.fromkeys(METRICS) | {
        "success": int(success),
        "phases_completed": 8 if success else 0,
        "phases_total": 8,
        "planning_time_s": (time_s,) * planned + (None,) * (5 - planned),
        "path_length_m": (0.6,) * planned + (None,) * (5 - planned),
        "motion_time_s": 9.0 + 0.1 * spec.seed,
        "grasp_cycle_time_s": 1.9 if success else None,
        "task_time_s": 9.0 + 0.1 * spec.seed + 5 * time_s if success else None,
    }
    return TrialRecord(
        variant=spec.variant,
        seed=spec.seed,
        fidelity=spec.fidelity,
        success=success,
        failure=None if success else Failure.PLANNING_LIMIT,
        failed_phase=None if success else Phase.MOVE_TO_GRASP,
        failure_detail="" if success else "no path",
        phases=tuple(
            PhaseRecord(
                phase=phase,
                outcome=PhaseOutcome.COMPLETED if success else PhaseOutcome.NOT_RUN,
                duration_s=1.0 if success else None,
                metrics={},
            )
            for phase in Phase
        ),
        planning=tuple(
            PlanningRecord(
                subtask=phase,
                outcome=PlanOutcome.SOLVED if success else PlanOutcome.NOT_RUN,
                checks=100,
                simplification_checks=0,
                time_s=time_s if success else None,
                path_length_m=0.6 if success else None,
            )
            for phase in PLANNED_PHASES
        ),
        metrics=metrics,
    )
