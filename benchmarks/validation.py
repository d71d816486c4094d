"""Compare the simulation with theory and with its own refinement; write docs/validation.md.

Run it from the repository's folder: ``python benchmarks/validation.py > docs/validation.md``.
Figures of time are ratios of processor time within one run, so that they hold on any machine.
"""

from __future__ import annotations

import contextlib
import io
import statistics
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from rgss.evidence import Fidelity, TrialRecord
from rgss.physics import World
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project, load_project
from rgss.tasks import default_task
from rgss.trials.execution import Execution
from rgss.trials.pieces.run import Pieces
from rgss.trials.planning import plan_task
from rgss.trials.reference import reference_of
from rgss.trials.timing import time_task
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import Workcell

sys.path.insert(0, str(Path(__file__).resolve().parent))
import carry
import payload

PROJECT = Path(__file__).resolve().parents[1]
NOMINAL = (12, 30, 48, 66)
SLOW = (3, 21, 39, 57)
SEEDS = (1, 2, 3)
FINE_HZ = 1000.0
REPETITIONS = 5


def main() -> None:
    """Write every table."""
    project = load_project(PROJECT, "studies/nominal_world.yaml")
    out = sys.stdout
    out.write("# Validation of the simulation\n\n")
    out.write("Written by `python benchmarks/validation.py > docs/validation.md`; do not edit.\n\n")
    out.write("Simulation counts as *analysis*: here the simulation is compared with theory and with itself, not\n")
    out.write("with the real robot.\n\n")
    _payload(out)
    records = _records(project)
    _rates(out, records)
    carry.write_carry(out, carry.rows_of(project))
    carry.write_forces(out, project)
    _fidelities(out, project)
    _limits(out, project, records)
    _grasps(out, project, records)
    _cost(out, project)


def _payload(out: Any) -> None:
    out.write("## Payload at first slip against Coulomb's law\n\n")
    out.write("The bench bisects the object's mass to the first slip while it is lifted with a constant\n")
    out.write("acceleration of 0.5, 1, 2 and 4 m/s², and compares it with mu F n / (g + a).\n\n")
    table = io.StringIO()
    with contextlib.redirect_stdout(table):
        payload.main()
    # The time of a probe is a figure of this machine.
    out.write(table.getvalue().rsplit("\n", 2)[0].rstrip() + "\n\n")


def _records(project: Project) -> dict[tuple[int, int], tuple[TrialRecord, TrialRecord]]:
    pieces = Pieces()
    found = {}
    for spec in _specs(project):
        fine = replace(spec, settings=replace(spec.settings, physics=replace(spec.settings.physics, rate_hz=FINE_HZ)))
        found[spec.variant, spec.seed] = (pieces.record(spec), pieces.record(fine))
    return found


def _specs(project: Project, numbers: tuple[int, ...] = NOMINAL) -> tuple[TrialSpec, ...]:
    variants = [project.designs.variant(number) for number in numbers]
    return trial_specs(project, variants=variants, seeds=SEEDS)


def _rates(out: Any, records: dict[tuple[int, int], tuple[TrialRecord, TrialRecord]]) -> None:
    out.write("## Step rate: 240 Hz and 1000 Hz\n\n")
    out.write("| variant | seed | success | t_e at 240 Hz (s) | t_e at 1000 Hz (s) | difference (%) ")
    out.write("| slip at 240 Hz (mm) | slip at 1000 Hz (mm) |\n|---|---|---|---|---|---|---|---|\n")
    for (variant, seed), (coarse, fine) in records.items():
        success = f"{_yes(coarse.success)}, {_yes(fine.success)}"
        if not (coarse.success and fine.success):
            reason = coarse.failure.value if coarse.failure else "–"
            out.write(f"| {variant} | {seed} | {success} ({reason}) | – | – | – | – | – |\n")
            continue
        before, after = _value(coarse, "task_time_s"), _value(fine, "task_time_s")
        out.write(
            f"| {variant} | {seed} | {success} | {before:.3f} | {after:.3f} | {100 * (after / before - 1):+.2f} "
            f"| {1e3 * _value(coarse, 'slip_m'):.2f} | {1e3 * _value(fine, 'slip_m'):.2f} |\n"
        )
    out.write("\n")


def _fidelities(out: Any, project: Project) -> None:
    out.write("## Three fidelities of one trial\n\n")
    out.write(
        "| variant | motion time, kinematic (s) | dynamic (s) | contact (s) | tool off its path, dynamic (mm) |\n"
    )
    out.write("|---|---|---|---|---|\n")
    pieces = Pieces()
    for spec in _specs(project):
        if spec.seed != SEEDS[0]:
            continue
        rows = {fidelity: pieces.record(replace(spec, fidelity=fidelity)) for fidelity in Fidelity}
        times = " | ".join(f"{_value(rows[fidelity], 'motion_time_s'):.3f}" for fidelity in Fidelity)
        tracking = 1e3 * _value(rows[Fidelity.DYNAMIC], "tracking_error_m")
        out.write(f"| {spec.variant} | {times} | {tracking:.4f} |\n")
    out.write("\n")


