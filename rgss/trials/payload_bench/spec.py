"""Specification of a payload bench."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from rgss.errors import DefinitionError
from rgss.physics import MOST_ITERATIONS, PhysicsSettings, light_fingers, passing_mass_kg
from rgss.scenes import (
    FORCE_WINDOW_S,
    Cylinder,
    Gripper,
    Gyration,
    ObjectShape,
    Pose,
    Scene,
    SuctionPoint,
    centre_of_mass,
)
from rgss.trials.payload_bench.from_above import grasp_from_above, suction_from_above

SAFETY_FACTOR = 1.5
"""Safety factor of a gripper's payload by friction (thesis, eq. 4.8)."""

_FINEST_RESOLUTION = 1.0e-6
_LEAST_RISE = 5.0


@dataclass(frozen=True, slots=True, kw_only=True)
class BenchSettings:
    """Settings of grasping, lifting and slip detection on the bench.

    Attributes:
        firm_share: Share of its force above which a finger counts as firm.
        firm_grasp_s: Duration for which every finger must be firm; closing causes a force spike.
        grasp_timeout_s: Timeout of the grasp in addition to the fingers' travel.
        lift_s: Least duration of the upward acceleration. An object heavier than the limit by a share s slides by s (g
        + a) lift_s² / 2, so a long lift separates close masses.
        largest_slip_m: Displacement of the object in the hand that counts as slip. Smaller displacements are the
        compliance of the simulated friction under load: 0.5 % and more below the limit it is less than 0.9 mm at 240
        Hz, while 0.5 % above the limit the slip exceeds 4 mm.
        resolution: Width of the final bracket as a share of its upper end.
        smallest_kg: Least mass of the search.
    """

    firm_share: float = 0.9
    firm_grasp_s: float = 0.05
    grasp_timeout_s: float = 0.5
    lift_s: float = 0.4
    largest_slip_m: float = 1.0e-3
    resolution: float = 0.005
    smallest_kg: float = 0.005


