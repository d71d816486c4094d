"""Report of a running sweep: its JSON document, and the page that shows it."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.live.page import live_page_to_html
    from rgss.reports.live.study_document import live_study_document
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
