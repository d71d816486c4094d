from __future__ import annotations

import json

import pytest

from rgss.reports.decision import decision_to_json
from rgss.tradeoff import decide


def test_of_a_choice(payload_and_time):
    document = json.loads(json.dumps(decision_to_json(decide(payload_and_time)), allow_nan=False))
    certificate = document.pop("certificate")
    assert document == {
        "program": "additive",
        "objectives": ["value"],
        "status": "optimal",
        "chosen": 1,
        "runner_up": 3,
        "ties": [1],
        "surpassed": [],
        "near_ties": [],
        "ranking": [
            {"variant": 1, "value": 0.5, "objectives": [0.5]},
            {"variant": 3, "value": 0.4375, "objectives": [0.4375]},
        ],
        "infeasible": [
            {"variant": 2, "requirements": ["R-1"], "value": 0.8},
            {"variant": 4, "requirements": ["R-2"], "value": 0.7625},
            {"variant": 5, "requirements": ["R-1", "R-2"], "value": 0.075},
        ],
        "excluded_better": [
            {"variant": 2, "requirements": ["R-1"], "value": 0.8},
            {"variant": 4, "requirements": ["R-2"], "value": 0.7625},
        ],
        "deciding_requirements": [
            {"requirement": "R-1", "excluded": 1},
            {"requirement": "R-2", "excluded": 1},
        ],
        "contributions": {
            "chosen": [
                {"measure": "P", "quantity": 1.0, "value": 0.5, "weight": 0.25, "contribution": 0.125},
                {"measure": "t", "quantity": 40.0, "value": 0.5, "weight": 0.75, "contribution": 0.375},
            ],
            "runner_up": [
                {"measure": "P", "quantity": 2.0, "value": 1.0, "weight": 0.25, "contribution": 0.25},
                {"measure": "t", "quantity": 50.0, "value": 0.25, "weight": 0.75, "contribution": 0.1875},
            ],
        },
        "conflicts": None,
        "flat_measures": [],
        "demands": {"R-1": "P >= 0.8 kg", "R-2": "cost <= 100 kg", "evidence:t": "t is known"},
        "counts": {"alternatives": 5, "feasible": 2, "excluded_better": 2},
    }
    residuals = certificate.pop("residuals")
    assert certificate.pop("objective") == pytest.approx(0.5, abs=1e-9)
    (stage,) = certificate.pop("stages")
    assert stage == {"name": "value", "variant": 1, "objective": pytest.approx(0.5, abs=1e-9), "gap": 0.0}
    assert certificate == {
        "enumeration_agrees": "agreed",
        "recomputation_agrees": True,
        "checks": [{"kind": "enumeration", "agrees": True, "detail": "the whole program evaluated at 5 alternatives"}],
        "status": "optimal",
        "solver": "HIGHS",
        "program": "additive",
        "alternatives": 5,
        "considered": 5,
        "solver_choice": 1,
        "objective_recomputed": 0.5,
        "gap": 0.0,
    }
    assert residuals[2] == {"name": "R-2: cost <= 100 kg", "residual": 0.0, "margin": 0.0}


def test_of_no_choice(build_problem):
    problem = build_problem({3: {"a": 0.4}, 7: {"a": None}}, thresholds=[("R", "a", ">=", 0.5)])
    document = json.loads(json.dumps(decision_to_json(decide(problem)), allow_nan=False))
    change = {
        "requirement": "R",
        "demand": "a >= 0.5 kg",
        "limit": 0.5,
        "needed": 0.4,
        "unit": "kg",
        "relative": pytest.approx(0.2),
    }
    assert document == {
        "program": "additive",
        "objectives": ["value"],
        "status": "infeasible",
        "chosen": None,
        "runner_up": None,
        "ties": [],
        "surpassed": [],
        "near_ties": [],
        "ranking": [],
        "infeasible": [
            {"variant": 3, "requirements": ["R"], "value": 0.4},
            {"variant": 7, "requirements": ["R"], "value": None},
        ],
        "excluded_better": [],
        "deciding_requirements": [],
        "contributions": {"chosen": [], "runner_up": []},
        "conflicts": {
            "excluded_by": [{"requirement": "R", "excluded": 2}],
            "minimal_conflict": ["R"],
            "minimal_conflicts": [["R"]],
            "complete": True,
            "corrections": [["R"]],
            "nearest": {"variant": 3, "requirements": ["R"]},
            "repairs": [{"requirement": "R", "changes": [change], "unlocked": 1, "winner": 3}],
            "joint_repairs": [{"requirements": ["R"], "changes": [change], "unlocked": 1, "winner": 3}],
            "survival": None,
        },
        "flat_measures": [],
        "demands": {"R": "a >= 0.5 kg"},
        "counts": {"alternatives": 2, "feasible": 0, "excluded_better": 0},
        "certificate": {
            "enumeration_agrees": "agreed",
            "recomputation_agrees": True,
            "checks": [
                {"kind": "enumeration", "agrees": True, "detail": "the whole program evaluated at 2 alternatives"}
            ],
            "status": "infeasible",
            "solver": "HIGHS",
            "program": "additive",
            "stages": [],
            "alternatives": 2,
            "considered": 2,
            "solver_choice": None,
            "objective": None,
            "objective_recomputed": None,
            "gap": None,
            "residuals": [],
        },
    }
