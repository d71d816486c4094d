"""The whole task by another engine: the same plans and timed motions, the same program, other physics."""

import pytest

from rgss.evidence import Failure
from rgss.physics.mujoco import MujocoWorld
from tests.fixtures.eight_states import Phase

pytestmark = pytest.mark.engine

# RRT with three and two fingers, standard and light, slow and fast: the first planning limit of each.
VARIANTS = [1, 10, 19, 28, 37, 46, 55, 64]


@pytest.mark.parametrize("variant", VARIANTS)
def test_both_engines_do_the_task(comparison, variant):
    first, second = comparison.both(variant)
    assert (first.failure, second.failure) == (None, None)
    assert first.success
    assert second.success


@pytest.mark.verifies("SYS-011")
@pytest.mark.parametrize("variant", VARIANTS)
def test_on_both_engines_the_cup_stays_where_it_was_gripped(comparison, variant):
    """And is left standing there, at the place where the plan sets it down.

    Rigid bodies below Coulomb's limit do not slip at all. What is lost by the step is some hundredths of a
    millimetre on both engines.
    """
    for outcome in comparison.both(variant):
        assert outcome.slip_m < 1.0e-4
        assert outcome.place_error_m < 2.0e-4


@pytest.mark.parametrize("variant", VARIANTS)
def test_both_engines_need_the_same_time_for_each_state(comparison, variant):
    """A state ends on a whole step, of 4.2 ms on the first engine; contact and rest are seen a step or two later."""
    first, second = comparison.both(variant)
    for phase in Phase:
        assert first.durations_s[phase] == pytest.approx(second.durations_s[phase], abs=3 / 240)


@pytest.mark.verifies("SYS-016")
@pytest.mark.parametrize("variant", VARIANTS)
def test_both_engines_need_the_same_joint_torques(comparison, variant):
    """Kinematics, masses and centres of mass were taken from the description twice, in different ways.

    The peaks differ by 0.2 % at most. A mass of the upper arm, the forearm or
    the first two wrist links that is wrong by a tenth moves them by 1.6 % and more.
    """
    first, second = comparison.both(variant)
    assert second.torque_ratio == pytest.approx(first.torque_ratio, rel=0.005)


@pytest.mark.verifies("SYS-007")
@pytest.mark.parametrize(("variant", "mass_kg"), [(10, 1.8), (28, 0.8), (28, 1.2)])
def test_both_engines_close_further_on_a_heavy_cup_and_carry_it(comparison, variant, mass_kg):
    """At 70 % of the force the margin is too small; 1.8 and 1.2 kg are 94 % of what three and two fingers bear."""
    first, second = comparison.both(variant, mass_kg=mass_kg)
    assert first.success
    assert second.success
    assert first.tightenings == second.tightenings == 3


@pytest.mark.parametrize(
    ("mass_kg", "failure", "phase"),
    [(2.1, Failure.OBJECT_DROPPED, Phase.LIFT), (2.2, Failure.NO_FIRM_GRASP, Phase.GRASP)],
)
def test_both_engines_fail_at_the_same_place_with_a_cup_that_is_too_heavy(comparison, mass_kg, failure, phase):
    """Three fingers bear 2.14 kg at rest, and 1.91 kg at the greatest acceleration of the lift.

    Without a force limit: while a cup slides, the second engine's contacts chatter, and their peaks mean nothing.
    """
    for outcome in comparison.both(10, mass_kg=mass_kg, breakable=False):
        assert (outcome.failure, outcome.failed_phase) == (failure, phase)


def test_both_engines_carry_a_cup_that_the_edges_of_the_fingers_hold(comparison):
    """It stands 12 mm off the plane of fingers that are 20 mm wide.

    With flat fingers the second engine found one point of each, about which the cup turned and was lost.
    """
    first, second = comparison.shifted(28, (-0.0058, -0.0124), mass_kg=0.59, friction=0.82)
    assert (first.failure, second.failure) == (None, None)
    # It is placed as far off as it stood.
    assert second.place_error_m == pytest.approx(first.place_error_m, abs=2.0e-4)
    assert first.place_error_m > 0.012


def test_what_slips_on_the_second_engine_is_lost_by_its_step(comparison, monkeypatch):
    """A cup that is carried round a bend moves along the tangent in each step, and friction has no memory.

    With a sideways acceleration a it falls behind at a dt / 2. So without the correction of the carried cup the slip
    halves with the step, within the micrometres that soft contacts add (2 % is 20 µm); with it, nothing is left of it.
    """
    _, corrected = comparison.both(10)
    with monkeypatch.context() as patched:
        patched.setattr(MujocoWorld, "bend", lambda world, arc_m: None)
        coarse, fine = comparison.on_second(10, 1000.0), comparison.on_second(10, 2000.0)
    assert coarse.success
    assert coarse.slip_m == pytest.approx(2 * fine.slip_m, rel=0.02)
    assert corrected.slip_m < 0.05 * fine.slip_m
