from __future__ import annotations

import itertools

import pytest

from rgss.tradeoff import NearestAlternative, RequirementCount, decide
from rgss.tradeoff.infeasibility.conflicts import find_conflicts, minimal_hitting_sets
from rgss.tradeoff.programs.enumeration import enumerate_alternatives


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


def test_what_no_alternative_has_a_value_of_is_named(build_problem):
    """R-2 excludes both, but none is shown to violate it; of R-1 one of them has a value."""
    problem = build_problem(
        {1: {"a": 0.1, "b": None}, 2: {"a": None, "b": None}},
        thresholds=[("R-1", "a", ">=", 0.5), ("R-2", "b", ">=", 0.5)],
        values={"a": (0.0, 1.0), "b": (0.0, 1.0)},
        weights={"a": 0.5, "b": 0.5},
    )
    conflicts = decide(problem).conflicts
    assert conflicts.unmeasured == ("R-2",)
    assert conflicts.unvalued == ("b",)
    known = decide(build_problem({1: {"a": 0.1}}, thresholds=[("R", "a", ">=", 0.5)])).conflicts
    assert (known.unmeasured, known.unvalued) == ((), ())


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


@pytest.mark.parametrize("seed", range(40))
def test_all_minimal_conflicts_by_trying_each_set(seeded, build_problem, seed):
    rng = seeded(f"all {seed}")
    names = "abcdef"
    measures = {variant: {name: rng.randrange(4) / 3 for name in names} for variant in range(1, rng.randrange(3, 12))}
    thresholds = [(f"R-{name}", name, ">=", rng.choice([0.3, 0.6, 1.0])) for name in names]
    conflicts = find_conflicts(enumerate_alternatives(build_problem(measures, thresholds=thresholds)))
    violated = [
        {requirement for requirement, name, _, value in thresholds if quantities[name] < value}
        for quantities in measures.values()
    ]
    ids = [requirement for requirement, *_ in thresholds]
    subsets = [set(each) for size in range(len(ids) + 1) for each in itertools.combinations(ids, size)]
    clashing = [each for each in subsets if all(each & violation for violation in violated)]
    smallest = {tuple(sorted(each)) for each in clashing if not any(other < each for other in clashing)}
    repaired = [each for each in subsets if any(violation <= each for violation in violated)]
    corrections = {tuple(sorted(each)) for each in repaired if not any(other < each for other in repaired)}
    if conflicts is None:
        assert not clashing
        return
    assert {tuple(sorted(each)) for each in conflicts.minimal_conflicts} == smallest
    assert conflicts.complete
    assert conflicts.minimal_conflict == conflicts.minimal_conflicts[0]
    assert [len(each) for each in conflicts.minimal_conflicts] == sorted(map(len, conflicts.minimal_conflicts))
    assert {tuple(sorted(each)) for each in conflicts.corrections} == corrections


def test_more_conflicts_than_are_listed():
    """n pairs of which each alternative violates one: 2^n minimal conflicts."""
    pairs = [(2 * place, 2 * place + 1) for place in range(12)]
    found, complete = minimal_hitting_sets(pairs, 100)
    assert (len(found), complete) == (100, False)
    assert all(set(each) & set(pair) for each in found for pair in pairs)
    found, complete = minimal_hitting_sets(pairs[:5], 100)
    assert (len(found), complete) == (32, True)
