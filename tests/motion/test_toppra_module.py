"""toppra is imported without matplotlib, which its own plots still find."""

from __future__ import annotations

import subprocess
import sys

import pytest

PROGRAM = """
import sys
{before}
from rgss.motion.toppra_module import load_toppra
toppra = load_toppra()
assert ("matplotlib" in sys.modules) is {is_imported}
from toppra.algorithm import algorithm
assert algorithm.plt.rcParams is sys.modules["matplotlib"].rcParams
import matplotlib.pyplot
assert matplotlib.pyplot.figure is algorithm.plt.figure
assert matplotlib.get_backend
"""


@pytest.mark.engine
@pytest.mark.parametrize(("before", "is_imported"), [("", False), ("import matplotlib.pyplot", True)])
def test_plots_are_imported_when_they_are_used(before, is_imported):
    program = PROGRAM.format(before=before, is_imported=is_imported)
    subprocess.run([sys.executable, "-W", "ignore", "-c", program], check=True)
