"""Design variants as a table, as CSV and as JSON."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.variants.formats import VARIANT_FORMATS, variant_format
    from rgss.reports.variants.table import variant_table_lines
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
