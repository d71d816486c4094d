"""Results of the regression guard as files and terminal text."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.regression.files import report_to_json, report_to_junit, report_to_markdown
    from rgss.reports.regression.terminal import report_lines
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
