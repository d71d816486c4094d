"""The decision as text, Markdown and JSON for ``rgss trade``."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.cli.trade.decision import (
        print_cautions,
        print_certificate,
        print_decision,
        print_heading,
        print_portfolio,
    )
    from rgss.cli.trade.effects import print_effects
    from rgss.cli.trade.json_document import trade_document
    from rgss.cli.trade.markdown import decision_section, text_with_place, with_section
    from rgss.cli.trade.robustness import print_robustness
    from rgss.cli.trade.what_if import print_what_if
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)

__all__ = [
    "decision_section",
    "print_cautions",
    "print_certificate",
    "print_decision",
    "print_effects",
    "print_heading",
    "print_portfolio",
    "print_robustness",
    "print_what_if",
    "text_with_place",
    "trade_document",
    "with_section",
]
