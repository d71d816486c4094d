"""Each term compiled alone: its CVXPY expression is evaluated at every selection."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.tradeoff import Alternative, Comparison, PiecewiseValue, Threshold
from rgss.tradeoff.milp.selection import VariantSelection
from rgss.tradeoff.milp.terms import EvidenceConstraint, QuantityRank, WeightedValue, WorstOf, compile_constraint


@pytest.fixture
def select():
    def build(quantities):
        return VariantSelection.of(
            [Alternative(variant=variant, measures={"m": quantity}) for variant, quantity in enumerate(quantities)]
        )

    return build


def at_every_selection(selection, compiled, attribute):
    found = []
    for unit in np.eye(len(selection.alternatives)):
        selection.variable.value = unit
        found.append(getattr(compiled, attribute)())
    return [float(np.asarray(entry)) for entry in found]


def values_of(selection, expression):
    found = []
    for unit in np.eye(len(selection.alternatives)):
        selection.variable.value = unit
        found.append(float(expression.value))
    return found


def test_weighted_value(select):
    selection = select([20.0, 30.0, 60.0, None])
    term = WeightedValue(function=PiecewiseValue(measure="m", worst=60.0, best=20.0), weight=0.5)
    assert values_of(selection, term.compile(selection)) == [0.5, 0.375, 0.0, 0.0]


@pytest.mark.parametrize("comparison", [Comparison.AT_LEAST, Comparison.AT_MOST])
@pytest.mark.parametrize("unit", [1e-15, 1e-6, 1.0, 1e6, 1e15, 1e300])
def test_no_violation_is_below_the_tolerance_of_the_solver_in_any_unit(select, comparison, unit):
    quantities = [unit * factor for factor in (0.0, 1.0, 1.0 - 3e-9, 1.0 + 3e-9, 1e3, -1e3)]
    threshold = Threshold(requirement="R", measure="m", comparison=comparison, value=unit, unit="1")
    selection = select([*quantities, None])
    constraint = compile_constraint(threshold, selection)
    violations = at_every_selection(selection, constraint, "violation")
    expected = [0.0 if threshold.is_met_by(quantity) else 1.0 for quantity in [*quantities, None]]
    assert violations == expected


def test_margins_that_overflow(select):
    threshold = Threshold(requirement="R", measure="m", comparison=Comparison.AT_LEAST, value=1e308, unit="1")
    selection = select([-1e308, 1.7e308, 1e308])
    constraint = compile_constraint(threshold, selection)
    assert at_every_selection(selection, constraint, "violation") == [1.0, 0.0, 0.0]


def test_threshold_that_all_meet(select):
    threshold = Threshold(requirement="R", measure="m", comparison=Comparison.AT_MOST, value=5.0, unit="s")
    selection = select([5.0, 4.0, -100.0])
    constraint = compile_constraint(threshold, selection)
    assert at_every_selection(selection, constraint, "violation") == [0.0, 0.0, 0.0]
    assert threshold.name == "R: m <= 5 s"


def test_evidence(select):
    selection = select([1.0, None, 0.0])
    term = EvidenceConstraint(measure="m")
    assert at_every_selection(selection, term.compile(selection), "violation") == [0.0, 1.0, 0.0]
    assert term.name == "evidence:m"


def test_choose_one(select):
    selection = select([1.0, 2.0])
    ((name, constraint),) = selection.structure
    for value, violation in (([1.0, 0.0], 0.0), ([0.0, 1.0], 0.0), ([0.0, 0.0], 1.0), ([1.0, 1.0], 1.0)):
        selection.variable.value = np.array(value)
        assert float(np.asarray(constraint.violation())) == violation
    assert name == "choose exactly one"


@pytest.mark.parametrize(
    ("sense", "ranks"), [(Comparison.AT_LEAST, [1, 0, 2, 1, 0]), (Comparison.AT_MOST, [1, 2, 0, 1, 0])]
)
@pytest.mark.parametrize("unit", [1e-300, 1.0, 1e300])
def test_rank_of_a_quantity(select, sense, ranks, unit):
    selection = select([2.0 * unit, 1.0 * unit, 2.0 * unit * (1 + 1e-12), 2.0 * unit, None])
    assert values_of(selection, QuantityRank(measure="m", sense=sense).compile(selection)) == ranks


def test_the_worst_of_scenarios(select):
    selection = select([0.0, 1.0, 0.25])
    rising = WeightedValue(function=PiecewiseValue(measure="m", worst=0.0, best=1.0), weight=1.0)
    falling = WeightedValue(function=PiecewiseValue(measure="m", worst=1.0, best=0.0), weight=1.0)
    term = WorstOf(scenarios=((0.0, (rising,)), (-0.5, (falling,))))
    assert values_of(selection, term.compile(selection)) == pytest.approx([0.0, -0.5, 0.25])
    assert [term.at(one) for one in selection.alternatives] == pytest.approx([0.0, -0.5, 0.25])


def test_every_replicate_is_known():
    rows = [(1.0, 2.0), (1.0, None), (None,)]
    selection = VariantSelection.of(
        [Alternative(variant=v, measures={"m": 1.0}, samples={"m": row}) for v, row in enumerate(rows)]
    )
    term = EvidenceConstraint(measure="m", every_replicate=True)
    assert at_every_selection(selection, term.compile(selection), "violation") == [0.0, 1.0, 1.0]
