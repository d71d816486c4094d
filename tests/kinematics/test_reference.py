"""The recorded answers of the independent solver, beside the solver itself where it has a wheel."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path

import numpy as np

from rgss.kinematics.configurations import TOLERANCE

RECORD = Path(__file__).parent / "ur10_reference.json"


def answers(configurations_rad):
    """What ur-analytic-ik says of configurations; solutions that miss the pose are its own mistakes and left out."""
    from ur_analytic_ik import ur10

    said = []
    for q in configurations_rad:
        matrix = ur10.forward_kinematics(*q)
        solutions = [
            np.asarray(solution, dtype=float).ravel().tolist()
            for solution in ur10.inverse_kinematics(matrix)
            if np.max(np.abs(ur10.forward_kinematics(*solution) - matrix)) < TOLERANCE
        ]
        said.append({"configuration_rad": list(q), "matrix": np.asarray(matrix).tolist(), "solutions_rad": solutions})
    return said


def record(count=100):
    """Write the record anew: configurations in the joints' ranges and what the solver says of them."""
    random = np.random.default_rng(2)
    ranges = np.array([2, 2, 1, 2, 2, 2]) * math.pi
    configurations_rad = random.uniform(-ranges, ranges, size=(count, 6)).tolist()
    rows = [json.dumps(each) for each in answers(configurations_rad)]
    RECORD.write_text("[\n" + ",\n".join(rows) + "\n]\n", encoding="utf-8")


def test_the_record_has_many_configurations_with_all_branches(reference):
    assert len(reference) == 100
    assert sum(len(each["solutions_rad"]) == 8 for each in reference) > 25


if sys.version_info < (3, 12):

    def test_the_record_is_what_the_solver_says(reference):
        said = answers([each["configuration_rad"] for each in reference])

        for ours, theirs in zip(reference, said, strict=True):
            assert np.allclose(ours["matrix"], theirs["matrix"], rtol=0.0, atol=1e-12)
            assert len(ours["solutions_rad"]) == len(theirs["solutions_rad"])
            assert np.allclose(ours["solutions_rad"], theirs["solutions_rad"], rtol=0.0, atol=1e-9)
