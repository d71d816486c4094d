"""Values of a measure in each replicate are the same whether others are wanted or not."""

from __future__ import annotations

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.assessment.replicates import replicates_of


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    """One variant whose second trial fails."""

    def record_for(spec):
        if spec.variant != 1:
            return None
        return record_of(spec, success=spec.seed != 2, planning_s=0.1 * spec.seed, path_m=0.4 + 0.1 * spec.seed)

    (found,) = measure_variants(shipped, filled(shipped, record_for), among=[shipped.designs.variant(1)])
    assert len(found.records) == 3
    return found


def test_each_measure_alone_has_the_values_that_it_has_among_all(shipped, measured):
    everything = replicates_of(shipped.measures, measured)
    assert {*everything} == {measure.id for measure in shipped.measures.measures if measure.from_trials}
    assert any(len({*row}) > 1 for row in everything.values())

    for measure, row in everything.items():
        assert replicates_of(shipped.measures, measured, only=[measure]) == {measure: row}
    wanted = ("S", "t_e_simulated", "C_total")
    assert replicates_of(shipped.measures, measured, only=wanted) == {name: everything[name] for name in wanted[:2]}
