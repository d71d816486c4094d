"""Random trade-offs for every program: with ties, near-ties, degenerate ranges, gaps, infeasible sets.

Used by ``benchmarks/tradeoff_agreement.py`` and by the tests.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable

from rgss.tradeoff import (
    AdditiveValue,
    Aim,
    Alternative,
    ChanceBound,
    Comparison,
    ElicitedInterval,
    ElicitedOrder,
    EpsilonConstraint,
    ExponentialValue,
    Incompatibility,
    LevelFactor,
    LevelSpace,
    LevelStructure,
    Lexicographic,
    MinimaxRegret,
    PiecewiseValue,
    PortfolioAim,
    PortfolioProblem,
    PortfolioTask,
    Program,
    Scenarios,
    TailBound,
    TargetValue,
    Tchebycheff,
    Threshold,
    TradeProblem,
    ValueFunction,
    WeightBounds,
    Weighting,
)

CLOSED = (Comparison.AT_LEAST, Comparison.AT_MOST)
"""Comparisons that a program can have."""

SIZES = (1, 2, 3, 8, 20, 72)
"""Numbers of alternatives."""

Row = dict[str, float | None]


def random_problem(rng: random.Random, program: str, *, levels: bool = False) -> TradeProblem:
    """A random trade-off under a program.

    Args:
        rng: The source of randomness.
        program: ``additive``, ``lexicographic``, ``epsilon_constraint``, ``tchebycheff``,
            ``minimax_regret`` or ``risk`` (additive with chance and tail constraints).
        levels: Whether the alternatives are combinations of levels, and levels are chosen.
    """
    names = "abcd"[: rng.randrange(1, 5)]
    structure = random_structure(rng) if levels else None
    variants = sorted(structure.levels) if structure else rng.sample(range(1, 200), rng.choice(SIZES))
    rng.shuffle(variants)
    draw = _quantities(rng, names, structure)
    measures = {variant: draw(variant) for variant in variants}
    weighting = _weighting(rng, names)
    sampled = program == "risk" or (program == "minimax_regret" and rng.random() < 0.4)
    samples = _samples(rng, measures, names) if sampled else {variant: {} for variant in variants}
    alternatives = tuple(
        Alternative(variant=variant, measures=measures[variant], samples=samples[variant]) for variant in variants
    )
    # Regret over replicates needs a weighted measure that has some.
    replicates = sampled and any(name in samples[variants[0]] for name in weighting.deciding_measures)
    bounds = _weight_bounds(rng, weighting) if program == "minimax_regret" and not replicates else WeightBounds()
    return TradeProblem(
        alternatives=alternatives,
        thresholds=_thresholds(rng, measures, names),
        value_functions=tuple(_value_function(rng, name, measures) for name in names),
        weighting=weighting,
        risks=_risks(rng, samples, names) if program == "risk" else (),
        program=_program(rng, program, names, measures, weighting, replicates=replicates),
        weight_bounds=bounds,
        levels=structure,
    )


def random_portfolio(rng: random.Random) -> PortfolioProblem:
    """A random portfolio problem over one to four tasks."""
    count = rng.choice([1, 2, 4, 8, 14])
    variants = rng.sample(range(1, 100), count)
    shares = [rng.choice([1, 1, 2, 5]) for _ in range(rng.randrange(1, 5))]
    tasks = []
    for place, share in enumerate(shares):
        measures: dict[int, Row] = {
            variant: {"a": rng.choice([0.0, 0.25, 0.5, 1.0, rng.random()]), "b": rng.random()} for variant in variants
        }
        limit = Threshold(
            requirement="R", measure="b", comparison=Comparison.AT_LEAST, value=rng.choice([0.0, 0.3, 0.7]), unit="1"
        )
        tasks.append(
            PortfolioTask(
                name=f"task {place}",
                weight=share / sum(shares),
                problem=TradeProblem(
                    alternatives=tuple(Alternative(variant=one, measures=row) for one, row in measures.items()),
                    thresholds=(limit,),
                    value_functions=(PiecewiseValue(measure="a", worst=0.0, best=1.0),),
                    weighting=Weighting(weights={"a": 1.0}),
                ),
            )
        )
    groups = {variant: rng.choice(["x", "y", "z"]) for variant in variants} if rng.random() < 0.4 else None
    return PortfolioProblem(
        tasks=tuple(tasks), at_most=rng.randrange(1, 4), groups=groups, aim=rng.choice(list(PortfolioAim))
    )


def random_structure(rng: random.Random) -> LevelStructure:
    """A random design space of two or three factors, now and then with incompatible combinations."""
    factors = tuple(
        LevelFactor(id=f"f{place}", levels=tuple("pqr"[: rng.randrange(1, 4)])) for place in range(rng.randrange(2, 4))
    )
    rules = []
    if rng.random() < 0.6:
        one, other = rng.sample(factors, 2)
        pairs = list(itertools.product(one.levels, other.levels))
        # At least one pair stays allowed, so that there is a design.
        excluded = rng.sample(pairs, rng.randrange(len(pairs)))
        rules.append(Incompatibility(id="rule", factors=(one.id, other.id), combinations=frozenset(excluded)))
    space = LevelSpace(factors=factors, rules=tuple(rules))
    return LevelStructure(space=space, levels=dict(space.combinations()))


def _quantities(rng: random.Random, names: str, structure: LevelStructure | None) -> Callable[[int], Row]:
    """Draws what an alternative is in each measure; of levels, from tables over some of the factors.

    Kinds: a coarse grid (many exact ties), near-ties, mixed magnitudes, a constant, uniform, and a
    hollow front, whose inner points no weighted sum selects.
    """
    kind = rng.choice(["grid", "near", "magnitude", "constant", "uniform", "hollow"])
    centre = {name: rng.random() for name in names}
    unknown = rng.choice([0.0, 0.0, 0.1, 0.5])
    tables: dict[str, tuple[tuple[int, ...], dict[tuple[str, ...], float | None]]] = {}

    def one(name: str) -> float | None:
        if rng.random() < unknown:
            return None
        return {
            "grid": lambda: rng.choice([0.0, 0.25, 0.5, 1.0]),
            "near": lambda: centre[name] + rng.choice([0.0, 1.37e-10, 4.19e-9, 2.03e-8]),
            "magnitude": lambda: rng.random() * 10.0 ** rng.choice([-12, 0, 12]),
            "constant": lambda: centre[name] if name == names[0] else rng.random(),
            "uniform": rng.random,
            "hollow": rng.random,
        }[kind]()

    def draw(variant: int) -> Row:
        if structure is not None:
            levels = structure.levels[variant]
            for name in names:
                if name not in tables:
                    places = range(len(levels))
                    tables[name] = (tuple(sorted(rng.sample(places, rng.randrange(len(levels) + 1)))), {})
            row: Row = {}
            for name, (places_of, entries) in tables.items():
                key = tuple(levels[place] for place in places_of)
                if key not in entries:
                    entries[key] = one(name)
                row[name] = entries[key]
            return row
        row = {name: one(name) for name in names}
        if kind == "hollow" and len(names) > 1 and None not in row.values():
            # x^0.5 + y^0.5 = 1 bends inwards: only its ends are supported.
            share = rng.random()
            row[names[0]], row[names[1]] = share**2, (1.0 - share) ** 2
        return row

    return draw


def _known(measures: dict[int, Row], name: str) -> list[float]:
    return [quantity for row in measures.values() if (quantity := row[name]) is not None] or [0.5]


def _thresholds(rng: random.Random, measures: dict[int, Row], names: str) -> tuple[Threshold, ...]:
    found = []
    for number in range(rng.randrange(4)):
        name = rng.choice(names)
        known = _known(measures, name)
        found.append(
            Threshold(
                requirement=f"R-{number // rng.choice([1, 2])}",
                measure=name,
                comparison=rng.choice(CLOSED),
                value=rng.choice([rng.choice(known), rng.choice(known), max(known) * 2 + 1]),
                unit="1",
            )
        )
    return tuple(found)


def _value_function(rng: random.Random, name: str, measures: dict[int, Row]) -> ValueFunction:
    worst = rng.choice([0.0, 1.0, 0.5, rng.choice(_known(measures, name))])
    # Now and then so narrow that every alternative is beyond one of the anchors.
    best = worst + rng.choice([1.0, -1.0, 0.3, 1e-9 if abs(worst) < 1.0 else 0.2])
    kind = rng.choice(["linear", "linear", "piecewise", "exponential", "target"])
    if kind == "piecewise" and abs(best - worst) > 0.1:
        return PiecewiseValue(
            measure=name, worst=worst, best=best, interior=((worst + 0.25 * (best - worst), rng.choice([0.25, 0.75])),)
        )
    if kind == "exponential" and abs(best - worst) > 0.1:
        halfway = worst + rng.choice([0.2, 0.4, 0.5, 0.9]) * (best - worst)
        return ExponentialValue(measure=name, worst=worst, best=best, halfway=halfway)
    if kind == "target" and abs(best - worst) > 0.1:
        low, high = sorted((worst, best))
        return TargetValue(measure=name, target=low + 0.25 * (high - low), too_low=low, too_high=high)
    return PiecewiseValue(measure=name, worst=worst, best=best)


def _weighting(rng: random.Random, names: str) -> Weighting:
    shares = [rng.choice([0, 1, 1, 2, 5]) for _ in names]
    shares[0] += not any(shares)
    return Weighting(weights={name: share / sum(shares) for name, share in zip(names, shares, strict=True)})


def _weight_bounds(rng: random.Random, weighting: Weighting) -> WeightBounds:
    """None, intervals around the weights, or their order."""
    kind = rng.choice(["none", "intervals", "order"])
    weights = weighting.weights
    if kind == "intervals":
        spread = rng.choice([0.0, 0.1, 0.3])
        return WeightBounds(
            intervals=tuple(
                ElicitedInterval(
                    name=name, measures=(name,), least=max(0.0, weight - spread), most=min(1.0, weight + spread)
                )
                for name, weight in weights.items()
            )
        )
    if kind == "order":
        ordered = sorted(weights, key=lambda name: -weights[name])
        return WeightBounds(
            orders=tuple(
                ElicitedOrder(heavier=one, heavier_measures=(one,), lighter=other, lighter_measures=(other,))
                for one, other in itertools.pairwise(ordered)
            )
        )
    return WeightBounds()


def _samples(
    rng: random.Random, measures: dict[int, Row], names: str
) -> dict[int, dict[str, tuple[float | None, ...]]]:
    """Replicates of all measures but perhaps the last, which then follows from the design alone."""
    count = rng.choice([4, 5, 10])
    sampled = names if rng.random() < 0.6 else names[:-1] or names
    missing = rng.choice([0.0, 0.0, 0.1])
    coarse = rng.random() < 0.5

    def one(quantity: float | None) -> float | None:
        if quantity is None or rng.random() < missing:
            return None
        # Of a tiny quantity the noise is all there is, and gains and losses cancel to next to nothing.
        return quantity + (rng.choice([-0.25, 0.0, 0.25]) if coarse else rng.gauss(0.0, 0.2))

    return {
        variant: {name: tuple(one(row[name]) for _ in range(count)) for name in sampled}
        for variant, row in measures.items()
    }


def _risks(
    rng: random.Random, samples: dict[int, dict[str, tuple[float | None, ...]]], names: str
) -> tuple[ChanceBound | TailBound, ...]:
    sampled = next(iter(samples.values()))
    found: list[ChanceBound | TailBound] = []
    for name in rng.sample(names, rng.randrange(1, len(names) + 1)):
        pool = [entry for rows in samples.values() for entry in rows.get(name, ()) if entry is not None] or [0.5]
        limit, sense = rng.choice(pool), rng.choice(CLOSED)
        count = len(sampled.get(name, (0.0,) * 10))
        if rng.random() < 0.5:
            probability = rng.choice([0.3, 0.5, 0.75, 1.0 - 1.0 / count])
            found.append(
                ChanceBound(
                    requirement=f"chance:{name}",
                    measure=name,
                    comparison=sense,
                    value=limit,
                    unit="1",
                    probability=probability,
                )
            )
        else:
            share = rng.choice([1.0 / count, 0.3, 0.37, 0.5, 0.9])
            found.append(
                TailBound(
                    requirement=f"tail:{name}",
                    measure=name,
                    comparison=sense,
                    value=limit,
                    unit="1",
                    share=max(share, 1.0 / count),
                )
            )
    return tuple(found)


def _program(
    rng: random.Random,
    program: str,
    names: str,
    measures: dict[int, Row],
    weighting: Weighting,
    *,
    replicates: bool,
) -> Program:
    if program in ("additive", "risk"):
        return AdditiveValue()
    if program == "lexicographic":
        return Lexicographic(
            aims=tuple(_aim(rng, name) for name in rng.sample(names, rng.randrange(1, len(names) + 1)))
        )
    if program == "epsilon_constraint":
        name = rng.choice(names)
        bounds = tuple(
            Threshold(
                requirement=f"limit:{other}",
                measure=other,
                comparison=rng.choice(CLOSED),
                value=rng.choice(_known(measures, other)),
                unit="1",
            )
            for other in rng.sample(names, rng.randrange(1, len(names) + 1))
        )
        return EpsilonConstraint(aim=_aim(rng, name), bounds=bounds)
    if program == "tchebycheff":
        reference = {name: rng.choice([0.5, 0.8, 1.0]) for name in weighting.deciding_measures if rng.random() < 0.5}
        return Tchebycheff(reference=reference, augmentation=rng.choice([1e-4, 1e-3, 1e-2]))
    if program == "minimax_regret":
        return MinimaxRegret(scenarios=Scenarios.REPLICATES if replicates else Scenarios.WEIGHTS)
    raise ValueError(program)


def _aim(rng: random.Random, name: str) -> Aim:
    absolute, relative = rng.choice([(0.0, 0.0), (0.0, 0.0), (0.25, 0.0), (0.1, 0.0), (0.0, 0.1), (0.0, 0.5)])
    return Aim(measure=name, sense=rng.choice(CLOSED), absolute=absolute, relative=relative)
