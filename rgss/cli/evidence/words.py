"""Text of counts and sizes of the evidence."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from rgss.findings import printable

if TYPE_CHECKING:
    from rgss.evidence.store import TrialName


def divided(trials: Iterable[TrialName], named: set[str]) -> tuple[list[TrialName], list[TrialName]]:
    """Split of the trials into named ones and others."""
    current: list[TrialName] = []
    stale: list[TrialName] = []
    for trial in trials:
        (current if trial.key in named else stale).append(trial)
    return current, stale


def by_fidelity(trials: Iterable[TrialName]) -> Mapping[str, int]:
    """Number of trials of each fidelity."""
    return dict(sorted(Counter(trial.fidelity for trial in trials).items()))


def counted_trials(what: str, trials: Iterable[TrialName]) -> str:
    """Number of trials, in all and of each fidelity."""
    numbers = by_fidelity(trials)
    each = ", ".join(f"{number} {printable(fidelity)}" for fidelity, number in numbers.items())
    return f"{sum(numbers.values())} {what}{f' ({each})' if each else ''}"


def size_text(size_bytes: int) -> str:
    """A size in kB or MB."""
    if size_bytes < 1_000_000:
        return f"{size_bytes / 1000:.0f} kB"
    return f"{size_bytes / 1_000_000:.1f} MB"
