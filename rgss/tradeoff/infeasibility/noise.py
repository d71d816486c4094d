"""Effect of the noise of the replicates: evidence resampled from the replicates that there are."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from rgss.tradeoff.infeasibility.conflicts import Conflicts, ConflictSurvival
from rgss.tradeoff.problem import FEWEST_REPLICATES, EvidenceTable, Resamples, Samples, bootstrap
from rgss.tradeoff.programs import violations

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from rgss.tradeoff.programs import Preferences

RESAMPLES = 1_000
"""Number of resamples of the replicates where there are too many distinct ones to evaluate each."""


def resampled_tables(table: EvidenceTable, resamples: Resamples) -> Iterator[EvidenceTable]:
    """Bootstrap resamples of the evidence: replicates drawn with replacement.

    The replicates of all alternatives share their seeds, so one draw of seeds applies to all of them and preserves
    their correlation. A quantity moves with the mean of its replicates; it is unknown if no replicate of a draw has it.

    Args:
        table: The evidence.
        resamples: Count of each replicate in each draw.

    Yields:
        A table for each draw.
    """
    means = {measure: _means(samples) for measure, samples in table.samples.items()}
    for counts in resamples.counts:
        draw = np.repeat(np.arange(len(counts)), counts)
        quantities = table.quantities.copy()
        drawn_samples = {}
        for measure, samples in table.samples.items():
            drawn = _drawn(samples, draw)
            drawn_samples[measure] = drawn
            if measure in table.measures:
                place = table.measures.index(measure)
                quantities[:, place] += _means(drawn) - means[measure]
        yield replace(table, quantities=quantities, samples=drawn_samples)


def conflict_survival(
    preferences: Preferences, table: EvidenceTable, conflicts: Conflicts, *, resamples: int = RESAMPLES, seed: int = 0
) -> Conflicts:
    """Share of resamples of the replicates in which each conflict is still present.

    Args:
        preferences: Preferences that the alternatives are compared by.
        table: The evidence.
        conflicts: The conflicts that it has.
        resamples: Number of resamples where there are too many distinct ones to evaluate each.
        seed: Seed of the draws.

    Returns:
        The conflicts with their survival; as they are where no measure has two replicates.
    """
    replicates = max((samples.values.shape[1] for samples in table.samples.values()), default=0)
    if replicates < FEWEST_REPLICATES:
        return conflicts
    drawn = bootstrap(replicates, draws=resamples, generator=np.random.default_rng(seed))
    names = preferences.requirements
    members = [[names.index(requirement) for requirement in each] for each in conflicts.minimal_conflicts]
    # What is always there keeps a probability of exactly 1, because only the rest is taken away.
    nothing = 1.0
    still = np.ones(len(members))
    for probability, resampled in zip(drawn.probabilities.tolist(), resampled_tables(table, drawn), strict=True):
        violated = violations(preferences, resampled)
        nothing -= probability * bool((~violated.any(axis=1)).any())
        still -= [probability * bool((~violated[:, places].any(axis=1)).any()) for places in members]
    return replace(
        conflicts,
        survival=ConflictSurvival(
            resamples=len(drawn.counts),
            exact=drawn.exact,
            nothing_feasible=max(0.0, nothing),
            conflicts=tuple(max(0.0, float(share)) for share in still),
        ),
    )


def _drawn(samples: Samples, draw: NDArray[np.int64]) -> Samples:
    """The replicates of a draw; of an alternative with fewer replicates, those of them that are drawn.

    An alternative none of whose replicates is drawn keeps its own.
    """
    width = samples.values.shape[1]
    places = draw[draw < width]
    values, ran = samples.values[:, places], samples.ran[:, places]
    left_out = ~ran.any(axis=1) & samples.ran.any(axis=1)
    if not left_out.any():
        return Samples(values=values, ran=ran)
    padded = np.full((len(values), max(width, len(places))), np.nan)
    padded_ran = np.zeros(padded.shape, dtype=np.bool_)
    padded[:, : len(places)], padded_ran[:, : len(places)] = values, ran
    padded[left_out, :width], padded_ran[left_out, :width] = samples.values[left_out], samples.ran[left_out]
    return Samples(values=padded, ran=padded_ran)


def _means(samples: Samples) -> NDArray[np.float64]:
    """The mean of the replicates that have a quantity, shape (n,); NaN where none does."""
    known = samples.ran & ~np.isnan(samples.values)
    counts = known.sum(axis=1)
    totals = np.where(known, samples.values, 0.0).sum(axis=1)
    return np.where(counts > 0, totals / np.maximum(counts, 1), np.nan)
