"""Random draws of a seed, each a function of only the seed and the quantity's name.

A counter-based generator (Philox 4x64-10, Salmon et al. 2011) is keyed by a digest of seed and name, and its first
number goes through the inverse distribution function. A draw therefore depends neither on the order of draws nor on the
other uncertain quantities, and is the same for every design (common random numbers). Quantities of a correlated group
depend only on each other.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rgss.scenes.robot import MOST_JOINTS
from rgss.scenes.uncertainty.declaration import Correlation, Uncertainty
from rgss.scenes.uncertainty.quantity_names import in_order, quantity_of

_DIGITS = 9
_SEEDS_KEPT = 4096


@lru_cache(maxsize=_SEEDS_KEPT)
def draws_of(uncertainty: Uncertainty, seed: int, *, joints: int = MOST_JOINTS) -> Mapping[str, float]:
    """Draws of a trial by name, in the order of the registry, then object by object.

    A draw is rounded to nine significant digits: numerical kernels of different processors differ in the sixteenth
    digit, and a draw, as an input, must be the same on all machines.

    Args:
        uncertainty: The uncertain quantities.
        seed: The trial's seed.
        joints: Number of the arm's joints; a quantity of each joint has one draw for each.
    """
    values = {one.quantity: one.distribution for one in uncertainty.values}
    declared = in_order(values)
    shares = {name: uniform_of(seed, name) for quantity in declared for name in quantity.draw_names_for(joints)}
    for group in uncertainty.correlations:
        if {*group.quantities} <= values.keys():
            shares.update(_correlated(group, shares, joints))
    return MappingProxyType(
        {
            name: float(f"{values[quantity.name].quantile(shares[name]):.{_DIGITS}g}")
            for quantity in declared
            for name in quantity.draw_names_for(joints)
        }
    )


def uniform_of(seed: int, name: str) -> float:
    """Uniform random number in the open interval (0, 1), a function of seed and name.

    Args:
        seed: The trial's seed.
        name: The name of a draw.
    """
    # Odd multiples of 2**-54 exclude both ends.
    return float((int(_generator(seed, name).random_raw()) >> 11) * 2 + 1) * 2.0**-54


def white_noise(seed: int, name: str, count: int) -> NDArray[np.float64]:
    """Standard normal random numbers, shape (count,), a function of seed and name; a prefix of any longer sequence.

    Args:
        seed: The trial's seed.
        name: The name of the noisy quantity.
        count: Number of values.
    """
    return np.random.Generator(_generator(seed, name)).standard_normal(count)


def _generator(seed: int, name: str) -> np.random.Philox:
    key = hashlib.sha256(f"{seed}:{name}".encode()).digest()[:16]
    return np.random.Philox(key=int.from_bytes(key, "big"))


def _correlated(group: Correlation, shares: Mapping[str, float], joints: int) -> dict[str, float]:
    """Correlated uniform numbers of a group by a Gaussian copula, independent between the joints."""
    from scipy.special import ndtr, ndtri

    names = [quantity_of(quantity).draw_names_for(joints) for quantity in group.quantities]
    factor = np.linalg.cholesky(np.array(group.matrix))
    found = {}
    for row in zip(*names, strict=True):
        scores = factor @ ndtri([shares[name] for name in row])
        found.update({name: float(share) for name, share in zip(row, ndtr(scores), strict=True)})
    return found
