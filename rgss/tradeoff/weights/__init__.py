"""Sets of weights: polytopes, regions of a winner, and sampling."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tradeoff.weights.centroids import centroid
    from rgss.tradeoff.weights.polytope import THINNEST, Polytope
    from rgss.tradeoff.weights.sampling import Drawing, sample_weights
    from rgss.tradeoff.weights.weight_region import (
        WeightRegion,
        of_each_region,
        winning_polytope,
        winning_regions,
    )
    from rgss.tradeoff.weights.weight_set import WeightSet
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