@dataclass(frozen=True, slots=True, kw_only=True)
class BenchSpec:
    """Payload bench of one gripper with one kind of object under one acceleration.

    Attributes:
        gripper: The gripper; the masses, force, velocity and friction of the design.
        shape: The object's solid; an upright cylinder is gripped at its centre.
        object_friction: The object's coefficient; the contact's is the product with the pads'.
        force_limit_n: Normal force of a finger, averaged over the window, above which the object is damaged.
        force_window_s: The averaging window.
        gravity_m_s2: Magnitude of gravity.
        acceleration_m_s2: Acceleration a_m at which the object is lifted.
        rated_kg: Upper end of the search, the rated payload of the arm.
        physics: Step length and solver.
        settings: Settings of grasping, lifting and slip detection.
        grasp: Transform of the grasp-centre frame to the object's frame, from above; None for an upright cylinder.
        gyration_m2: The object's inertia divided by its mass; None for that of the homogeneous shape.
        centre_of_mass_m: The object's centre of mass in its frame; of an object between fingers it is in the middle.
        suction: Place of the suction cup on the object, from above; None for fingers.
    """

    gripper: Gripper
    shape: ObjectShape
    object_friction: float
    force_limit_n: float
    gravity_m_s2: float
    acceleration_m_s2: float
    rated_kg: float
    physics: PhysicsSettings = field(default_factory=PhysicsSettings)
    settings: BenchSettings = field(default_factory=BenchSettings)
    force_window_s: float = FORCE_WINDOW_S
    grasp: Pose | None = None
    gyration_m2: Gyration | None = None
    centre_of_mass_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    suction: SuctionPoint | None = None

    @property
    def friction(self) -> float:
        """Coulomb coefficient mu of a finger on the object."""
        return self.gripper.friction * self.object_friction

    @property
    def total_force_n(self) -> float:
        """F_max of eq. 4.8 with the force limit of one finger: N_f times that force; of a cup that of its vacuum."""
        if self.gripper.suction is not None:
            return (1.0 - self.gripper.suction.leak) * self.gripper.finger_force_n
        return self.gripper.geometry.fingers * self.gripper.finger_force_n

    @property
    def theory_kg(self) -> float:
        """Greatest mass by statics under the acceleration a_m.

        Of fingers by Coulomb's law, mu N_f F / (g + a_m). Of a cup F (1 - leak) / ((g + a_m) (1 + d / r)) with d the
        distance of the centre of mass from its axis and r the radius of its lip, which lifts off on one side.
        """
        held_n = self.total_force_n * (self.friction if self.gripper.suction is None else 1.0 / (1.0 + self.lever_1))
        return held_n / (self.gravity_m_s2 + self.acceleration_m_s2)

    @property
    def lever_1(self) -> float:
        """Distance of the centre of mass from a cup's axis, divided by the radius of its lip; 0 for fingers."""
        if self.suction is None or self.gripper.geometry.cup is None:
            return 0.0
        (px, py, pz), (nx, ny, nz) = self.suction.position_m, self.suction.normal
        x, y, z = self.centre_of_mass_m
        lever_m = math.hypot(
            (y - py) * nz - (z - pz) * ny, (z - pz) * nx - (x - px) * nz, (x - px) * ny - (y - py) * nx
        )
        return lever_m / self.gripper.geometry.cup.radius_m

    @property
    def eq_4_8_kg(self) -> float:
        """Payload of the gripper by eq. 4.8, which includes a safety factor."""
        return self.theory_kg / SAFETY_FACTOR

    @property
    def lift_s(self) -> float:
        """Duration of the upward acceleration in s.

        An object that cannot be carried stays on the post and slips by the hand's rise. For any acceleration the hand
        rises by several times the largest slip.
        """
        least_rise_m = _LEAST_RISE * self.settings.largest_slip_m
        return max(self.settings.lift_s, math.sqrt(2 * least_rise_m / self.acceleration_m_s2))

    def physics_for(self, mass_kg: float) -> PhysicsSettings:
        """Step length and solver with enough iterations to transmit the finger force through object and fingers."""
        return self.physics.passing(
            force_n=self.gripper.finger_force_n,
            speed_m_s=self.gripper.finger_velocity_m_s,
            lightest_kg=min(mass_kg, passing_mass_kg(self.gripper)),
        )

    @property
    def lightest_body_kg(self) -> float:
        """Least mass in kg of a body, finger or object, through which the default iterations transmit the force."""
        return self._lightest_body_kg(self.physics.solver_iterations)

    def _lightest_body_kg(self, iterations: int) -> float:
        gripper = self.gripper
        return self.physics.lightest_body_kg(
            force_n=gripper.finger_force_n, speed_m_s=gripper.finger_velocity_m_s, iterations=iterations
        )

    @property
    def first_kg(self) -> float:
        """Smallest mass of the first probes, with the default iterations; a smaller one needs more."""
        if self.gripper.suction is not None:
            return self.settings.smallest_kg
        return max(self.settings.smallest_kg, self.lightest_body_kg)

    @property
    def smallest_kg(self) -> float:
        """Smallest probed mass: through a lighter one the solver does not transmit the finger force."""
        return min(self.first_kg, max(self.settings.smallest_kg, self._lightest_body_kg(MOST_ITERATIONS)))

    def check(self) -> None:
        """Validate the specification.

        Raises:
            DefinitionError: A number is out of range, or the open hand does not fit over the object.
        """
        positive = {
            "the acceleration": self.acceleration_m_s2,
            "the rated mass": self.rated_kg,
            "the time of the lift": self.settings.lift_s,
            "the smallest mass": self.settings.smallest_kg,
            "the largest slip": self.settings.largest_slip_m,
            "the force of a finger": self.gripper.finger_force_n,
            "the velocity of a finger": self.gripper.finger_velocity_m_s,
        }
        for name, value in positive.items():
            if not 0.0 < value < math.inf:
                raise DefinitionError(
                    f"{name} of a payload bench must be positive, got {value:g}", hint="give a number above zero"
                )
        if not _FINEST_RESOLUTION <= self.settings.resolution < 1.0:
            raise DefinitionError(
                f"the resolution of a payload bench must be from {_FINEST_RESOLUTION:g} to below 1, "
                f"got {self.settings.resolution:g}",
                hint="give the width of the final bracket as a share of its upper end",
            )
        light = light_fingers(self.gripper, self.physics)
        if light is not None:
            message, hint = light
            raise DefinitionError(message, hint=hint)
        if self.first_kg >= self.rated_kg:
            raise DefinitionError(
                f"the smallest mass of {self.first_kg:.3g} kg is not below the rated {self.rated_kg:g} kg",
                hint="give the bench a rated mass above the smallest one",
            )
        self._check_fit()

    def _check_fit(self) -> None:
        geometry = self.gripper.geometry
        if geometry.cup is not None:
            if self.suction is None or self.suction.room_m < geometry.cup.radius_m:
                raise DefinitionError(
                    f"the object has no flat place on its top for the cup of gripper {geometry.id!r}",
                    hint="use a smaller cup or an object with a larger flat face",
                )
            return
        if not isinstance(self.shape, Cylinder):
            if self.grasp is None:
                raise DefinitionError(
                    f"gripper {geometry.id!r} has no grasp of the object from above",
                    hint="use a thinner object or a gripper that opens wider",
                )
            return
        if self.shape.radius_m >= geometry.largest_opening_m:
            raise DefinitionError(
                f"an object of radius {self.shape.radius_m:g} m does not fit into gripper {geometry.id!r}, "
                f"which opens to {geometry.largest_opening_m:g} m",
                hint="use a thinner object or a gripper that opens wider",
            )
        palm_m = geometry.grasp_depth_m - geometry.palm_height_m
        if self.shape.half_height_m >= palm_m:
            raise DefinitionError(
                f"an object of height {self.shape.height_m:g} m gripped at its centre collides with the base "
                f"of gripper {geometry.id!r}, which is {palm_m:g} m above",
                hint="use a lower object or a deeper grasp",
            )


