"""HTML views of a study, a trial and a trade-off for Jupyter."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from rgss.evidence import TrialRecord
from rgss.studies import Project
from rgss.tradeoff import Decision

_LONGEST_RANKING = 5


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
    return _view(title, _table((), rows))


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
    return _view(title, _table(("state", "outcome", "duration, s"), rows))


def decision_view(title: str, decision: Decision) -> str:
    """The decision with the first places of its ranking.

    Args:
        title: Its heading.
        decision: The decision.
    """
    first = decision.ranking[:_LONGEST_RANKING]
    rows = [
        (place, one.variant, "–" if one.value is None else f"{one.value:.3f}", _role(decision, one.variant))
        for place, one in enumerate(first, start=1)
    ]
    rest = len(decision.ranking) - len(first)
    more = f"<p>and {rest} more in <code>ranking</code></p>" if rest else ""
    table = _table(("place", "variant", "weighted value", ""), rows) if rows else ""
    return _view(title, f"<p>{escape(repr(decision))}</p>{table}{more}")


def _role(decision: Decision, variant: int) -> str:
    if variant == decision.chosen:
        return "chosen"
    if variant in decision.ties:
        return "tied"
    return "runner-up" if variant == decision.runner_up else ""


def _view(title: str, body: str) -> str:
    return f"<div><p><strong>{escape(title)}</strong></p>{body}</div>"


def _table(heads: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    head = "".join(f"<th>{escape(one)}</th>" for one in heads)
    body = "".join(f"<tr>{''.join(f'<td>{escape(str(cell))}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table>{f'<thead><tr>{head}</tr></thead>' if heads else ''}<tbody>{body}</tbody></table>"
