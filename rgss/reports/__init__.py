"""Pure renderers of evidence and decisions."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.board_page import board_to_html
    from rgss.reports.failure_drivers import case_lines, cases_to_json, driver_lines, drivers_to_json
    from rgss.reports.plain_text import TableLine, TextTable, aligned_table
    from rgss.reports.response_plots import write_response_plot
    from rgss.reports.study_page import TrialPictures, study_report_to_html
    from rgss.reports.workspace import draw_workspace
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
