"""Expected gain of value by more replicates as it is stated, beside what is gained, on emulated studies.

Run it from the repository's folder; nothing is simulated by an engine:

``python benchmarks/expected_gain.py [REPETITIONS] [KIND]``

Each repetition draws the truth of 12 designs and the replicates of a study of them, and states the gain of more. Then
the further replicates are drawn from the truth, the choice is made again by the estimates, and the difference of the
true values of both choices is what was gained; an infeasible choice is worth nothing. The exit status is 1 if the means
differ by more than three standard errors of their difference, and by more than a tenth; not for `UNDERSTATED`.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff import Alternative, Comparison, PiecewiseValue, Threshold, TradeProblem, Weighting
from rgss.tradeoff.problem import tabulated
from rgss.tradeoff.programs import enumerate_alternatives
from rgss.tradeoff.robustness import PosteriorOutcomes, replication_gains

Array = NDArray[np.float64]

DESIGNS = 12
MORE = (1, 10, 30)
REPETITIONS = 200
LIMIT = 0.9
UNDERSTATED = "limit on success, n = 4"
"""Of few trials the choice is too often taken for feasible, so that little seems to be gained over it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """A kind of emulated studies.

    Attributes:
        count: Number of replicates.
        spread: Standard deviation of the logarithms of the designs' true times.
        sigma: That of the replicates of one design.
        common: Share of its variance that all designs of a seed have in common.
        least: Least true share of success; the greatest is 1.
        valued: Weight of the share of success.
        limited: Whether the share of success has a limit.
    """

    count: int
    spread: float
    sigma: float
    common: float
    least: float
    valued: float
    limited: bool


KINDS: Mapping[str, Kind] = {
    "clear times": Kind(count=10, spread=0.3, sigma=0.2, common=0.0, least=1.0, valued=0.0, limited=False),
    "near times": Kind(count=10, spread=0.03, sigma=0.2, common=0.0, least=1.0, valued=0.0, limited=False),
    "near times, common seeds": Kind(
        count=10, spread=0.03, sigma=0.2, common=0.8, least=1.0, valued=0.0, limited=False
    ),
    "skewed times": Kind(count=10, spread=0.2, sigma=0.8, common=0.3, least=1.0, valued=0.0, limited=False),
    "success valued, 0.5 to 1": Kind(count=10, spread=0.1, sigma=0.2, common=0.3, least=0.5, valued=0.2, limited=False),
    "success valued, 0.98 to 1": Kind(
        count=10, spread=0.3, sigma=0.2, common=0.0, least=0.98, valued=0.2, limited=False
    ),
    UNDERSTATED: Kind(count=4, spread=0.1, sigma=0.2, common=0.3, least=0.7, valued=0.2, limited=True),
    "limit on success, n = 10": Kind(count=10, spread=0.1, sigma=0.2, common=0.3, least=0.7, valued=0.2, limited=True),
}


def main() -> int:
    """Print a table of the kinds; 1 if a stated gain is not what is gained."""
    repetitions = int(sys.argv[1]) if len(sys.argv) > 1 else REPETITIONS
    kinds = {name: kind for name, kind in KINDS.items() if len(sys.argv) < 3 or sys.argv[2] in name}
    sys.stdout.write("| studies | more | stated | gained | standard error of the difference | matched moments |\n")
    sys.stdout.write("|---|---:|---:|---:|---:|---:|\n")
    right = True
    for name, kind in kinds.items():
        rows = np.array([_one(kind, np.random.default_rng([run, len(name)])) for run in range(repetitions)])
        for place, label in enumerate([*map(str, MORE), "perfect"]):
            stated, gained, matched = rows[:, place].T
            error = float((stated - gained).std(ddof=1)) / math.sqrt(repetitions)
            off = abs(float(stated.mean() - gained.mean()))
            right &= name == UNDERSTATED or off <= max(3.0 * error, 0.1 * float(stated.mean()))
            figures = (stated.mean(), gained.mean(), error, matched.mean())
            sys.stdout.write(f"| {name} | {label} | {' | '.join(f'{one:.4f}' for one in figures)} |\n")
        sys.stdout.flush()
    return int(not right)


