"""Start-up is light: what the command line needs for its help pulls in no engine and no table library."""

from __future__ import annotations

import subprocess
import sys

import pytest

HEAVY = ["pybullet", "ompl", "pinocchio", "coal", "eaik", "toppra", "cvxpy", "highspy"]
HEAVY += ["pandas", "networkx", "scipy", "numpy", "pint", "jinja2", "openpyxl", "pygraphviz", "reqif", "moocore"]


@pytest.mark.parametrize("module", ["rgss", "rgss.errors", "rgss.findings", "rgss.quantities", "rgss.documents"])
def test_importing(module):
    assert heavy_modules_after(f"import {module}") == []


def test_importing_the_command_line():
    assert heavy_modules_after("import rgss.cli.main") == []


def heavy_modules_after(statement):
    script = f"import sys\n{statement}\nprint(*sorted(set({HEAVY!r}) & set(sys.modules)))"
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)

    assert (run.returncode, run.stderr) == (0, "")
    return run.stdout.split()
