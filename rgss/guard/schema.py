"""Schema of a baseline: units of the guarded metrics, the metrics of a record, the reason of an update."""

from __future__ import annotations

from rgss.errors import DefinitionError
from rgss.studies import Project, RegressionGuard
from rgss.trials import METRICS

LONGEST_REASON = 500


def one_line_reason(text: str) -> str:
    """A reason as one line, validated.

    Raises:
        DefinitionError: It is too long.
    """
    words = " ".join(text.split())
    if len(words) > LONGEST_REASON:
        raise DefinitionError(f"the reason has {len(words)} characters", hint=f"use at most {LONGEST_REASON}")
    return words


def units_of(guard: RegressionGuard) -> dict[str, str]:
    """Unit of each guarded metric."""
    return {metric.metric: metric.guard.unit for metric in guard.metrics}


def record_schema(project: Project) -> dict[str, str]:
    """Unit and row length of each metric that a record of a project's study may have."""
    planned, joints = len(project.study.task.planned), len(project.scene.robot.joints)
    lengths = {name: kind.length_in_trial(planned=planned, joints=joints) for name, kind in METRICS.items()}
    return {
        name: kind.unit if lengths[name] is None else f"{lengths[name]} × {kind.unit}" for name, kind in METRICS.items()
    }
