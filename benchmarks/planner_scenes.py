"""Random scenes of counters, boxes and columns round the reference arm, for settings of planners.

None of them is a scene of a study: the places of the pick and of the place, the furniture and the clutter are drawn
anew for each. A scene is taken when every move of the task begins and ends at a valid configuration.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from rgss.evidence import PlanOutcome
from rgss.motion import PlanningClock
from rgss.scenes import Box, Cylinder, Pose, Scene, SceneBody, load_gripper_file, load_scene
from rgss.tasks import default_task
from rgss.trials import PlanningSettings
from rgss.trials.planning import plan_task
from rgss.trials.workcell import Workcell

REPOSITORY = Path(__file__).resolve().parents[1]
SEED = 20
CLEARANCE_M = 0.008
_FRICTION = 0.5
_COLOUR = (0.6, 0.6, 0.6, 1.0)
_BASE_M = 0.85
_GRIPPER = "scenes/grippers/kg-3.yaml"
_MOVES = 5


def random_cells(count: int, seed: int = SEED) -> Iterator[Workcell]:
    """The first scenes of a seed in which the task can be planned, as workcells.

    Args:
        count: Number of scenes.
        seed: Seed of the scenes.
    """
    reference = load_scene(REPOSITORY / "scenes/restaurant.yaml", label="restaurant.yaml", project=REPOSITORY)
    geometry = load_gripper_file(REPOSITORY / _GRIPPER, label=_GRIPPER).geometry
    found, number = 0, 0
    while found < count:
        generator = np.random.default_rng([seed, number])
        number += 1
        cell = Workcell(_scene(reference, generator, number), geometry, clearance_m=CLEARANCE_M, task=default_task())
        if _is_well_posed(cell):
            found += 1
            yield cell


def _is_well_posed(cell: Workcell) -> bool:
    """Whether each move has a valid configuration at both ends; nothing is searched for."""
    settings = PlanningSettings(clock=PlanningClock(), search_limit_s=0.0, simplification_checks=0)
    plan = plan_task(cell, "RRT", seed=1, settings=settings, past_failures=True)
    ill_posed = (PlanOutcome.INVALID_START, PlanOutcome.INVALID_GOAL)
    return len(plan.moves) == _MOVES and not any(move.outcome in ill_posed for move in plan.moves.values())


def _scene(reference: Scene, generator: np.random.Generator, number: int) -> Scene:
    """A scene: two counters at an angle, clutter on them, something that hangs above, a column between."""
    pick = generator.uniform(-math.pi, math.pi)
    place = pick + generator.choice((-1.0, 1.0)) * generator.uniform(math.radians(60), math.radians(150))
    pick_height, place_height = generator.uniform(0.75, 1.0, size=2)
    reach = generator.uniform(0.6, 0.85, size=2)
    bodies = [
        _box("floor", (0.0, 0.0, -0.02), (5.0, 5.0, 0.02), 0.0),
        SceneBody(
            id="pedestal",
            shape=Cylinder(radius_m=0.14, height_m=_BASE_M),
            pose=Pose(position_m=(0.0, 0.0, _BASE_M / 2)),
            friction=_FRICTION,
            colour=_COLOUR,
        ),
        _box("counter_pick", _polar(0.78, pick), (0.6, 0.9, pick_height), pick),
        _box("counter_place", _polar(0.78, place), (0.6, 0.9, place_height), place),
    ]
    target, goal = _polar(reach[0], pick), _polar(reach[1], place)
    for index in range(int(generator.integers(2, 6))):
        angle, top = ((pick, pick_height), (place, place_height))[index % 2]
        # Beside the object or its place, at 0.14 to 0.35 m along the counter's edge.
        aside = generator.choice((-1.0, 1.0)) * generator.uniform(0.14, 0.35)
        x, y, _ = _polar(generator.uniform(0.55, 0.95), angle)
        foot = (x - aside * math.sin(angle), y + aside * math.cos(angle), top)
        size = (generator.uniform(0.05, 0.3), generator.uniform(0.05, 0.2), generator.uniform(0.1, 0.4))
        bodies.append(_box(f"clutter_{index}", foot, size, angle + generator.uniform(-0.5, 0.5)))
    middle = (pick + place) / 2 + generator.uniform(-0.3, 0.3)
    height = generator.uniform(0.9, 1.3)
    x, y, _ = _polar(generator.uniform(0.45, 0.75), middle)
    column = Cylinder(radius_m=generator.uniform(0.03, 0.08), height_m=height)
    pose = Pose(position_m=(x, y, height / 2))
    bodies.append(SceneBody(id="column", shape=column, pose=pose, friction=_FRICTION, colour=_COLOUR))
    foot = (*_polar(generator.uniform(0.5, 0.9), place + generator.uniform(-0.4, 0.4))[:2], generator.uniform(1.6, 1.9))
    bodies.append(_box("shelf", foot, (generator.uniform(0.3, 0.6), generator.uniform(0.3, 0.9), 0.03), place))
    half_m = reference.workpiece.shape.half_height_m
    workpiece = replace(reference.workpiece, pose=Pose(position_m=(target[0], target[1], pick_height + half_m)))
    return replace(
        reference,
        id=f"random-{number}",
        bodies=tuple(bodies),
        support="counter_pick",
        place_support="counter_place",
        workpiece=workpiece,
        place=replace(reference.place, centre_m=(goal[0], goal[1], place_height)),
    )


def _polar(radius_m: float, angle_rad: float) -> tuple[float, float, float]:
    return radius_m * math.cos(angle_rad), radius_m * math.sin(angle_rad), 0.0


def _box(
    name: str, foot_m: tuple[float, float, float], size_m: tuple[float, float, float], yaw_rad: float
) -> SceneBody:
    x, y, z = foot_m
    pose = Pose.from_roll_pitch_yaw((x, y, z + size_m[2] / 2), (0.0, 0.0, yaw_rad))
    return SceneBody(id=name, shape=Box(size_m=size_m), pose=pose, friction=_FRICTION, colour=_COLOUR)
