"""Result of one phase of an execution."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rgss.evidence import Failure, Metric


@dataclass(frozen=True, slots=True, kw_only=True)
class PhaseResult:
    """Outcome and observations of one phase.

    Attributes:
        phase: Which of the eight states.
        failure: What went wrong; None if it is complete.
        detail: The numbers that show the failure; empty if it is complete.
        duration_s: Simulated time that it took.
        metrics: Observations of this phase alone, so that a trial that ends earlier has the
            same ones for the phases that it shares.
    """

    phase: str
    failure: Failure | None
    detail: str
    duration_s: float
    metrics: Mapping[str, Metric]
