"""Peak memory of the robustness of 10,092 variants with 10 replicates each; writes a table in Markdown.

Run it from the repository's folder: ``python benchmarks/robustness_memory.py [LEVELS [REPLICATES]]``. The
shipped study is widened to LEVELS speeds of the tool and LEVELS planning limits (29 by default, which makes
12 x 29 x 29 variants), and its store is filled with records that were never simulated. Reading and analysis
run in a process of their own, so that their memory is their own. It fails above 1.5 GB.
"""

from __future__ import annotations

import json
import resource
import shutil
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose
from rgss.decision.robustness.robustness import analyse_robustness
from rgss.evidence import (
    EvidenceStore,
    Metric,
    PhaseOutcome,
    PhaseRecord,
    PlanningRecord,
    PlanOutcome,
    Provenance,
    TrialRecord,
)
from rgss.studies import FOLDERS
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project, load_project
from rgss.sweep.trial_keys import key_of
from rgss.tasks import default_task
from rgss.trials.metrics import METRICS
from rgss.trials.trial_spec import TrialSpec

LARGEST_MB = 1500
"""The memory that is allowed."""


def widened(folder: Path, levels: int) -> None:
    """Copy the shipped project and give two of its factors many levels."""
    for name in FOLDERS:
        shutil.copytree(Path(__file__).parents[1] / name, folder / name)
    space = folder / "designs" / "grasping_system.yaml"
    text = space.read_text(encoding="utf-8")
    for parameter, unit, first, last in (("d7", "m/s", 0.5, 1.0), ("d9", "s", 4.0, 8.0)):
        lines = text.splitlines(keepends=True)
        marks = [place for place, line in enumerate(lines) if f"sets: {{{parameter}:" in line]
        step = (last - first) / max(1, levels - 1)
        made = [
            f"      - id: {parameter}-{level}\n        sets: {{{parameter}: {first + level * step:.6f} {unit}}}\n"
            for level in range(levels)
        ]
        text = "".join([*lines[: marks[0] - 1], *made, *lines[marks[-1] + 1 :]])
    space.write_text(text, encoding="utf-8")


def project_of(folder: Path, replicates: int) -> Project:
    """The widened project with a number of replicates."""
    project = load_project(folder)
    return replace(project, study=replace(project.study, replicates=replicates))


def record_of(spec: TrialSpec) -> TrialRecord:
    """A successful trial of all metrics whose times depend on design and seed."""
    time_s, joints = 0.3 + 0.0001 * spec.variant + 0.001 * spec.seed, len(spec.scene.robot.joints)
    metrics: dict[str, Metric] = {
        name: time_s + place if length is None else (time_s + place,) * length
        for place, (name, kind) in enumerate(METRICS.items())
        for length in (kind.length_in_trial(planned=len(default_task().planned), joints=joints),)
    } | {
        "success": 1,
        "phases_completed": 8,
        "phases_total": 8,
        "planning_time_s": (time_s,) * len(default_task().planned),
        "path_length_m": (0.6,) * len(default_task().planned),
        "motion_time_s": 9.0 + 0.1 * spec.seed,
        "task_time_s": 9.0 + 0.1 * spec.seed + 5.0 * time_s,
    }
    return TrialRecord(
        variant=spec.variant,
        seed=spec.seed,
        fidelity=spec.fidelity,
        success=True,
        failure=None,
        failed_phase=None,
        failure_detail="",
        phases=tuple(
            PhaseRecord(phase=phase, outcome=PhaseOutcome.COMPLETED, duration_s=1.0 + time_s, metrics={})
            for phase in default_task().phases
        ),
        planning=tuple(
            PlanningRecord(
                subtask=phase,
                outcome=PlanOutcome.SOLVED,
                checks=1000 + spec.variant,
                simplification_checks=1000 + spec.seed,
                time_s=time_s,
                path_length_m=0.6 + time_s,
            )
            for phase in default_task().planned
        ),
        metrics=metrics,
    )


def fill(project: Project) -> None:
    """Put a record of every trial into the store."""
    with EvidenceStore.open(project.evidence) as store:
        store.put_many(
            trials=(
                (key_of(spec), record_of(spec), Provenance(inputs={}, versions={})) for spec in trial_specs(project)
            )
        )


def peak_mb() -> float:
    """The largest memory of this process so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def analyse(project: Project) -> None:
    """Read and analyse, and write the peaks as JSON."""
    loaded = peak_mb()
    with EvidenceStore.open(project.evidence, create=False) as store:
        measured = measure_variants(project, store)
    read = peak_mb()
    decision = choose(project, measured)
    decided = peak_mb()
    found = analyse_robustness(project, measured, decision)
    sys.stdout.write(
        json.dumps(
            {
                "variants": len(measured),
                "trials": sum(len(entry.records) for entry in measured),
                "loaded_mb": loaded,
                "read_mb": read,
                "decided_mb": decided,
                "peak_mb": peak_mb(),
                "not_computed": len(found.not_computed),
            }
        )
        + "\n"
    )


def main() -> int:
    """Fill a store, and analyse it in a process of its own; 1 if that takes more memory than is allowed."""
    levels = int(sys.argv[1]) if len(sys.argv) > 1 else 29
    replicates = int(sys.argv[2]) if len(sys.argv) > 2 else 10
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        widened(folder, levels)
        fill(project_of(folder, replicates))
        command = [sys.executable, __file__, "--one", name, str(replicates)]
        row = json.loads(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout)  # noqa: S603 - itself
    sys.stdout.write("| " + " | ".join(row) + " |\n|" + "---|" * len(row) + "\n")
    sys.stdout.write("| " + " | ".join(f"{value:.0f}" for value in row.values()) + " |\n")
    return int(row["peak_mb"] > LARGEST_MB)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        analyse(project_of(Path(sys.argv[2]), int(sys.argv[3])))
    else:
        sys.exit(main())
