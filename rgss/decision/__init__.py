"""The decision of a study: choice, portfolios, screening, and replication until decided."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.decision.choosing import choose, trade_problem, unweighted_measures
    from rgss.decision.named_trials import NamingStudy, asked_of, asked_trials, naming_studies
    from rgss.decision.portfolios import choose_portfolio, measured_studies
    from rgss.decision.replication_check import replication_findings
    from rgss.decision.screening import (
        measure_survivors,
        reopened,
        screen,
        screening_specs,
    )
    from rgss.decision.screening_result import ScreenedVariant, ScreeningResult, screening_summary
    from rgss.decision.staged_sweep import promoted_by_screening, sweep_in_stages
    from rgss.decision.tracing import trace_evidence
    from rgss.decision.until_decided import UntilDecided, replicate_until_decided, trial_twins
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
