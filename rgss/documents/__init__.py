"""Strict YAML reader with typed models; every problem of a file is reported with line and column."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.documents.digests import canonical_json, digest
    from rgss.documents.editing import AppendEntry, Edit, RemoveEntry, RemoveKey, SetKey, edited
    from rgss.documents.fields import (
        IDENTIFIER_PATTERN,
        Dimensionless,
        Hertz,
        Identifier,
        JointAcceleration,
        JointEffort,
        JointPosition,
        JointQuantity,
        JointSpeed,
        Kilograms,
        KilogramsPerCubicMetre,
        KilogramSquareMetres,
        Metres,
        MetresPerSecond,
        MetresPerSecondSquared,
        Newtons,
        NewtonSecondsPerMetre,
        NewtonsPerMetre,
        QuantityText,
        Radians,
        RadiansPerSecond,
        RadiansPerSecondSquared,
        ReadFrom,
        Seconds,
        Text,
        UnitText,
        number_as_text,
    )
    from rgss.documents.model import STRICT, DocumentModel
    from rgss.documents.output_files import (
        is_disk_failure,
        is_standard_output,
        remove_abandoned_parts,
        replaced_file,
        require_no_source,
        unwritable,
        why_not_writable,
        write_output,
    )
    from rgss.documents.project_files import FilePlace, content_digest, place_of
    from rgss.documents.project_sources import DATA_FOLDERS
    from rgss.documents.reader import LARGEST_FILE_BYTES, Document, read_document
    from rgss.documents.refusals import MOST_PROBLEMS, cut_short
    from rgss.documents.regular_file import chunks_of, open_regular
    from rgss.documents.running_processes import is_running
    from rgss.documents.schemas import json_schema
    from rgss.documents.small_sources import write_small_source
    from rgss.documents.spreadsheet_cells import (
        LONGEST_EXCEL_TEXT,
        neutralised,
        printable,
        restored,
        starts_like_a_formula,
        without_clock,
    )
    from rgss.documents.steering import escaped_for_json, escaped_for_xml, has_control_characters
    from rgss.documents.validation import LoadedDocument, load_document, typed_document, validated
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
