"""Scan the validated range of the payload bench against statics; write tables in Markdown.

Of fingers every quantity at both ends of its range with the others as in the reference study, corners of the whole
range, and random benches within it; of suction cups corners and random benches. The laws, of Coulomb and of a lip that
lifts off on one side, are computed here and not by the bench.

Run it from the repository's folder: ``python benchmarks/bench_range.py [CASES]``.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from rgss.physics import PhysicsSettings
from rgss.scenes import Box, Cylinder, Gripper, at_top, load_gripper, load_gripper_file, load_scene
from rgss.trials.payload_bench.bench import run_bench
from rgss.trials.payload_bench.range import BOUND, VALIDATED, VALIDATED_CUP, ValidatedQuantity, outside
from rgss.trials.payload_bench.spec import BenchSpec, bench_spec

SCENES = Path(__file__).resolve().parents[1] / "scenes"
ITERATIONS = (20, 50)
CASES = 20


def main(cases: int = CASES) -> int:
    """Scan, write, and return 1 if a bench is farther from the law than the bound."""
    worst = [_scan(VALIDATED, [(name, deviation(spec)) for name, spec in benches(cases)])]
    worst.append(_scan(VALIDATED_CUP, [(name, cup_deviation(spec)) for name, spec in cup_benches(cases)]))
    return int(max(worst) > BOUND)


def _scan(validated: Sequence[ValidatedQuantity], scanned: Sequence[tuple[str, float]]) -> float:
    """Write the ranges and the deviations of the groups; the greatest of these."""
    out = sys.stdout
    out.write("| quantity | from | to | unit |\n|---|---|---|---|\n")
    for quantity in validated:
        out.write(f"| {quantity.name} | {quantity.lowest:g} | {quantity.highest:g} | {quantity.unit} |\n")
    out.write("\n| benches | number | least − theory (%) | greatest − theory (%) |\n|---|---|---|---|\n")
    for group in dict.fromkeys(name for name, _ in scanned):
        errors = [100.0 * error for name, error in scanned if name == group]
        out.write(f"| {group} | {len(errors)} | {min(errors):+.2f} | {max(errors):+.2f} |\n")
    out.write("\n")
    return max(abs(error) for _, error in scanned)


def deviation(spec: BenchSpec) -> float:
    """Relative deviation of a bench from Coulomb's law, mu n F / (g + a), whose factors are read off the parts."""
    gripper = spec.gripper
    normal_n = len(gripper.geometry.azimuths_rad) * gripper.finger_force_n
    law_kg = gripper.friction * spec.object_friction * normal_n / (spec.gravity_m_s2 + spec.acceleration_m_s2)
    return run_bench(spec).payload_kg / law_kg - 1.0


def cup_deviation(spec: BenchSpec) -> float:
    """Relative deviation of a cup's bench from F (1 - leak) / ((g + a) (1 + d / r)), whose factors are read off."""
    gripper, suction = spec.gripper, spec.gripper.suction
    if suction is None or gripper.geometry.cup is None or spec.suction is None:
        raise AssertionError("asked of a bench with a cup")
    lever = math.dist(spec.centre_of_mass_m[:2], spec.suction.position_m[:2]) / gripper.geometry.cup.radius_m
    vacuum_n = gripper.finger_force_n * (1.0 - suction.leak)
    law_kg = vacuum_n / ((spec.gravity_m_s2 + spec.acceleration_m_s2) * (1.0 + lever))
    return run_bench(spec).payload_kg / law_kg - 1.0


def benches(cases: int) -> Iterator[tuple[str, BenchSpec]]:
    """The benches by the group that they are in, all within the validated range."""
    for fingers in (2, 3):
        for iterations in ITERATIONS:
            yield "reference", bench(fingers, iterations)
        for name, (low, high) in RANGES.items():
            for value in (low, high):
                spec = bench(fingers, ITERATIONS[0], **{name: value})
                if not outside(spec):
                    yield name, spec
    generator = np.random.default_rng(1)
    for group in ("corners", "random"):
        found = 0
        while found < cases:
            shares = generator.random(len(RANGES))
            if group == "corners":
                shares = np.round(shares)
            drawn = {
                name: float(low * (high / low) ** share)
                for (name, (low, high)), share in zip(RANGES.items(), shares.tolist(), strict=True)
            }
            spec = bench(int(generator.choice((2, 3))), int(generator.choice(ITERATIONS)), **drawn)
            if not outside(spec):
                found += 1
                yield group, spec


