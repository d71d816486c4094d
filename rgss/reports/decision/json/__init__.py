"""Decision of a study as plain values for JSON."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.decision.json.decision import certificate_to_json, decision_to_json
    from rgss.reports.decision.json.document import portfolio_to_json, trade_document
    from rgss.reports.decision.json.elicitation import elicitation_to_json
    from rgss.reports.decision.json.robustness import assumptions_to_json, costs_to_json
    from rgss.reports.decision.json.screening import screening_to_json
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
