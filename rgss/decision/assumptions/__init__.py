"""Modelling assumptions of a study: the choice under each alternative."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.decision.assumptions.outcomes import AssumptionOutcome, assumption_outcomes, missing_trials
    from rgss.decision.assumptions.place_findings import assumption_findings
    from rgss.decision.assumptions.questions import questions_of
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
