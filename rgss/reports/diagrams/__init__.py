"""Requirement, structure and behaviour diagrams as SVG."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.diagrams.diagrams import diagrams_of, drawings_for_page, missing_diagrams, write_diagrams
    from rgss.reports.diagrams.style import STYLE
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
