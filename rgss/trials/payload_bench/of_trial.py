"""Payload bench of a trial's gripper."""

from __future__ import annotations

from rgss.evidence import Fidelity
from rgss.scenes import misfit
from rgss.trials.payload_bench.range import outside
from rgss.trials.payload_bench.spec import BenchSpec, bench_spec
from rgss.trials.trial_spec import TrialSpec


def bench_of(spec: TrialSpec) -> BenchSpec | None:
    """Payload bench of a trial's gripper; None if there is none.

    There is none below contact physics, for an object that does not fit the gripper, and outside the validated range.
    """
    if spec.fidelity is not Fidelity.CONTACT:
        return None
    bench = payload_bench(spec)
    if misfit(spec.gripper.geometry, spec.scene):
        return None
    return None if outside(bench) else bench


def payload_bench(spec: TrialSpec) -> BenchSpec:
    """Payload bench of a trial's gripper, object and physics, without a check of the validated range."""
    robot = spec.scene.robot
    return bench_spec(
        spec.scene,
        spec.gripper,
        acceleration_m_s2=robot.tool_acceleration_m_s2,
        rated_kg=robot.payload_kg,
        physics=spec.settings.physics,
    )