def _limits(out: Any, project: Project, records: dict[tuple[int, int], tuple[TrialRecord, TrialRecord]]) -> None:
    out.write("## Limits kept in contact trials at 240 Hz\n\n")
    pieces = Pieces()
    slow = [(spec, pieces.record(spec)) for spec in _specs(project, SLOW)]
    limits = {spec.variant: spec.tool_speed_m_s for spec in (*_specs(project), *(spec for spec, _ in slow))}
    good = [record for record in (*(record for record, _ in records.values()), *(r for _, r in slow)) if record.success]
    out.write("| figure | greatest | bound |\n|---|---|---|\n")
    out.write(f"| tool off its path (mm) | {1e3 * _most(good, 'tracking_error_m'):.4f} | 0.1 |\n")
    for limit in sorted(set(limits.values())):
        peaks = [_value(record, "peak_tool_speed_m_s") for record in good if limits[record.variant] == limit]
        out.write(f"| tool speed over d7 of {limit:g} m/s, measured | {max(peaks) / limit:.4f} | 1.01 |\n")
    acceleration = _most(good, "peak_tool_acceleration_m_s2") / project.scene.robot.tool_acceleration_m_s2
    out.write(f"| tool acceleration over its limit, measured over 20 ms | {acceleration:.4f} | 1.01 |\n")
    out.write(f"| joint torque over its limit | {_most(good, 'peak_joint_torque_ratio'):.3f} | 1 |\n")
    out.write(f"| time of a joint at its torque limit (s) | {max(map(_saturated_s, good)):.3f} | 0 |\n")
    out.write(f"| contacts of arm and scene | {_most(good, 'arm_scene_contacts'):.0f} | 0 |\n")
    out.write(f"| object off its place (mm) | {1e3 * _most(good, 'place_error_m'):.3f} | 40 |\n\n")


def _grasps(out: Any, project: Project, records: dict[tuple[int, int], tuple[TrialRecord, TrialRecord]]) -> None:
    workpiece, scene = project.scene.workpiece, project.scene
    least = workpiece.mass_kg * scene.gravity_m_s2
    most = workpiece.mass_kg * (scene.gravity_m_s2 + scene.robot.tool_acceleration_m_s2)
    out.write("## Grasps over the carry in contact trials at 240 Hz\n\n")
    out.write("Each grasp is analysed when it is firm, twice a second while it carries, and at the end of each\n")
    out.write("phase. By Newton's second law the net wrench of the contacts on the object is m |a - g|: at rest\n")
    out.write(f"{least:.3f} N, and at most {most:.3f} N with the acceleration of the tool.\n\n")
    out.write(
        "| variant | seed | samples | in force closure (%) | greatest net wrench (N) | distance in the hand (mm) "
    )
    out.write("| greatest gap rate (mm/s) | greatest slip speed (mm/s) |\n|---|---|---|---|---|---|---|---|\n")
    for (variant, seed), (record, _) in records.items():
        if not record.success:
            continue
        rate = max(_value(record, "contact_closing_speed_m_s"), _value(record, "contact_opening_speed_m_s"))
        out.write(
            f"| {variant} | {seed} | {_value(record, 'grasp_samples'):.0f} "
            f"| {100 * _value(record, 'grasp_force_closure_share_1'):.0f} | {_value(record, 'held_wrench_n'):.3f} "
            f"| {1e3 * _value(record, 'held_distance_m'):.2f} | {1e3 * rate:.2f} "
            f"| {1e3 * _value(record, 'contact_slip_speed_m_s'):.2f} |\n"
        )
    out.write("\n")


def _cost(out: Any, project: Project) -> None:
    out.write("## Cost of a trial beyond the engine's steps\n\n")
    out.write("Processor time of the eight states over that of as many bare engine steps in the same grasping world,\n")
    out.write(f"the median of {REPETITIONS} such ratios.\n\n")
    out.write("| variant | steps | ratio | bound |\n|---|---|---|---|\n")
    for spec in _specs(project):
        if spec.seed == SEEDS[0]:
            steps, ratio = _cost_of(spec)
            out.write(f"| {spec.variant} | {steps} | {ratio:.2f} | 1.4 |\n")


def _cost_of(spec: TrialSpec) -> tuple[int, float]:
    settings = spec.settings
    cell = Workcell(spec.scene, spec.gripper.geometry, clearance_m=settings.planning.clearance_m, task=default_task())
    plan = plan_task(cell, spec.planner, seed=spec.seed, settings=settings.planning)
    timing = time_task(cell, plan, tool_speed_m_s=spec.tool_speed_m_s, settings=settings.planning)
    physics = settings.physics
    references = {
        phase: reference_of(found, cell.arm, step_s=physics.step_s, gravity_m_s2=spec.scene.gravity_m_s2)
        for phase, found in timing.trajectories.items()
    }
    ratios, steps = [], 0
    for _ in range(REPETITIONS):
        with World(spec.scene, spec.gripper, physics) as world:
            begin = time.process_time()
            results = Execution(world, references, settings.control, cell.arm, task=default_task()).run()
            full_s = time.process_time() - begin
        steps = round(sum(result.duration_s for result in results) / physics.step_s)
        grasping = {phase: references[phase] for phase in ("move_to_grasp", "lift")}
        with World(spec.scene, spec.gripper, physics) as world:
            Execution(world, grasping, settings.control, cell.arm, task=default_task()).run()
            begin = time.process_time()
            for _ in range(steps):
                world.step()
            ratios.append(full_s / (time.process_time() - begin))
    return steps, statistics.median(ratios)


def _value(record: TrialRecord, name: str) -> float:
    value = record.metrics[name]
    if not isinstance(value, (int, float)):
        raise TypeError(f"{name} is not one number")
    return float(value)


def _most(records: list[TrialRecord], name: str) -> float:
    return max(_value(record, name) for record in records)


def _saturated_s(record: TrialRecord) -> float:
    row = record.metrics["joint_saturated_s"]
    if not isinstance(row, tuple):
        raise TypeError("joint_saturated_s is not a row")
    return max(float(value or 0.0) for value in row)


def _yes(success: object) -> str:
    return "yes" if success else "no"


if __name__ == "__main__":
    main()
