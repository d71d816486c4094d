"""Made-up series and baselines."""

from __future__ import annotations

import pytest

from rgss.regression.baseline import (
    Baseline,
    BaselineOrigin,
    BaselineRun,
    Change,
    DecisionState,
)
from rgss.regression.comparing import Candidate, Guard, Subject

PHASES = 8


@pytest.fixture
def candidate():
    """Makes a comparison of one variant from rows of values by seed."""

    def make(
        old,
        new,
        *,
        metric="time_s",
        phase="lift",
        margin=1.0,
        higher=False,
        success=False,
        identical=False,
        run="r",
        both=False,
    ):
        rows = [row if isinstance(row, dict) else {1: row} for row in (old, new)]
        series = [{variant: dict(enumerate(row)) for variant, row in each.items()} for each in rows]
        return Candidate(
            subject=Subject(run=run, metric=metric, phase=phase),
            guard=Guard(unit="s", higher_is_better=higher, margin=margin, is_success=success, both_ways=both),
            baseline=series[0],
            current=series[1],
            seeds=tuple(range(max(len(row) for row in rows[0].values()))),
            identical=identical,
        )

    return make


def prints(letter: str, *, changed: int | None = None) -> str:
    """A fingerprint of nine parts, of which one phase may differ."""
    parts = [letter * 4] * (PHASES + 1)
    if changed is not None:
        parts[0], parts[1 + changed] = "ffff", "ffff"
    return " ".join(parts)


@pytest.fixture
def baseline() -> Baseline:
    """A small baseline: two variants, three seeds."""
    return Baseline(
        study="pick_place",
        units={"success": "1", "time_s": "s"},
        record={"success": "1", "time_s": "s"},
        runs={
            "planning": BaselineRun(
                fidelity="kinematic",
                seeds=(1, 2, 3),
                values={
                    "time_s": {
                        "lift": {"9": (1.0, 0.1 + 0.2, None), "10": (2.0, 1e-9, 3.0)},
                        "trial": {"9": (1.5, 2.5, 3.5), "10": (2.5, 3.5, 4.5)},
                    },
                    "success": {"trial": {"9": (1.0, 0.0, 1.0), "10": (1.0, 1.0, 1.0)}},
                },
                fingerprints={"9": (prints("a"),) * 3, "10": (prints("b"),) * 3},
                inputs={"9": {"planner": "'RRT'"}, "10": {"planner": "'TRRT'"}},
                first_look=2,
            )
        },
        decision=DecisionState(
            run="planning",
            chosen=9,
            pareto=(9,),
            verdicts={"9": {"SYS-1": "met"}, "10": {"SYS-1": "not_met"}},
            measures={"9": {"t_p": (1.0, None, 2.0)}, "10": {"t_p": (3.0, 4.0, 5.0)}},
        ),
        origin=BaselineOrigin(
            revision="abc",
            machine="Linux",
            engines={"ompl": "1"},
            code={"plan": "d"},
            inputs={"scenes/a.yaml": "e"},
            modules={"rgss.physics.world": "f"},
            constants={"rgss.physics.world._ARM_POSITION_GAIN": "0.4"},
        ),
        history=(Change(reason="First.", revision="abc"),),
        inputs={"tool_speed_m_s": "0.5", "settings.control.firm_grasp_s": "0.05"},
    )
