"""Rules of the static check: wording, coverage, criteria, links, reviews and evidence."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trace.rules.explaining import rule_as_json, rule_lines, rules_markdown
    from rgss.trace.rules.registry import FAMILIES, RULES, check_trace, rule_of
    from rgss.trace.rules.review_stamps import expanded, stamped, write_reviews
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
