"""Clearance and manipulability along a move, against dense sampling and finite differences."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.trials.path_quality import manipulability, path_quality
from rgss.trials.planning import plan_of
from rgss.trials.timing import timing_of
from rgss.trials.workcell import cell_of
from tests.fixtures.eight_states import Phase

pytestmark = pytest.mark.engine


@pytest.fixture(scope="module")
def made(spec_of):
    spec = spec_of(65)
    return cell_of(spec), timing_of(spec, plan_of(spec))


def jacobian_by_differences(arm, q, step=1e-6):
    """(v, ω) of the tool for each joint, from its poses alone."""
    columns = []
    for joint in range(6):
        turn = np.zeros(6)
        turn[joint] = step
        before, after = arm.tool_matrix(q - turn), arm.tool_matrix(q + turn)
        spin = (after[:3, :3] - before[:3, :3]) @ arm.tool_matrix(q)[:3, :3].T / (2 * step)
        moved = (after[:3, 3] - before[:3, 3]) / (2 * step)
        columns.append([*moved, spin[2, 1], spin[0, 2], spin[1, 0]])
    return np.array(columns).T


def test_manipulability_is_the_volume_of_the_jacobian_by_finite_differences(made):
    cell, _ = made
    rng = np.random.default_rng(7)
    for q in rng.uniform(-2.5, 2.5, size=(20, 6)):
        jacobian = jacobian_by_differences(cell.arm, q)
        volume = math.sqrt(max(0.0, float(np.linalg.det(jacobian @ jacobian.T))))
        assert manipulability(cell.arm, q) == pytest.approx(volume, rel=1e-4, abs=1e-7)


def test_a_stretched_arm_has_none(made):
    cell, _ = made
    q = np.array([0.3, -0.4, 0.0, 0.5, 0.7, 0.2])

    assert manipulability(cell.arm, q) == pytest.approx(0.0, abs=1e-12)


def test_the_least_values_are_those_of_a_dense_sampling(made):
    cell, timing = made
    for phase, trajectory in timing.trajectories.items():
        rows = trajectory.positions(np.linspace(0.0, trajectory.duration_s, 1501))
        clearance = min(cell.planning[phase].clearance_m(q) for q in rows[::2])
        volume = min(manipulability(cell.arm, q) for q in rows)
        found = timing.qualities[phase]
        assert clearance - 1e-4 <= found.clearance_m <= clearance + 1e-3
        assert found.manipulability_m3 == pytest.approx(volume, rel=1e-2)
    # Planned paths keep 8 mm; the timed motion rounds their corners and keeps a quarter of it.
    assert min(quality.clearance_m for quality in timing.qualities.values()) >= 0.002


def test_the_clearance_counts_no_contact_that_is_meant_and_no_pair_of_links(made):
    cell, timing = made
    at_grasp = timing.trajectories[Phase.LIFT].positions([0.0])[0]
    model = cell.planning[Phase.LIFT]

    # The cup stands on the counter, and links next to each other are near: neither is a clearance.
    assert model.clearance_m(at_grasp) > model.distance(at_grasp)


def test_a_scene_without_surroundings_has_no_clearance(made):
    cell, timing = made

    class Empty:
        def clearance_m(self, q):
            return math.inf

    assert path_quality(timing.trajectories[Phase.LIFT], Empty(), cell.arm).clearance_m is None