def bench_spec(
    scene: Scene,
    gripper: Gripper,
    *,
    acceleration_m_s2: float,
    rated_kg: float,
    physics: PhysicsSettings | None = None,
    settings: BenchSettings | None = None,
) -> BenchSpec:
    """Payload bench of a gripper with the object and the gravity of a scene.

    Args:
        scene: The scene; its object's mass and place are ignored.
        gripper: The gripper.
        acceleration_m_s2: Acceleration at which the object is lifted.
        rated_kg: Upper end of the search.
        physics: Step length and solver, with defaults.
        settings: Settings of grasping, lifting and slip detection, with defaults.
    """
    workpiece = scene.workpiece
    suction, grasp, centre_m = None, None, (0.0, 0.0, 0.0)
    if gripper.suction is None:
        grasp = grasp_from_above(workpiece.shape, gripper.geometry, gripper.friction * workpiece.friction)
    else:
        suction, grasp = suction_from_above(scene, gripper)
        centre_m = centre_of_mass(workpiece)
    return BenchSpec(
        gripper=gripper,
        shape=workpiece.shape,
        grasp=grasp,
        gyration_m2=workpiece.gyration_m2,
        centre_of_mass_m=centre_m,
        suction=suction,
        object_friction=workpiece.friction,
        force_limit_n=workpiece.force_limit_n,
        force_window_s=workpiece.force_window_s,
        gravity_m_s2=scene.gravity_m_s2,
        acceleration_m_s2=acceleration_m_s2,
        rated_kg=rated_kg,
        physics=physics or PhysicsSettings(),
        settings=settings or BenchSettings(),
    )
