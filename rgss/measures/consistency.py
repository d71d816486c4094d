"""Consistency checks of the entries of a measures file, except expressions."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable, Mapping

from rgss.documents import Document, LoadedDocument
from rgss.findings import Finding
from rgss.measures.definitions import MeasureKind
from rgss.measures.document import MeasureEntry, MeasuresDocument
from rgss.measures.functions import FUNCTIONS

_SYMBOL = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_SOURCE = re.compile(r"design\.[A-Za-z]\w*|component\.[a-z]\w*\.[a-z]\w*|trial\.[a-z]\w*")
_SYMBOL_SECTIONS = ("constants", "inputs", "measures")


def check_entries(loaded: LoadedDocument[MeasuresDocument]) -> list[Finding]:
    """Check ids, sources, assumptions and equations.

    Args:
        loaded: The file's entries with their positions.
    """
    document, entries = loaded.document, loaded.value
    return [
        *_check_ids(document, entries),
        *_check_sources(document, entries),
        *_check_assumptions(document, entries),
        *_check_equations(document, entries),
    ]


def check_roles(
    document: Document,
    entries: MeasuresDocument,
    used: Mapping[str, frozenset[str]],
    by_trial: Mapping[str, bool],
    lengths: Mapping[str, int | None],
) -> list[Finding]:
    """Check that each measure has the keys that its kind and its expression require.

    Args:
        document: The positions.
        entries: The file's entries.
        used: Symbols on which each measure depends, directly or not.
        by_trial: Whether each measure varies from trial to trial.
        lengths: The number of entries of each measure; None for a single number.
    """
    findings: list[Finding] = []
    effectiveness = [entry.id for entry in entries.measures if entry.kind is MeasureKind.EFFECTIVENESS]
    for index, entry in enumerate(entries.measures):
        wrong = [
            *_kind_problems(entry, effectiveness, used),
            *_estimate_problems(entry, by_trial.get(entry.id)),
            *(_summary_problems(entry, lengths[entry.id]) if entry.id in lengths else ()),
        ]
        findings += [
            document.finding(f"measures.{rule}", message, ("measures", index, *where), hint=hint)
            for rule, message, where, hint in wrong
        ]
    return findings


_Problem = tuple[str, str, tuple["str | int", ...], str]


def _check_ids(document: Document, entries: MeasuresDocument) -> Iterable[Finding]:
    seen: dict[str, int] = {}
    for section in _SYMBOL_SECTIONS:
        for index, entry in enumerate(getattr(entries, section)):
            location = (section, index, "id")
            name = entry.id
            if name in FUNCTIONS:
                yield document.finding("measures.symbol", f"{name!r} is the name of a function", location)
            elif not _SYMBOL.fullmatch(name) or keyword.iskeyword(name):
                hint = "a letter, then letters, digits and '_'; not a keyword of Python"
                yield document.finding("measures.symbol", f"{name!r} cannot be a symbol", location, hint=hint)
            yield from _duplicate(document, seen, name, location)
    for section in ("assumptions", "equations"):
        seen = {}
        for index, entry in enumerate(getattr(entries, section)):
            yield from _duplicate(document, seen, entry.id, (section, index, "id"))


def _duplicate(
    document: Document, seen: dict[str, int], name: str, location: tuple[str | int, ...]
) -> Iterable[Finding]:
    if name in seen:
        message = f"id {name!r} is already in line {seen[name]}"
        yield document.finding("measures.duplicate-id", message, location, hint="give one of them another id")
    seen.setdefault(name, document.values[location][0])


def _check_sources(document: Document, entries: MeasuresDocument) -> Iterable[Finding]:
    for index, entry in enumerate(entries.inputs):
        if not _SOURCE.fullmatch(entry.source):
            hint = "write design.<parameter>, component.<role>.<property> or trial.<metric>"
            message = f"{entry.source!r} is not a source"
            yield document.finding("measures.source", message, ("inputs", index, "source"), hint=hint)
        elif entry.length is not None and not entry.source.startswith("trial."):
            message = "only a trial's metric can be a row"
            hint = "remove 'length'"
            yield document.finding("measures.source", message, ("inputs", index, "length"), hint=hint)


def _check_assumptions(document: Document, entries: MeasuresDocument) -> Iterable[Finding]:
    symbols = {entry.id for section in _SYMBOL_SECTIONS for entry in getattr(entries, section)}
    known = symbols | {entry.id for entry in entries.equations}
    concerned: set[str] = set()
    for index, entry in enumerate(entries.assumptions):
        concerned |= {*entry.concerns}
        for place, name in enumerate(entry.concerns):
            if name not in known:
                message = f"{name!r} is not a constant, an input, a measure or an equation"
                yield document.finding("measures.assumption", message, ("assumptions", index, "concerns", place))
    for index, constant in enumerate(entries.constants):
        if constant.source is None and constant.id not in concerned:
            message = f"constant {constant.id!r} has neither a source nor an assumption"
            hint = "add 'source', or an assumption that concerns it"
            yield document.finding("measures.unsourced", message, ("constants", index), hint=hint)


def _check_equations(document: Document, entries: MeasuresDocument) -> Iterable[Finding]:
    known = [entry.id for entry in entries.equations]
    cited = {entry.equation for entry in entries.measures}
    for index, measure in enumerate(entries.measures):
        if measure.equation is not None and measure.equation not in known:
            hint = f"equations: {', '.join(known)}" if known else "add it to 'equations'"
            message = f"equation {measure.equation!r} is not listed"
            yield document.finding("measures.equation", message, ("measures", index, "equation"), hint=hint)
    for index, equation in enumerate(entries.equations):
        if equation.id not in cited:
            message = f"no measure realises equation {equation.id}"
            hint = "name it in the measure that does"
            yield document.finding("measures.equation", message, ("equations", index, "id"), hint=hint)


def _kind_problems(
    entry: MeasureEntry, effectiveness: list[str], used: Mapping[str, frozenset[str]]
) -> Iterable[_Problem]:
    if entry.kind is MeasureKind.EFFECTIVENESS and not entry.traces:
        yield ("trace", f"measure of effectiveness {entry.id!r} traces to no stakeholder need", (), "add 'traces'")
    if entry.kind is not MeasureKind.EFFECTIVENESS and entry.traces:
        hint = "remove 'traces', or make it a moe"
        yield ("trace", "only a measure of effectiveness traces to stakeholder needs", ("traces",), hint)
    if entry.kind is MeasureKind.PERFORMANCE and not entry.contributes_to:
        message = f"measure of performance {entry.id!r} contributes to no measure of effectiveness"
        yield ("contribution", message, (), "add 'contributes_to'")
    if entry.kind is MeasureKind.SUPPLEMENTARY and entry.contributes_to:
        hint = "remove 'contributes_to', or make it a mop"
        message = "a supplementary measure contributes to no measure of effectiveness"
        yield ("contribution", message, ("contributes_to",), hint)
        return
    for place, name in enumerate(entry.contributes_to):
        where = ("contributes_to", place)
        if name not in effectiveness:
            hint = f"measures of effectiveness: {', '.join(effectiveness)}"
            yield ("contribution", f"{name!r} is not a measure of effectiveness", where, hint)
        elif name in used and entry.id not in used[name]:
            hint = f"use {entry.id} in the expression of {name}, or remove it here"
            yield ("contribution", f"{name!r} does not depend on {entry.id!r}", where, hint)


def _estimate_problems(entry: MeasureEntry, by_trial: bool | None) -> Iterable[_Problem]:  # noqa: FBT001
    if by_trial is True and entry.estimate is None:
        message = f"measure {entry.id!r} varies from trial to trial and has no 'estimate'"
        yield ("estimate", message, (), "add 'estimate' with 'statistic' and 'over'")
    if by_trial is False and entry.estimate is not None:
        message = f"measure {entry.id!r} follows from the design alone; there is nothing to estimate"
        yield ("estimate", message, ("estimate",), "remove 'estimate'")


def _summary_problems(entry: MeasureEntry, length: int | None) -> Iterable[_Problem]:
    if length is not None and entry.summary is None:
        message = f"measure {entry.id!r} is a row of {length} and has no 'summary'"
        yield ("summary", message, (), "add 'summary': sum, mean or max")
    if length is None and entry.summary is not None:
        yield ("summary", f"measure {entry.id!r} is a single number", ("summary",), "remove 'summary'")
