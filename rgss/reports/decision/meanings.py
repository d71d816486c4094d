"""Explanations of the figures of a decision, for readers who decide and do not compute."""

from __future__ import annotations

WEIGHTS_MEANING = "weights: if people may weigh the measures in any way, how large a part of these ways leads here"
FIRST_MEANING = "first: how often it would be the best if both the weights and the luck of the trials were drawn anew"
CONFIDENCE_MEANING = (
    "confidence: if the weights are those that speak for it, how surely the trials show that it is best"
)
