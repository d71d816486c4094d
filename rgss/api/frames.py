"""Pandas frames of a study, with the columns of `rgss.api.columns`."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from rgss.api.column import Column, Kind
from rgss.api.columns import FRAMES
from rgss.api.metric_columns import phase_metric_columns, trial_metric_columns
from rgss.assessment import VariantMeasures, requirements_with_criteria
from rgss.evidence import Metric, PhaseRecord, PlanningRecord, TrialRecord
from rgss.requirements import common_attributes
from rgss.scenes.uncertainty import QUANTITIES, draw_column, object_quantity_of_column
from rgss.studies import Project

if TYPE_CHECKING:
    import pandas as pd

Row = dict[str, Any]
"""The cells of a row by column; an absent key is a missing value."""


def frame_of(index: Sequence[Column], columns: Sequence[Column], rows: Sequence[Mapping[str, Any]]) -> pd.DataFrame:
    """A frame of these rows, each column of its type, with their units in ``attrs["units"]``.

    Args:
        index: The columns of the index.
        columns: The other columns, in order.
        rows: The rows, in order.
    """
    import pandas as pd

    series = {
        one.name: pd.Series([row.get(one.name) for row in rows], dtype=one.kind.value) for one in (*index, *columns)
    }
    frame: pd.DataFrame = pd.DataFrame(series)
    for one in index:  # The index is never missing, and plain integers are easier to read.
        if one.kind is Kind.COUNT:
            frame[one.name] = frame[one.name].astype("int64")
    indexed: pd.DataFrame = frame.set_index([one.name for one in index])
    indexed.attrs["units"] = {one.name: one.unit for one in (*index, *columns) if one.unit}
    return indexed


def described_frame(
    name: str, rows: Sequence[Mapping[str, Any]], extra: Sequence[Column] | None = None
) -> pd.DataFrame:
    """Frame with its described columns.

    Args:
        name: Its name.
        rows: Its rows.
        extra: The columns that replace the described ones, where these are patterns.
    """
    frame = FRAMES[name]
    return frame_of(frame.index, frame.columns if extra is None else extra, rows)


def trials_frame(measured: Iterable[VariantMeasures]) -> pd.DataFrame:
    """One row for each trial with evidence."""
    columns = FRAMES["trials"].columns
    rows = [
        _trial_row(key, record) for entry in measured for key, record in zip(entry.trials, entry.records, strict=True)
    ]
    return described_frame("trials", rows, _with_entries(columns, rows))


def phases_frame(records: Iterable[TrialRecord]) -> pd.DataFrame:
    """One row for each trial and state."""
    columns = FRAMES["phases"].columns
    rows = []
    for record in records:
        planning = {one.subtask: one for one in record.planning}
        rows += [_phase_row(record, phase, planning.get(phase.phase)) for phase in record.phases]
    return described_frame("phases", rows, _with_entries(columns, rows))


def measures_frame(project: Project, measured: Iterable[VariantMeasures]) -> pd.DataFrame:
    """One row for each variant and measure."""
    rows = []
    for entry in measured:
        for name, estimate in entry.estimates.items():
            measure = project.measures.measure(name)
            rows.append(
                {
                    "variant": entry.variant.id,
                    "measure": name,
                    "value": estimate.value,
                    "low": estimate.low,
                    "high": estimate.high,
                    "unit": estimate.unit,
                    "n": estimate.n,
                    "kind": measure.kind.value,
                    "better": measure.better.value,
                }
            )
    return described_frame("measures", rows)


def requirements_frame(project: Project) -> pd.DataFrame:
    """One row for each system requirement, with its criterion if it has one."""
    rows = []
    for one in project.requirements.system:
        row: Row = {
            "requirement": one.id,
            "group": one.group.value,
            "text": one.text,
            **common_attributes(one),
            "parent": one.parent,
            "derived_from": ", ".join(one.derived_from),
            "traces": ", ".join(one.traces),
            "satisfied_by": ", ".join(one.satisfied_by),
            "verification": None if one.verification is None else one.verification.value,
        }
        criterion = one.criterion
        if criterion is not None:
            row |= {
                "measure": criterion.measure,
                "statistic": criterion.statistic.value,
                "comparison": criterion.comparison.value,
                "threshold": criterion.threshold,
                "unit": criterion.unit,
            }
        rows.append(row)
    return described_frame("requirements", rows)


def verdicts_frame(project: Project, measured: Iterable[VariantMeasures]) -> pd.DataFrame:
    """One row for each variant and requirement with a criterion."""
    criteria = {one.id: one.criterion for one in requirements_with_criteria(project) if one.criterion is not None}
    rows = []
    for entry in measured:
        for requirement, verdict in entry.verdicts.items():
            criterion = criteria[requirement]
            rows.append(
                {
                    "variant": entry.variant.id,
                    "requirement": requirement,
                    "verdict": verdict.value,
                    "changed": ", ".join(cause.value for cause in entry.causes.get(requirement, ())),
                    "measure": criterion.measure,
                    "statistic": criterion.statistic.value,
                    "comparison": criterion.comparison.value,
                    "threshold": criterion.threshold,
                    "unit": criterion.unit,
                }
            )
    return described_frame("verdicts", rows)


def variant_columns(project: Project) -> tuple[Column, ...]:
    """The columns of the frame of variants, with the patterns replaced by the project's parameters and factors."""
    found: list[Column] = []
    for column in FRAMES["variants"].columns:
        if column.name == "PARAMETER":
            found += [
                Column(
                    name=one.column,
                    meaning=one.description or one.name,
                    unit=one.unit,
                    kind={"quantity": Kind.NUMBER, "count": Kind.COUNT, "name": Kind.TEXT}[one.kind.value],
                )
                for one in project.designs.parameters
            ]
        elif column.name == "level_FACTOR":
            found += [
                Column(name=f"level_{factor.id}", meaning=f"level of: {factor.name}")
                for factor in project.designs.factors
            ]
        else:
            found.append(column)
    return tuple(found)


