"""Error rates of verdicts and calibration of the reported probabilities, on emulated data.

Run it from the repository's folder; nothing is simulated:

- ``python benchmarks/calibration.py verdicts [REPETITIONS]``: false "met" and "not met" of means and proportions.
- ``python benchmarks/calibration.py feasible [REPETITIONS]``: reported probability of feasibility, and the truth.
- ``python benchmarks/calibration.py choice [REPETITIONS]``: the same of the chosen design; it judges nothing.
- ``python benchmarks/calibration.py first [REPETITIONS]``: reported standard error of ``first``, and the real one.
- ``python benchmarks/calibration.py decided [REPETITIONS]``: reported probability of good selection, and the truth.
- ``python benchmarks/calibration.py``: all of them; 1 if a stated rate is exceeded.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray
from scipy import stats
from until_decided import made_up, until_decided

from rgss.measures import proportion_estimate
from rgss.measures.mean_limits import mean_limits
from rgss.tradeoff import Alternative, Comparison, PiecewiseValue, Threshold, TradeProblem, Weighting
from rgss.tradeoff.problem import ObservedRows, posterior_means, tabulated
from rgss.tradeoff.robustness import PosteriorOutcomes, admitted_weights, smaa2
from rgss.tradeoff.sequential import SequentialRule

Array = NDArray[np.float64]
Drawing = Callable[[np.random.Generator, tuple[int, ...]], Array]

SIZES = (3, 10, 30)
NOMINAL = 0.025
REPETITIONS = 2_000
FEWER_REPETITIONS = 200
POINTS = 0.03
"""A probability may be off by so much; the standard error of a share of 200 is as large."""

LIMIT = 0.9


def main() -> int:
    """Run the command of the arguments; 1 if a stated rate is exceeded."""
    command, *arguments = sys.argv[1:] or ["all"]
    count = int(arguments[0]) if arguments else None
    parts: Mapping[str, Callable[[], bool]] = {
        "verdicts": lambda: verdicts(count or REPETITIONS),
        "feasible": lambda: feasible(count or REPETITIONS),
        "choice": lambda: choice(count or FEWER_REPETITIONS),
        "first": lambda: first(count or FEWER_REPETITIONS),
        "decided": lambda: decided(count or FEWER_REPETITIONS),
    }
    chosen = parts if command == "all" else {command: parts[command]}
    results = [part() for part in chosen.values()]
    return int(not all(results))


def _mixture(share: float) -> Drawing:
    """Mixture of times of which some are ten times as long; the mean is 1."""

    def draw(generator: np.random.Generator, shape: tuple[int, ...]) -> Array:
        longer = np.where(generator.random(shape) < share, 10.0, 1.0)
        return generator.normal(1.0, 0.1, shape) * longer / (1.0 + 9.0 * share)

    return draw


def _lognormal(sigma: float) -> Drawing:
    return lambda generator, shape: generator.lognormal(-(sigma**2) / 2.0, sigma, shape)


TIMES: Mapping[str, Drawing] = {
    "normal, 20 %": lambda generator, shape: generator.normal(1.0, 0.2, shape),
    "lognormal, 0.5": _lognormal(0.5),
    "lognormal, 1.0": _lognormal(1.0),
    "exponential": lambda generator, shape: generator.exponential(1.0, shape),
    "2 % ten times longer": _mixture(0.02),
    "5 % ten times longer": _mixture(0.05),
    "10 % ten times longer": _mixture(0.10),
}
"""Distributions of times, each with a mean of 1."""


def student(rows: Array) -> tuple[Array, Array]:
    """Student's limits."""
    count = rows.shape[1]
    half = stats.t.ppf(1.0 - NOMINAL, count - 1) * rows.std(axis=1, ddof=1) / math.sqrt(count)
    return rows.mean(axis=1) - half, rows.mean(axis=1) + half


def johnson(rows: Array) -> tuple[Array, Array]:
    """Student's limits, moved for skewness (Johnson 1978)."""
    count = rows.shape[1]
    third = ((rows - rows.mean(axis=1, keepdims=True)) ** 3).mean(axis=1)
    moved = third / (6.0 * np.maximum(rows.var(axis=1, ddof=1), 1e-300) * count)
    low, high = student(rows)
    return low + moved, high + moved


