"""Loader of measures files, and builder of a consistent set of measures from their entries."""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from rgss.documents import Document, LoadedDocument, read_document, typed_document
from rgss.errors import DocumentError, QuantityError
from rgss.findings import Finding
from rgss.measures.consistency import check_entries, check_roles
from rgss.measures.definitions import (
    Constant,
    Measure,
    MeasureSet,
)
from rgss.measures.dependencies import evaluation_order, transitive_use
from rgss.measures.dimensions import PURE, Kind, kind_of, si_unit
from rgss.measures.document import ConstantEntry, MeasureEntry, MeasuresDocument
from rgss.measures.estimators import Estimator
from rgss.measures.expressions import Binary, Expression, ExpressionProblem
from rgss.measures.parsing import parse_expression
from rgss.measures.ratios import QUOTIENT
from rgss.measures.readings import with_readings
from rgss.quantities import conversion_factor, dimension, parse_quantity

_SETS_KEPT = 16
_UNITS_KEPT = 512

Bounds = tuple["float | None", "float | None"]


def load_measures(path: Path, *, label: str | None = None) -> MeasureSet:
    """Read a measures file.

    Args:
        path: The file, such as ``requirements/measures.yaml``.
        label: Its name in messages; the path itself by default.

    Raises:
        DocumentError: The file is not a consistent set of measures; with every problem in it.
    """
    return _measures_of(read_document(path, label=label))


@lru_cache(maxsize=_SETS_KEPT)
def _measures_of(document: Document) -> MeasureSet:
    """Measures of a document; the studies of one project share them, and a verb may read several."""
    loaded = typed_document(document, MeasuresDocument)
    lines = document.text.splitlines()
    built = _Builder(loaded, lines).build()
    if isinstance(built, MeasureSet):
        built = with_readings(built, loaded, lambda other: _Builder(other, lines).findings_of_definitions())
    if isinstance(built, MeasureSet):
        return built
    raise DocumentError(sorted(built))


