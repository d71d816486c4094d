"""Contents of the study's report, section by section."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.study.column_entries import entry_at, entry_text
    from rgss.reports.study.compared_variants import compared_trials, comparison_rows
    from rgss.reports.study.document import report_document
    from rgss.reports.study.first_screen import first_screen_content, worst_failure_in_words
    from rgss.reports.study.page_data import data_address, embedded_json, packed_json, parted
    from rgss.reports.study.planners_compared import PLANNERS_NOTE, planner_comparison, planner_data, planner_table
    from rgss.reports.study.trials import NotableTrial, notable_trials
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
