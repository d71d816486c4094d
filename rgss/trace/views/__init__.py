"""Views of the trace graph: chains, impact, matrices and metrics."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trace.views.chain import Chain, ChainStep, chain_of
    from rgss.trace.views.figures import (
        end_in_words,
        estimate_in_words,
        record_in_words,
        rounded_away,
        share_in_words,
        value_in_words,
        verdict_in_words,
    )
    from rgss.trace.views.impact import Impact, impact_of
    from rgss.trace.views.matrices import (
        TraceMatrix,
        matrix_of,
        stakeholder_by_effectiveness,
        system_by_architecture,
        system_by_stakeholder,
    )
    from rgss.trace.views.metrics import CoverageMetric, coverage_metrics, trace_matrices
    from rgss.trace.views.neighbours import ThingKind
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