def shipped(rows: Array) -> tuple[Array, Array]:
    """Limits by the product of a time without a declared bound."""
    limits = [mean_limits(row, least=0.0, most=None, tail=NOMINAL) for row in rows.tolist()]
    return np.array([low for low, _ in limits]), np.array([high for _, high in limits])


def verdicts(repetitions: int) -> bool:
    """Rates of false verdicts with the truth at the threshold, where they are greatest."""
    out, kept = sys.stdout, True
    out.write(
        "| times | n | false met: Student | Johnson | shipped | false not met: Student | Johnson | shipped "
        "| median upper limit / mean |\n|---|---|---|---|---|---|---|---|---|\n"
    )
    for name, draw in TIMES.items():
        for count in SIZES:
            rows = draw(np.random.default_rng([count, len(name)]), (repetitions, count))
            found = [method(rows) for method in (student, johnson, shipped)]
            met = [float(np.mean(high < 1.0)) for _, high in found]
            missed = [float(np.mean(low > 1.0)) for low, _ in found]
            cells = [f"{rate:.1%}" for rate in (*met, *missed)]
            out.write(
                f"| {name} | {count} | {' | '.join(cells)} | {np.median(found[-1][1] / rows.mean(axis=1)):.2f} |\n"
            )
            kept &= max(met[-1], missed[-1]) <= NOMINAL
    out.write(
        "\n| proportions: worst of 19 truths | n | false met: Jeffreys | Wilson | shipped | false not met: shipped |\n"
    )
    out.write("|---|---|---|---|---|---|\n")
    for count in SIZES:
        rates = np.array([_proportion_rates(count, truth, repetitions) for truth in np.linspace(0.05, 0.95, 19)])
        worst = rates.max(axis=0)
        out.write(f"| | {count} | {' | '.join(f'{rate:.1%}' for rate in worst)} |\n")
        # Simulated rates of exact limits may exceed the nominal one by chance: three standard errors.
        kept &= max(worst[2:]) <= NOMINAL + 3.0 * math.sqrt(NOMINAL / repetitions)
    out.write("\n")
    return kept


def _proportion_rates(count: int, truth: float, repetitions: int) -> list[float]:
    drawn = np.random.default_rng([count, round(1000 * truth)]).binomial(count, truth, repetitions)
    ones = np.arange(count + 1)
    jeffreys = stats.beta.ppf(NOMINAL, ones + 0.5, count - ones + 0.5)
    wilson = np.array([stats.binomtest(int(k), count).proportion_ci(method="wilson").low for k in ones])
    limits = [proportion_estimate(int(k), count) for k in ones]
    low, high = np.array([one.low for one in limits]), np.array([one.high for one in limits])
    return [float(np.mean(ends[drawn] > truth)) for ends in (jeffreys, wilson, low)] + [
        float(np.mean(high[drawn] < truth))
    ]


