"""The trials that options choose in place of those of the study's file, and the words of commands for them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialChoice:
    """Chosen trials of a study; by default those of its file.

    Attributes:
        fidelity: Their fidelity; None for the study's.
        replicates: Trials of each variant; None for the study's number.
        is_nominal: True without uncertainty and workload.
    """

    fidelity: str | None = None
    replicates: int | None = None
    is_nominal: bool = False

    @property
    def words(self) -> tuple[str, ...]:
        """The options of a command that chooses these trials."""
        words: tuple[str, ...] = () if self.fidelity is None else ("--fidelity", self.fidelity)
        words += () if self.replicates is None else ("--replicates", str(self.replicates))
        return (*words, "--nominal") if self.is_nominal else words
