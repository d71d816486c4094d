"""Two tables of docs/grippers.md: light fingers on the payload bench, and objects that a suction cup carries or loses.

Run it from the repository's folder: ``python -m benchmarks.hands``.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from rgss.evidence import Fidelity
from rgss.scenes import Gripper, GripperDrive, Pose, load_gripper, load_scene
from rgss.studies import load_project
from rgss.studies.expansion import trial_specs
from rgss.trials.payload_bench.bench import run_bench
from rgss.trials.payload_bench.spec import bench_spec
from rgss.trials.pieces import TrialSpec, run_trial
from tests.trials.hands.gripper_files import HELD, gripper_of

REPOSITORY = Path(__file__).resolve().parents[1]
LIGHT = ((0.5, 0.03, 0.7), (2.0, 0.04, 0.3), (5.0, 0.1, 1.0), (10.0, 0.04, 0.7), (20.0, 0.01, 0.7))
"""Force (N), speed (m/s) and friction of a finger."""

DRIVES_KG = (0.0, 0.1)
MASSES_KG = (0.5, 0.9, 1.1, 1.3, 1.5)
RATES_HZ = (240.0, 960.0)


def main() -> None:
    """Write both tables in Markdown."""
    _say("| force (N) | speed (mm/s) | friction | 2 fingers | 3 fingers |\n|---|---|---|---|---|")
    for force_n, speed_m_s, friction in LIGHT:
        shares = [_farthest_share(fingers, force_n, speed_m_s, friction) for fingers in (2, 3)]
        _say(f"| {force_n:g} | {1e3 * speed_m_s:g} | {friction:g} | {shares[0]:.4f} | {shares[1]:.4f} |")
    _say("\n| mass (kg) | rate (Hz) | outcome |\n|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        base = _of_a_cup(Path(folder))
        for mass_kg in MASSES_KG:
            for rate_hz in RATES_HZ:
                _say(f"| {mass_kg:g} | {rate_hz:g} | {_outcome(base, mass_kg, rate_hz)} |")


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def _farthest_share(fingers: int, force_n: float, speed_m_s: float, friction: float) -> float:
    """Payload over that of Coulomb's law, of both drives the one that is farther from 1."""
    scene = load_scene(REPOSITORY / "scenes" / "restaurant.yaml")
    shares = []
    for drive_kg in DRIVES_KG:
        gripper = Gripper(
            geometry=load_gripper(REPOSITORY / "scenes" / "grippers" / f"kg-{fingers}.yaml"),
            base_mass_kg=0.8,
            finger_mass_kg=0.02,
            finger_velocity_m_s=speed_m_s,
            finger_force_n=force_n,
            friction=friction,
            drive=GripperDrive(inertia_kg=drive_kg),
        )
        spec = bench_spec(scene, gripper, acceleration_m_s2=scene.robot.tool_acceleration_m_s2, rated_kg=10.0)
        result = run_bench(spec)
        shares.append(result.payload_kg / result.theory_kg)
    return max(shares, key=lambda share: abs(share - 1.0))


def _of_a_cup(folder: Path) -> TrialSpec:
    project = load_project(REPOSITORY, "studies/nominal_world.yaml")
    (base,) = trial_specs(project, variants=[project.designs.variant(28)], seeds=[1])
    own = base.scene.workpiece
    x, y, z = own.pose.position_m
    pose = Pose(position_m=(x, y, z - (own.shape.half_height_m - HELD.half_height_m)))
    return replace(
        base,
        scene=replace(base.scene, workpiece=replace(own, shape=HELD, pose=pose)),
        gripper=gripper_of(folder, "vacuum"),
        fidelity=Fidelity.CONTACT,
        settings=replace(base.settings, planning=replace(base.settings.planning, clearance_m=5.0e-4)),
    )


def _outcome(base: TrialSpec, mass_kg: float, rate_hz: float) -> str:
    scene = replace(base.scene, workpiece=replace(base.scene.workpiece, mass_kg=mass_kg))
    physics = replace(base.settings.physics, rate_hz=rate_hz)
    record = run_trial(replace(base, scene=scene, settings=replace(base.settings, physics=physics)))
    if record.failure is not None:
        return f"{record.failed_phase}: {record.failure_detail}"
    return f"placed, slip {1e3 * float(record.metrics['slip_m']):.3f} mm"


if __name__ == "__main__":
    main()
