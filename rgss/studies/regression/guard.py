"""Guard of a study's metrics: watched trials, guarded metrics and their margins."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.evidence import Fidelity
from rgss.regression import Guard


@dataclass(frozen=True, slots=True, kw_only=True)
class WatchedRun:
    """Trials in which metrics are guarded.

    Attributes:
        id: Their name.
        fidelity: Their fidelity.
        variants: The variants, as ``--only`` takes them.
        replicates: Seeds at the first look.
        batch: Seeds that each further look adds.
        cap: The most seeds.
    """

    id: str
    fidelity: Fidelity
    variants: str
    replicates: int
    batch: int
    cap: int

    @property
    def looks(self) -> int:
        """Greatest number of looks."""
        return 1 + -(-(self.cap - self.replicates) // self.batch)

    def seeds_at(self, look: int) -> int:
        """Number of seeds at a look, counted from 1."""
        return min(self.cap, self.replicates + (look - 1) * self.batch)


@dataclass(frozen=True, slots=True, kw_only=True)
class GuardedMetric:
    """A metric that is guarded.

    Attributes:
        metric: Its name.
        guard: Its guard.
        runs: The runs in which it is compared.
        phases: The phases, or ``trial``.
        wherever: Whether it is compared in those of the phases alone that observe it.
    """

    metric: str
    guard: Guard
    runs: tuple[str, ...]
    phases: tuple[str, ...]
    wherever: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class RegressionGuard:
    """Guard of a study: watched trials and guarded metrics.

    Attributes:
        error_rate: The probability of any false alarm.
        runs: The trials.
        metrics: The metrics.
        decision: The run among whose variants is decided; None if no decision is guarded.
    """

    error_rate: float
    runs: tuple[WatchedRun, ...]
    metrics: tuple[GuardedMetric, ...]
    decision: str | None
