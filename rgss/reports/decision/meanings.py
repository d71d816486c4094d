"""Explanations of the figures of a decision in plain words."""

from __future__ import annotations

_WEIGHTS = "weights: if people may weigh the measures in any way, how large a part of these ways leads here"
_FIRST = "first: how often it would be the best if both the weights and the noise of the trials were drawn again"
_FIRST_WITHOUT_NOISE = "first: how often it would be the best if the weights were drawn again"
_CONFIDENCE = "confidence: with the weights that are typical for it, the probability that it is best"


def meanings(*, with_noise: bool) -> tuple[str, ...]:
    """Explanations of `weights`, `first` and, where the noise is known, `confidence`.

    Args:
        with_noise: Whether draws of `first` include the noise of the trials.
    """
    return (_WEIGHTS, _FIRST, _CONFIDENCE) if with_noise else (_WEIGHTS, _FIRST_WITHOUT_NOISE)
