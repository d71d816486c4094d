"""Measures as SysML v2 calculations: the parametric model."""

from __future__ import annotations

from collections.abc import Mapping

from rgss.exchange.sysml.notation import body, declared, documentation, name, real
from rgss.measures import (
    FIRST_KNOWN,
    Binary,
    Call,
    Measure,
    MeasureSet,
    Name,
    Negative,
    Node,
    Number,
    Power,
    replaceable_symbols,
)

MEASURES = "Measures"

_ENTRY_BY_ENTRY = ("abs", "sqrt")


def calculations(measures: MeasureSet) -> list[str]:
    """Constants as attributes, measures as calculations from them, from inputs and from each other.

    A calculation takes the symbols of its expression as parameters, in SI; a row is a parameter
    with as many values as the row has entries. Units are in the documentation, since some of them
    (money) are not in the library.
    """
    lengths: dict[str, int | None] = {symbol.id: symbol.length for symbol in measures.inputs}
    lengths |= {measure.id: measure.length for measure in measures.measures}
    units = {symbol.id: symbol.unit for symbol in measures.inputs}
    units |= {measure.id: measure.unit for measure in measures.measures}
    constants = {constant.id for constant in measures.constants}
    lines: list[str] = []
    for constant in measures.constants:
        text = [documentation(f"{constant.definition} {_unit(constant.unit)}")]
        lines += body(f"attribute {name(constant.id)} : Real = {real(constant.value)}", text)
    for measure in measures.measures:
        lines += _calculation(measure, lengths, units, constants)
    return lines


def _calculation(
    measure: Measure, lengths: Mapping[str, int | None], units: Mapping[str, str], constants: set[str]
) -> list[str]:
    equation = f" Equation {measure.equation}." if measure.equation else ""
    text = f"{measure.kind.value.upper()}: {measure.definition} Given in {measure.unit}.{equation}"
    inner = [documentation(text)]
    replaceable = replaceable_symbols(measure.expression)
    for symbol in measure.expression.names:
        if symbol not in constants:
            may_lack = "[0..1]" if symbol in replaceable else ""
            count = f"[{lengths[symbol]}] ordered nonunique" if lengths.get(symbol) else may_lack
            inner += body(f"in {name(symbol)} : Real{count}", [documentation(_unit(units[symbol]))])
    rows = {symbol: length for symbol, length in lengths.items() if length}
    length = _length(measure.expression.root, rows)
    result = _written(measure.expression.root, rows, {})
    count = f"[{length}] ordered nonunique" if length else ""
    inner.append(f"return {name('result')} : Real{count} = {result};")
    return body(declared("calc def", measure.id, measure.name), inner)


def _unit(unit: str) -> str:
    return "Dimensionless." if unit == "1" else f"In the SI unit of {unit}."


def _length(node: Node, rows: Mapping[str, int]) -> int | None:
    """Number of entries of a node; None for one number."""
    return next((rows[symbol] for symbol in _rows(node, rows)), None)


def _rows(node: Node, rows: Mapping[str, int]) -> tuple[str, ...]:
    """The symbols of rows in a node that are evaluated entry by entry, each once."""
    if isinstance(node, Name):
        return (node.id,) if node.id in rows else ()
    if isinstance(node, Negative):
        return _rows(node.operand, rows)
    if isinstance(node, Binary):
        return tuple(dict.fromkeys((*_rows(node.left, rows), *_rows(node.right, rows))))
    if isinstance(node, Power):
        return _rows(node.base, rows)
    if isinstance(node, Call) and node.function in _ENTRY_BY_ENTRY:
        return _rows(node.arguments[0], rows)
    return ()


def _written(node: Node, rows: Mapping[str, int], entries: Mapping[str, str]) -> str:
    """A node in the expression language.

    Args:
        node: The node.
        rows: Number of entries of each row.
        entries: The expression of an entry of each row, within a row that is computed entry by entry.
    """
    length = _length(node, rows)
    if length and not entries and not isinstance(node, Name):
        inner = _rows(node, rows)
        if len(inner) == 1:
            return f"{name(inner[0])}->collect {{in x : Real; {_written(node, rows, {inner[0]: 'x'})}}}"
        indexed = {symbol: f"{name(symbol)}#(i)" for symbol in inner}
        return f"(1..{length})->collect {{in i : Natural; {_written(node, rows, indexed)}}}"
    if isinstance(node, Number):
        return real(node.value)
    if isinstance(node, Name):
        return entries.get(node.id, name(node.id))
    if isinstance(node, Negative):
        return f"(-{_written(node.operand, rows, entries)})"
    if isinstance(node, Binary):
        left, right = (_written(side, rows, entries) for side in (node.left, node.right))
        return f"({left} {node.symbol} {right})"
    if isinstance(node, Power):
        return f"({_written(node.base, rows, entries)} ^ {real(node.exponent)})"
    return _call(node, rows, entries)


def _call(node: Call, rows: Mapping[str, int], entries: Mapping[str, str]) -> str:
    if node.function in _ENTRY_BY_ENTRY:
        return f"{node.function}({_written(node.arguments[0], rows, entries)})"
    if node.function in ("min", "max") and len(node.arguments) > 1:
        *others, last = (_written(argument, rows, entries) for argument in node.arguments)
        for other in reversed(others):
            last = f"{node.function}({other}, {last})"
        return last
    if node.function == FIRST_KNOWN:
        return f"({' ?? '.join(_written(argument, rows, entries) for argument in node.arguments)})"
    # A reduction is one number, also within a row that is computed entry by entry.
    row = _written(node.arguments[0], rows, {})
    return {
        "min": f"{row}->minimize {{in x : Real; x}}",
        "max": f"{row}->maximize {{in x : Real; x}}",
        "sum": f"sum({row})",
        "count": f"size({row})",
        "mean": f"(sum({row}) / size({row}))",
        "norm": f"sqrt(sum({row}->collect {{in x : Real; x * x}}))",
    }[node.function]
