"""Decision of a study as lines for a terminal."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.decision.text.decision import certificate_lines, portfolio_lines
    from rgss.reports.decision.text.effects import effects_lines, usable_resamples_sentence
    from rgss.reports.decision.text.page import decision_lines
    from rgss.reports.decision.text.robustness import robustness_lines
    from rgss.reports.decision.text.screening import screening_lines
    from rgss.reports.decision.text.weighing import question_lines, weighing_lines
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
