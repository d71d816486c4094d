"""Trial and checks of a new project, by which a layout is accepted."""

from __future__ import annotations

from dataclasses import replace

from rgss.evidence import Fidelity
from rgss.findings import Severity
from rgss.studies.design_settings import GRIPPER
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project
from rgss.studies.scene_findings import check_scene
from rgss.trials.pieces import run_trial


def carries_object(project: Project) -> bool:
    """True if a kinematic trial of the first design with each gripper succeeds."""
    firsts = {variant.components[GRIPPER].id: variant for variant in reversed(project.designs.expand())}
    specs = trial_specs(project, variants=list(firsts.values()), seeds=[project.study.seed])
    return all(run_trial(replace(spec, fidelity=Fidelity.KINEMATIC)).success for spec in specs)


def has_scene_errors(project: Project) -> bool:
    """True if `rgss check` finds an error in the scene, or cannot check it."""
    check = check_scene(project)
    return bool(check.skipped) or any(finding.severity is Severity.ERROR for finding in check.findings)
