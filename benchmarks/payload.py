"""Measure the payload bench against Coulomb's law over 72 cases; write a table in Markdown.

Run it from the repository's folder: ``python benchmarks/payload.py``.
"""

from __future__ import annotations

import sys
import time
from dataclasses import replace
from itertools import product
from pathlib import Path

from rgss.scenes import Gripper, load_gripper, load_scene
from rgss.trials.payload_bench.bench import run_bench
from rgss.trials.payload_bench.rig import probe
from rgss.trials.payload_bench.spec import BenchSettings, bench_spec

SCENES = Path(__file__).resolve().parents[1] / "scenes"
FINGERS, FRICTIONS, FORCES_N, ACCELERATIONS_M_S2 = (2, 3), (0.4, 0.7, 0.9), (5.0, 10.0, 20.0), (0.5, 1.0, 2.0, 4.0)
RESOLUTION = 5.0e-4


def main() -> None:
    """Bisect every case and write how far it is from the law."""
    scene = load_scene(SCENES / "restaurant.yaml")
    out = sys.stdout
    out.write("| fingers | mu | F (N) | least − theory (%) | greatest − theory (%) | creep at 0.9 (mm/s) |\n")
    out.write("|---|---|---|---|---|---|\n")
    probes, seconds = 0, 0.0
    for fingers, friction, force in product(FINGERS, FRICTIONS, FORCES_N):
        gripper = Gripper(
            geometry=load_gripper(SCENES / f"grippers/kg-{fingers}.yaml"),
            base_mass_kg=0.4,
            finger_mass_kg=0.3,
            finger_velocity_m_s=0.04,
            finger_force_n=force,
            friction=friction,
        )
        errors, creeps = [], []
        for acceleration in ACCELERATIONS_M_S2:
            spec = bench_spec(
                scene,
                gripper,
                acceleration_m_s2=acceleration,
                rated_kg=10.0,
                settings=BenchSettings(resolution=RESOLUTION),
            )
            # Forces beyond what the scene's cup bears are tried too.
            spec = replace(spec, force_limit_n=1.0e6)
            begin = time.perf_counter()
            result = run_bench(spec)
            seconds += time.perf_counter() - begin
            probes += result.trials
            errors.append(100.0 * (result.payload_kg / result.theory_kg - 1.0))
            creeps.append(abs(probe(spec, 0.9 * result.theory_kg).creep_m_s or 0.0) * 1e3)
        row = f"{fingers} | {friction:g} | {force:g} | {min(errors):+.2f} | {max(errors):+.2f} | {max(creeps):.4f}"
        out.write(f"| {row} |\n")
    out.write(f"\n{probes} probes, {1e3 * seconds / probes:.1f} ms each.\n")


if __name__ == "__main__":
    main()
