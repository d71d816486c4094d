"""Grips of boxes, lying cylinders and meshes on the payload bench, compared with Coulomb's law.

A mass that friction holds with a margin above 1 must not slip, and one that is too heavy must. The margin is
mu N_f F / (m (g + a)). Run: python -m benchmarks.object_grips
"""

from __future__ import annotations

import itertools
import math
import sys
from dataclasses import replace
from pathlib import Path

from rgss.physics import PhysicsSettings
from rgss.scenes import Box, LyingCylinder, MeshShape, ObjectShape
from rgss.studies import load_project
from rgss.studies.expansion import trial_specs
from rgss.trials.payload_bench.rig import probe
from rgss.trials.payload_bench.spec import BenchSpec, bench_spec

_MARGINS = (1.05, 1.5, 4.0, 16.0)
_TOO_HEAVY = 0.95
_RATES_HZ = (240.0, 480.0, 1000.0)
_ITERATIONS = (50, 150)
_VARIANTS = {2: 65, 3: 5}
_SIDE_M, _HALF_HEIGHT_M = 0.04, 0.04


def main() -> None:
    """Print one row for each object and gripper."""
    project = load_project(Path(__file__).resolve().parents[1], "studies/nominal_world.yaml")
    _say("| object | fingers | probes | greatest slip held [µm] | greatest creep held [µm/s] | too heavy, slipped |")
    _say("|---|---:|---:|---:|---:|---:|")
    for fingers, variant in _VARIANTS.items():
        (spec,) = trial_specs(project, variants=[project.designs.variant(variant)], seeds=[1])
        if spec.gripper.geometry.fingers != fingers:
            raise SystemExit(f"variant {variant} has not {fingers} fingers")
        for name, (shape, gyration) in _shapes().items():
            scene = replace(spec.scene, workpiece=replace(spec.scene.workpiece, shape=shape, gyration_m2=gyration))
            bench = bench_spec(scene, spec.gripper, acceleration_m_s2=2.0, rated_kg=10.0)
            if bench.grasp is None:
                _say(f"| {name} | {fingers} | 0 | no grasp from above | | |")
                continue
            _say(_row(name, fingers, bench))


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def _row(name: str, fingers: int, bench: BenchSpec) -> str:
    slips, creeps, slipped, heavy, dropped = [], [], 0, 0, 0
    for rate_hz, iterations in itertools.product(_RATES_HZ, _ITERATIONS):
        tried = replace(bench, physics=PhysicsSettings(rate_hz=rate_hz, solver_iterations=iterations))
        for margin in _MARGINS:
            found = probe(tried, bench.theory_kg / margin)
            if found.held:
                slips.append(found.slip_m)
                creeps.append(abs(found.creep_m_s or 0.0))
            else:
                dropped += 1
        heavy += 1
        slipped += not probe(tried, bench.theory_kg / _TOO_HEAVY).held
    held = f"{len(slips)} held, {dropped} not" if dropped else str(len(slips))
    slip, creep = (f"{1e6 * max(values):.3g}" if values else "" for values in (slips, creeps))
    return f"| {name} | {fingers} | {held} | {slip} | {creep} | {slipped} of {heavy} |"


def _shapes() -> dict[str, tuple[ObjectShape, tuple[float, float, float, float, float, float] | None]]:
    turns = [math.pi * corner / 3 for corner in range(6)]
    prism = tuple(
        (_SIDE_M * math.cos(turn), _SIDE_M * math.sin(turn), z)
        for turn in turns
        for z in (-_HALF_HEIGHT_M, _HALF_HEIGHT_M)
    )
    # A regular hexagon of side s has the polar gyration 5 s² / 12.
    polar = 5.0 * _SIDE_M**2 / 12.0
    across = polar / 2.0 + _HALF_HEIGHT_M**2 / 3.0
    return {
        "box 60 × 50 × 80 mm": (Box(size_m=(0.06, 0.05, 0.08)), None),
        "box 100 × 60 × 50 mm": (Box(size_m=(0.1, 0.06, 0.05)), None),
        "lying cylinder 60 × 90 mm": (LyingCylinder(radius_m=0.03, length_m=0.09), None),
        "hexagonal prism, mesh": (MeshShape(parts_m=(prism,), sha256=""), (across, across, polar, 0.0, 0.0, 0.0)),
    }


if __name__ == "__main__":
    main()