class _Builder:
    def __init__(self, loaded: LoadedDocument[MeasuresDocument], lines: Sequence[str]) -> None:
        self._loaded = loaded
        self._document = loaded.document
        self._entries = loaded.value
        self._lines = lines
        self._indices: dict[str, int] = {}
        for index, entry in enumerate(loaded.value.measures):
            self._indices.setdefault(entry.id, index)
        self._findings: list[Finding] = []

    def build(self) -> MeasureSet | list[Finding]:
        """The set of measures, or every problem of the entries."""
        self._findings += check_entries(self._loaded)
        make = self._checked()
        return self._findings or make()

    def findings_of_definitions(self) -> list[Finding]:
        """Problems of expressions, units and estimates, all that another definition of a measure can cause."""
        self._checked()
        return self._findings

    def _checked(self) -> Callable[[], MeasureSet]:
        """Collect the problems of the entries; what is returned makes the set of measures if there are none."""
        entries = self._entries
        values = [self._constant_value(index) for index in range(len(entries.constants))]
        expressions = self._expressions()
        self._check_symbols(expressions)
        order, used = self._order(expressions)
        lengths = self._check_kinds(expressions, order)
        bounds = {name: self._bounds(index) for name, index in self._indices.items()}
        self._findings += check_roles(self._document, entries, used, self._by_trial(order, used), lengths)

        def make() -> MeasureSet:
            measures = {
                name: _measure(entries.measures[self._indices[name]], expressions[name], lengths[name], bounds[name])
                for name in order
            }
            return MeasureSet(
                constants=tuple(map(_constant, entries.constants, values)),
                inputs=entries.inputs,
                assumptions=entries.assumptions,
                equations=entries.equations,
                measures=tuple(measures[entry.id] for entry in entries.measures),
                evaluation_order=tuple(measures[name] for name in order),
                used=used,
            )

        return make

    def _order(self, expressions: dict[str, Expression]) -> tuple[tuple[str, ...], Mapping[str, frozenset[str]]]:
        uses = {name: [other for other in one.names if other in expressions] for name, one in expressions.items()}
        order, cycles = evaluation_order(uses)
        for cycle in cycles:
            message = f"measures must not depend on each other in a cycle: {' → '.join(cycle)}"
            self._report(cycle[0], "measures.cycle", message, hint="remove one of these dependencies")
        return order, transitive_use({name: one.names for name, one in expressions.items()}, order)

    def _by_trial(self, order: Sequence[str], used: Mapping[str, frozenset[str]]) -> dict[str, bool]:
        """Whether each measure varies from trial to trial, where that is known."""
        inputs = {entry.id: entry.source.startswith("trial.") for entry in self._entries.inputs}
        from_trials = {name for name, is_from_trials in inputs.items() if is_from_trials}
        sound = {*inputs, *order, *(entry.id for entry in self._entries.constants)}
        return {
            name: not used[name].isdisjoint(from_trials)
            for name in order
            if not used[name].isdisjoint(from_trials) or used[name] <= sound
        }

    def _constant_value(self, index: int) -> float:
        entry = self._entries.constants[index]
        location = ("constants", index, "value")
        try:
            value = parse_quantity(entry.value, entry.unit) * _si_per_unit(entry.unit)
        except QuantityError as error:
            self._findings.append(self._document.finding("measures.unit", error.message, location, hint=error.hint))
            return math.nan
        if not math.isfinite(value):
            self._findings.append(self._document.finding("measures.unit", "the number is too large", location))
        return value

    def _bounds(self, index: int) -> Bounds:
        """Declared bounds of a measure's trial values, in its unit."""
        entry = self._entries.measures[index]
        rule = entry.estimate
        if rule is None:
            return None, None
        found: list[float | None] = []
        for key, text in (("least", rule.least), ("most", rule.most)):
            location = ("measures", index, "estimate", key)
            if text is not None and rule.statistic is Estimator.PROPORTION:
                self._refuse_bound(location, "a proportion is always between 0 and 1", "remove the bound")
                return None, None
            try:
                found.append(None if text is None else parse_quantity(text, entry.unit))
            except QuantityError as error:
                self._refuse_bound(location, error.message, error.hint)
                found.append(None)
        least, most = found
        if least is not None and most is not None and least >= most:
            message = f"'least' must be below 'most', got {least:g} and {most:g} {entry.unit}"
            self._refuse_bound(("measures", index, "estimate", "least"), message, "correct the bounds")
        return least, most

    def _refuse_bound(self, location: tuple[str | int, ...], message: str, hint: str) -> None:
        self._findings.append(self._document.finding("measures.estimate", message, location, hint=hint))

    def _expressions(self) -> dict[str, Expression]:
        expressions: dict[str, Expression] = {}
        for name, index in self._indices.items():
            parsed = parse_expression(self._entries.measures[index].expression)
            if isinstance(parsed, Expression):
                expressions[name] = parsed
            else:
                self._report_all(name, parsed)
        return expressions

    def _check_symbols(self, expressions: dict[str, Expression]) -> None:
        constants, inputs = self._entries.constants, self._entries.inputs
        known = {*self._indices, *(entry.id for entry in constants), *(entry.id for entry in inputs)}
        for name, expression in expressions.items():
            for symbol, offset in expression.names.items():
                if symbol not in known:
                    near = difflib.get_close_matches(symbol, sorted(known), n=1)
                    hint = f"did you mean {near[0]!r}?" if near else "define it as a constant, an input or a measure"
                    message = f"unknown symbol {symbol!r}"
                    self._report(name, "measures.unknown-symbol", message, offset=offset, hint=hint)

    def _check_kinds(self, expressions: dict[str, Expression], order: tuple[str, ...]) -> dict[str, int | None]:
        """Check every unit; returns the number of entries of each measure, if known."""
        kinds: dict[str, Kind | None] = {}
        for constant in self._entries.constants:
            kinds[constant.id] = Kind(dimension=dimension(constant.unit))
        for index, symbol in enumerate(self._entries.inputs):
            kinds[symbol.id] = Kind(dimension=dimension(symbol.unit), length=symbol.length)
            self._check_unit(("inputs", index, "unit"), symbol.unit)
            if symbol.of_design and not symbol.from_trial:
                message = f"{symbol.source} is a design value already; 'of_design' is for values computed by trials"
                at = ("inputs", index, "of_design")
                found = self._document.finding("measures.estimate", message, at, hint="remove 'of_design'")
                self._findings.append(found)
        lengths: dict[str, int | None] = {}
        for name in order:
            entry = self._entries.measures[self._indices[name]]
            self._check_unit(("measures", self._indices[name], "unit"), entry.unit)
            kind, problems = kind_of(expressions[name], kinds)
            self._report_all(name, problems)
            if kind is None:
                continue
            declared = dimension(entry.unit)
            if kind.dimension != declared:
                message = f"the expression gives {si_unit(kind.dimension)}, the measure's unit is {entry.unit}"
                self._report(name, "measures.unit", message, hint="correct the expression or the unit")
            # Dependent measures are checked with the declared kind.
            kinds[name] = Kind(dimension=declared, length=kind.length)
            lengths[name] = kind.length
            proportion = entry.estimate is not None and entry.estimate.statistic is Estimator.PROPORTION
            if proportion and (declared != PURE or entry.unit != "1" or kind.length is not None):
                location = ("measures", self._indices[name], "estimate", "statistic")
                message = 'a proportion needs a single number in unit "1"'
                self._findings.append(self._document.finding("measures.estimate", message, location))
            self._check_ratio(entry, expressions[name], kind.length)
        return lengths

    def _check_ratio(self, entry: MeasureEntry, expression: Expression, length: int | None) -> None:
        root = expression.root
        if entry.estimate is None or entry.estimate.statistic is not Estimator.RATIO:
            return
        if length is not None or not isinstance(root, Binary) or root.symbol != QUOTIENT:
            location = ("measures", self._indices[entry.id], "estimate", "statistic")
            message = "a ratio needs an expression that is a quotient of two numbers"
            hint = "write 'numerator / denominator', with parentheses around a sum or a product"
            self._findings.append(self._document.finding("measures.estimate", message, location, hint=hint))

    def _check_unit(self, location: tuple[str | int, ...], unit: str) -> None:
        try:
            _si_per_unit(unit)
        except QuantityError as error:
            self._findings.append(self._document.finding("measures.unit", error.message, location, hint=error.hint))

    def _report_all(self, name: str, problems: Sequence[ExpressionProblem]) -> None:
        for problem in problems:
            self._report(name, problem.rule, problem.message, offset=problem.offset, hint=problem.hint)

    def _report(self, name: str, rule: str, message: str, *, offset: int | None = None, hint: str = "") -> None:
        location = ("measures", self._indices[name], "expression")
        finding = self._document.finding(rule, message, location, hint=hint)
        if offset is not None:
            expression = self._entries.measures[self._indices[name]].expression
            finding = replace(finding, column=self._column(finding, expression, offset))
        self._findings.append(finding)

    def _column(self, finding: Finding, expression: str, offset: int) -> int:
        """Column of a character of an expression; the first column if the expression is folded over lines."""
        written = self._lines[finding.line - 1][finding.column - 1 :]
        if written.startswith(expression):
            return finding.column + offset
        return finding.column + 1 + offset if written[1:].startswith(expression) else finding.column


def _constant(entry: ConstantEntry, value: float) -> Constant:
    return Constant(id=entry.id, value=value, unit=entry.unit, definition=entry.definition, source=entry.source or "")


def _measure(entry: MeasureEntry, expression: Expression, length: int | None, bounds: Bounds) -> Measure:
    return Measure(
        id=entry.id,
        kind=entry.kind,
        name=entry.name,
        definition=entry.definition,
        unit=entry.unit,
        si_per_unit=_si_per_unit(entry.unit),
        expression=expression,
        equation=entry.equation,
        better=entry.better,
        traces=entry.traces,
        contributes_to=entry.contributes_to,
        estimate=entry.estimate,
        summary=entry.summary,
        length=length,
        least=bounds[0],
        most=bounds[1],
    )


@lru_cache(maxsize=_UNITS_KEPT)
def _si_per_unit(unit: str) -> float:
    return conversion_factor(unit, si_unit(dimension(unit)))
