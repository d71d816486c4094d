"""Variants as tables."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping

from rgss.designs.parameters import format_value
from rgss.designs.variants import DesignVariant

ID_COLUMN = "design_id"


def variant_rows(variants: Iterable[DesignVariant]) -> list[Mapping[str, float | int | str]]:
    """One row for each variant: its id, then its parameters in SI by column."""
    return [{ID_COLUMN: variant.id, **variant.columns()} for variant in variants]


def variants_csv(variants: Iterable[DesignVariant]) -> str:
    """Variants as CSV with a header and line feeds.

    Numbers have the shortest exact form: ``0.3``, ``10``, ``1``.
    """
    rows = variant_rows(variants)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    if rows:
        writer.writerow(rows[0])
    writer.writerows([format_value(value) for value in row.values()] for row in rows)
    return text.getvalue()
