"""The baseline: raw values of each seed, where they come from, and why they were last changed."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from pathlib import Path
from typing import Any

from rgss.errors import EvidenceError
from rgss.evidence.records import plain_json, read_plain

SCHEMA = 5
"""The form of the file."""

_WITHOUT_DESIGNS = 4
"""An earlier schema without the levels of designs and the seeds of the first look; it is still read."""

_WITHOUT_PHASE_RECORD = 3
"""An earlier schema that lacks the metrics of phases too; it is still read."""

_WITHOUT_VALUES = 2
"""An earlier schema that lacks the values of inputs too; it is still read."""

EARLIER_SCHEMAS = (_WITHOUT_VALUES, _WITHOUT_PHASE_RECORD, _WITHOUT_DESIGNS)
"""The earlier schemas that are read."""

LARGEST_FILE_BYTES = 32 * 1024 * 1024
_LONGEST_NUMBER = 12

Values = Mapping[str, Mapping[str, Mapping[str, tuple[float | None, ...]]]]
"""By metric, phase and variant, the values in the order of the seeds."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BaselineRun:
    """Trials of one run.

    Attributes:
        fidelity: How much physics they had.
        seeds: Their seeds, the same for every variant.
        values: The raw values.
        fingerprints: By variant, the fingerprint of the record of each seed.
        inputs: By variant, the values of those inputs that not all trials of the baseline share, by name.
        designs: By variant, the id of its level of each factor; empty if they are not known.
        first_look: Number of seeds at the first look; 0 if it is not known.
    """

    fidelity: str
    seeds: tuple[int, ...]
    values: Values = field(hash=False)
    fingerprints: Mapping[str, tuple[str, ...]] = field(hash=False)
    inputs: Mapping[str, Mapping[str, str]] = field(default_factory=dict, hash=False)
    designs: Mapping[str, Mapping[str, str]] = field(default_factory=dict, hash=False)
    first_look: int = 0

    @property
    def variants(self) -> tuple[int, ...]:
        """The variants, ascending."""
        return tuple(sorted(int(name) for name in self.fingerprints))


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionState:
    """Decision among the variants of one run.

    Attributes:
        run: The run.
        chosen: The chosen variant; None if none is feasible.
        pareto: The variants on the Pareto front, ascending.
        verdicts: By variant, the verdict on each requirement.
        measures: By variant and measure that the decision or a verdict rests on, its value by each seed alone.
    """

    run: str
    chosen: int | None
    pareto: tuple[int, ...]
    verdicts: Mapping[str, Mapping[str, str]] = field(hash=False)
    measures: Mapping[str, Mapping[str, tuple[float | None, ...]]] = field(hash=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class BaselineOrigin:
    """Provenance of a baseline.

    Attributes:
        revision: Revision of the code; empty if unknown.
        machine: The machine.
        engines: Version of each engine, and other items of the trials' provenance, such as numerics.
        code: A digest of the source of each piece of a trial.
        inputs: SHA-256 of each input file.
        modules: A digest of each module that makes a piece of a trial.
        constants: Named numeric constants of these modules and their classes, as text.
    """

    revision: str
    machine: str
    engines: Mapping[str, str] = field(hash=False)
    code: Mapping[str, str] = field(hash=False)
    inputs: Mapping[str, str] = field(hash=False)
    modules: Mapping[str, str] = field(default_factory=dict, hash=False)
    constants: Mapping[str, str] = field(default_factory=dict, hash=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """Reason of a new or changed baseline.

    Attributes:
        reason: Text of the user.
        revision: Revision of the code; empty if unknown.
    """

    reason: str
    revision: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Baseline:
    """Baseline with which metrics and the decision are compared.

    Attributes:
        study: The study's id.
        units: The unit of each guarded metric.
        record: Name and unit of every metric that a trial's record has.
        runs: The trials by run.
        decision: The decision; None if the study guards none.
        origin: Origin of the values.
        history: Every change of the file, the first one first.
        inputs: The values of those inputs that all trials share, by dotted name, as text.
        phase_record: Name and unit of every metric that a phase's record may have; empty if it is not known.
        schema: The form of the file.
    """

    study: str
    units: Mapping[str, str] = field(hash=False)
    record: Mapping[str, str] = field(hash=False)
    runs: Mapping[str, BaselineRun] = field(hash=False)
    decision: DecisionState | None
    origin: BaselineOrigin
    history: tuple[Change, ...]
    inputs: Mapping[str, str] = field(default_factory=dict, hash=False)
    phase_record: Mapping[str, str] = field(default_factory=dict, hash=False)
    schema: int = SCHEMA

    @property
    def has_values(self) -> bool:
        """True if it has the values of inputs, which one of an earlier version of rgss has not."""
        return self.schema > _WITHOUT_VALUES

    def inputs_of(self, run: str, variant: int) -> dict[str, str]:
        """The values of all inputs of a variant's trials, by name; none if the baseline lacks them."""
        own = self.runs[run].inputs.get(str(variant)) if run in self.runs else None
        return {} if own is None else {**self.inputs, **own}


def baseline_to_text(baseline: Baseline) -> str:
    """The file's text: sorted, one line for the values of one variant, so that a change shows as lines."""
    return _text(_plain(baseline), "") + "\n"


def read_baseline(path: Path, *, label: str) -> Baseline:
    """Read a baseline.

    Args:
        path: The file.
        label: Its name in messages.

    Raises:
        EvidenceError: It is missing, or not as `baseline_to_text` writes it.
    """
    again = "make it with 'rgss regress --update --reason TEXT'"
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE_BYTES + 1)
    except FileNotFoundError:
        raise EvidenceError(f"there is no baseline {label}", hint=again) from None
    except (OSError, ValueError) as error:
        said = getattr(error, "strerror", None) or "not the name of a file"
        raise EvidenceError(f"the baseline {label} cannot be read: {said}") from None
    if len(content) > LARGEST_FILE_BYTES:
        raise EvidenceError(f"the baseline {label} is larger than {LARGEST_FILE_BYTES // 1024**2} MiB", hint=again)
    try:
        data = plain_json(content.decode("utf-8-sig"), f"baseline {label}")
    except UnicodeDecodeError:
        raise EvidenceError(f"the baseline {label} is not UTF-8", hint=again) from None
    if not isinstance(data, dict) or "schema" not in data:
        raise EvidenceError(f"{label} is not a baseline: it has no 'schema'", hint=again)
    if data["schema"] in EARLIER_SCHEMAS:
        _add_empty_values(data)
    elif data["schema"] != SCHEMA:
        readable = f"{', '.join(map(str, EARLIER_SCHEMAS))} and {SCHEMA} are read"
        raise EvidenceError(f"the baseline {label} has schema {data['schema']!r}; {readable}", hint=again)
    try:
        baseline = read_plain(data, Baseline, "baseline")
    except EvidenceError as error:
        raise EvidenceError(f"{label}: {error.message}", hint=again) from error
    _check(baseline, label, again)
    return baseline


def _add_empty_values(data: dict[str, Any]) -> None:
    """Migrate a baseline of an earlier schema, if well-formed."""
    found = data.get("runs")
    runs = [run for run in (found.values() if isinstance(found, dict) else ()) if isinstance(run, dict)]
    for run in runs:
        run.setdefault("designs", {})
        run.setdefault("first_look", 0)
    if data["schema"] in (_WITHOUT_VALUES, _WITHOUT_PHASE_RECORD):
        data.setdefault("phase_record", {})
    if data["schema"] != _WITHOUT_VALUES:
        return
    origin = data.get("origin")
    for name in ("modules", "constants"):
        if isinstance(origin, dict):
            origin.setdefault(name, {})
    for part in (data, *runs):
        part.setdefault("inputs", {})


def _check(baseline: Baseline, label: str, again: str) -> None:
    """Check beyond the types: a reason, seeds of the first look, and a value of each row for each seed.

    Raises:
        EvidenceError: One of these is missing.
    """
    if not any(each.reason.strip() for each in baseline.history):
        raise EvidenceError(f"the baseline {label}: its history has no reason", hint=again)
    for name, run in baseline.runs.items():
        least = 1 if baseline.schema > _WITHOUT_DESIGNS else 0
        if not least <= run.first_look <= len(run.seeds):
            problem = f"takes {run.first_look} of {len(run.seeds)} seeds at the first look"
            raise EvidenceError(f"the baseline {label}: run {name} {problem}", hint=again)
        wrong = [variant for variant in run.fingerprints if not _is_number(variant)]
        if wrong:
            raise EvidenceError(f"the baseline {label}: run {name} has the variant {wrong[0][:20]!r}", hint=again)
        rows = {f"the fingerprints of {variant}": row for variant, row in run.fingerprints.items()}
        for metric, phases in run.values.items():
            for phase, by_variant in phases.items():
                if by_variant.keys() != run.fingerprints.keys():
                    raise EvidenceError(
                        f"the baseline {label}: run {name} has other variants for {metric} at {phase}", hint=again
                    )
                rows |= {f"{metric} at {phase} of {variant}": row for variant, row in by_variant.items()}  # type: ignore[misc]
        short = [what for what, row in rows.items() if len(row) != len(run.seeds)]
        if short:
            raise EvidenceError(
                f"the baseline {label}: run {name} has {len(run.seeds)} seeds, but not for {short[0]}", hint=again
            )
    if baseline.decision is not None:
        problem = _decision_problem(baseline.decision, baseline.runs)
        if problem:
            raise EvidenceError(f"the baseline {label}: {problem}", hint=again)


def _decision_problem(decision: DecisionState, runs: Mapping[str, BaselineRun]) -> str:
    """Part of a decision that is missing, as after a merge of two files, and would not be compared; empty if none."""
    run = runs.get(decision.run)
    if run is None:
        return f"the decision is that of run {decision.run}, which it lacks"
    for what, rows in (("verdicts", decision.verdicts), ("measures", decision.measures)):
        for variant in sorted(run.fingerprints.keys() ^ rows.keys(), key=_order):
            if variant in rows:
                return f"the decision has {what} of variant {variant}, which run {decision.run} does not try"
            return f"the decision lacks the {what} of variant {variant}"
        names = {name for row in rows.values() for name in row}
        for variant, row in rows.items():
            if names != row.keys():
                return f"the decision lacks {min(names - row.keys())} among the {what} of variant {variant}"
    return ""


def _is_number(variant: str) -> bool:
    return variant.isascii() and variant.isdecimal() and len(variant) < _LONGEST_NUMBER


def _plain(value: Any) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        return {each.name: _plain(getattr(value, each.name)) for each in fields(value)}
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    return [_plain(item) for item in value] if isinstance(value, (tuple, list)) else value


def _text(value: Any, indent: str) -> str:
    deeper = indent + "  "
    if isinstance(value, dict) and value:
        lines = [f"{deeper}{json.dumps(key)}: {_text(value[key], deeper)}" for key in sorted(value, key=_order)]
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    if isinstance(value, list) and any(isinstance(item, (dict, list)) for item in value):
        return "[\n" + ",\n".join(deeper + _text(item, deeper) for item in value) + f"\n{indent}]"
    return json.dumps(value, ensure_ascii=True, allow_nan=False)


def _order(key: str) -> tuple[int, str]:
    """Variants by their number, other names by themselves."""
    return (int(key), "") if _is_number(key) else (-1, key)
