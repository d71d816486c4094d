"""What a rule of traceability is: an id, a severity, an explanation and a check."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from rgss.findings import Finding, Severity
from rgss.trace.measure_trace import MeasureTrace
from rgss.trace.model import TraceModel


@dataclass(frozen=True, slots=True, kw_only=True)
class Breach:
    """One place where a rule is broken.

    Attributes:
        subject: The element of the requirements, by its id, or the measure.
        message: What is wrong, in one line.
        hint: How to mend it, in one line; may be empty.
        at: The part of the element to point at; a measure is pointed at as a whole.
    """

    subject: str | MeasureTrace
    message: str
    hint: str = ""
    at: tuple[str | int, ...] = ("id",)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """One rule of traceability.

    Attributes:
        id: Its id, such as ``trace.orphan``.
        severity: How much a breach matters.
        explanation: What must hold, and why.
        check: Finds the breaches in a model.
    """

    id: str
    severity: Severity
    explanation: str
    check: Callable[[TraceModel], Iterator[Breach]]

    def findings(self, model: TraceModel) -> Iterator[Finding]:
        """The breaches of the rule as findings in the user's files."""
        for breach in self.check(model):
            yield self._finding(model, breach)

    def _finding(self, model: TraceModel, breach: Breach) -> Finding:
        if isinstance(breach.subject, str):
            return model.requirements.finding(
                self.id, breach.subject, breach.message, at=breach.at, hint=breach.hint, severity=self.severity
            )
        measure = breach.subject
        return Finding(
            file=measure.file,
            line=measure.line,
            column=measure.column,
            rule=self.id,
            severity=self.severity,
            message=breach.message,
            hint=breach.hint,
        )
