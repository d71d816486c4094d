"""Points of the Sobol sequence against those of another library."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from scipy.stats.qmc import Sobol

from rgss.kinematics.sobol_points import sobol_points


@pytest.mark.parametrize("dimensions", range(1, 19))
def test_the_points_are_those_of_another_library_bit_for_bit(dimensions):
    expected = Sobol(dimensions, scramble=False).random_base2(12)

    for count in (1, 2, 255, 256, 4096):
        found = sobol_points(dimensions, count)
        assert found.dtype == np.float64
        assert np.array_equal(found, expected[:count])


def test_points_are_only_read():
    with pytest.raises(ValueError, match="read-only"):
        sobol_points(2, 4)[0, 0] = 1.0


@pytest.mark.engine
def test_a_collision_model_needs_no_library_of_statistics(shipped):
    """Its import takes longer than to plan a move, in each process that plans one."""
    program = (
        "import sys\n"
        "from pathlib import Path\n"
        "from rgss.kinematics.link_contacts import lasting_contacts\n"
        "from rgss.scenes import Pose, load_robot\n"
        "project = Path(sys.argv[1])\n"
        "lasting_contacts(load_robot(project / 'scenes/robots/ur10.yaml', base=Pose(), project=project))\n"
        "assert 'scipy.stats' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", program, str(shipped.folder)], check=True)
