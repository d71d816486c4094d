"""The regression guard of a study: metrics and decision compared with a baseline."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.guard.baseline_making import baseline_name, make_baseline
    from rgss.guard.comparing import compare_with_baseline
    from rgss.guard.designs import guard_findings
    from rgss.guard.runs import guard_of
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
