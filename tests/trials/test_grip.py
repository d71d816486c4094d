"""Holding: the grip's margin against Coulomb's law, closing further when it falls, and dropping when nothing helps."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rgss.evidence import Failure
from rgss.kinematics import Arm, CollisionContext, CollisionModel, inverse_kinematics
from rgss.physics import PhysicsSettings, World
from rgss.scenes import Gripper, load_gripper, load_scene
from rgss.tasks import default_task
from rgss.trials.execution import Execution
from rgss.trials.plants.control import ControlSettings
from rgss.trials.reference import reference_of
from tests.fixtures.eight_states import Phase

pytestmark = pytest.mark.engine

SCENES = Path(__file__).parents[2] / "scenes"
RATE_HZ = 240.0


class Along:
    """A joint trajectory through configurations that are one physics step apart."""

    def __init__(self, configurations_rad):
        self.configurations_rad = np.array(configurations_rad)
        self.duration_s = (len(configurations_rad) - 1) / RATE_HZ

    def positions(self, times_s):
        return self.configurations_rad[np.rint(np.asarray(times_s) * RATE_HZ).astype(int)]


class Notes:
    """What is observed while the object is lifted."""

    def __init__(self):
        self.margins = []
        self.commanded_n = []
        self.normals_n = []
        self.forces_n = []
        self.friction_n = []
        self.grasping_n = []

    def after_step(self, world, phase, contacts, grip_margin, commanded_force_n):
        if phase == Phase.GRASP:
            self.grasping_n.append(commanded_force_n)
        if phase == Phase.LIFT:
            self.margins.append(grip_margin)
            self.commanded_n.append(commanded_force_n)
            self.normals_n.append(contacts.finger_force_sum_n)
            self.forces_n.append(contacts.finger_forces_n)
            self.friction_n.append(contacts.friction_n)


class Lift:
    """A grasp and a straight lift of constant acceleration, first up, then braking as hard."""

    def __init__(self, fingers):
        self.scene = load_scene(SCENES / "restaurant.yaml")
        self.geometry = load_gripper(SCENES / "grippers" / f"kg-{fingers}.yaml")
        self.arm = Arm(self.scene.robot, self.geometry.grasp_centre)
        self.inverse = inverse_kinematics(self.arm)
        standing = CollisionContext(opening_m=self.geometry.largest_opening_m, standing=self.scene.workpiece.pose)
        free = CollisionModel(self.scene, self.geometry, standing)
        home = np.array(self.scene.robot.home_rad)
        found = [q for q in self.inverse.solve(self.scene.grasp) if free.is_valid(q)]
        self.at = min(found, key=lambda q: float(np.linalg.norm(q - home)))

    def up(self, acceleration_m_s2, *, half_s=0.2):
        """Configurations of the lift."""
        times = np.arange(round(2 * half_s * RATE_HZ) + 1) / RATE_HZ
        rising = 0.5 * acceleration_m_s2 * times**2
        braking = acceleration_m_s2 * (half_s**2 - 0.5 * (2 * half_s - times) ** 2)
        configurations = [self.at]
        for height in np.where(times <= half_s, rising, braking)[1:]:
            configurations.append(self.inverse.nearest(self.scene.grasp.raised(float(height)), configurations[-1]))
        return configurations

    def run(self, acceleration_m_s2, *, half_s=0.2, friction=0.7, force_n=10.0, **control):
        """Results of the moves and the grasp, and what was observed."""
        gripper = Gripper(
            geometry=self.geometry,
            base_mass_kg=0.55,
            finger_mass_kg=0.3,
            finger_velocity_m_s=0.04,
            finger_force_n=force_n,
            friction=friction,
        )
        lift = self.up(acceleration_m_s2, half_s=half_s)
        references = {
            phase: reference_of(
                Along(configurations), self.arm, step_s=1 / RATE_HZ, gravity_m_s2=self.scene.gravity_m_s2
            )
            for phase, configurations in ((Phase.MOVE_TO_GRASP, [self.at] * 3), (Phase.LIFT, lift))
        }
        notes = Notes()
        settings = replace(ControlSettings(), **control)
        with World(self.scene, gripper, PhysicsSettings(rate_hz=RATE_HZ)) as world:
            results = Execution(world, references, settings, self.arm, observer=notes, task=default_task()).run()
        return {result.phase: result for result in results}, notes

    def margin(self, force_n, acceleration_m_s2, friction=0.7):
        """mu N_f F / (m (g + a)): friction available over friction needed (Coulomb)."""
        load_n = self.scene.workpiece.mass_kg * (self.scene.gravity_m_s2 + acceleration_m_s2)
        return friction * self.geometry.fingers * force_n / load_n


@pytest.fixture(scope="module", params=[2, 3], ids=["two fingers", "three fingers"])
def lift(request):
    return Lift(request.param)


@pytest.fixture(scope="module")
def two():
    return Lift(2)


@pytest.mark.parametrize("acceleration_m_s2", [1.0, 3.0])
def test_the_margin_is_coulombs_during_a_constant_acceleration(lift, acceleration_m_s2):
    results, notes = lift.run(acceleration_m_s2, holding_share=1.0)
    assert [result.failure for result in results.values()] == [None] * 3
    margins, half = notes.margins, round(0.2 * RATE_HZ)
    # The forces are averaged over 20 ms, and the parting from the counter takes some steps.
    rising, braking = margins[12 : half - 1], margins[half + 12 : -1]
    assert rising == pytest.approx([lift.margin(10.0, acceleration_m_s2)] * len(rising), rel=0.02)
    assert braking == pytest.approx([lift.margin(10.0, -acceleration_m_s2)] * len(braking), rel=0.02)
    assert results[Phase.LIFT].metrics["grip_margin_min"] == pytest.approx(
        lift.margin(10.0, acceleration_m_s2), rel=0.02
    )


@pytest.mark.parametrize("acceleration_m_s2", [1.0, 3.0])
def test_the_margin_needs_what_friction_really_carries(lift, acceleration_m_s2):
    # What the contacts of the simulation carry is the object's weight and inertia, as the margin takes it.
    _, notes = lift.run(acceleration_m_s2, holding_share=1.0)
    half = round(0.2 * RATE_HZ)
    for part in (slice(12, half - 1), slice(half + 12, -1)):
        carried = np.linalg.norm(np.mean(notes.friction_n[part], axis=0))
        available = 0.7 * np.mean(notes.normals_n[part])
        assert available / carried == pytest.approx(np.mean(notes.margins[part]), rel=0.02)


def test_a_full_grip_is_never_tightened(lift):
    results, notes = lift.run(2.0, holding_share=1.0)
    assert results[Phase.GRASP].metrics["tightenings"] == 0
    assert results[Phase.LIFT].metrics["tightenings"] == 0
    assert set(notes.commanded_n) == {10.0}


def test_a_loose_grip_is_tightened_until_it_has_its_margin_and_holds(two):
    # 2.5 N hold the resting cup. Rising, 1.5 times what is needed takes 3.2 N; each command adds 0.5 N.
    results, notes = two.run(2.0, holding_share=0.25, tightening_share=0.05)
    lifted = results[Phase.LIFT]
    assert [result.failure for result in results.values()] == [None] * 3
    assert results[Phase.GRASP].metrics["tightenings"] == 0
    assert lifted.metrics["tightenings"] == 2
    assert (notes.commanded_n[0], notes.commanded_n[-1]) == (2.5, 3.5)
    assert notes.commanded_n == sorted(notes.commanded_n)
    assert lifted.metrics["grip_margin_min"] == pytest.approx(two.margin(2.5, 2.0), rel=0.02)
    assert lifted.metrics["slip_m"] < 1e-3
    assert notes.normals_n[-1] == pytest.approx(2 * 3.5, rel=0.02)


def test_two_commands_are_at_least_a_force_window_apart(two):
    _, notes = two.run(2.0, holding_share=0.25, tightening_share=0.05, force_window_s=0.05)
    steps = range(1, len(notes.commanded_n))
    changes = [index for index in steps if notes.commanded_n[index] > notes.commanded_n[index - 1]]
    assert len(changes) == 2
    assert changes[1] - changes[0] >= round(0.05 * RATE_HZ)


def test_the_grip_is_never_above_the_force_of_the_design(two):
    # Whatever margin is asked for.
    results, notes = two.run(2.0, holding_share=0.75, tighten_below=100.0, tightening_share=0.1)
    assert results[Phase.LIFT].metrics["tightenings"] == 3
    assert notes.commanded_n[-1] == 10.0
    assert max(notes.commanded_n) == 10.0
    assert results[Phase.LIFT].failure is None


def test_a_grasp_that_is_not_firm_is_tightened_before_the_lift(two):
    # The cup needs 1.75 N on each finger, so 1 N is not firm and 2 N is: together the fingers hold, although the
    # counter's friction takes up to half of what their forces differ by.
    results, notes = two.run(2.0, holding_share=0.1)
    grasp = results[Phase.GRASP]
    assert grasp.failure is None
    assert grasp.metrics["tightenings"] == 1
    assert (notes.grasping_n[0], notes.grasping_n[-1]) == (1.0, 2.0)
    assert grasp.metrics["finger_force_needed_n"] == pytest.approx(0.25 * 9.81 / (0.7 * 2))
    assert min(grasp.metrics["finger_force_n"]) > grasp.metrics["finger_force_needed_n"] / 2
    assert sum(grasp.metrics["finger_force_n"]) == pytest.approx(4.0, rel=0.01)
    counter_n = 0.5 * 0.25 * 9.81
    assert np.ptp(grasp.metrics["finger_force_n"]) <= 1.1 * counter_n
    assert results[Phase.LIFT].failure is None


def test_a_lifted_object_is_pressed_with_the_force_that_was_commanded(lift):
    results, notes = lift.run(1.0, holding_share=0.7)
    assert results[Phase.LIFT].failure is None
    assert notes.forces_n[-1] == pytest.approx((7.0,) * lift.geometry.fingers, rel=0.01)


def test_an_object_that_friction_cannot_carry_is_dropped_at_full_force(two):
    # Friction of 0.135 · 20 N = 2.70 N holds the cup's 2.45 N at rest, but not the 3.45 N of the lift.
    results, notes = two.run(4.0, half_s=0.25, friction=0.135)
    grasp, lifted = results[Phase.GRASP], results[Phase.LIFT]
    assert grasp.failure is None
    assert grasp.metrics["tightenings"] == 3
    assert notes.commanded_n[-1] == 10.0
    assert lifted.failure is Failure.OBJECT_DROPPED
    assert lifted.detail.startswith("the object slipped 2")
    assert lifted.detail.endswith(" mm in the gripper")
    assert lifted.metrics["slip_m"] > 0.02
    # Before it slides far: then the engine's contacts break and are found anew, and the force is only at times whole.
    margins = [margin for margin in notes.margins if margin is not None]
    assert margins[0] == pytest.approx(two.margin(10.0, 4.0, friction=0.135), rel=0.02)
    assert lifted.metrics["grip_margin_min"] == min(margins) < 1.0
    assert lifted.duration_s < 0.5


def test_an_object_that_friction_cannot_hold_at_rest_is_not_lifted(two):
    results, _ = two.run(1.0, friction=0.1)
    assert list(results) == [Phase.MOVE_TO_GRASP, Phase.GRASP]
    assert results[Phase.GRASP].failure is Failure.NO_FIRM_GRASP
    found = re.fullmatch(r"fingers press with (\S+), (\S+) N, each needs 12\.26 N", results[Phase.GRASP].detail)
    assert found is not None
    assert float(found[1]) + float(found[2]) == pytest.approx(20.0, abs=0.05)
    assert results[Phase.GRASP].metrics["tightenings"] == 3
