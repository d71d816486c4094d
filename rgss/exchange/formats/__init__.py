"""Formats of ``rgss export``, one module each, and their registry."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.exchange.formats.registry import EXPORT_FORMATS, export_format
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
