"""Tables of a confirmation, one column or row for each setting."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.confirmation import COMPARED_METRICS, Confirmation
from rgss.measures import Verdict
from rgss.reports.tables import Cell, Table

_DIGITS = 4


def confirmation_tables(confirmation: Confirmation) -> tuple[Table, ...]:
    """Decisions, verdicts that differ, outcomes and metrics side by side; empty tables are omitted."""
    made = (_decisions(confirmation), _verdicts(confirmation), _outcomes(confirmation), _metrics(confirmation))
    return tuple(table for table in made if table.rows)


def shown_number(value: float | None) -> str:
    """Number with four digits; a dash if there is none."""
    return "–" if value is None else f"{value:.{_DIGITS}g}"


def _decisions(confirmation: Confirmation) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for result in confirmation.results:
        ranking = "; ".join(f"{variant}: {shown_number(value)}" for variant, value in result.ranking) or "none feasible"
        first = "–" if result.first is None else str(result.first)
        rows.append((result.setting.aspect.value, result.setting.label, first, ranking))
    return Table(
        name="decisions",
        title="Decision under each setting",
        heads=("setting", "physics", "first", "ranking (variant: value)"),
        rows=rows,
    )


def _verdicts(confirmation: Confirmation) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for variant, verdicts in confirmation.results[0].verdicts.items():
        for requirement in verdicts:
            found = [result.verdicts[variant][requirement] for result in confirmation.results]
            if any(verdict is not Verdict.MET for verdict in found):
                rows.append((str(variant), requirement, *_side_by_side([one.value.replace("_", " ") for one in found])))
    return Table(
        name="verdicts",
        title="Verdicts that are not met under every setting",
        heads=("variant", "requirement", *_settings(confirmation)),
        rows=rows,
    )


def _outcomes(confirmation: Confirmation) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for trial in confirmation.trials:
        found = [trial.outcome(index) for index in range(len(trial.records))]
        kind = "sample" if trial.is_sample else "design"
        rows.append((str(trial.variant), str(trial.seed), kind, *_side_by_side(found)))
    return Table(
        name="outcomes",
        title="Outcomes",
        heads=("variant", "seed", "as", *_settings(confirmation)),
        rows=rows,
    )


def _metrics(confirmation: Confirmation) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for metric in COMPARED_METRICS:
        extremes = [confirmation.extreme(metric, index) for index in range(len(confirmation.results))]
        if not any(extremes):
            continue
        cells = []
        for index, extreme in enumerate(extremes):
            cell = "–" if extreme is None else f"{shown_number(extreme[0])} … {shown_number(extreme[1])}"
            difference = confirmation.largest_difference(metric, index) if index else None
            cells.append(cell if difference is None else f"{cell} (±{shown_number(difference)})")
        rows.append((metric, *cells))
    return Table(
        name="metrics",
        title="Metrics: least and greatest over the trials, and the greatest difference from the study's",
        heads=("metric", *_settings(confirmation)),
        rows=rows,
    )


def _side_by_side(found: Sequence[str]) -> tuple[str, ...]:
    """Rows with the study's values, and those of the other settings where they differ."""
    return (found[0], *("the same" if other == found[0] else other for other in found[1:]))


def _settings(confirmation: Confirmation) -> tuple[str, ...]:
    return tuple(result.setting.aspect.value for result in confirmation.results)
