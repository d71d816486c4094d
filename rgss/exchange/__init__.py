"""Formats of other tools."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.exchange.absent_links import with_absent_links
    from rgss.exchange.applying import FileChange, planned, rehearsed, written
    from rgss.exchange.attributes import Part
    from rgss.exchange.comparison import ChangeKind, ElementChange, ImportDefaults, compare, not_as_planned
    from rgss.exchange.content import Content, content_of, part_of
    from rgss.exchange.foreign_measures import with_measures_compared
    from rgss.exchange.foreign_names import ATTRIBUTE_NAMES, RELATION_MEANINGS, ForeignNames, with_values_mapped
    from rgss.exchange.journal import contents_of, has_journal, importing, undone, was_interrupted
    from rgss.exchange.mapping_file import (
        DEFAULT_NAMES,
        MAPPING_KIND,
        NamesAndDefaults,
        read_mapping,
        unknown_attribute_hint,
        unknown_meaning_hint,
    )
    from rgss.exchange.verification_records import record_cells, with_records_compared
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
