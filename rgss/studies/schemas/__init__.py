"""Schemas of a project's YAML files: every kind of document, the descriptions of its keys, and the headers of files."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.studies.schemas.document_kinds import DOCUMENT_KINDS, DocumentKind, document_kind, kind_of
    from rgss.studies.schemas.schema_headers import (
        SCHEMAS,
        cannot_write,
        schema_reference,
        with_header,
        write_headers,
        write_schemas,
    )
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
