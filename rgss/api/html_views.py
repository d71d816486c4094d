"""HTML views of a study and a trial for Jupyter."""

from __future__ import annotations

from rgss.evidence import TrialRecord
from rgss.html_tables import html_table, html_view
from rgss.studies import Project


def study_view(title: str, project: Project, variants: int) -> str:
    """Overview of a study from its files; no evidence is read.

    Args:
        title: Its heading.
        project: The project with the study.
        variants: Number of design variants.
    """
    study = project.study
    rows = [
        ("study", study.label),
        ("project", project.folder),
        ("design variants", variants),
        ("seeds for each", study.replicates),
        ("fidelity", study.fidelity.value),
        ("evidence", project.evidence if project.evidence.exists() else "none yet: call sweep()"),
    ]
    return html_view(title, html_table((), rows))


def trial_view(title: str, record: TrialRecord) -> str:
    """States of a trial with their outcomes and durations.

    Args:
        title: Its heading.
        record: The trial.
    """
    rows = [
        (one.phase, one.outcome.value, "–" if one.duration_s is None else f"{one.duration_s:.2f}")
        for one in record.phases
    ]
    return html_view(title, html_table(("state", "outcome", "duration, s"), rows))
