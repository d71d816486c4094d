"""Strict YAML to typed models, with every problem of a file reported at its line and column."""

from rgss.documents.fields import (
    Dimensionless,
    Dollars,
    Hertz,
    Identifier,
    Kilograms,
    Metres,
    MetresPerSecond,
    MetresPerSecondSquared,
    NewtonMetres,
    Newtons,
    QuantityText,
    Radians,
    RadiansPerSecond,
    RadiansPerSecondSquared,
    Seconds,
    Text,
    UnitText,
)
from rgss.documents.json_schema import described_keys, json_schema
from rgss.documents.model import DocumentModel
from rgss.documents.reader import Document, read_document
from rgss.documents.validation import LoadedDocument, load_document

__all__ = [
    "Dimensionless",
    "Document",
    "DocumentModel",
    "Dollars",
    "Hertz",
    "Identifier",
    "Kilograms",
    "LoadedDocument",
    "Metres",
    "MetresPerSecond",
    "MetresPerSecondSquared",
    "NewtonMetres",
    "Newtons",
    "QuantityText",
    "Radians",
    "RadiansPerSecond",
    "RadiansPerSecondSquared",
    "Seconds",
    "Text",
    "UnitText",
    "described_keys",
    "json_schema",
    "load_document",
    "read_document",
]
