"""Posterior draws of measures observed in replicates, joint over alternatives with common seeds.

Alternatives are modelled as draws from one population whose spread is estimated from them (Gelman et al., "Bayesian
Data Analysis", chapter 5), factor by factor of their design: the best of many estimates is too good on average, and
more so the fewer replicates there are; but a clear effect of a factor is not noise. The correlation of their trials is
preserved: replicate k of every alternative has the same seed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem.alternatives import Array
from rgss.tradeoff.problem.mean_noise import MeanNoise, noise_scores
from rgss.tradeoff.problem.population import drawn_with_population, joint_draws
from rgss.tradeoff.problem.proportion_population import proportion_population

_LEAST_RATIO = 0.02
_LEAST_OWN = 0.05
_UNSEEN = 0.5
"""Jeffreys's prior count of seeds that separate alternatives where none did: one side of Beta(1/2, 1/2)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ObservedRows:
    """Replicates of one measure.

    Attributes:
        values: Quantities, shape (n, r); NaN where a replicate lacks it or was not run.
        is_proportion: Whether each is 0 or 1.
    """

    values: Array
    is_proportion: bool


def posterior_means(
    observed: Sequence[ObservedRows],
    *,
    draws: int,
    generator: np.random.Generator,
    levels: NDArray[np.intp] | None = None,
    apart: bool = False,
) -> list[Array]:
    """Posterior draws of the true mean of each measure.

    Args:
        observed: The replicates of each measure, of the same n alternatives.
        draws: Number of draws.
        generator: Source of randomness.
        levels: The level of each alternative in each factor of its design, as numbers of any kind,
            shape (n, f); None where designs are not made of levels.
        apart: Whether any two alternatives may differ in seeds to come as in none so far. A seed in which one of
            two alone succeeded is then no proof that it is the better one: each side has half a seed more.

    Returns:
        Draws of each measure, shape (draws, n); NaN where no replicate of an alternative is known.
    """
    if not observed:
        return []
    groups = alike_groups(observed)
    most = max(one.values.shape[1] for one in observed)
    inside = max(draws, joint_draws(len(groups)))
    shared = generator.standard_normal((inside, most))
    weights = generator.standard_gamma(1.0, size=(inside, most))
    return [
        (
            _proportions(one.values, groups, weights, generator, apart=apart)
            if one.is_proportion
            else _means(one.values, levels, shared, generator)
        )[:draws]
        for one in observed
    ]


def alike_groups(observed: Sequence[ObservedRows]) -> NDArray[np.intp]:
    """The group of each alternative, shape (n,), that shares the trials behind its proportions.

    Alternatives are alike where no replicate of a proportion, and none of some mean, separates
    them: planning limits that never bind, or tool speeds of the same plans. Equal proportions alone
    are not enough: they are often equal by chance.
    """
    count = len(observed[0].values)
    proportions = [one for one in observed if one.is_proportion]
    means = [one for one in observed if not one.is_proportion]
    group = np.arange(count)
    for mean in means:
        seen: dict[bytes, int] = {}
        for row in range(count):
            rows = [one.values[row] for one in (*proportions, mean)]
            first = seen.setdefault(b"".join(np.ascontiguousarray(each).tobytes() for each in rows), row)
            if group[first] != group[row]:
                group[group == group[row]] = group[first]
    return np.unique(group, return_inverse=True)[1]


def _proportions(
    values: Array, groups: NDArray[np.intp], weights: Array, generator: np.random.Generator, *, apart: bool
) -> Array:
    """Draws of proportions: beta-binomial, with a mixture of beta distributions as the population.

    The prior adds a success and a failure with random weights to those of the seeds: with exponential weights of the
    seeds the proportion has exactly its beta posterior.
    """
    known = ~np.isnan(values)
    found = np.full((len(weights), len(values)), np.nan)
    rows = np.flatnonzero(known.any(axis=1))
    if not len(rows):
        return found
    seen, there = np.where(known, values, 0.0)[rows], known[rows]
    _, first, group = np.unique(groups[rows], return_index=True, return_inverse=True)
    successes, trials = seen.sum(axis=1)[first], there.sum(axis=1)[first]
    # What all alternatives of a seed share does not separate them: only the rest is noise between them, which the
    # population's strength is weighed against.
    rates = (successes / trials)[:, None]
    own = max(_LEAST_OWN, _own_share(np.where(there[first], seen[first] - rates, 0.0), there[first]))
    mean, strength = proportion_population(successes / own, trials / own, draws=len(weights), generator=generator)
    strength = strength * own
    more = generator.standard_gamma(mean * strength)[:, group]
    less = generator.standard_gamma((1.0 - mean) * strength)[:, group]
    # Alternatives that no seed separated may differ in later seeds: each has its own half seed.
    unseen = np.ones(len(rows), dtype=np.bool_) if apart else np.bincount(group)[group] > 1
    shape = (len(weights), int(unseen.sum()))
    size = _UNSEEN if apart else _UNSEEN / 2.0
    more[:, unseen] += generator.standard_gamma(size, size=shape)
    less[:, unseen] += generator.standard_gamma(size, size=shape)
    used = weights[:, : values.shape[1]]
    won = used @ seen.T + more
    total = used @ there.T.astype(np.float64) + more + less
    found[:, rows] = won / np.maximum(total, 1e-300)
    return found


def _own_share(noise: Array, known: NDArray[np.bool_]) -> float:
    """The share of the noise's variance that alternatives do not have in common, seed by seed."""
    count = len(noise)
    total = float((noise**2).sum())
    if count < 2 or total == 0.0:
        return 1.0
    number = known.sum(axis=0)
    common = noise.sum(axis=0) / np.maximum(number, 1)
    rest = float((np.where(known, noise - common, 0.0) ** 2).sum())
    return min(1.0, rest * count / (count - 1) / total)


def _means(values: Array, levels: NDArray[np.intp] | None, shared: Array, generator: np.random.Generator) -> Array:
    """Draws of means, by pivots with noise of pooled form and own width, shrunk to the population.

    Where all values are positive noise is a factor and the population is one of logarithms.
    """
    draws = len(shared)
    found = np.full((draws, len(values)), np.nan)
    if np.isnan(values).all():
        return found
    noise = MeanNoise.of(values)
    rows, counts, positive = noise.rows, noise.counts, noise.positive
    scores = noise_scores(noise.noise, shared[:, : values.shape[1]], noise.group, generator)
    centres = np.log(noise.means) if positive else noise.means
    moved = np.empty((draws, len(rows)))
    for count in np.unique(counts):
        at = counts == count
        # The observed mean is high by so much; the pivot falls where it is.
        high = noise.widths[at] * noise.of_means(int(count), scores[:, at], generator)
        moved[:, at] = -np.log(np.maximum(1.0 + high, _LEAST_RATIO)) if positive else -high
    drawn = drawn_with_population(
        centres + moved,
        noise.group,
        None if levels is None else levels[rows],
        seeds=int(np.median(counts)),
        generator=generator,
    )
    found[:, rows] = np.exp(drawn) if positive else drawn
    return found
