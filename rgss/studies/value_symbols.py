"""Symbols of value properties: each names a constant, an input or a measure of the same dimension."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Finding
from rgss.measures import MeasureSet
from rgss.quantities import same_dimension
from rgss.requirements import RequirementSet, nearest


def symbol_findings(requirements: RequirementSet, measures: MeasureSet) -> Iterator[Finding]:
    """Findings on the symbols that blocks' values name.

    Args:
        requirements: The requirements with the architecture.
        measures: The measures of the same project.
    """
    units = {one.id: one.unit for one in measures.constants}
    units |= {one.id: one.unit for one in measures.inputs}
    units |= {one.id: one.unit for one in measures.measures}
    for block in requirements.architecture.blocks:
        place = requirements.places[block.id]
        for index, value in enumerate(block.values):
            at = (*place.location, "values", index)
            if value.symbol is None:
                continue
            if value.symbol not in units:
                message = f"symbol: {value.symbol!r} is not a constant, an input or a measure"
                hint = nearest(value.symbol, units)
                yield place.document.finding("requirements.symbol", message, (*at, "symbol"), hint=hint)
            elif not same_dimension(value.unit, units[value.symbol]):
                message = f"unit: {value.id!r} is in {value.unit!r}, but {value.symbol!r} is in {units[value.symbol]!r}"
                yield place.document.finding("requirements.symbol", message, (*at, "unit"), hint="make them agree")
