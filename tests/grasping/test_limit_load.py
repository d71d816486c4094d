"""The load that pads bear, against the least power of friction over all centres of rotation."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from scipy.optimize import minimize

from rgss.errors import DefinitionError
from rgss.grasping import ContactPoint, load_factor

FORCE_N, FRICTION, HALF_WIDTH_M = 8.0, 0.7, 0.015


def pads(places, *, friction=FRICTION):
    """Two pads that close along x, each with points at (y, z)."""
    return tuple(
        ContactPoint(position_m=(-side * HALF_WIDTH_M, y, z), normal=(side, 0.0, 0.0), friction=friction, finger=finger)
        for finger, side in enumerate((1.0, -1.0))
        for y, z in places
    )


def by_power(places, centre, weight_n):
    """Least multiple of a weight along -z at which the points could turn about a centre, or slide (upper bound).

    The points of both pads coincide seen along x, each with its even share of the force.
    """
    points = np.array(places)
    held_n = 2 * FRICTION * FORCE_N / len(points)

    def multiple(about):
        lever_m = abs(centre[0] - about[0])
        return held_n * np.hypot(*(points - about).T).sum() / (weight_n * max(lever_m, 1e-12))

    starts = product(np.linspace(-0.1, 0.1, 5), np.linspace(-0.05, 0.05, 3))
    found = [
        minimize(multiple, start, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-9}) for start in starts
    ]
    return min(2 * FRICTION * FORCE_N / weight_n, *(one.fun for one in found))


KNOBS = tuple(product((-0.006, 0.006), (-0.004, 0.008)))


@pytest.mark.parametrize(
    "places", [KNOBS, ((0.0, -0.01), (0.0, 0.01)), ((0.002, 0.0),)], ids=["knobs", "ribs", "point"]
)
@pytest.mark.parametrize("centre", [(0.0, 0.0), (0.005, 0.0), (0.014, 0.003), (-0.02, -0.01)])
def test_a_weight_beside_the_line_between_the_pads_turns_the_object(places, centre):
    centre_m = (0.0, *centre)
    factor = load_factor(pads(places), centre_m, (0.0, 0.0, -5.0), finger_force_limit_n=FORCE_N)
    if len(places) == 1:
        # One point of each pad resists no torque about the line between them.
        beside = abs(centre[0] - places[0][0]) > 1e-9
        assert factor == pytest.approx(0.0 if beside else 2 * FRICTION * FORCE_N / 5.0, abs=1e-9)
        return
    # The pyramid of 32 edges lies inside the cone by up to 0.5 %.
    expected = by_power(places, centre, 5.0)
    assert 0.994 * expected <= factor <= expected * (1 + 1e-6)


def test_a_weight_between_the_pads_tilts_them_by_uneven_normal_forces():
    """Each pad bears its share of the weight by friction, and the turning about y by the unevenness of its points."""
    factor = load_factor(pads(KNOBS), (0.014, 0.0, 0.002), (0.0, 0.0, -5.0), finger_force_limit_n=FORCE_N)
    one_pad_alone = FRICTION * FORCE_N / (5.0 * (HALF_WIDTH_M + 0.014) / (2 * HALF_WIDTH_M))
    assert one_pad_alone < factor < 2 * FRICTION * FORCE_N / 5.0
    # With points side by side the pads resist no turning about y.
    level = load_factor(
        pads(((-0.006, 0.0), (0.006, 0.0))), (0.014, 0.0, 0.0), (0.0, 0.0, -5.0), finger_force_limit_n=FORCE_N
    )
    assert level == pytest.approx(one_pad_alone, rel=1e-2)


def test_a_load_along_the_closing_direction_is_borne_by_one_finger():
    factor = load_factor(pads(KNOBS), (0.0, 0.0, 0.002), (-5.0, 0.0, 0.0), finger_force_limit_n=FORCE_N)
    assert factor == pytest.approx(FORCE_N / 5.0, rel=1e-9)


def test_scales():
    """Twice the force bears twice the load; the load's own size divides it."""
    one = load_factor(pads(KNOBS), (0.0, 0.01, 0.0), (0.0, 0.0, -5.0), finger_force_limit_n=FORCE_N)
    two = load_factor(pads(KNOBS), (0.0, 0.01, 0.0), (0.0, 0.0, -2.5), finger_force_limit_n=2 * FORCE_N)
    assert two == pytest.approx(4 * one, rel=1e-9)
    assert load_factor(pads(KNOBS), (0.0, 0.01, 0.0), (0.0, 0.0, 0.0), finger_force_limit_n=FORCE_N) == math.inf
    slippery = pads(KNOBS, friction=0.0)
    assert load_factor(slippery, (0.0, 0.0, 0.0), (0.0, 0.0, -5.0), finger_force_limit_n=FORCE_N) == 0.0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"finger_force_limit_n": 0.0}, "a finger cannot have the force limit 0 N"),
        ({"load_n": (0.0, math.nan, 1.0)}, "a load of (0.0, nan, 1.0) N cannot be borne"),
        ({"contacts": ()}, "a grasp must have at least one contact, got none"),
    ],
)
def test_bad_arguments_are_refused(changes, message):
    given = {
        "contacts": pads(KNOBS),
        "centre_of_mass_m": (0.0, 0.0, 0.0),
        "load_n": (0.0, 0.0, -1.0),
        "finger_force_limit_n": FORCE_N,
    }
    with pytest.raises(DefinitionError) as error:
        load_factor(**{**given, **changes})
    assert str(error.value).startswith(message)
