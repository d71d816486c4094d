"""Error rates of verdicts that are looked at again and again, on emulated data; nothing is simulated.

``python benchmarks/verdicts_over_looks.py [REPETITIONS]`` puts the truth at the threshold, looks after 8, 12, … 200
replicates, and prints how often a verdict was *ever* false: by the intervals of a fixed number of replicates, and by
those that hold at any number. It ends with 1 if the latter exceed the stated rate.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from functools import partial

import numpy as np
from calibration import NOMINAL, TIMES, Array

from rgss.measures import bounded_mean_evidence, proportion_estimate, proportion_evidence
from rgss.measures.mean_limits import UNSEEN_FACTOR, tail_probability

LOOKS = range(8, 201, 4)
SHARES = (0.5, 0.9, 0.95)


def main() -> int:
    """Print the table; 1 if a rate that is to hold is exceeded by more than chance."""
    repetitions = int(sys.argv[1]) if len(sys.argv) > 1 else 400
    out, worst = sys.stdout, 0.0
    out.write("| | false met: fixed number | any number | false not met: fixed number | any number |\n")
    out.write("|---|---|---|---|---|\n")
    size = (repetitions, LOOKS[-1])
    for name, draw in TIMES.items():
        rows = draw(np.random.default_rng(len(name)), size)
        # A time is met where its mean is below the threshold.
        worst = max(worst, _write(name, rows, (_fixed, _any_number), met_above=False))
    for share in SHARES:
        rows = (np.random.default_rng(round(1000 * share)).random(size) < share).astype(np.float64)
        methods = (partial(_fixed_share, share=share), partial(_any_share, share=share))
        worst = max(worst, _write(f"share of {share:g}", rows, methods, met_above=True))
    return int(worst > NOMINAL + 3.0 * math.sqrt(NOMINAL / repetitions))


def _write(name: str, rows: Array, methods: tuple[Callable[..., bool], ...], *, met_above: bool) -> float:
    """Write a row of the table; the greater rate of the second method."""
    rates = [
        float(np.mean([any(method(row[:count], above=above) for count in LOOKS) for row in rows]))
        for above in (met_above, not met_above)
        for method in methods
    ]
    sys.stdout.write(f"| {name} | {' | '.join(f'{rate:.1%}' for rate in rates)} |\n")
    return max(rates[1], rates[3])


def _fixed(seen: Array, *, above: bool) -> bool:
    """True if the interval of a fixed number of times excludes their mean of 1."""
    values, limit = (-seen, -1.0) if above else (seen, 1.0)
    bound = 0.0 if above else max(UNSEEN_FACTOR * float(np.abs(seen).mean()), float(seen.max()))
    below = float(values.mean()) < limit
    return below and tail_probability(sorted(values.tolist()), max(bound, float(values.max())), limit) < NOMINAL


def _any_number(seen: Array, *, above: bool) -> bool:
    return bounded_mean_evidence(seen, 1.0, above=above, least=0.0) >= -math.log(NOMINAL)


def _fixed_share(seen: Array, *, above: bool, share: float) -> bool:
    found = proportion_estimate(int(seen.sum()), len(seen))
    return bool(found.low > share if above else found.high < share)


def _any_share(seen: Array, *, above: bool, share: float) -> bool:
    return proportion_evidence(int(seen.sum()), len(seen), share, above=above) >= -math.log(NOMINAL)


if __name__ == "__main__":
    sys.exit(main())
