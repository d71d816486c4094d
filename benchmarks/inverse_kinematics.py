"""Numerical inverse kinematics of an arm: share of reachable poses that are reached, and the time of each.

    python benchmarks/inverse_kinematics.py URDF [--poses 10000] [--flange LINK] [--seed 1]

Poses are those of configurations drawn evenly from the joints' ranges; each is asked for from the middle of the
ranges, without knowledge of the configuration that made it. Times are processor times. Exit status 1 if less than
99.9 % are reached or the median is 5 ms or more.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

SHARE, MEDIAN_MS = 0.999, 5.0


def main() -> int:
    """Measure and print."""
    from rgss.kinematics import Arm
    from rgss.kinematics.numerical_inverse import NumericalInverse
    from rgss.scenes import Pose
    from rgss.studies.robot_project.draft import drafted_robot

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("urdf", type=Path)
    parser.add_argument("--poses", type=int, default=10_000)
    parser.add_argument("--flange")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        robot = drafted_robot(options.urdf, Path(folder), flange=options.flange).robot
    arm = Arm(robot, Pose(position_m=(0.0, 0.0, 0.15)))
    inverse = NumericalInverse(arm)
    inverse.nearest(arm.tool_pose(robot.home_rad), robot.home_rad)
    shares = np.random.default_rng(options.seed).random((options.poses, len(robot.joints)))
    times_ms, missed = [], 0
    for q in arm.lower_rad + shares * (arm.upper_rad - arm.lower_rad):
        pose = arm.tool_pose(q)
        begun = time.process_time()
        found = inverse.nearest(pose, robot.home_rad)
        times_ms.append((time.process_time() - begun) * 1e3)
        missed += found is None or float(np.max(np.abs(arm.tool_matrix(found) - arm.tool_matrix(q)))) > 1e-6
    reached = 1.0 - missed / options.poses
    median = float(np.median(times_ms))
    reached_poses = f"{options.poses - missed} of {options.poses} poses reached"
    sys.stdout.write(f"{robot.id}, {len(robot.joints)} joints: {reached_poses}\n")
    slow, slowest = np.percentile(times_ms, 95), max(times_ms)
    sys.stdout.write(f"median {median:.2f} ms, 95 % within {slow:.2f} ms, at most {slowest:.0f} ms\n")
    return 0 if reached >= SHARE and median < MEDIAN_MS else 1


if __name__ == "__main__":
    sys.exit(main())
