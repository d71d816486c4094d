"""Result of one phase of an execution."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rgss.evidence import Failure, Metric


@dataclass(frozen=True, slots=True, kw_only=True)
class PhaseResult:
    """Outcome and observations of one phase.

    Attributes:
        phase: Name of the phase.
        failure: The failure; None if it is complete.
        detail: Numbers of the failure; empty if it is complete.
        duration_s: Its simulated time.
        metrics: Observations of only this phase, so that a trial that ends earlier has the same ones for the shared
        phases.
    """

    phase: str
    failure: Failure | None
    detail: str
    duration_s: float
    metrics: Mapping[str, Metric]
