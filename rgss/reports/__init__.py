"""Pure renderers of evidence and decisions."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.failure_drivers import driver_lines, drivers_to_json
    from rgss.reports.plain_text import aligned_table
    from rgss.reports.study_page import TrialPictures, study_report_to_html
    from rgss.reports.workspace import draw_workspace
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)

__all__ = [
    "TrialPictures",
    "aligned_table",
    "draw_workspace",
    "driver_lines",
    "drivers_to_json",
    "study_report_to_html",
]
