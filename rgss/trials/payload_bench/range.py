"""Validated range of the payload bench, in which it agrees with Coulomb's law within 2 %.

`benchmarks/bench_range.py` compares it with mu N_f F / (g + a_m), computed independently of the bench. Outside the
range the bench gives no result.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from rgss.errors import DefinitionError
from rgss.physics import MOST_ITERATIONS
from rgss.trials.payload_bench.spec import BenchSpec

BOUND = 0.02
"""Greatest relative deviation of the bench from Coulomb's law in the validated range."""


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


VALIDATED: tuple[ValidatedQuantity, ...] = (
    ValidatedQuantity(
        name="acceleration", unit="m/s²", lowest=0.001, highest=10.0, of=lambda spec: spec.acceleration_m_s2
    ),
    ValidatedQuantity(name="gravity", unit="m/s²", lowest=1.6, highest=12.0, of=lambda spec: spec.gravity_m_s2),
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
        of=lambda spec: spec.physics.solver_iterations * spec.lightest_body_kg / spec.gripper.driven_mass_kg,
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
"""The validated ranges. Every object diameter that the gripper can close on is validated."""


def outside(spec: BenchSpec) -> tuple[str, ...]:
    """Quantities of a bench outside the validated range, and what makes it impossible, one phrase each.

    Args:
        spec: The bench.
    """
    found = []
    # A trial can choose another grasp than the bench: a bench that cannot be built has no result, and the trial runs.
    try:
        spec.check()
    except DefinitionError as error:
        found.append(error.message)
    for quantity in VALIDATED:
        value = quantity.of(spec)
        if not quantity.contains(value):
            shown = f"{value:.3g} {quantity.unit}".rstrip()
            found.append(f"{quantity.name} of {shown}, validated from {quantity.words()}")
    return tuple(found)
