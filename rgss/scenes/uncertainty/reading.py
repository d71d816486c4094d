"""Reader of uncertainty from its document model, with findings."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from rgss.documents import Document
from rgss.errors import QuantityError
from rgss.findings import Finding
from rgss.quantities import parse_quantity
from rgss.scenes.uncertainty.declaration import Correlation, Uncertainty, UncertainValue
from rgss.scenes.uncertainty.distributions import (
    Constant,
    Discrete,
    Distribution,
    LogNormal,
    Normal,
    TruncatedNormal,
    Uniform,
)
from rgss.scenes.uncertainty.document import CorrelationEntry, DistributionEntry
from rgss.scenes.uncertainty.quantities import UncertainQuantity
from rgss.scenes.uncertainty.quantity_names import quantity_of

_KINDS = ("normal", "truncated_normal", "uniform", "lognormal", "discrete", "constant")
_SYMMETRY = 1e-12
_LEAST_EIGENVALUE = 1e-9


def read_uncertainty(
    values: Mapping[str, DistributionEntry],
    correlations: Sequence[CorrelationEntry],
    document: Document,
    findings: list[Finding],
    *,
    declared: Sequence[str] | None = None,
) -> Uncertainty:
    """Read the uncertainty of a scene or a study.

    Args:
        values: The distribution of each quantity.
        correlations: The groups.
        document: The file, for positions, with ``uncertainty`` and ``correlations``.
        findings: List to which findings are added.
        declared: Names allowed in a group in addition to those of `values`; None if unknown here.
    """
    read = []
    for name, entry in values.items():
        distribution = _Reader(name, document, findings).read(entry)
        if distribution is not None:
            read.append(UncertainValue(quantity=name, distribution=distribution))
    groups = []
    taken: set[str] = set()
    known = None if declared is None else {*values, *declared}
    constants = {name for name, entry in values.items() if entry.constant is not None}
    for index, group in enumerate(correlations):
        wrong = _wrong_group(group, taken, known, constants)
        taken.update(group.quantities)
        if wrong:
            message, key, hint = wrong
            findings.append(document.finding("uncertainty.group", message, ("correlations", index, key), hint=hint))
        else:
            groups.append(Correlation(quantities=group.quantities, matrix=group.matrix))
    return Uncertainty(values=tuple(read), correlations=tuple(groups))


class _Reader:
    """Reader of the distribution of one quantity."""

    def __init__(self, name: str, document: Document, findings: list[Finding]) -> None:
        self._quantity: UncertainQuantity = quantity_of(name)
        self._document = document
        self._findings = findings
        self._place: tuple[str | int, ...] = ("uncertainty", name)

    def read(self, entry: DistributionEntry) -> Distribution | None:
        given = [kind for kind in _KINDS if getattr(entry, kind) is not None]
        if len(given) != 1:
            what = "has none" if not given else f"has {' and '.join(given)}"
            self._note("uncertainty.kind", f"{self._quantity.name} needs exactly one distribution and {what}", ())
            return None
        (kind,) = given
        before = len(self._findings)
        distribution = self._distribution(kind, entry)
        if len(self._findings) > before or distribution is None:
            return None
        least = distribution.support[0]
        if not self._quantity.is_possible(least):
            below = f"{self._quantity.least:g} {self._quantity.unit}" if self._quantity.unit != "1" else "0"
            relation = "below" if self._quantity.is_least_allowed else "at or below"
            message = f"{self._quantity.name} cannot be {relation} {below}, and this distribution can"
            self._note("uncertainty.range", message, (kind,), hint="use truncated_normal, uniform or lognormal")
            return None
        return distribution

    def _distribution(self, kind: str, entry: DistributionEntry) -> Distribution | None:
        if entry.normal is not None:
            return Normal(mean=self._value(kind, "mean", entry.normal.mean), sd=self._spread(kind, entry.normal.sd))
        if entry.truncated_normal is not None:
            cut = entry.truncated_normal
            mean, sd = self._value(kind, "mean", cut.mean), self._spread(kind, cut.sd)
            low, high = self._ends(kind, cut.low, cut.high)
            return TruncatedNormal(mean=mean, sd=sd, low=low, high=high)
        if entry.uniform is not None:
            low, high = self._ends(kind, entry.uniform.low, entry.uniform.high)
            return Uniform(low=low, high=high)
        if entry.lognormal is not None:
            median = self._value(kind, "median", entry.lognormal.median)
            if not median > 0.0:
                self._note(
                    "uncertainty.median", "the median of a lognormal must be greater than zero", (kind, "median")
                )
            if not entry.lognormal.geometric_sd > 1.0:
                message = "geometric_sd is a factor and must be greater than 1"
                self._note("uncertainty.spread", message, (kind, "geometric_sd"))
            return LogNormal(median=median, geometric_sd=entry.lognormal.geometric_sd)
        if entry.discrete is not None:
            return self._discrete(kind, entry)
        return Constant(value=self._value("constant", "", entry.constant or ""))

    def _discrete(self, kind: str, entry: DistributionEntry) -> Discrete | None:
        if entry.discrete is None:
            return None
        listed = [self._value(kind, "values", text, index) for index, text in enumerate(entry.discrete.values)]
        weights = entry.discrete.weights or (1.0,) * len(listed)
        if len(weights) != len(listed):
            message = f"there are {len(listed)} values and {len(weights)} weights"
            self._note("uncertainty.weights", message, (kind, "weights"))
        elif any(not 0.0 < weight < math.inf for weight in weights):
            self._note("uncertainty.weights", "weights must be greater than zero", (kind, "weights"))
        if len(set(listed)) < len(listed):
            self._note("uncertainty.values", "a value is listed twice", (kind, "values"), hint="add both weights")
        if len(weights) != len(listed):
            return None
        pairs = sorted(zip(listed, weights, strict=True))
        return Discrete(values=tuple(value for value, _ in pairs), weights=tuple(weight for _, weight in pairs))

    def _ends(self, kind: str, low_text: str, high_text: str) -> tuple[float, float]:
        low, high = self._value(kind, "low", low_text), self._value(kind, "high", high_text)
        if low >= high:
            self._note("uncertainty.ends", "low must be less than high", (kind, "low"))
        return low, high

    def _spread(self, kind: str, text: str) -> float:
        sd = self._value(kind, "sd", text)
        if not sd > 0.0:
            self._note(
                "uncertainty.spread",
                "sd must be greater than zero",
                (kind, "sd"),
                hint="use a constant for a known value",
            )
        return sd

    def _value(self, kind: str, key: str, text: str, *index: int) -> float:
        try:
            return parse_quantity(text, self._quantity.unit)
        except QuantityError as error:
            place: tuple[str | int, ...] = (kind, key, *index) if key else (kind,)
            self._note("uncertainty.unit", f"{self._quantity.name}: {error.message}", place, hint=error.hint)
            return 1.0

    def _note(self, rule: str, message: str, place: tuple[str | int, ...], *, hint: str = "") -> None:
        self._findings.append(self._document.finding(rule, message, (*self._place, *place), hint=hint))


def _wrong_group(
    group: CorrelationEntry, taken: set[str], known: set[str] | None, constants: set[str]
) -> tuple[str, str, str] | None:
    """Message, key and hint of the first error of a group; None if it is valid."""
    size = len(group.quantities)
    if len(set(group.quantities)) < size or taken.intersection(group.quantities):
        return "a quantity is in a group twice", "quantities", "put all correlated quantities in one group"
    missing = [] if known is None else [name for name in group.quantities if name not in known]
    if missing:
        return f"{missing[0]} has no distribution", "quantities", "give it one under 'uncertainty'"
    fixed = [name for name in group.quantities if name in constants]
    if fixed:
        return f"{fixed[0]} is constant and cannot be correlated", "quantities", "take it out of the group"
    if len({quantity_of(name).joint_kind for name in group.quantities}) > 1:
        return "a quantity of each joint can be correlated only with others of the same joints", "quantities", ""
    if any(len(row) != size for row in group.matrix) or len(group.matrix) != size:
        return f"the matrix must have {size} rows of {size} correlations", "matrix", ""
    matrix = np.array(group.matrix)
    if np.abs(matrix - matrix.T).max() > _SYMMETRY or np.abs(np.diag(matrix) - 1.0).max() > _SYMMETRY:
        return "a correlation matrix must be symmetric, with ones on its diagonal", "matrix", ""
    if float(np.linalg.eigvalsh(matrix).min()) < _LEAST_EIGENVALUE:
        return "the correlation matrix must be positive definite", "matrix", "lower the correlations"
    return None
