"""OMPL is loaded late, and an interpreter that loaded it ends well."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.fixtures.processes import PATIENCE_S

IMPORTED_LATE = """
import sys
import rgss.motion, rgss.kinematics
late = {"ompl", "toppra", "pinocchio", "coal", "eaik", "scipy", "matplotlib"} & set(sys.modules)
assert not late, late
"""

PLANNED = """
import numpy
{before}
from rgss.motion import SOURCE_PLANNERS, PlanningClock, PlanningProblem, plan
{after}
class Open:
    def is_valid(self, q):
        return True
problem = PlanningProblem(
    lower_rad=(-3.0,) * 6, upper_rad=(3.0,) * 6, start=(0.0,) * 6, goal=(1.0,) * 6, resolution_rad=0.05
)
for planner in SOURCE_PLANNERS:
    result = plan(
        problem, Open(), planner, seed=1, budget_checks=5000, simplification_checks=100, clock=PlanningClock()
    )
    assert result.path is not None
"""


def run(code):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=PATIENCE_S, check=False)


def test_importing_the_packages_loads_no_engine():
    done = run(IMPORTED_LATE)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.engine
@pytest.mark.parametrize(
    ("before", "after"),
    [("", ""), ("import pybullet, pinocchio", ""), ("", "import pinocchio, pybullet")],
    ids=["alone", "after the others", "before the others"],
)
def test_an_interpreter_that_planned_ends_with_status_zero_and_in_silence(before, after):
    done = run(PLANNED.format(before=before, after=after))
    assert done.returncode == 0, done.stderr
    said = [line for line in (done.stdout + done.stderr).splitlines() if "pybullet build time" not in line]
    assert said == []
