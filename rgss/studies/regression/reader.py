"""Reader of the section ``regression`` of a study."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.documents import Document
from rgss.errors import QuantityError
from rgss.evidence import Fidelity
from rgss.findings import Finding, shown
from rgss.quantities import parse_quantity
from rgss.regression import SUCCESS, WHOLE_TRIAL, Guard
from rgss.studies.regression.document import RegressionEntry, RegressionMetricEntry, RegressionRunEntry
from rgss.studies.regression.guard import GuardedMetric, RegressionGuard, WatchedRun
from rgss.trials import FOR_EACH_JOINT, FOR_EACH_MOVE, METRICS, PHASE_METRICS


def read_regression(
    entry: RegressionEntry | None, document: Document, findings: list[Finding], *, phases: Sequence[str]
) -> RegressionGuard | None:
    """Read the section.

    Args:
        entry: The section of the file; None if there is none.
        document: The file.
        findings: Collects the problems.
        phases: Names of the steps of the task.

    Returns:
        The guard; None if there is none. It can be used if nothing was found.
    """
    return None if entry is None else _Reader(document, findings, phases).read(entry)


class _Reader:
    def __init__(self, document: Document, findings: list[Finding], phases: Sequence[str]) -> None:
        self._phases = tuple(phases)
        self._document = document
        self._findings = findings

    def read(self, entry: RegressionEntry) -> RegressionGuard:
        if not 0.0 < entry.error_rate < 0.5:
            message = f"error rate must be between 0 and 0.5, got {entry.error_rate:g}"
            self._report(message, ("error_rate",), "give a share between 0 and 0.5, such as 0.05")
        runs = [self._run(one, place) for place, one in enumerate(entry.runs)]
        names = [one.id for one in entry.runs]
        for place, name in enumerate(names):
            if name in names[:place]:
                self._report(f"there are two runs {name!r}", ("runs", place, "id"), "give each its own name")
        metrics = [self._metric(one, place, names) for place, one in enumerate(entry.metrics)]
        seen: set[tuple[str, str, str]] = set()
        for place, metric in enumerate(metrics):
            # One name for two margins would be compared twice, and have one entry in the baseline.
            subjects = {(run, metric.metric, phase) for run in metric.runs for phase in metric.phases}
            if subjects & seen:
                self._report(f"{metric.metric} is guarded twice", ("metrics", place, "metric"), "keep one")
            seen |= subjects
        if entry.decision is not None and entry.decision not in names:
            self._unknown_run(entry.decision, ("decision",), names)
        return RegressionGuard(
            error_rate=entry.error_rate, runs=tuple(runs), metrics=tuple(metrics), decision=entry.decision
        )

    def _run(self, entry: RegressionRunEntry, place: int) -> WatchedRun:
        cap = entry.replicates if entry.cap is None else entry.cap
        if cap < entry.replicates:
            message = f"the cap of {cap} seeds is below the {entry.replicates} of the first look"
            self._report(message, ("runs", place, "cap"), "raise it, or omit it")
        return WatchedRun(
            id=entry.id,
            fidelity=Fidelity(entry.fidelity),
            variants=entry.variants,
            replicates=entry.replicates,
            batch=entry.batch or entry.replicates,
            cap=max(cap, entry.replicates),
        )

    def _metric(self, entry: RegressionMetricEntry, place: int, runs: list[str]) -> GuardedMetric:
        at = ("metrics", place)
        for number, run in enumerate(entry.runs or ()):
            if run not in runs:
                self._unknown_run(run, (*at, "runs", number), runs)
        unit = self._unit(entry, at)
        margin, relative = (1.0, 0.0) if unit is None else self._margins(entry, unit, at)
        phases = (
            (WHOLE_TRIAL,) if entry.phases is None else self._phases if entry.phases == "all" else tuple(entry.phases)
        )
        for key, names in (("runs", entry.runs or ()), ("phases", phases)):
            for number, name in enumerate(names):
                if name in names[:number]:
                    self._report(f"{name} is named twice", (*at, key, number), "keep one")
        for number, phase in enumerate(phases):
            if phase not in (*self._phases, WHOLE_TRIAL):
                hint = f"phases: {', '.join(self._phases)}"
                self._report(f"unknown phase {phase!r}", (*at, "phases", number), hint)
        return GuardedMetric(
            metric=entry.metric,
            guard=Guard(
                unit=unit or "1",
                higher_is_better=entry.better == "higher",
                margin=margin,
                is_success=entry.metric == SUCCESS,
                both_ways=entry.better == "neither",
                relative=relative,
            ),
            runs=tuple(runs) if entry.runs is None else entry.runs,
            phases=phases,
            wherever=entry.phases == "all",
        )

    def _unit(self, entry: RegressionMetricEntry, at: tuple[str | int, ...]) -> str | None:
        """Unit of a metric that is a single number; None if it is reported."""
        name, in_phases = entry.metric, entry.phases is not None
        metrics, observer = (PHASE_METRICS, "phase") if in_phases else (METRICS, "trial")
        metric = metrics.get(name)
        if metric is None:
            self._report(f"no {observer} observes a metric {name!r}", (*at, "metric"), _near(name, tuple(metrics)))
            return None
        length = metric.length_in_phase if in_phases else metric.length
        if length is not None:
            known = {
                0: "numbers, one per finger",
                FOR_EACH_MOVE: "numbers, one per planned move",
                FOR_EACH_JOINT: "numbers, one per joint of the arm",
            }
            count = known.get(length, f"{length} numbers")
            is_number_of_phase = name in PHASE_METRICS and PHASE_METRICS[name].length_in_phase is None
            hint = "write 'phases: all'" if is_number_of_phase else "guard one that is a single number"
            self._report(f"{name} is a row of {count}", (*at, "metric"), hint)
            return None
        return metric.unit

    def _margins(self, entry: RegressionMetricEntry, unit: str, at: tuple[str | int, ...]) -> tuple[float, float]:
        """The margin in the metric's unit, and its share of the baseline's mean, 0 if it has none."""
        if entry.metric == SUCCESS and entry.better != "higher":
            self._report(f"of success, {entry.better} is not better", (*at, "better"), "write 'better: higher'")
        if not (_is_share(entry.margin) and unit != "1"):
            if entry.at_least is not None:
                hint = "omit it, or give the margin in per cent of the baseline's mean"
                self._report("at_least belongs to a margin in per cent", (*at, "at_least"), hint)
            return self._margin(entry, entry.margin, unit, (*at, "margin")), 0.0
        relative = self._margin(entry, entry.margin, "1", (*at, "margin"))
        if entry.at_least is None:
            hint = "add the least margin in its unit, such as 'at_least: 50 ms', for a baseline near zero"
            self._report(f"a margin of {shown(entry.margin)} needs 'at_least'", (*at, "margin"), hint)
            return 1.0, relative
        return self._margin(entry, entry.at_least, unit, (*at, "at_least")), relative

    def _margin(self, entry: RegressionMetricEntry, given: str, unit: str, place: tuple[str | int, ...]) -> float:
        text = given.strip()
        if unit == "1":
            text = text.removesuffix("percent") + "%" if text.endswith("percent") else text
        try:
            margin = parse_quantity(text, unit)
        except QuantityError as error:
            self._report(error.message, place, error.hint)
            return 1.0
        if margin <= 0.0:
            message = f"a margin of {shown(given)} can never be kept for certain"
            self._report(message, place, "say how much worse it may get")
        elif entry.metric == SUCCESS and margin >= 1.0:
            message = f"a margin of {shown(given)} lets every trial fail"
            self._report(message, place, "give a share below 1, such as 20 %")
        return margin

    def _unknown_run(self, name: str, at: tuple[str | int, ...], runs: list[str]) -> None:
        self._report(f"unknown run {name!r}", at, f"runs: {', '.join(runs)}")

    def _report(self, message: str, at: tuple[str | int, ...], hint: str) -> None:
        self._findings.append(self._document.finding("study.regression", message, ("regression", *at), hint=hint))


def _is_share(text: str) -> bool:
    return text.strip().endswith(("%", "percent"))


def _near(name: str, names: tuple[str, ...]) -> str:
    import difflib

    near = difflib.get_close_matches(name, names, n=1)
    return f"did you mean {near[0]!r}?" if near else "such as success, duration_s, planning_time_s, slip_m"
