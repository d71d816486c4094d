"""Sentences on weights that follow from pairwise answers: method, and consistency of the answers."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping

from rgss.tradeoff.elicitation import (
    GREATEST_RATIO,
    Consistency,
    ElicitedWeights,
    FitMethod,
    PairwiseAnswer,
    RatioBeyondBounds,
    Triad,
)

DIGEST_SHOWN = 12
"""Digits of a digest on pages; the JSON document has all."""


def elicitation_sentences(elicited: Iterable[ElicitedWeights], by: Mapping[str, ElicitedWeights]) -> Iterator[str]:
    """Sentences on the answers that weights follow from, with their digests.

    Args:
        elicited: The groups of the study.
        by: Those of its stakeholders, by name.
    """
    for whose, one in [*(("", one) for one in elicited), *((f" of {name}", one) for name, one in by.items())]:
        yield (
            f"Weights{whose} of {', '.join(one.weights)}: from {answers_phrase(one)}, SHA-256 "
            f"{one.digest[:DIGEST_SHOWN]}…; {verdict_phrase(one)}."
        )


def answers_phrase(one: ElicitedWeights) -> str:
    """The number of answers in words."""
    return f"{len(one.answers)} pairwise answer{'' if len(one.answers) == 1 else 's'}"


def verdict_phrase(one: ElicitedWeights) -> str:
    """Phrase on the agreement of the answers."""
    consistency = one.consistency
    if consistency is None:
        return "the answers are orders and ranges, which agree"
    if consistency.is_acceptable is None:
        return "no ratio checks another" + ("; the orders and ranges agree with them" if consistency.bounds else "")
    return f"the answers are {'consistent enough' if consistency.is_acceptable else 'too inconsistent'}"


def method_sentence(one: ElicitedWeights) -> str:
    """Sentence on the method that gave the weights."""
    if one.method is FitMethod.LEAST_SQUARES:
        bounds = ", within the orders and ranges" if one.bounds else ""
        return f"Least squares of the logarithms of the ratios{bounds}; the worst ratio is missed by ×{one.factor:.3g}."
    missed = "" if one.factor <= 1.0 + 1e-9 else f", each ratio within ×{one.factor:.3g}"
    return f"Centre of all weights that agree with the answers{missed}."


def consistency_sentences(found: Consistency) -> Iterator[str]:
    """The indices with their limits, the worst triad and the worst answer with their corrections."""
    if found.is_contradicted:
        yield (
            f"The orders and ranges contradict the ratios: the worst is missed by ×{found.bound_factor:.3g} because of "
            f"them, limit ×{found.greatest_bound_factor:.3g}."
        )
        for one in found.beyond_bounds:
            yield f"{one.answer.words}, while orders and ranges allow {_allowed(one)}."
    if found.index is None:
        ratios = f"{found.answers} ratio{'s' if found.answers > 1 else ''}"
        yield (
            f"No ratio checks another: {ratios} for {found.criteria} criteria. Answer one more, between two that are "
            "compared with a third."
        )
        return
    yield (
        f"Geometric consistency index {found.index:.3f}, limit {found.index_limit:.3f} (Aguarón and Moreno-Jiménez "
        f"2003); {found.checks} answer{'s check' if found.checks > 1 else ' checks'} the others."
    )
    if found.ratio is not None:
        yield f"Consistency ratio {found.ratio:.3f}, limit {GREATEST_RATIO:g} (Saaty 1980)."
    if found.worst_triad is not None and found.worst_triad.factor > 1.0 + 1e-9:
        yield _triad(found.worst_triad)
    worst = found.worst_answer
    if worst is not None and worst.factor > 1.0 + 1e-9:
        implied = "" if worst.implied is None else f"; the other answers imply {_pair(worst.answer, worst.implied)}"
        yield f"The answer that fits least: {worst.answer.words}, while the weights say {worst.fitted:.3g}{implied}."


def _allowed(one: RatioBeyondBounds) -> str:
    if one.least == 0.0:
        return f"at most {one.most:.3g}"
    return f"at least {one.least:.3g}" if math.isinf(one.most) else f"{one.least:.3g} to {one.most:.3g}"


def _triad(triad: Triad) -> str:
    answers = ", ".join(answer.words for answer in triad.answers)
    mends = " or ".join(_pair(answer, ratio) for answer, ratio in zip(triad.answers, triad.mends, strict=True))
    return f"The worst triad, off by ×{triad.factor:.3g}: {answers}. Any one of these would correct it: {mends}."


def _pair(answer: PairwiseAnswer, ratio: float) -> str:
    return f"{answer.swing_of} = {ratio:.3g} × {answer.over}"
