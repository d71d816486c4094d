"""Searches of the planners as a benchmark database of OMPL."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.exchange.formats.format import ExportFormat

if TYPE_CHECKING:
    from rgss.studies import Project


def _write(project: Project, path: Path, evidence: str) -> Mapping[str, int]:
    from rgss.evidence import EvidenceStore
    from rgss.exchange.ompl_database import write_ompl_database
    from rgss.motion import ClockKind
    from rgss.sweep import planning_runs
    from rgss.trials.code import versions

    planning = project.study.planning.settings
    is_counted = planning.clock.kind is ClockKind.COUNTED
    with EvidenceStore.open(project.evidence, create=False, label=evidence) as store:
        runs = planning_runs(project, store)
    write_ompl_database(
        path,
        runs,
        name=project.study.id,
        seed=project.study.seed,
        version=versions()["ompl"],
        setup={
            "scene": project.scene.id,
            "planning clock": f"{planning.clock.charge_s:g} s a validity check" if is_counted else "wall",
            "resolution": f"{planning.resolution_rad:g} rad",
            "clearance": f"{planning.clearance_m:g} m",
        },
    )
    return {"planning runs": len(runs)}


OMPL = ExportFormat(name="ompl", write=_write)
