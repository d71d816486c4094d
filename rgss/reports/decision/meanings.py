"""Explanations of the figures of a decision in plain words."""

from __future__ import annotations

WEIGHTS_MEANING = "weights: if people may weigh the measures in any way, how large a part of these ways leads here"
FIRST_MEANING = "first: how often it would be the best if both the weights and the noise of the trials were drawn again"
CONFIDENCE_MEANING = "confidence: with the weights that are typical for it, the probability that it is best"
