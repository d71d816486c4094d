"""Sequential comparison: replication until a decision is statistically clear."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tradeoff.sequential.evidence import SequentialEvidence
    from rgss.tradeoff.sequential.forecasting import MOST_FORECAST, Forecast, forecast
    from rgss.tradeoff.sequential.probability import probability_of_good_selection
    from rgss.tradeoff.sequential.reserve import next_batch_with_reserve
    from rgss.tradeoff.sequential.rule import SequentialRule, check_pilot
    from rgss.tradeoff.sequential.sequential import Decided, Reason, next_batch
    from rgss.tradeoff.sequential.settling import Progress
    from rgss.tradeoff.sequential.support import unsupported_reason
    from rgss.tradeoff.sequential.valueless import ended_without_values, valueless_measures
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
