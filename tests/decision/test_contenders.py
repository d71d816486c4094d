"""Lines of a terminal on the designs that nearly won."""

from __future__ import annotations

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.robustness import robustness
from rgss.decision.study_decision import decide_study
from rgss.reports.decision.text.contenders import contender_lines


@pytest.fixture(scope="module")
def made(shipped, filled, record_of):
    store = filled(shipped, lambda spec: record_of(spec, planning_s=0.5 + 0.01 * spec.variant + 0.1 * spec.seed))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(robustness, "ITERATIONS", 200)
        return decide_study(shipped, measure_variants(shipped, store), evidence="evidence.sqlite")


@pytest.mark.parametrize(("tolerance", "within"), [(0.0, ""), (0.1, " within the tolerance of the choice")])
def test_the_legend_names_the_tolerance_and_has_errors_in_points(made, tolerance, within):
    lines = list(contender_lines(made.robustness, tolerance=tolerance))

    draws = made.robustness.analysis.draws
    assert f"feasible: probability that they meet every requirement{within}, by {draws:,} posterior draws" in lines
    (first,) = [line for line in lines if line.startswith("first: share of")]
    error = max(one.first_error for one in made.robustness.contenders)
    assert first.endswith(f"(standard error over studies of this size: up to {100 * error:.2g} percentage points)")
