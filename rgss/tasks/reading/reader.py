"""Reader of the steps of a task file: the findings, the file's configurations and thresholds, and the expansion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from rgss.documents import Document
from rgss.findings import Finding
from rgss.tasks.reading.thresholds_entry import ThresholdsEntry

Location = tuple[str | int, ...]
MOST_STEPS = 10_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Position:
    """Position of an entry in the file and in the loops around it.

    Attributes:
        at: Location in the file.
        prefix: Beginning of the names of its steps, from the loops.
        object: Default object of its steps, from the loop over objects; empty for that of the scene.
    """

    at: Location
    prefix: str = ""
    object: str = ""

    def within(self, *keys: str | int) -> Position:
        """Position of a part of the entry."""
        return replace(self, at=(*self.at, *keys))


class TaskReader:
    """Reader of the entries of one file.

    Attributes:
        findings: The findings so far.
        configurations: Positions of the joints by configuration.
        thresholds: Default thresholds of the steps.
    """

    def __init__(
        self, document: Document, configurations: Mapping[str, tuple[float, ...]], thresholds: ThresholdsEntry
    ) -> None:
        """Start without findings.

        Args:
            document: The file.
            configurations: Positions of the joints by configuration.
            thresholds: Default thresholds of the steps.
        """
        self.findings: list[Finding] = []
        self.configurations = configurations
        self.thresholds = thresholds
        self._document = document
        self._count = 0

    def count_step(self) -> None:
        """Count a step towards the limit of a task."""
        self._count += 1

    def is_too_long(self, at: Location) -> bool:
        """True, with a finding, if the task has more steps than a task may have.

        Args:
            at: The entry that is being expanded.
        """
        if self._count <= MOST_STEPS:
            return False
        self.report("task.long", f"the task has more than {MOST_STEPS} steps", at, "repeat less often")
        return True

    def report(self, rule: str, message: str, at: Location, hint: str = "") -> None:
        """Add a finding.

        Args:
            rule: Its rule.
            message: The message.
            at: Location in the file.
            hint: How to mend it.
        """
        self.findings.append(self._document.finding(rule, message, at, hint=hint))

    def refuse_not_positive(self, at: Location, **values: float | None) -> None:
        """Add a finding for each value that is stated and not greater than zero.

        Args:
            at: The entry that has them.
            **values: The values by key.
        """
        for key, value in values.items():
            if value is not None and value <= 0.0:
                self.report("task.not-positive", f"{key} must be greater than zero", (*at, key))
