"""Remedies for stale verdicts: which commands give verdicts on the present project."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.assessment.measuring import VariantMeasures
from rgss.studies import Project


def stale_remedies(project: Project, measured: Sequence[VariantMeasures]) -> tuple[str, ...]:
    """Sentences that name the commands after which no verdict is stale; empty if none is.

    Trials of an earlier model are made again. A change of a requirement or a measure leaves them as they are, so that a
    sweep finds nothing to run, and the verdicts are recorded again.
    """
    needing = {entry.outdated > 0 for entry in measured if entry.causes}
    sentences = []
    if True in needing:
        sentences.append(
            f"'{project.command('sweep')}' makes the outdated trials again, and records the verdicts of their variants."
        )
    if False in needing:
        others = " the other" if True in needing else ""
        sentences.append(f"'{project.command('measure')} --record' gives{others} verdicts by the stored evidence.")
    return tuple(sentences)