def metric_cells(columns: Iterable[Column], metrics: Mapping[str, Metric]) -> Row:
    """The cells of metrics; a row of numbers is a cell for each entry."""
    cells: Row = {}
    for column in columns:
        value = metrics.get(column.name)
        if isinstance(value, tuple):
            cells.update({f"item_{number}_{column.name}": entry for number, entry in enumerate(value, start=1)})
        else:
            cells[column.name] = value
    return cells


def _trial_row(key: str, record: TrialRecord) -> Row:
    return {
        "variant": record.variant,
        "seed": record.seed,
        "key": key,
        "fidelity": record.fidelity.value,
        "success": record.success,
        "failure": None if record.failure is None else record.failure.value,
        "failed_phase": None if record.failed_phase is None else record.failed_phase,
        "failure_detail": record.failure_detail or None,
        "workload": record.workload or None,
        **{draw_column(name): value for name, value in record.draws.items()},
        **metric_cells(trial_metric_columns(), record.metrics),
    }


def _phase_row(record: TrialRecord, phase: PhaseRecord, planning: PlanningRecord | None) -> Row:
    row: Row = {
        "variant": record.variant,
        "seed": record.seed,
        "phase": phase.phase,
        "outcome": phase.outcome.value,
        "duration_s": phase.duration_s,
        **metric_cells(phase_metric_columns(), phase.metrics),
    }
    if planning is not None:
        row |= {
            "planning_outcome": planning.outcome.value,
            "planning_checks": planning.checks,
            "planning_simplification_checks": planning.simplification_checks,
            "planning_time_s": planning.time_s,
            "path_length_m": planning.path_length_m,
        }
    return row


def _drawn_columns(there: Collection[str]) -> Iterator[Column]:
    """The columns of the draws that rows have, in the order of the registry, then object by object."""
    for quantity in QUANTITIES.values():
        for name in quantity.draw_names:
            if draw_column(name) in there:
                meaning = quantity.meaning.rstrip(".")
                yield Column(name=draw_column(name), meaning=meaning, unit=quantity.unit, kind=Kind.NUMBER)
    for column in there:
        further = object_quantity_of_column(column)
        if further is not None:
            meaning = further.meaning.rstrip(".")
            yield Column(name=column, meaning=meaning, unit=further.unit, kind=Kind.NUMBER)


def _with_entries(columns: Iterable[Column], rows: Sequence[Mapping[str, Any]]) -> tuple[Column, ...]:
    """The columns with each row of numbers divided into its entries; where the length differs, as many as exist."""
    there = dict.fromkeys(name for row in rows for name in row)
    found: list[Column] = []
    for column in columns:
        if column.name == "drawn_QUANTITY":
            found += _drawn_columns(there)
            continue
        count = 0
        while column.items == 0 and f"item_{count + 1}_{column.name}" in there:
            count += 1
        found += column.entries(count)
    return tuple(found)