def _one(kind: Kind, generator: np.random.Generator) -> list[tuple[float, float, float]]:
    """Stated gain, real gain and the gain by matched moments, of each number of more and of perfect knowledge."""
    fixed = generator.uniform(0.3, 0.6, DESIGNS)
    times = 10.0 * generator.lognormal(0.0, kind.spread, DESIGNS)
    chances = generator.uniform(kind.least, 1.0, DESIGNS)
    success, drawn = _replicates(kind, times, chances, kind.count + max(MORE), generator)
    problem = _problem(kind, fixed, success[:, : kind.count], drawn[:, : kind.count])
    true = np.where((chances >= LIMIT) | (not kind.limited), _values(kind, fixed, times, chances), 0.0)
    now = _choice(problem)
    if now is None:
        return [(0.0, 0.0, 0.0)] * (len(MORE) + 1)
    found = PosteriorOutcomes.of(problem, tabulated(problem.alternatives), {"S"}, generator=generator)
    stated = replication_gains(found, now, generator=generator, more=MORE)
    worth = np.where(found.outcomes.feasible, np.nan_to_num(found.totals), 0.0)
    rows = []
    for count, gain in stated.of_more:
        size = kind.count + count
        later = _choice(_problem(kind, fixed, success[:, :size], drawn[:, :size]))
        rows.append((gain, (0.0 if later is None else true[later]) - true[now], _matched(worth, count / size)))
    return [*rows, (stated.perfect, float(true.max()) - true[now], _matched(worth, 1.0))]


def _replicates(
    kind: Kind, times: Array, chances: Array, count: int, generator: np.random.Generator
) -> tuple[Array, Array]:
    """Successes and times of replicates whose seeds designs have in common, shape (n, count); NaN after a failure."""
    from scipy.special import ndtr

    def scores() -> Array:
        common = generator.standard_normal(count)
        own = generator.standard_normal((DESIGNS, count))
        return np.asarray(math.sqrt(kind.common) * common + math.sqrt(1.0 - kind.common) * own)

    success = (ndtr(scores()) < chances[:, None]).astype(np.float64)
    drawn = times[:, None] * np.exp(kind.sigma * scores() - kind.sigma**2 / 2.0)
    return success, np.where(success > 0.0, drawn, np.nan)


def _problem(kind: Kind, fixed: Array, success: Array, drawn: Array) -> TradeProblem:
    alternatives = []
    for place, worth in enumerate(fixed):
        known = drawn[place][~np.isnan(drawn[place])]
        alternatives.append(
            Alternative(
                variant=place + 1,
                measures={
                    "worth": float(worth),
                    "S": float(success[place].mean()),
                    "t": float(known.mean()) if len(known) else None,
                },
                samples={
                    "S": tuple(success[place].tolist()),
                    "t": tuple(None if math.isnan(each) else each for each in drawn[place].tolist()),
                },
            )
        )
    limit = Threshold(requirement="R", measure="S", comparison=Comparison.AT_LEAST, value=LIMIT, unit="1")
    return TradeProblem(
        alternatives=tuple(alternatives),
        thresholds=(limit,) if kind.limited else (),
        value_functions=(
            PiecewiseValue(measure="worth", worst=0.0, best=1.0),
            PiecewiseValue(measure="S", worst=0.5, best=1.0),
            PiecewiseValue(measure="t", worst=30.0, best=0.0),
        ),
        weighting=Weighting(weights={"worth": 0.2, "S": kind.valued, "t": 0.8 - kind.valued}),
    )


def _values(kind: Kind, fixed: Array, times: Array, chances: Array) -> Array:
    """Weighted values, written anew."""
    of_times = np.clip((30.0 - times) / 30.0, 0.0, 1.0)
    of_chances = np.clip((chances - 0.5) / 0.5, 0.0, 1.0)
    return np.asarray(0.2 * fixed + kind.valued * of_chances + (0.8 - kind.valued) * of_times)


def _choice(problem: TradeProblem) -> int | None:
    found = enumerate_alternatives(problem)
    worth = np.where(found.feasible, found.values, -np.inf)
    return int(worth.argmax()) if found.feasible.any() else None


def _matched(worth: Array, share: float) -> float:
    """The gain of who takes the best mean of the draws, narrowed by √(m / (n + m)) (Heath and others 2018)."""
    means = worth.mean(axis=0)
    moved = means + math.sqrt(share) * (worth - means)
    return max(0.0, float(moved.max(axis=1).mean() - means.max()))


if __name__ == "__main__":
    sys.exit(main())
