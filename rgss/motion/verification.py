"""Verification of a path at a finer resolution than that of its search."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.motion.paths import coarse_to_fine, segment_states
from rgss.motion.validity import StateValidity, first_invalid_between

Vector = NDArray[np.float64]

Replan = Callable[[Vector, Vector, int, int], tuple[Vector | None, int]]
"""Callback that replans a motion from its ends, number and the check count; returns corners or None, and its checks."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Verification:
    """Result of the verification of a path.

    Attributes:
        corners: Corners of the path in rad, shape (n, joints), with the replanned motions.
        is_valid: Whether every state is valid; False also where a motion could not be replanned.
        gave_up: Whether a motion could not be replanned within the budget.
        checks: Validity checks of the verification.
        repair_checks: Validity checks of replanning.
        repairs: Number of replanned motions.
    """

    corners: Vector
    is_valid: bool
    gave_up: bool = False
    checks: int
    repair_checks: int = 0
    repairs: int = 0


def verified(
    corners: Vector, validity: StateValidity, *, resolution_rad: float, replan: Replan | None = None
) -> Verification:
    """Check the motions of a path at a resolution, and replan the invalid ones.

    Motions are checked in order, each by bisection. A motion that collides between its ends is replaced by a path
    between the same ends, planned at the same resolution, which needs no further check.

    Args:
        corners: Corners of the path in rad, shape (n, joints); every corner is valid.
        validity: State-validity checker.
        resolution_rad: Greatest Euclidean distance in joint space between two checked states.
        replan: Callback that replans a motion; None ends the verification at the first invalid motion.
    """
    find = first_invalid_between(validity)
    kept, checks, repair_checks, repairs = [corners[:1]], 0, 0, 0
    for number, (start, end) in enumerate(itertools.pairwise(corners)):
        states = segment_states(start, end, resolution_rad)[:-1]
        index = find(states[list(coarse_to_fine(len(states)))]) if len(states) else None
        checks += len(states) if index is None else index + 1
        if index is None:
            kept.append(end[None])
            continue
        if replan is None:
            return Verification(corners=corners, is_valid=False, checks=checks)
        around, took = replan(start, end, number, checks + repair_checks)
        repair_checks += took
        if around is None:
            return Verification(
                corners=corners,
                is_valid=False,
                gave_up=True,
                checks=checks,
                repair_checks=repair_checks,
                repairs=repairs,
            )
        repairs += 1
        kept.append(around[1:])
    return Verification(
        corners=np.vstack(kept), is_valid=True, checks=checks, repair_checks=repair_checks, repairs=repairs
    )
