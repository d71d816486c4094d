"""Suppositions about one study that hold in another one too."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.decision.what_if.scenario import Scenario
from rgss.decision.what_if.unknown_input import UnknownSuppositionError
from rgss.decision.what_if.what_if import suppose
from rgss.studies import Project


def suppose_known(project: Project, suppositions: Sequence[str]) -> Scenario | None:
    """Apply to a study those suppositions that it has; None if it has none of them.

    Suppositions about the study of a portfolio concern each study that it serves and that has the number too.

    Args:
        project: The project with one of the served studies.
        suppositions: Texts as in `suppose`.

    Raises:
        DefinitionError: As in `suppose`, except for an unknown name.
        TradeoffError: As in `suppose`.
    """
    known = []
    for text in suppositions:
        try:
            suppose(project, [text])
        except UnknownSuppositionError:
            continue
        known.append(text)
    return suppose(project, known) if known else None
