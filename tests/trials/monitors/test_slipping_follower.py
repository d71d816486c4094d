"""A follower of the arm whose coupling gives way ends a phase, and its effort is an input of the execution alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Failure
from rgss.trials.pieces.scene_digests import geometry_digest, physics_digest
from rgss.trials.plants import slip_detail
from tests.fixtures.palletizer import palletizer
from tests.trials.monitors.test_watch import QUIET, ScriptedWorld, seen, watch_of


@pytest.fixture
def scene(spec_of, tmp_path):
    return replace(spec_of().scene, robot=palletizer(tmp_path))


class Palletizer(ScriptedWorld):
    """A world with four joints."""

    slipped_follower = ""

    def __init__(self, spec, scene):
        super().__init__(spec)
        self.scene = scene

    def arm_state(self):
        return (0.0,) * 4, (0.0,) * 4, (0.0,) * 4

    def tool_motion(self, qs, dqs):
        return np.zeros((len(qs), 3)), np.zeros((len(qs), 3))


def test_a_phase_ends_when_a_follower_slips(spec_of, scene):
    world = Palletizer(spec_of(), scene)
    watch = watch_of(world)
    assert seen(world, watch, QUIET, steps=3) == (None, "")
    world.slipped_follower = "elbow_level"
    told = "elbow_level slipped on elbow, whose coupling transmits 100 N·m at most"
    assert seen(world, watch, QUIET) == (Failure.TRACKING_ERROR, told)
    assert slip_detail(scene.robot, "elbow_level") == told


def test_the_effort_of_a_follower_is_an_input_of_the_execution_alone(scene):
    first, second = scene.robot.followers
    weak = replace(scene.robot, followers=(replace(first, effort=5.0), second))
    free = replace(scene.robot, followers=(replace(first, effort=float("inf")), second))
    scenes = [replace(scene, robot=robot) for robot in (scene.robot, weak, free)]
    assert len({geometry_digest(one) for one in scenes}) == 1
    assert len({physics_digest(one) for one in scenes}) == 3
