from __future__ import annotations

import itertools

import pytest

from rgss.tradeoff import NearestAlternative, RequirementCount
from rgss.tradeoff.conflicts import find_conflicts
from rgss.tradeoff.enumeration import enumerate_alternatives


def test_none_where_something_is_feasible(payload_and_time):
    assert find_conflicts(enumerate_alternatives(payload_and_time)) is None


def test_hand_worked(build_problem):
    """R-1 and R-3 each leave an alternative, together none; R-2 excludes one but is not needed."""
    problem = build_problem(
        {
            1: {"a": 0.9, "b": 0.1, "c": 0.9},
            2: {"a": 0.9, "b": 0.9, "c": 0.9},
            3: {"a": 0.1, "b": 0.9, "c": 0.1},
        },
        thresholds=[("R-1", "a", ">=", 0.5), ("R-2", "b", ">=", 0.5), ("R-3", "c", "<=", 0.5)],
    )
    conflicts = find_conflicts(enumerate_alternatives(problem))
    assert conflicts is not None
    assert conflicts.excluded_by == (
        RequirementCount(requirement="R-1", excluded=1),
        RequirementCount(requirement="R-2", excluded=1),
        RequirementCount(requirement="R-3", excluded=2),
    )
    assert conflicts.minimal_conflict == ("R-1", "R-3")
    assert conflicts.nearest == NearestAlternative(variant=2, requirements=("R-3",))


def test_missing_evidence_is_a_requirement_like_others(build_problem):
    problem = build_problem({4: {"a": None, "b": 1.0}, 2: {"a": None, "b": 0.0}}, thresholds=[("R", "b", ">=", 0.5)])
    conflicts = find_conflicts(enumerate_alternatives(problem))
    assert conflicts is not None
    assert conflicts.minimal_conflict == ("evidence:a",)
    assert conflicts.nearest == NearestAlternative(variant=4, requirements=("evidence:a",))


@pytest.mark.parametrize("seed", range(40))
def test_the_conflict_is_minimal_by_brute_force(seeded, build_problem, seed):
    rng = seeded(seed)
    names = "abcde"
    measures = {variant: {name: rng.randrange(4) / 3 for name in names} for variant in range(1, 8)}
    thresholds = [(f"R-{name}", name, ">=", rng.choice([0.3, 0.6, 1.0])) for name in names]
    conflicts = find_conflicts(enumerate_alternatives(build_problem(measures, thresholds=thresholds)))

    violated = {
        variant: {requirement for requirement, name, _, value in thresholds if quantities[name] < value}
        for variant, quantities in measures.items()
    }

    def conflict(requirements):
        return all(violation & set(requirements) for violation in violated.values())

    if conflicts is None:
        assert not conflict([requirement for requirement, *_ in thresholds])
        return
    assert conflict(conflicts.minimal_conflict)
    for smaller in itertools.combinations(conflicts.minimal_conflict, len(conflicts.minimal_conflict) - 1):
        assert not conflict(smaller)
    fewest = min(len(violation) for violation in violated.values())
    assert conflicts.nearest.variant == min(v for v, violation in violated.items() if len(violation) == fewest)
    assert set(conflicts.nearest.requirements) == violated[conflicts.nearest.variant]
    assert [count.excluded for count in conflicts.excluded_by] == [
        sum(requirement in violation for violation in violated.values()) for requirement, *_ in thresholds
    ]
