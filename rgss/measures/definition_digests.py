"""Digest of the definition of a measure."""

from __future__ import annotations

from typing import Any

from rgss.documents import digest
from rgss.measures.definitions import Constant, InputSymbol, Measure, MeasureSet


def definition_digest(measures: MeasureSet, id: str) -> str:  # noqa: A002 - the domain's word
    """SHA-256 of a measure's definition and of the definitions on which it depends.

    It depends on the expressions, constants, sources of inputs, units, the estimator, and texts of definitions of the
    measure and its dependencies. It does not depend on names, traces, order in the file, or other measures.

    Raises:
        DefinitionError: The measure is unknown.
    """
    measure = measures.measure(id)
    below = measures.used[measure.id]
    return digest(
        {
            "measures": {one.id: _of_measure(one) for one in (measure, *measures.measures) if one.id in {id, *below}},
            "inputs": {one.id: _of_input(one) for one in measures.inputs if one.id in below},
            "constants": {one.id: _of_constant(one) for one in measures.constants if one.id in below},
        }
    )


def _of_measure(measure: Measure) -> dict[str, Any]:
    rule = measure.estimate
    return {
        "definition": _flat(measure.definition),
        "unit": measure.unit,
        "expression": _flat(measure.expression.text),
        "estimate": None if rule is None else [rule.statistic, rule.over, *_bounds(measure)],
        "summary": measure.summary,
        "length": measure.length,
    }


def _bounds(measure: Measure) -> list[float | None]:
    return [] if measure.least is None and measure.most is None else [measure.least, measure.most]


def _of_input(symbol: InputSymbol) -> dict[str, Any]:
    return {
        "definition": _flat(symbol.definition),
        "source": symbol.source,
        "unit": symbol.unit,
        "length": symbol.length,
        **({"of_design": True} if symbol.of_design else {}),
    }


def _of_constant(constant: Constant) -> dict[str, Any]:
    # The unit only affects the display of the value.
    return {"definition": _flat(constant.definition), "value": constant.value}


def _flat(text: str) -> str:
    return " ".join(text.split())
