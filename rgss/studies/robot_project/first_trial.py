"""Trial of a new project, by which a layout is accepted."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rgss.evidence import Fidelity
from rgss.studies.design_settings import GRIPPER
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.trials.pieces import run_trial


def carries_object(folder: Path) -> bool:
    """True if a kinematic trial of the first design with each gripper succeeds.

    Args:
        folder: The project.
    """
    project = load_project(folder)
    firsts = {variant.components[GRIPPER].id: variant for variant in reversed(project.designs.expand())}
    specs = trial_specs(project, variants=list(firsts.values()), seeds=[project.study.seed])
    return all(run_trial(replace(spec, fidelity=Fidelity.KINEMATIC)).success for spec in specs)
