"""Elicitation of weights from pairwise answers on swings, with the inconsistency of the answers."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tradeoff.elicitation.answers import PairwiseAnswer
    from rgss.tradeoff.elicitation.consistency import GREATEST_RATIO, Consistency, RatioBeyondBounds, Triad
    from rgss.tradeoff.elicitation.contradictions import contradiction_of
    from rgss.tradeoff.elicitation.elicited_weights import ElicitedWeights, FitMethod
    from rgss.tradeoff.elicitation.fitting import weights_from_answers
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
