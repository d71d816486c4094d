"""Weights from pairwise answers, and the questionnaire, for a terminal."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping

from rgss.reports.decision.answers_in_words import (
    answers_phrase,
    consistency_sentences,
    method_sentence,
    verdict_phrase,
)
from rgss.reports.plain_text import aligned_table
from rgss.tradeoff.elicitation import ElicitedWeights


def weighing_lines(
    study: str,
    elicited: Iterable[ElicitedWeights],
    by: Mapping[str, ElicitedWeights],
    *,
    stated: Mapping[str, float] | None = None,
) -> Iterator[str]:
    """Weights, intervals and inconsistency, group by group.

    Args:
        study: The study's id.
        elicited: The groups whose weights follow from answers.
        by: Those of stakeholders, by name.
        stated: The weights if none follow from answers; None if some do.
    """
    if stated is not None:
        yield f"Study {study} states its weights; 'rgss weigh --questions' prints questions to answer instead."
        yield from aligned_table(
            ["measure", "weight"], [[name, f"{weight:.3f}"] for name, weight in stated.items()], right=(1,)
        )
    groups = [*(("", one) for one in elicited), *((f" of {name}", one) for name, one in by.items())]
    for place, (whose, one) in enumerate(groups):
        if place or stated is not None:
            yield ""
        yield f"Study {study}: weights{whose} from {answers_phrase(one)}; {verdict_phrase(one)}"
        rows = [
            [name, f"{weight:.3f}", f"{one.low[name]:.3f}", f"{one.high[name]:.3f}"]
            for name, weight in one.weights.items()
        ]
        yield from aligned_table(["swing of", "weight", "from", "to"], rows, right=(1, 2, 3))
        yield method_sentence(one)
        yield "(from, to: weights that agree with the orders and ranges and, within that factor, with the ratios; and"
        yield "the fits without any one of the ratios)"
        if one.consistency is not None:
            yield from consistency_sentences(one.consistency)
        yield f"Answers: SHA-256 {one.digest}"


def question_lines(swings: Iterable[tuple[str, str, str]]) -> Iterator[str]:
    """Questions on the swings of measures, as a section to fill in.

    Each measure is compared with the next, and the first with the last, so that one answer checks the others.

    Args:
        swings: Measure, its worst and its best quantity, each.
    """
    known = list(swings)
    yield "# Which swing from worst to best is worth most, and what is each worth relative to another?"
    yield "# Fill in a ratio; or 'between: [least, most]'; or nothing, where the first is worth at least as much."
    yield "# Take 'weight', 'points' and 'rank' out of 'values'."
    yield "  elicitation:"
    pairs = list(itertools.pairwise(known))
    if len(known) > 2:
        pairs.append((known[0], known[-1]))
    for (one, worst, best), (other, other_worst, other_best) in pairs:
        yield f"    # {one} from {worst} to {best}, against {other} from {other_worst} to {other_best}:"
        yield f"    - {{swing_of: {one}, over: {other}}}"
