"""A carton and a tin beside it, carried one after the other."""

from __future__ import annotations

from dataclasses import replace

from rgss.scenes import Approach, Box, Cylinder, GraspCandidates

CARTON, TIN = Box(size_m=(0.05, 0.04, 0.09)), Cylinder(radius_m=0.03, height_m=0.06)
CANDIDATES = GraspCandidates(approaches=(Approach.ABOVE,), heights=3, yaws=8, samples=24)
STEPS = """
task: two
steps:
  - for_each:
      objects: [{objects}]
      steps:
        - move: {{to: grasp_approach}}
        - move: {{to: grasp, mode: straight}}
        - grip: {{}}
        - wait: {{duration: 100 ms}}
        - check: {{name: has_it, held: true}}
        - move: {{to: lift, mode: straight}}
        - move: {{to: place_approach}}
        - move: {{to: place, mode: straight}}
        - release: {{}}
        - move: {{to: place_approach, mode: straight, name: retreat}}
"""


def on_the_ground(pose, shape, *, foot_m, aside_m=0.0):
    x, y, _ = pose.position_m
    return replace(pose, position_m=(x + aside_m, y, foot_m + shape.half_height_m))


def on_top(scene, *, of):
    """The scene with the tin's place on the carton, at an offset in its frame."""
    (tin,) = scene.others
    place = replace(tin.place, offset_m=(0.004, -0.002)).on(scene.workpiece.pose, CARTON.size_m[2] / 2)
    return replace(scene, others=(replace(tin, place=place, place_support=of),))
