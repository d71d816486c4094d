"""Configurations of an arm at the waypoints of a study's scene, with as much clearance as they can all have.

    python benchmarks/saved_configurations.py STUDY [--gripper FILE] [--step 1] [--decimals 2]

A task may move between saved configurations of the joints. Where no source gives them, these are found as follows: the
clearance that arm, gripper and object keep from the scene is raised by a step in mm for as long as each waypoint still
has a configuration; of those at the last step, the ones with the least summed travel from one waypoint to the next are
taken and rounded. Printed are the clearance, how far the rounding moves the tool, and the configurations as a task
file has them. Nothing is drawn: the same files give the same text. Exit status 1 if a waypoint has none.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

REPOSITORY = Path(__file__).resolve().parents[1]
MOST_MM = 100


def main() -> int:
    """Search and print."""
    from rgss.scenes import Waypoint, load_gripper_file
    from rgss.studies import load_project
    from rgss.tasks import default_task
    from rgss.trials import Workcell, waypoint_configurations

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study")
    parser.add_argument("--gripper", help="a gripper file of the project (default: the study's first)")
    parser.add_argument("--step", type=float, default=1.0)
    parser.add_argument("--decimals", type=int, default=2)
    options = parser.parse_args()
    project = load_project(REPOSITORY, options.study)
    if options.gripper is None:
        geometry = next(iter(project.grippers.values())).geometry
    else:
        geometry = load_gripper_file(REPOSITORY / options.gripper, label=options.gripper).geometry

    kept, clearance_mm = {}, 0.0
    for number in range(1, int(MOST_MM / options.step)):
        tried_mm = number * options.step
        cell = Workcell(project.scene, geometry, clearance_m=tried_mm / 1e3, task=default_task())
        found = waypoint_configurations(cell)
        if len(found) < len(Waypoint):
            break
        kept, clearance_mm, arm = found, tried_mm, cell.arm
    if not kept:
        sys.stdout.write(f"{project.study.label}: a waypoint has no configuration\n")
        return 1
    moved_mm = 0.0
    lines = []
    for name, q in kept.items():
        rounded = np.round(np.degrees(q), options.decimals) + 0.0
        moved = arm.tool_matrix(np.radians(rounded)) - arm.tool_matrix(q)
        moved_mm = max(moved_mm, 1e3 * float(np.linalg.norm(moved[:3, 3])))
        lines.append(f"  {name}: [{', '.join(f'{each:.{options.decimals}f} deg' for each in rounded)}]")
    said = f"clearance {clearance_mm:g} mm, the tool moved by at most {moved_mm:.3f} mm by the rounding"
    sys.stdout.write(f"# {project.study.label} with {geometry.id}: {said}\nconfigurations:\n")
    sys.stdout.writelines(f"{line}\n" for line in lines)
    return 0


if __name__ == "__main__":
    sys.exit(main())
