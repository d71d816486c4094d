"""Registry of the formats of other tools: a new one is a module and a line here."""

from __future__ import annotations

from rgss.errors import DefinitionError
from rgss.exchange.formats.format import ExportFormat
from rgss.exchange.formats.ompl import OMPL
from rgss.exchange.formats.reqif import REQIF
from rgss.exchange.formats.sysml import SYSML
from rgss.exchange.formats.tables import CSV, EXCEL

EXPORT_FORMATS: tuple[ExportFormat, ...] = (REQIF, SYSML, CSV, EXCEL, OMPL)
"""All formats, in the order in which they are listed."""


def export_format(name: str) -> ExportFormat:
    """The format with a name.

    Raises:
        DefinitionError: The name is unknown.
    """
    for one in EXPORT_FORMATS:
        if one.name == name:
            return one
    raise DefinitionError(
        f"unknown format {name!r}", hint=f"choose one of {', '.join(one.name for one in EXPORT_FORMATS)}"
    )
