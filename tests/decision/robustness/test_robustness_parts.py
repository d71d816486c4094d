"""A part of the analysis that cannot be computed says so, and the others are there."""

from __future__ import annotations

import json

import pytest

from rgss.api.trade_frames import acceptability_frame, computed_effects, weights_frame
from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose
from rgss.decision.robustness import robustness
from rgss.decision.robustness.parts import Part, PartComputer, not_computed_lines
from rgss.decision.robustness.robustness import analyse_robustness
from rgss.errors import TradeoffError
from rgss.reports.decision.json.robustness import robustness_to_json

FUNCTIONS = {
    Part.PARETO: "pareto_front",
    Part.REGIONS: "winning_regions",
    Part.NEAREST: "weight_shifts",
    Part.RANGES: "weight_ranges",
    Part.ACCEPTABILITY: "smaa2",
    Part.ASSUMPTIONS: "assumption_findings",
    Part.COSTS: "cost_box",
    Part.PRICES: "requirement_prices",
    Part.REVERSALS: "rank_reversals",
    Part.EFFECTS: "study_effects",
}


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    store = filled(shipped, lambda spec: record_of(spec, planning_s=0.5 + 0.01 * spec.variant + 0.1 * spec.seed))
    return measure_variants(shipped, store)


@pytest.fixture(scope="module")
def decision(shipped, measured):
    return choose(shipped, measured)


@pytest.fixture(autouse=True)
def few_draws(monkeypatch):
    monkeypatch.setattr(robustness, "ITERATIONS", 200)


@pytest.fixture(scope="module")
def whole(shipped, measured, decision):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(robustness, "ITERATIONS", 200)
        return robustness_to_json(analyse_robustness(shipped, measured, decision))


def fail(*_, **__):
    raise TradeoffError("the solver gave no answer", hint="ask for less")


def at(document, place):
    for name in place.split("."):
        document = document[name]
    return document


@pytest.mark.parametrize("first", [0, 1])
def test_some_parts_fail(monkeypatch, shipped, measured, decision, whole, first):
    """Every second part fails, and each of the others is what it is without that."""
    failed = set(list(FUNCTIONS)[first::2])
    for part in failed:
        monkeypatch.setattr(robustness, FUNCTIONS[part], fail)
    document = robustness_to_json(analyse_robustness(shipped, measured, decision))

    failed |= {Part.STRETCHED} if Part.REVERSALS in failed else set()
    assert document["not_computed"] == {
        one.value: {"reason": "the solver gave no answer", "remedy": "ask for less"} for one in failed
    }
    for other in {*FUNCTIONS, Part.STRETCHED}:
        assert at(document, other.value) == (None if other in failed else at(whole, other.value)), other
    json.dumps(document, allow_nan=False)


def test_nothing_fails(whole):
    assert whole["not_computed"] == {}


def test_frames_say_why(monkeypatch, shipped, measured, decision):
    for name in ("weight_ranges", "smaa2", "study_effects"):
        monkeypatch.setattr(robustness, name, fail)
    found = analyse_robustness(shipped, measured, decision)

    for frame in (weights_frame, acceptability_frame, computed_effects):
        with pytest.raises(TradeoffError, match=r"not computed: the solver gave no answer \(ask for less\)"):
            frame(found)


def test_a_lack_of_memory_is_a_reason_and_a_mistake_is_not():
    parts = PartComputer()

    def hungry():
        raise MemoryError

    assert parts.compute(Part.EFFECTS, hungry, 7) == 7
    (line,) = not_computed_lines(parts.missing)
    assert line.startswith("Not computed: effects of the factors: it needs more memory than there is. Remedy: ")
    with pytest.raises(ZeroDivisionError):
        parts.compute(Part.COSTS, lambda: 1 // 0, 7)
