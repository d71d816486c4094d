"""Renderers of a confirmation: text, Markdown and JSON."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.confirmation.document import confirmation_to_json
    from rgss.reports.confirmation.text import confirmation_lines, confirmation_to_markdown
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
