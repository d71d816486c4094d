"""Registry of the formats of a list of variants: a new one is a function and a line here."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.designs import DesignSpace, DesignVariant


@dataclass(frozen=True, slots=True, kw_only=True)
class VariantFormat:
    """A format of a list of variants.

    Attributes:
        name: Its name in options.
        write: Function from the design space and the listed variants to the pieces of the text.
        is_data: True if the text is the content of a file, which is printed unchanged.
    """

    name: str
    write: Callable[[DesignSpace, Sequence[DesignVariant]], Iterable[str]]
    is_data: bool = False


def variant_format(name: str) -> VariantFormat:
    """The format with a name; raises `KeyError` if there is none."""
    return {one.name: one for one in VARIANT_FORMATS}[name]


def _table(designs: DesignSpace, variants: Sequence[DesignVariant]) -> Iterator[str]:
    from rgss.reports.variants.table import variant_table_lines

    return (f"{line}\n" for line in variant_table_lines(designs, variants))


def _csv(designs: DesignSpace, variants: Sequence[DesignVariant]) -> Iterator[str]:  # noqa: ARG001
    from rgss.designs import variants_csv

    yield variants_csv(variants)


def _json(designs: DesignSpace, variants: Sequence[DesignVariant]) -> Iterator[str]:  # noqa: ARG001
    rows = [{"id": variant.id, "parameters": dict(variant.columns())} for variant in variants]
    yield json.dumps(rows, indent=2, allow_nan=False, ensure_ascii=False) + "\n"


VARIANT_FORMATS: tuple[VariantFormat, ...] = (
    VariantFormat(name="table", write=_table),
    VariantFormat(name="csv", write=_csv, is_data=True),
    VariantFormat(name="json", write=_json),
)
"""All formats, in the order in which they are listed."""
