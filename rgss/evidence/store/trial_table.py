"""Trials as a table: one row per trial, one column per value, units in the names of the columns.

The columns, in order; NAME is the name of a metric, with its unit as suffix:

- ``key``, ``content_digest``: digests of the inputs and of the record. - ``variant``, ``seed``, ``fidelity``,
``success``, ``failure``, ``failed_phase``, ``failure_detail``. - ``workload``, ``drawn_QUANTITY``: case of the
workload, and draws of uncertain quantities; only if there are any. - ``NAME``: a metric of the trial (except success,
which has its own column). A row metric has a column for each entry: ``item_1_NAME``, ``item_2_NAME`` and so on; a row
of
  planning or of paths has the planned moves in their order.
- ``PHASE_outcome``, ``PHASE_duration_s``, ``PHASE_NAME``: each step of the task and its metrics.
- ``planning_N_outcome``, ``_checks``, ``_simplification_checks``, ``_time_s``, ``_path_length_m``: the
  planning of each of the five moves.
- ``input_NAME``, ``version_NAME``, ``file_NAME``: digests of the pieces, versions of code and engines,
  digests of the input files; ``inputs_digest``, ``revision``, ``machine``.

Metrics are floats; values that are not observed are missing.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rgss.errors import EvidenceError
from rgss.evidence.records import Metric, StoredTrial
from rgss.findings import shown
from rgss.scenes.uncertainty import draw_column

if TYPE_CHECKING:
    import pandas as pd

MOST_COLUMNS = 2000
"""Greatest number of columns of a table; a record has some hundred values."""

_SAID = "success"
"""The metric equal to the column ``success``."""

_HEAD, _DRAWN, _METRICS, _PHASES, _PLANNING, _ORIGIN = range(6)

_PLANNING_COLUMNS = {
    "outcome": str,
    "checks": int,
    "simplification_checks": int,
    "time_s": float,
    "path_length_m": float,
}

_Order = tuple[int, int, str, int]
"""Position of a column: part of the table, place in the part, name and index of a metric."""

_Cell = tuple[str, Any, _Order, type]
"""Name of the column, value, place and type of the column."""


@dataclass(slots=True, kw_only=True)
class _Column:
    order: _Order
    kind: type
    cells: list[Any]


def trial_frame(trials: Iterable[StoredTrial]) -> pd.DataFrame:
    """Trials as a data frame, in their order.

    Args:
        trials: The trials, which may be a stream: only the values of the table are kept in memory.

    Raises:
        EvidenceError: A value does not fit a column, two columns have the same name, or there are too many columns.
    """
    import pandas as pd

    columns = {name: _Column(order=order, kind=kind, cells=[]) for name, _, order, kind in _head(None)}
    for rows, trial in enumerate(trials):
        for name, value, order, kind in _cells(trial):
            column = columns.get(name)
            if column is None:
                column = columns[name] = _Column(order=order, kind=kind, cells=[None] * rows)
            elif column.order != order or len(column.cells) > rows:
                raise EvidenceError(f"two columns of the table would have the name {shown(name)}")
            column.cells.append(value)
        if len(columns) > MOST_COLUMNS:
            raise EvidenceError(f"the number of columns must be at most {MOST_COLUMNS}")
        for column in columns.values():
            if len(column.cells) == rows:
                column.cells.append(None)
    dtypes = {float: "float64", int: "Int64", bool: "boolean", str: "string"}
    names = sorted(columns, key=lambda name: columns[name].order)
    series = {name: pd.Series(columns[name].cells, dtype=dtypes[columns.pop(name).kind]) for name in names}
    frame: pd.DataFrame = pd.DataFrame(series, columns=names)
    return frame


def _cells(trial: StoredTrial) -> Iterator[_Cell]:
    record, provenance = trial.record, trial.provenance
    yield from _head(trial)
    if record.workload:
        yield "workload", _text(record.workload), (_DRAWN, 0, "", 0), str
    for name, drawn in record.draws.items():
        yield _text(draw_column(name)), _number(drawn, name), (_DRAWN, 1, name, 0), float
    for name, value in record.metrics.items():
        if name != _SAID:
            yield from _metric(_METRICS, 0, "", name, value)
    for number, phase in enumerate(record.phases):
        title = phase.phase
        yield f"{title}_outcome", phase.outcome.value, (_PHASES, number, "", 0), str
        yield f"{title}_duration_s", _number(phase.duration_s, "duration_s"), (_PHASES, number, "", 1), float
        for name, value in phase.metrics.items():
            yield from _metric(_PHASES, number, f"{title}_", name, value)
    for number, planning in enumerate(record.planning, start=1):
        for place, (name, kind) in enumerate(_PLANNING_COLUMNS.items()):
            value = getattr(planning, name)
            cell = value.value if kind is str else _number(value, name) if kind is float else _count(value, name)
            yield f"planning_{number}_{name}", cell, (_PLANNING, number, "", place), kind
    for place, (kind_of, texts) in enumerate(
        (("input", provenance.inputs), ("version", provenance.versions), ("file", provenance.files))
    ):
        for name, text in texts.items():
            yield f"{kind_of}_{_text(name)}", _text(text), (_ORIGIN, place, name, 0), str
    for place, name in enumerate(("inputs_digest", "revision", "machine"), start=3):
        yield name, _text(getattr(provenance, name)) or None, (_ORIGIN, place, "", 0), str


def _head(trial: StoredTrial | None) -> Iterator[_Cell]:
    """Columns of every table, also of one without trials."""
    record = None if trial is None else trial.record
    cells: list[tuple[str, type, Any]] = [
        ("key", str, trial and trial.key),
        ("content_digest", str, trial and trial.content_digest),
        ("variant", int, record and _count(record.variant, "variant")),
        ("seed", int, record and _count(record.seed, "seed")),
        ("fidelity", str, record and record.fidelity.value),
        ("success", bool, record and record.success),
        ("failure", str, record and record.failure and record.failure.value),
        ("failed_phase", str, record and record.failed_phase and record.failed_phase),
        ("failure_detail", str, record and _text(record.failure_detail)),
    ]
    for place, (name, kind, cell) in enumerate(cells):
        yield name, cell, (_HEAD, place, "", 0), kind


def _metric(part: int, place: int, prefix: str, name: str, value: Metric) -> Iterator[_Cell]:
    title = _text(name)
    if not isinstance(value, tuple):
        yield prefix + title, _number(value, name), (part, place, name, 2), float
        return
    for index, entry in enumerate(value, start=1):
        yield f"{prefix}item_{index}_{title}", _number(entry, name), (part, place, name, 2 + index), float


def _number(value: float | None, name: str) -> float | None:
    """Number as a float, if exactly representable."""
    if value is None or type(value) is float:
        return value
    try:
        number = float(value)
    except OverflowError:
        number = None
    if number is None or number != value:
        raise EvidenceError(f"{shown(name)} has a value that no column of floats can hold: {shown(value)}")
    return number


def _count(value: int, name: str) -> int:
    if abs(value) >= 2**63:
        raise EvidenceError(f"{shown(name)} has a value that no column of integers can hold: {shown(value)}")
    return value


def _text(text: str) -> str:
    """Text without unpaired surrogates, which JSON can contain but files cannot."""
    return text if text.isascii() else text.encode("utf-8", "replace").decode("utf-8")
