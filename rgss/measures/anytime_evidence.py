"""Anytime-valid evidence on means and proportions, and the confidence limits that follow from it.

The evidence is the logarithm of a nonnegative supermartingale that starts at 1 where the hypothesis holds. By Ville's
inequality (1939) the probability that it *ever* reaches log(1/a) is at most a: a test that rejects at the first look at
which it does so errs with probability at most a, whatever the rule of stopping. The limits are the ends of what is not
rejected, a confidence sequence (Howard, Ramdas, McAuliffe and Sekhon 2021), valid at any number of trials.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING

from rgss.measures.mean_limits import UNSEEN_FACTOR

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_STEP_OF_BETS = math.sqrt(2.0)
_BETS_BELOW = 24
_CENTRAL_BET = 0.125
_LARGEST_BET = 1e290
_DIGITS = 9
_MOST_STEPS = 100


def proportion_evidence(successes: int, trials: int, limit: float, *, above: bool) -> float:
    """Logarithm of the evidence that a success probability lies above, or below, a limit.

    The likelihood ratio against the limit, mixed over the probabilities on the other side with
    Jeffreys's prior (Robbins, "Statistical methods related to the law of the iterated logarithm",
    1970). Every term of the mixture is a supermartingale for each probability of the hypothesis,
    because the likelihood ratio of a Bernoulli variable is monotone.

    Args:
        successes: Number of trials that succeeded.
        trials: Number of trials.
        limit: The limit.
        above: Whether the hypothesis that is to be rejected is "at most the limit"; "at least" otherwise.
    """
    if not above:
        return proportion_evidence(trials - successes, trials, 1.0 - limit, above=True)
    if limit >= 1.0:
        return -math.inf
    if limit <= 0.0:
        return math.inf if successes else 0.0
    from scipy.special import betainc, betaln

    posterior = betainc(trials - successes + 0.5, successes + 0.5, 1.0 - limit)
    if posterior <= 0.0:
        return -math.inf
    prior = betainc(0.5, 0.5, 1.0 - limit)
    mixture = betaln(successes + 0.5, trials - successes + 0.5) - betaln(0.5, 0.5) + math.log(posterior / prior)
    return float(mixture - successes * math.log(limit) - (trials - successes) * math.log1p(-limit))


def bounded_mean_evidence(
    values: Sequence[float] | NDArray[np.float64],
    limit: float,
    *,
    above: bool,
    least: float = -math.inf,
    most: float = math.inf,
) -> float:
    """Logarithm of the evidence that a mean lies above, or below, a limit, for any distribution between bounds.

    Against a mean of at least m a gambler bets that the values are smaller: the wealth ``Π (1 + f (m - x))`` is a
    supermartingale for any bet f from 0 to 1/(b - m), where b is the upper bound (Waudby-Smith and Ramdas, "Estimating
    means of bounded random variables by betting", 2024). It is spread over bets whose ratio is √2. The other side is
    mirrored.

    Without a bound on the side that the hypothesis allows, unobserved values are assumed to be at most `UNSEEN_FACTOR`
    times the mean of the observed ones in absolute value, as for the intervals of `rgss.measures.mean_limits`. The bets
    are then shares of 1/|x|, where x is the first value that is not 0; they are on the values after it, so that no bet
    depends on the value that it is on. Those that the assumed bound does not allow count as lost: what remains is at
    most a supermartingale while the assumption holds. The evidence rises with m, so that what is not rejected is an
    interval.

    Args:
        values: The values in the order in which they were observed, shape (n,).
        limit: The limit.
        above: As for `proportion_evidence`.
        least: The least possible value; minus infinity if unknown.
        most: The greatest possible value; infinity if unknown.
    """
    import numpy as np

    values = np.asarray(values, dtype=np.float64)
    if above:
        return bounded_mean_evidence(-values, -limit, above=False, least=-most, most=-least)
    count = len(values)
    stated = math.isfinite(most) and not (count and float(values.max()) > most)
    # Values that are all 0 bound no other: no value is assumed from them.
    if not count or (not stated and (count < 2 or not values.any())):
        return -math.inf
    top = most if stated else _assumed_bound(values)
    room = top - limit
    if room <= 0.0:
        return math.inf if float(values.min()) < limit else -math.inf
    reach = _BETS_BELOW if stated else 2 * _BETS_BELOW
    places = np.arange(0 if stated else -reach, reach + 1, dtype=np.float64)
    if stated:
        largest = min(1.0 / room, _LARGEST_BET)
    else:
        first = int(np.flatnonzero(values)[0])
        largest, values = min(_CENTRAL_BET / abs(float(values[first])), _LARGEST_BET), values[first + 1 :]
    parts = _STEP_OF_BETS ** -np.abs(places)
    bets = largest * _STEP_OF_BETS**-places
    allowed = bets * room <= 1.0 if not stated else np.ones(len(bets), dtype=np.bool_)
    with np.errstate(divide="ignore"):
        # Of the largest bet a value at the bound takes all, but for rounding.
        wealth = np.log1p(np.maximum(np.outer(bets[allowed], limit - values), -1.0)).sum(axis=1)
        wealth += np.log(parts[allowed] / parts.sum())
    greatest = float(wealth.max(initial=-math.inf))
    if not math.isfinite(greatest):
        return greatest
    return greatest + math.log(math.fsum(np.exp(wealth - greatest)))


def anytime_proportion_limits(successes: int, trials: int, *, tail: float) -> tuple[float, float]:
    """Confidence limits of a proportion that hold at any number of trials.

    Args:
        successes: Number of successes.
        trials: Number of trials; positive.
        tail: Probability with which each limit ever fails.
    """
    low = 0.0 if not successes else 1.0 - _greatest_proportion(trials - successes, trials, tail)
    low = float(f"{low:.{_DIGITS}g}")
    return low, _greatest_proportion(successes, trials, tail)


def anytime_mean_limits(
    values: Sequence[float], *, least: float | None, most: float | None, tail: float
) -> tuple[float | None, float | None]:
    """Confidence limits of a mean that hold at any number of trials; arguments and None as for `mean_limits`.

    Args:
        values: The observations in their order; not empty.
        least: The least possible value; None if unknown.
        most: The greatest possible value; None if unknown.
        tail: Probability with which each limit ever fails.
    """
    high = _greatest_mean(tuple(values), most, tail)
    low = _greatest_mean(tuple(-each for each in values), None if least is None else -least, tail)
    return None if low is None else -low, high


@lru_cache(maxsize=4_096)
def _greatest_proportion(successes: int, trials: int, tail: float) -> float:
    if successes == trials:
        return 1.0
    height = _height(lambda limit: proportion_evidence(successes, trials, limit, above=False), trials, tail)
    return max(successes / trials, _crossing(height, successes / trials, 1.0))


@lru_cache(maxsize=16_384)
def _greatest_mean(seen: tuple[float, ...], most: float | None, tail: float) -> float | None:
    """Upper limit from values in their order and an upper bound."""
    import numpy as np

    values = np.array(seen)
    top = _assumed_bound(values) if most is None else max(*seen, most)
    if most is None and (len(seen) < 2 or not any(seen) or not math.isfinite(top)):
        return None
    mean = math.fsum(each / len(seen) for each in seen)
    if top <= min(seen):
        return top

    def evidence(limit: float) -> float:
        return bounded_mean_evidence(values, limit, above=False, most=math.inf if most is None else top)

    return max(mean, _crossing(_height(evidence, len(seen), tail), mean, top))


def _assumed_bound(values: NDArray[np.float64]) -> float:
    """Greatest value that is assumed where no bound is stated."""
    return max(float(values.max()), UNSEEN_FACTOR * math.fsum(abs(each) / len(values) for each in values.tolist()))


def _crossing(height: Callable[[float], float], low: float, high: float) -> float:
    """Point in which a function falls through 0, by Brent's method, since it may jump; the ends if it does not."""
    from scipy.optimize import brentq

    if height(low) <= 0.0:
        return low
    if height(high) > 0.0:
        return high
    return float(f"{brentq(height, low, high, xtol=1e-11 * (high - low), maxiter=_MOST_STEPS, disp=False):.{_DIGITS}g}")


def _height(evidence: Callable[[float], float], count: int, tail: float) -> Callable[[float], float]:
    """Nearly straight function, of powers of p-values, that falls through 0 where the evidence reaches log(1/tail)."""
    needed = float(tail ** (1.0 / count))

    def height(limit: float) -> float:
        return math.exp(-max(evidence(limit), 0.0) / count) - needed

    return height
