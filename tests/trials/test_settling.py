"""Waiting until a released object stands: by where it is, not by a speed that it has for one step."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.kinematics import Arm
from rgss.physics import World
from rgss.scenes import Pose
from rgss.tasks import default_task
from rgss.trials.execution import Execution
from rgss.trials.plants.control import ControlSettings
from tests.fixtures.eight_states import Phase, step_of

pytestmark = pytest.mark.engine

CONTROL = ControlSettings()


class Shaking(World):
    """The cup is seen here and there, step by step, for a while, then at rest."""

    shift_m = (0.0, 0.0, 0.0)
    turn_rad = 0.0
    shaking_s = 0.3
    _seen = 0

    def step(self):
        super().step()
        self._seen += 1

    def workpiece_pose(self):
        pose = super().workpiece_pose()
        if self._seen > self.shaking_s * self.settings.rate_hz or self._seen % 2:
            return pose
        turn = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (self.turn_rad, 0.0, 0.0))
        return Pose(position_m=self.shift_m) @ pose @ turn


@pytest.fixture
def place(spec_of):
    """Opens the open hand over a cup that stands where it should, in a world that shows it otherwise."""
    spec = spec_of()
    scene = spec.scene
    x, y, z = scene.place.centre_m
    standing = Pose(position_m=(x, y, z + scene.workpiece.shape.half_height_m))
    scene = replace(scene, workpiece=replace(scene.workpiece, pose=standing))

    def run(**shaking):
        with Shaking(scene, spec.gripper, spec.settings.physics) as world:
            for name, value in shaking.items():
                setattr(world, name, value)
            execution = Execution(
                world, {}, CONTROL, Arm(scene.robot, spec.gripper.geometry.grasp_centre), task=default_task()
            )
            execution.start(scene.robot.home_rad)
            return execution.release(step_of(Phase.PLACE))

    return run


def test_a_cup_that_stands_is_waited_for_no_longer_than_it_must_stand(place):
    result = place()

    assert result.failure is None
    assert result.duration_s == pytest.approx(CONTROL.settled_s, abs=1e-9)
    assert result.metrics["settling_s"] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    "shaking",
    [{"shift_m": (3e-4, 0.0, 0.0)}, {"shift_m": (0.0, 0.0, 3e-4)}, {"turn_rad": 0.01}],
    ids=["aside", "up", "turning"],
)
def test_a_cup_that_moves_is_waited_for(place, shaking):
    result = place(**shaking)

    assert result.failure is None
    assert result.metrics["settling_s"] == pytest.approx(Shaking.shaking_s, abs=0.02)
    assert result.duration_s == pytest.approx(Shaking.shaking_s + CONTROL.settled_s, abs=0.02)


@pytest.mark.parametrize("shaking", [{"shift_m": (1e-4, 0.0, 0.0)}, {"turn_rad": 0.002}], ids=["aside", "turning"])
def test_a_twitch_is_no_motion(place, shaking):
    # 2 mm/s over a tenth of a second are 0.2 mm.
    assert place(**shaking).metrics["settling_s"] == pytest.approx(0.0, abs=1e-9)


def test_the_wait_ends(place):
    result = place(shift_m=(1e-3, 0.0, 0.0), shaking_s=100.0)

    assert result.duration_s == pytest.approx(CONTROL.settling_timeout_s, abs=0.02)
