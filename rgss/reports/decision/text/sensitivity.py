"""Sensitivity of a decision to its inputs, exchange rates, designs worth keeping, and stakeholders, for a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.decision.robustness import not_computed_lines
from rgss.decision.sensitivity import Sensitivity
from rgss.reports.decision.exchange_sentences import (
    EXCHANGE_HEADS,
    exchange_rows,
    exchange_sentences,
    exchange_title,
)
from rgss.reports.decision.sensitivity_sentences import (
    KeptGroup,
    agreement_sentences,
    beaten_sentences,
    bend_sentences,
    keep_rule,
    kept_groups,
    range_sentence,
    regret_text,
)
from rgss.reports.decision.text.tornado import tornado_lines
from rgss.reports.decision.words import ids_text, score
from rgss.reports.plain_text import aligned_table


def sensitivity_lines(found: Sensitivity) -> Iterator[str]:
    """The lines of the section."""
    if found.tornado is not None:
        yield ""
        yield "How sensitive it is"
        yield from tornado_lines(found.tornado)
        yield from bend_sentences(found.bends)
        yield range_sentence(found.tornado)
    if found.exchange is not None:
        yield ""
        yield exchange_title(found.exchange)
        rows = [list(row.cells) for row in exchange_rows(found.exchange)]
        yield from aligned_table(list(EXCHANGE_HEADS), rows, right=(1, 2, 3))
        yield from exchange_sentences(found.exchange)
    if found.kept is not None and len(found.variants) > 1:
        yield ""
        yield f"Designs worth keeping ({keep_rule(found)})"
        yield from _kept(kept_groups(found))
        yield from beaten_sentences(found)
    if found.agreement is not None:
        yield ""
        yield from _stakeholders(found)
    yield from not_computed_lines(found.not_computed)


def _kept(groups: tuple[KeptGroup, ...]) -> list[str]:
    rows = [[ids_text(one.variants), one.why, score(one.behind)] for one in groups]
    return aligned_table(["variants", "kept because", "behind now"], rows, right=(2,))


def _stakeholders(found: Sensitivity) -> Iterator[str]:
    agreement = found.agreement
    if agreement is None:
        return
    yield "What stakeholders choose by their own weights"
    rows = [
        [
            view.name,
            ids_text(found.variants[row] for row in view.best),
            score(view.best_value),
            ids_text(found.variants[row] for row in view.accepted),
            regret_text(view, agreement),
        ]
        for view in agreement.views
    ]
    titles = ["stakeholder", "chooses", "value", f"accepts (within {found.accept_within:g})", "regret of compromise"]
    yield from aligned_table(titles, rows, right=(2, 4))
    yield from agreement_sentences(found)