def feasible(repetitions: int) -> bool:
    """Reported probability that a share of success of 90 % is kept, over populations of designs.

    Beside it is the range that the counts leave open whatever the method; where that is wider than 6
    points no method keeps within 3 points of every population.
    """
    populations: Mapping[str, Callable[[np.random.Generator], Array]] = {
        "70 % feasible": lambda g: np.where(g.random(24) < 0.7, g.uniform(0.9, 1.0, 24), g.uniform(0.3, 0.9, 24)),
        "70 % feasible, rest hopeless": lambda g: np.where(
            g.random(24) < 0.7, g.uniform(0.93, 1.0, 24), g.uniform(0.0, 0.5, 24)
        ),
        "uniform from 0.5 to 1": lambda g: g.uniform(0.5, 1.0, 24),
        "all alike, 0.95": lambda _: np.full(24, 0.95),
    }
    out = sys.stdout
    out.write("| population of 24 designs | n | truly feasible | reported | by resampling | what counts can know |\n")
    out.write("|---|---|---|---|---|---|\n")
    kept = True
    for name, population in populations.items():
        for count in SIZES:
            sums = np.zeros(3)
            runs = max(1, repetitions // 24)
            for run in range(runs):
                generator = np.random.default_rng([run, count])
                truth = population(generator)
                rows = (generator.random((24, count)) < truth[:, None]).astype(float)
                observed = [ObservedRows(values=rows, is_proportion=True)]
                (drawn,) = posterior_means(observed, draws=500, generator=generator)
                again = generator.binomial(count, rows.mean(axis=1), (500, 24)) / count
                sums += [np.mean(truth >= LIMIT), np.mean(drawn >= LIMIT), np.mean(again >= LIMIT - 1e-9)]
            true, reported, resampled = sums / runs
            out.write(f"| {name} | {count} | {true:.2f} | {reported:.2f} | {resampled:.2f} |")
            low, high = _knowable(population, count)
            out.write(f" {low:.2f} to {high:.2f} |\n")
            kept &= abs(true - reported) <= POINTS
    out.write("\n")
    return kept


def choice(repetitions: int) -> bool:
    """Reported probability that the chosen design keeps its limit on success, beside how often it does.

    The choice is the best by a value without noise of those whose estimates keep the limit. Of few trials no prior is
    right for all populations, so that nothing is judged.
    """
    populations: Mapping[str, tuple[float, Callable[[np.random.Generator, int], Array]]] = {
        "uniform from 0.5 to 1": (0.9, lambda g, n: g.uniform(0.5, 1.0, n)),
        "uniform from 0.7 to 1": (0.9, lambda g, n: g.uniform(0.7, 1.0, n)),
        "uniform from 0.95 to 1": (0.98, lambda g, n: g.uniform(0.95, 1.0, n)),
        "70 % from 0.9 to 1, rest from 0.3": (
            0.9,
            lambda g, n: np.where(g.random(n) < 0.7, g.uniform(0.9, 1.0, n), g.uniform(0.3, 0.9, n)),
        ),
        "70 % from 0.93 to 1, rest up to 0.5": (
            0.9,
            lambda g, n: np.where(g.random(n) < 0.7, g.uniform(0.93, 1.0, n), g.uniform(0.0, 0.5, n)),
        ),
        "all alike, 0.95": (0.9, lambda _, n: np.full(n, 0.95)),
        "all alike, 0.85": (0.9, lambda _, n: np.full(n, 0.85)),
    }
    out = sys.stdout
    out.write(
        "| population | limit | designs | n | choices | truly feasible | reported |\n|---|---|---|---|---|---|---|\n"
    )
    for name, (limit, population) in populations.items():
        for designs, count in ((2, 4), (12, 4), (12, 30)):
            rows = []
            for run in range(repetitions):
                generator = np.random.default_rng([run, designs, count])
                truth = population(generator, designs)
                worth = generator.random(designs)
                values = (generator.random((designs, count)) < truth[:, None]).astype(float)
                kept = values.mean(axis=1) >= limit - 1e-9
                if kept.any():
                    chosen = int(np.where(kept, worth, -1.0).argmax())
                    observed = [ObservedRows(values=values, is_proportion=True)]
                    (drawn,) = posterior_means(observed, draws=250, generator=generator)
                    rows.append((truth[chosen] >= limit, (drawn[:, chosen] >= limit).mean()))
            true, reported = np.mean(rows, axis=0)
            out.write(f"| {name} | {limit} | {designs} | {count} | {len(rows)} | {true:.2f} | {reported:.2f} |\n")
            out.flush()
    out.write("\n")
    return True


def _knowable(population: Callable[[np.random.Generator], Array], count: int) -> tuple[float, float]:
    """Least and greatest share of feasible designs among populations that show the same successes.

    Of infinitely many designs, each tried ``count`` times, the shares that have 0, 1, … successes are
    known and nothing more; populations that agree in these cannot be told apart by any method. They are
    found by linear programs over proportions on a grid.
    """
    from scipy.optimize import linprog

    generator = np.random.default_rng(0)
    truth = np.concatenate([population(generator) for _ in range(2_000)])
    grid, won = np.linspace(0.0, 1.0, 1_001), np.arange(count + 1)
    # To the nearest of the grid, so that the population itself is among those that agree.
    truth = np.clip(np.where(truth >= LIMIT, np.ceil(1_000 * truth), np.floor(1_000 * truth)) / 1_000, 0.0, 1.0)
    shown = stats.binom.pmf(won[:, None], count, truth).mean(axis=1)
    rates = stats.binom.pmf(won[:, None], count, grid)
    feasible_ones = (grid >= LIMIT - 1e-9).astype(float)
    ends = []
    for sign in (1.0, -1.0):
        found = linprog(
            sign * feasible_ones,
            A_ub=np.vstack([rates, -rates]),
            b_ub=np.concatenate([shown, -shown]) + 1e-9,
            A_eq=np.ones((1, len(grid))),
            b_eq=[1.0],
        )
        ends.append(sign * found.fun if found.status == 0 else math.nan)
    return ends[0], ends[1]


def first(repetitions: int) -> bool:
    """The standard deviation of ``first`` over repeated studies, beside the one that each reports."""
    out, kept = sys.stdout, True
    out.write("| n | real standard error of first | reported, mean | of the draws alone |\n|---|---|---|---|\n")
    worth = np.array([0.50, 0.48, 0.45, 0.40, 0.52, 0.46])
    means = np.array([10.0, 9.0, 8.0, 7.0, 11.0, 9.5])
    for count in SIZES:
        firsts, errors = [], []
        for run in range(repetitions):
            generator = np.random.default_rng([run, count])
            rows = means[:, None] * _lognormal(0.4)(generator, (6, count))
            problem = TradeProblem(
                alternatives=tuple(
                    Alternative(
                        variant=place,
                        measures={"worth": float(worth[place - 1]), "t": float(row.mean())},
                        samples={"t": tuple(row.tolist())},
                    )
                    for place, row in enumerate(rows, start=1)
                ),
                thresholds=(
                    Threshold(requirement="R", measure="t", comparison=Comparison.AT_MOST, value=14.0, unit="s"),
                ),
                value_functions=(
                    PiecewiseValue(measure="worth", worst=0.3, best=0.6),
                    PiecewiseValue(measure="t", worst=15.0, best=5.0),
                ),
                weighting=Weighting(weights={"worth": 0.5, "t": 0.5}),
            )
            found = PosteriorOutcomes.of(problem, tabulated(problem.alternatives), (), generator=generator, draws=300)
            admitted = admitted_weights(problem)
            firsts.append(smaa2(found.outcomes, admitted, iterations=2_000, generator=generator).first)
            errors.append(found.first_errors(admitted, generator))
        real, reported = np.std(firsts, axis=0, ddof=1), np.mean(errors, axis=0)
        alone = math.sqrt(0.25 / 20_000)
        out.write(f"| {count} | {_list(real)} | {_list(reported)} | {alone:.3f} |\n")
        kept &= bool(0.67 <= reported.mean() / real.mean() <= 1.5)
    out.write("\n")
    return kept


def decided(repetitions: int) -> bool:
    """Probability that a sweep until decided reports of its choice, beside how often the choice is good."""
    out, kept = sys.stdout, True
    out.write("| times | repetitions | reported | good | trials |\n|---|---|---|---|---|\n")
    rule = SequentialRule(batch=16, cap=96, verdict_cap=32)
    for name in ("normal, 20 %", "lognormal, 0.5", "lognormal, 1.0", "5 % ten times longer"):
        reported, good, trials = [], [], []
        for run in range(repetitions):
            generator = np.random.default_rng([run, len(name)])
            truth = [
                (generator.uniform(0.4, 0.6), generator.uniform(0.85, 1.0), generator.uniform(8.0, 14.0))
                for _ in range(5)
            ]
            rows = {}
            for variant, (_, chance, mean) in enumerate(truth, start=1):
                success = generator.random(rule.cap) < chance
                time = mean * TIMES[name](generator, (rule.cap,))
                rows[variant] = {"S": success.astype(float), "t": np.where(success, time, np.nan)}
            answer, wanted, probability = until_decided(made_up(truth), rows, rule)
            reported.append(probability)
            good.append(answer.variant in _good_choices(truth, rule.margin))
            trials.append(sum(wanted.values()))
        means = float(np.mean(reported)), float(np.mean(good))
        out.write(f"| {name} | {repetitions} | {means[0]:.3f} | {means[1]:.3f} | {np.mean(trials):.0f} |\n")
        out.flush()
        kept &= abs(means[0] - means[1]) <= POINTS
    return kept


def _good_choices(truth: list[tuple[float, float, float]], margin: float) -> set[int | None]:
    """The feasible variants within the margin of the best; None alone where there is none."""
    values = {
        variant: 0.6 * worth + 0.2 * max(0.0, (chance - 0.8) / 0.2) + 0.2 * (25.0 - time) / 20.0
        for variant, (worth, chance, time) in enumerate(truth, start=1)
        if chance >= 0.9 and time <= 11.5
    }
    return {variant for variant, value in values.items() if value >= max(values.values()) - margin} or {None}


def _list(numbers: Array) -> str:
    return ", ".join(f"{number:.2f}" for number in numbers)


if __name__ == "__main__":
    sys.exit(main())
