"""Sources of the measures' inputs: the check that they exist, and the ranges of those from trials."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from rgss.documents import Document
from rgss.findings import Finding
from rgss.measures import InputSymbol, Range
from rgss.quantities import dimension
from rgss.trials import FOR_EACH_JOINT, METRICS, MetricDescriptor

_LONGEST_LIST = 12
_MOST_ALIKE = 3
# Words of a source, without units such as m_s2, are compared by their beginnings.
_SHORTEST_WORD, _STEM = 4, 6


def metric_ranges() -> dict[str, Range]:
    """Range of each metric of trials, in SI."""
    return {
        name: Range(
            low=-math.inf if metric.least is None else metric.least,
            high=math.inf if metric.most is None else metric.most,
        )
        for name, metric in METRICS.items()
    }


def source_findings(
    inputs: Iterable[InputSymbol],
    design_units: Mapping[str, str],
    document: Document,
    *,
    planned: int,
    joints: Sequence[int],
) -> Iterator[Finding]:
    """Find inputs whose source is not there or measures something else.

    Args:
        inputs: The inputs of the measures, in the order of their file.
        design_units: The unit of each source that designs have; empty for a name.
        document: The measures' file, for positions.
        planned: Number of planned moves of the task.
        joints: Numbers of joints of the arms; none if the scene cannot be read, and rows of joints are not checked.
    """
    trial_units = {f"trial.{name}": kind.unit for name, kind in METRICS.items()}
    for index, symbol in enumerate(inputs):
        owner, units = ("trials", trial_units) if symbol.from_trial else ("designs", design_units)
        unit = units.get(symbol.source)
        if unit is None:
            message = f"{symbol.id}: the {owner} have no {symbol.source!r}"
            hint = _metrics_like(symbol) if symbol.from_trial else _known(symbol.source, list(units))
            yield document.finding("measures.unknown-source", message, ("inputs", index, "source"), hint=hint)
        elif not unit:
            message = f"{symbol.id}: {symbol.source!r} is a name, not a number"
            yield document.finding("measures.source-unit", message, ("inputs", index, "source"))
        elif dimension(unit) != dimension(symbol.unit):
            message = f"{symbol.id}: {symbol.source!r} is measured in {unit!r}, not in {symbol.unit!r}"
            hint = "correct the source or the unit"
            yield document.finding("measures.source-unit", message, ("inputs", index, "unit"), hint=hint)
        elif symbol.from_trial:
            metric = METRICS[symbol.metric]
            if metric.length == FOR_EACH_JOINT and len(joints) != 1:
                if joints:
                    message = f"{symbol.id}: {symbol.source!r} is a row of {' or '.join(map(str, joints))}"
                    hint = "take a metric of the whole arm: the designs have arms of different numbers of joints"
                    yield document.finding("measures.source-length", message, ("inputs", index), hint=hint)
                continue
            length = metric.length_in_trial(planned=planned, joints=joints[0] if joints else 0)
            if symbol.length == length:
                continue
            message = f"{symbol.id}: {symbol.source!r} is {'one number' if length is None else f'a row of {length}'}"
            hint = "remove 'length'" if length is None else f"write 'length: {length}'"
            yield document.finding("measures.source-length", message, ("inputs", index), hint=hint)


def _metrics_like(symbol: InputSymbol) -> str:
    """Metrics with a similar name, else those that share words with the source, or measure what the input does."""
    near = difflib.get_close_matches(symbol.metric, METRICS, n=1)
    if near:
        return f"did you mean 'trial.{near[0]}'?"
    scores = {metric.name: _likeness(symbol, metric) for metric in METRICS.values()}
    best = [METRICS[name] for name, score in scores.items() if 0 < score == max(scores.values())]
    alike = [f"'trial.{one.name}' ({one.meaning_in_trial})" for one in best[:_MOST_ALIKE]]
    every = "'rgss check --explain measures.unknown-source' lists all"
    return f"did you mean {' or '.join(alike)}? {every}" if alike else every


def _likeness(symbol: InputSymbol, metric: MetricDescriptor) -> int:
    """Twice the words of the source in a metric's name and meaning; one more each for the same dimension and unit."""
    known = _words(f"{metric.name} {metric.meaning_in_trial}")
    shared = sum(any(one.startswith(word[:_STEM]) for one in known) for word in _words(symbol.metric))
    kind = dimension(symbol.unit)
    return 2 * shared + (bool(kind and kind == dimension(metric.unit)) and 1 + (symbol.unit == metric.unit))


def _words(text: str) -> set[str]:
    return {word for word in re.findall("[a-z]+", text.lower()) if len(word) >= _SHORTEST_WORD}


def _known(source: str, names: list[str]) -> str:
    near = difflib.get_close_matches(source, names, n=1)
    if near:
        return f"did you mean {near[0]!r}?"
    alike = [name for name in names if name.split(".")[:-1] == source.split(".")[:-1]] or names
    return f"sources: {', '.join(alike[:_LONGEST_LIST])}{' …' if len(alike) > _LONGEST_LIST else ''}"
