"""Robustness of a decision: Pareto sets, acceptability, effects, costs and rank reversal."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tradeoff.robustness.acceptability import Acceptability, Outcomes, smaa2
    from rgss.tradeoff.robustness.assumption_sensitivity import AssumptionRange, Standing, linear_range, scanned_range
    from rgss.tradeoff.robustness.complete_block import largest_complete_block
    from rgss.tradeoff.robustness.cost_box import BoxProblem, BoxRange, box_range
    from rgss.tradeoff.robustness.effects import LEAST_USED, Effect, FactorialAnalysis, factorial_effects
    from rgss.tradeoff.robustness.flip import WeightRange, WeightShift, weight_ranges, weight_shifts
    from rgss.tradeoff.robustness.heavy_tails import ENOUGH_REPLICATES
    from rgss.tradeoff.robustness.kept_alternatives import KeptAlternative, KeptFor, worth_keeping
    from rgss.tradeoff.robustness.outcomes import admitted_weights, common_replicates, condition_masks, noisy_outcomes
    from rgss.tradeoff.robustness.overlap import Overlap, SharedPart, overlapping_measures, shared_parts
    from rgss.tradeoff.robustness.pareto import ParetoFront, Support, pareto_front
    from rgss.tradeoff.robustness.posterior_outcomes import DRAWS, PosteriorOutcomes, good_selection
    from rgss.tradeoff.robustness.prices import PriceStep, changes_of_best, price_list, step_at
    from rgss.tradeoff.robustness.rank_reversal import RankReversal, rank_reversals, sample_anchored
    from rgss.tradeoff.robustness.replication_gain import replication_gains
    from rgss.tradeoff.robustness.sampled_effects import (
        FEWEST_DESIGNS,
        SampledIndex,
        first_order_indices,
        level_terms,
        range_terms,
    )
    from rgss.tradeoff.robustness.stakeholders import StakeholderAgreement, StakeholderView, stakeholder_agreement
    from rgss.tradeoff.robustness.uncertainty import (
        FEWEST_AT_THRESHOLD,
        TIE_PROBABILITY,
        ChoiceUncertainty,
        Rival,
        choice_uncertainty,
    )
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
