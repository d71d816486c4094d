"""Validated range of the payload bench, in which it agrees with statics within 2 %.

`benchmarks/bench_range.py` compares it with mu N_f F / (g + a_m) of fingers and F (1 - leak) / ((g + a_m) (1 + d / r))
of a cup, computed independently of the bench. Outside the range the bench gives no result.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from rgss.errors import DefinitionError
from rgss.physics import MOST_ITERATIONS, passing_mass_kg
from rgss.scenes import half_extents_m
from rgss.trials.payload_bench.spec import BenchSpec

BOUND = 0.02
"""Greatest relative deviation of the bench from statics in the validated range."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ValidatedQuantity:
    """Validated range of one quantity, for any values of the others in their ranges.

    Attributes:
        name: Its name.
        unit: Its unit, in SI.
        lowest: Least validated value.
        highest: Greatest validated value.
        of: Function that returns its value for a bench.
    """

    name: str
    unit: str
    lowest: float
    highest: float
    of: Callable[[BenchSpec], float]

    def contains(self, value: float) -> bool:
        """True if a value is in the range, its ends included."""
        return self.lowest * (1 - 1e-9) <= value <= self.highest * (1 + 1e-9)

    def words(self) -> str:
        """Text of the range with its unit."""
        return f"{self.lowest:g} to {self.highest:g} {self.unit}".rstrip()


def _slenderness_1(spec: BenchSpec) -> float:
    """Height of the centre of mass above the post, divided by its distance from the nearest side of the object."""
    across_m = zip(half_extents_m(spec.shape)[:2], spec.centre_of_mass_m[:2], strict=True)
    room_m = min(half_m - abs(at_m) for half_m, at_m in across_m)
    height_m = spec.shape.half_height_m + spec.centre_of_mass_m[2]
    return height_m / room_m if room_m > 0.0 else math.inf


_LIFT = (
    ValidatedQuantity(
        name="acceleration", unit="m/s²", lowest=0.001, highest=10.0, of=lambda spec: spec.acceleration_m_s2
    ),
    ValidatedQuantity(name="gravity", unit="m/s²", lowest=1.6, highest=12.0, of=lambda spec: spec.gravity_m_s2),
)

VALIDATED: tuple[ValidatedQuantity, ...] = (
    *_LIFT,
    ValidatedQuantity(
        name="friction of finger and object", unit="", lowest=0.05, highest=1.5, of=lambda spec: spec.friction
    ),
    ValidatedQuantity(
        name="force of a finger", unit="N", lowest=0.5, highest=40.0, of=lambda spec: spec.gripper.finger_force_n
    ),
    ValidatedQuantity(
        name="mass of a finger with its drive",
        unit="kg",
        lowest=0.02,
        highest=0.5,
        of=lambda spec: spec.gripper.driven_mass_kg,
    ),
    ValidatedQuantity(
        name="velocity of a finger",
        unit="m/s",
        lowest=0.005,
        highest=0.1,
        of=lambda spec: spec.gripper.finger_velocity_m_s,
    ),
    # Heavy fingers with little force bounce on closing for longer than the timeout of the grasp.
    ValidatedQuantity(
        name="momentum of a finger over its force",
        unit="s",
        lowest=0.0,
        highest=0.03,
        of=lambda spec: spec.gripper.driven_mass_kg * spec.gripper.finger_velocity_m_s / spec.gripper.finger_force_n,
    ),
    ValidatedQuantity(
        name="solver iterations that transmit the force of a finger",
        unit="",
        lowest=0.0,
        highest=MOST_ITERATIONS,
        of=lambda spec: spec.physics.solver_iterations * spec.lightest_body_kg / passing_mass_kg(spec.gripper),
    ),
    # Below it, two ribs of a pad are too close together to prevent a rotation of the object: at 20 mm a slow heavy
    # finger with 0.5 N has an error of 4.5 %.
    ValidatedQuantity(
        name="height of the object", unit="m", lowest=0.03, highest=0.2, of=lambda spec: 2.0 * spec.shape.half_height_m
    ),
    ValidatedQuantity(
        name="payload by Coulomb's law", unit="kg", lowest=0.03, highest=50.0, of=lambda spec: spec.theory_kg
    ),
)
"""The validated ranges of fingers. Every object diameter that the gripper can close on is validated."""

VALIDATED_CUP: tuple[ValidatedQuantity, ...] = (
    *_LIFT,
    ValidatedQuantity(
        name="force of the vacuum, without the leak",
        unit="N",
        lowest=0.5,
        highest=60.0,
        of=lambda spec: spec.total_force_n,
    ),
    ValidatedQuantity(
        name="radius of the lip",
        unit="m",
        lowest=0.005,
        highest=0.03,
        of=lambda spec: 0.0 if spec.gripper.geometry.cup is None else spec.gripper.geometry.cup.radius_m,
    ),
    ValidatedQuantity(
        name="distance of the centre of mass from the cup's axis over the radius of the lip",
        unit="",
        lowest=0.0,
        highest=0.7,
        of=lambda spec: spec.lever_1,
    ),
    # A slender object topples from the post before the vacuum has built up.
    ValidatedQuantity(
        name="height of the centre of mass over its distance from the side of the object",
        unit="",
        lowest=0.0,
        highest=5.0,
        of=_slenderness_1,
    ),
    ValidatedQuantity(name="payload by statics", unit="kg", lowest=0.03, highest=30.0, of=lambda spec: spec.theory_kg),
)
"""The validated ranges of a suction cup, for any object with a flat place that is large enough."""


def validated(spec: BenchSpec) -> tuple[ValidatedQuantity, ...]:
    """The validated ranges that apply to a bench."""
    return VALIDATED if spec.gripper.suction is None else VALIDATED_CUP


def outside(spec: BenchSpec) -> tuple[str, ...]:
    """Quantities of a bench outside the validated range, and what makes it impossible, one phrase each."""
    found = []
    # A trial can choose another grasp than the bench: a bench that cannot be built has no result, and the trial runs.
    try:
        spec.check()
    except DefinitionError as error:
        found.append(error.message)
    for quantity in validated(spec):
        value = quantity.of(spec)
        if not quantity.contains(value):
            shown = f"{value:.3g} {quantity.unit}".rstrip()
            found.append(f"{quantity.name} of {shown}, validated from {quantity.words()}")
    return tuple(found)
