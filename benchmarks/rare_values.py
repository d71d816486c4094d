"""Reported against true probability that a choice is good, where some times are ten times as long; docs/replication.md.

python benchmarks/rare_values.py 300
"""

from __future__ import annotations

import sys

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import ObservedRows, posterior_means
from rgss.tradeoff.robustness import good_selection

Array = NDArray[np.float64]

DESIGNS = 10
REPLICATES = 10
THRESHOLD = 0.85
MARGIN = 0.05
DRAWS = 500


def main() -> None:
    """Print the mean of what is reported, and the share of studies in which the choice is good."""
    studies = int(sys.argv[1]) if len(sys.argv) > 1 else 300
    generator = np.random.default_rng(12)
    for kind in ("5 % ten times longer", "normal, 20 %"):
        outcomes = [one for seed in range(studies) if (one := _study(kind, seed, generator)) is not None]
        reported, good = np.mean(outcomes, axis=0)
        sys.stdout.write(f"{kind}: reported {reported:.2f}, true {good:.2f} ({len(outcomes)} studies with a choice)\n")


def _study(kind: str, seed: int, generator: np.random.Generator) -> tuple[float, float] | None:
    """Reported probability, and whether the choice is good; None where no design is feasible by its estimates."""
    shares, means = generator.uniform(0.6, 1.0, DESIGNS), generator.uniform(8.0, 20.0, DESIGNS)
    generator.random(REPLICATES)
    succeeded = (generator.random((DESIGNS, REPLICATES)) < shares[:, None]).astype(float)
    times = np.clip(means[:, None] * _noise(kind, generator), 0.01, None)
    feasible = succeeded.mean(axis=1) >= THRESHOLD
    if not feasible.any():
        return None
    chosen = int(np.where(feasible, _value(succeeded.mean(axis=1), times.mean(axis=1)), -np.inf).argmax())
    rows = [ObservedRows(values=succeeded, is_proportion=True), ObservedRows(values=times, is_proportion=False)]
    drawn = posterior_means(rows, draws=DRAWS, generator=np.random.default_rng(seed))
    reported = good_selection(_value(*drawn), drawn[0] >= THRESHOLD, chosen, MARGIN)
    true = good_selection(_value(shares, means)[None], (shares >= THRESHOLD)[None], chosen, MARGIN)
    return reported, true


def _noise(kind: str, generator: np.random.Generator) -> Array:
    shape = (DESIGNS, REPLICATES)
    if kind.startswith("normal"):
        return 1.0 + 0.2 * generator.standard_normal(shape)
    usual = 1.0 + 0.1 * generator.standard_normal(shape)
    return np.asarray(usual * np.where(generator.random(shape) < 0.05, 10.0, 1.0) / 1.45)


def _value(shares: Array, times: Array) -> Array:
    return 0.5 * np.clip((shares - 0.6) / 0.4, 0.0, 1.0) + 0.5 * np.clip((25.0 - times) / 20.0, 0.0, 1.0)


if __name__ == "__main__":
    main()