def cup_benches(cases: int) -> Iterator[tuple[str, BenchSpec]]:
    """Benches of suction cups by the group that they are in, all within the validated range."""
    generator = np.random.default_rng(2)
    for group in ("corners", "random"):
        found = 0
        while found < cases:
            shares = generator.random(len(CUP_RANGES))
            shares = np.round(shares) if group == "corners" else shares
            drawn = {
                name: float(low + (high - low) * share) if low == 0.0 else float(low * (high / low) ** share)
                for (name, (low, high)), share in zip(CUP_RANGES.items(), shares.tolist(), strict=True)
            }
            spec = cup_bench(float(generator.choice((240.0, 480.0))), float(generator.uniform(0.0, 6.3)), **drawn)
            if not outside(spec):
                found += 1
                yield group, spec


CUP_RANGES = {
    "acceleration": (0.001, 10.0),
    "gravity": (1.6, 12.0),
    "force": (0.5, 60.0),
    "lip": (0.005, 0.03),
    "lever": (0.0, 0.7),
    "leak": (0.0, 0.3),
    "height": (0.01, 0.2),
}
"""What the scan of cups varies."""


def cup_bench(
    rate_hz: float,
    towards_rad: float,
    *,
    acceleration: float,
    gravity: float,
    force: float,
    lip: float,
    lever: float,
    leak: float,
    height: float,
) -> BenchSpec:
    """A bench of the Lite6's cup with other figures in SI units, over a box whose centre of mass is beside its axis."""
    file = load_gripper_file(SCENES / "grippers/lite6_vacuum.yaml")
    shape = Box(size_m=(2.2 * lip, 2.6 * lip, height))
    geometry = at_top(replace(file.geometry, cup=Cylinder(radius_m=lip, height_m=0.02)), shape)
    if file.suction is None:
        raise AssertionError("the gripper has a cup")
    gripper = Gripper(
        geometry=geometry,
        base_mass_kg=0.3,
        finger_mass_kg=0.0,
        finger_velocity_m_s=1.0,
        finger_force_n=force / (1.0 - leak),
        friction=1.0,
        suction=replace(file.suction, leak=leak),
    )
    scene = load_scene(SCENES / "restaurant.yaml")
    across_m = (lever * lip * math.cos(towards_rad), lever * lip * math.sin(towards_rad))
    workpiece = replace(scene.workpiece, shape=shape, centre_of_mass_across_m=across_m)
    spec = bench_spec(
        replace(scene, workpiece=workpiece, gravity_m_s2=gravity),
        gripper,
        acceleration_m_s2=acceleration,
        rated_kg=1000.0,
        physics=PhysicsSettings(rate_hz=rate_hz),
    )
    return replace(spec, force_limit_n=1.0e6)


RANGES = {
    "acceleration": (0.001, 10.0),
    "gravity": (1.6, 12.0),
    "friction": (0.05, 1.5),
    "force": (0.5, 40.0),
    "finger_mass": (0.05, 0.5),
    "finger_velocity": (0.005, 0.1),
    "height": (next(quantity.lowest for quantity in VALIDATED if "height" in quantity.name), 0.11),
    "radius": (0.024, 0.068),
}
"""What the scan varies; height and radius as far as the reference grippers take them."""


def bench(
    fingers: int,
    iterations: int,
    *,
    acceleration: float = 1.2,
    gravity: float = 9.81,
    friction: float = 0.7,
    force: float = 10.0,
    finger_mass: float = 0.3,
    finger_velocity: float = 0.04,
    height: float = 0.1,
    radius: float = 0.035,
) -> BenchSpec:
    """A bench in SI units."""
    gripper = Gripper(
        geometry=load_gripper(SCENES / f"grippers/kg-{fingers}.yaml"),
        base_mass_kg=0.4,
        finger_mass_kg=finger_mass,
        finger_velocity_m_s=finger_velocity,
        finger_force_n=force,
        friction=friction,
    )
    spec = bench_spec(
        load_scene(SCENES / "restaurant.yaml"),
        gripper,
        acceleration_m_s2=acceleration,
        rated_kg=1000.0,
        physics=PhysicsSettings(solver_iterations=iterations),
    )
    shape = Cylinder(radius_m=radius, height_m=height)
    return replace(spec, gravity_m_s2=gravity, force_limit_n=1.0e6, shape=shape)


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:2])))
