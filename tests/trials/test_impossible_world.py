"""A world that the physics engine cannot build."""

from __future__ import annotations

import pytest

from rgss.errors import SimulationError
from rgss.trials.pieces.run import run_trial

from .spec_changes import with_workpiece

pytestmark = pytest.mark.engine


def test_a_workpiece_without_mass_is_an_error(spec_of):
    with pytest.raises(SimulationError, match="the mass of the workpiece must be positive, got 0"):
        run_trial(with_workpiece(spec_of(28), mass_kg=0.0))
