"""Schema of a baseline: units of the guarded metrics, the metrics of a record, the reason of an update."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.errors import DefinitionError
from rgss.studies import Project, RegressionGuard
from rgss.trials import METRICS, MetricDescriptor

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
    planned = len(project.study.task.planned)
    joints = sorted({len(one.scene.robot.joints) for one in project.by_arm().values()})
    return {name: _length_and_unit(kind, planned, joints) for name, kind in METRICS.items()}


def _length_and_unit(kind: MetricDescriptor, planned: int, joints: Sequence[int]) -> str:
    """Unit of a metric after the lengths of its row, which is one for each joint of the arm of the design."""
    lengths = dict.fromkeys(kind.length_in_trial(planned=planned, joints=number) for number in joints)
    rows = " or ".join(str(length) for length in lengths if length is not None)
    return f"{rows} × {kind.unit}" if rows else kind.unit
