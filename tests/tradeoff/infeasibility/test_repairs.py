"""What would have to change for something to be feasible: each repair is put in and decided anew."""

from __future__ import annotations

import dataclasses
import math

import pytest

from rgss.tradeoff import (
    Aim,
    Alternative,
    ChanceBound,
    Comparison,
    Lexicographic,
    LimitChange,
    MinimaxRegret,
    TailBound,
    decide,
)


def relaxed(problem, repair):
    """The problem with the limits of a repair."""
    needed = {change.demand: change.needed for change in repair.changes}
    requirements = {change.requirement for change in repair.changes}
    return dataclasses.replace(
        problem,
        thresholds=tuple(
            dataclasses.replace(one, value=needed[one.demand])
            if one.demand in needed and one.requirement in requirements
            else one
            for one in problem.thresholds
        ),
    )


def test_by_hand(build_problem):
    problem = build_problem(
        {
            1: {"a": 0.9, "b": 0.30},
            2: {"a": 0.4, "b": 0.80},
            3: {"a": 0.7, "b": 0.45},
            4: {"a": 0.2, "b": 0.10},
        },
        thresholds=[("R-a", "a", ">=", 0.5), ("R-b", "b", ">=", 0.5)],
        values={"a": (0.0, 1.0), "b": (0.0, 1.0)},
        weights={"a": 0.5, "b": 0.5},
    )
    first, second = decide(problem).conflicts.repairs
    assert first.changes == (LimitChange(requirement="R-a", demand="a >= 0.5 kg", limit=0.5, needed=0.4, unit="kg"),)
    assert (first.requirement, first.unlocked, first.winner) == ("R-a", 1, 2)
    assert first.changes[0].relative == pytest.approx(0.2)
    assert second.changes[0].needed == 0.45
    assert (second.requirement, second.unlocked, second.winner) == ("R-b", 1, 3)


def test_no_change_of_one_requirement_helps(build_problem):
    problem = build_problem({1: {"a": 0.1, "b": 0.1}}, thresholds=[("R-a", "a", ">=", 0.5), ("R-b", "b", ">=", 0.5)])
    assert [(one.changes, one.unlocked, one.winner) for one in decide(problem).conflicts.repairs] == [((), 0, None)] * 2


def test_missing_evidence_cannot_be_repaired(build_problem):
    problem = build_problem({1: {"a": None}}, thresholds=[("R", "a", ">=", 0.5)])
    (repair,) = decide(problem).conflicts.repairs
    assert (repair.changes, repair.winner) == ((), None)
    problem = build_problem({1: {"a": None, "b": 0.0}}, thresholds=[("R", "b", ">=", 0.5)])
    assert [repair.changes for repair in decide(problem).conflicts.repairs] == [(), ()]


def test_a_requirement_with_two_limits_moves_both_where_both_are_missed(build_problem):
    problem = build_problem(
        {1: {"a": 0.4, "b": 12.0}, 2: {"a": 0.1, "b": 10.0}},
        thresholds=[("R", "a", ">=", 0.5), ("R", "b", "<=", 10.0)],
    )
    (repair,) = decide(problem).conflicts.repairs
    assert [(change.demand, change.needed) for change in repair.changes] == [("a >= 0.5 kg", 0.4), ("b <= 10 kg", 12.0)]
    assert decide(relaxed(problem, repair)).chosen == repair.winner == 1


def test_a_limit_of_zero_has_no_relative_change(build_problem):
    problem = build_problem({1: {"a": 2.0}}, thresholds=[("R", "a", "<=", 0.0)])
    (repair,) = decide(problem).conflicts.repairs
    assert (repair.changes[0].needed, repair.changes[0].relative) == (2.0, None)


def test_of_a_chance_and_a_tail_the_level_and_the_limit_move(build_problem):
    alternatives = (Alternative(variant=1, measures={"a": 0.5}, samples={"a": (0.1, 0.3, 0.7, 0.9)}),)
    common = {"measure": "a", "comparison": Comparison.AT_LEAST, "unit": "1"}
    risks = (
        ChanceBound(requirement="chance:a", value=0.5, probability=0.75, **common),
        TailBound(requirement="tail:a", value=0.3, share=0.5, **common),
    )
    decision = decide(build_problem({}, alternatives=alternatives, risks=risks[:1]))
    assert decision.conflicts.repairs[0].changes[0] == LimitChange(
        requirement="chance:a", demand="P[a >= 0.5] >= 0.75", limit=0.75, needed=0.5, unit="1"
    )
    decision = decide(build_problem({}, alternatives=alternatives, risks=risks[1:]))
    assert decision.conflicts.repairs[0].changes[0].needed == pytest.approx(0.2)


def test_a_chance_of_nothing_is_no_demand(build_problem):
    risk = ChanceBound(
        requirement="chance:a", measure="a", comparison=Comparison.AT_LEAST, value=0.5, unit="1", probability=0.5
    )
    alternatives = (Alternative(variant=1, measures={"a": 0.2}, samples={"a": (0.1, 0.3)}),)
    repair, *_ = decide(build_problem({}, alternatives=alternatives, risks=(risk,))).conflicts.repairs
    assert (repair.requirement, repair.changes, repair.winner) == ("chance:a", (), None)


def test_two_requirements_move_together_where_neither_is_enough(build_problem):
    problem = build_problem(
        {
            1: {"a": 0.40, "b": 0.45, "c": 0.0},
            2: {"a": 0.45, "b": 0.20, "c": 0.0},
            3: {"a": 0.42, "b": 0.46, "c": 0.0},
            4: {"a": 0.10, "b": 0.90, "c": 0.9},
        },
        thresholds=[("R-a", "a", ">=", 0.5), ("R-b", "b", ">=", 0.5), ("R-c", "c", "<=", 0.5)],
        values={"a": (0.0, 1.0)},
        weights={"a": 1.0},
    )
    conflicts = decide(problem).conflicts
    assert all(not repair.changes for repair in conflicts.repairs)
    assert conflicts.corrections == (("R-a", "R-b"), ("R-a", "R-c"))
    first, second = conflicts.joint_repairs
    assert (first.requirements, first.unlocked, first.winner) == (("R-a", "R-b"), 1, 3)
    assert [(change.requirement, change.needed) for change in first.changes] == [("R-a", 0.42), ("R-b", 0.46)]
    assert (second.requirements, second.winner) == (("R-a", "R-c"), 4)


def test_missing_evidence_moves_with_nothing(build_problem):
    problem = build_problem({1: {"a": None, "b": 0.0}}, thresholds=[("R", "b", ">=", 0.5)])
    (repair,) = decide(problem).conflicts.joint_repairs
    assert (repair.requirements, repair.changes, repair.winner) == (("R", "evidence:a"), (), None)


def gaps_of(alternative, limits):
    """By how much, as a share of its limit, an alternative misses what it misses."""
    missed = {}
    for name, (comparison, limit) in limits.items():
        gap = (limit - alternative.measures[name]) * (1 if comparison == ">=" else -1) / limit
        if gap > 0:
            missed[f"R-{name}"] = gap
    return missed


def test_each_joint_repair_is_enough_and_the_smallest(seeded, build_problem):
    names, together = "abcd", 0
    for seed in range(30):
        rng = seeded(f"joint repair {seed}")
        limits = {name: (rng.choice([">=", "<="]), rng.choice([0.2, 0.5, 0.8])) for name in names}
        problem = build_problem(
            {variant: {name: rng.randrange(41) / 40 for name in names} for variant in range(1, 7)},
            thresholds=[(f"R-{name}", name, *limits[name]) for name in names],
            values=dict.fromkeys(names, (0.0, 1.0)),
            weights=dict.fromkeys(names, 1 / 4),
        )
        conflicts = decide(problem).conflicts
        if conflicts is None:
            continue
        assert tuple(repair.requirements for repair in conflicts.joint_repairs) == conflicts.corrections
        for repair in conflicts.joint_repairs:
            mended = decide(relaxed(problem, repair))
            assert (mended.chosen, mended.counts.feasible) == (repair.winner, repair.unlocked)
            gaps = [gaps_of(one, limits) for one in problem.alternatives]
            candidates = [max(each.values()) for each in gaps if set(each) == set(repair.requirements)]
            assert max(change.relative for change in repair.changes) == pytest.approx(min(candidates))
            together += len(repair.requirements) > 1
            if len(repair.requirements) == 1:
                (alone,) = (one for one in conflicts.repairs if one.requirement == repair.requirements[0])
                assert (alone.changes, alone.unlocked, alone.winner) == (repair.changes, repair.unlocked, repair.winner)
    assert together > 10


@pytest.mark.parametrize("seed", range(30))
def test_each_repair_is_the_smallest_and_its_winner_wins(seeded, build_problem, seed):
    rng = seeded(f"repair {seed}")
    names = "abc"
    program = rng.choice(
        [
            {},
            {"program": MinimaxRegret()},
            {"program": Lexicographic(aims=(Aim(measure="b", sense=Comparison.AT_LEAST, absolute=0.2),))},
        ]
    )
    problem = build_problem(
        {variant: {name: rng.randrange(21) / 20 for name in names} for variant in range(1, 15)},
        thresholds=[(f"R-{name}", name, rng.choice([">=", "<="]), rng.choice([0.02, 0.5, 0.98])) for name in names],
        values=dict.fromkeys(names, (0.0, 1.0)),
        weights=dict.fromkeys(names, 1 / 3),
        **program,
    )
    decision = decide(problem)
    if decision.conflicts is None:
        return
    for repair in decision.conflicts.repairs:
        (threshold,) = (one for one in problem.thresholds if one.requirement == repair.requirement)
        if not repair.changes:
            # Without this requirement at all there would be nothing either.
            without = dataclasses.replace(
                problem, thresholds=tuple(one for one in problem.thresholds if one is not threshold)
            )
            assert decide(without).chosen is None
            continue
        mended = decide(relaxed(problem, repair))
        assert (mended.chosen, mended.counts.feasible) == (repair.winner, repair.unlocked)
        (change,) = repair.changes
        towards = math.nextafter(change.needed, threshold.value) + (threshold.value - change.needed) * 1e-6
        less = dataclasses.replace(repair, changes=(dataclasses.replace(change, needed=towards),))
        assert decide(relaxed(problem, less)).chosen is None


@pytest.mark.parametrize("last", [False, True])
def test_of_equals_the_repair_names_the_one_that_is_then_chosen(build_problem, last):
    """All four are worth 1; the first is surpassed in a, beyond the best end."""
    problem = build_problem(
        {
            1: {"a": 1.2, "b": 0.4, "c": 0.6},
            2: {"a": 1.5, "b": 0.4, "c": 0.6},
            3: {"a": 1.5, "b": 0.4, "c": 0.6},
            4: {"a": 1.2, "b": 0.4, "c": 0.6},
        },
        thresholds=[("R-b", "b", ">=", 0.5), ("R-c", "c", ">=", 0.5)],
    )
    conflicts = decide(problem, last_of_equals=last).conflicts
    (joint,) = conflicts.joint_repairs
    for repair in (conflicts.repairs[0], joint):
        then = decide(relaxed(problem, repair), last_of_equals=last)
        assert repair.winner == then.chosen == (3 if last else 2)


def test_of_equal_largest_changes_the_least_in_total_is_taken(build_problem):
    """Both lack a fifth of a; the second lacks less of b."""
    problem = build_problem(
        {1: {"a": 0.4, "b": 0.42}, 2: {"a": 0.4, "b": 0.48}},
        thresholds=[("R-a", "a", ">=", 0.5), ("R-b", "b", ">=", 0.5)],
    )
    (joint,) = decide(problem).conflicts.joint_repairs
    assert [change.needed for change in joint.changes] == [0.4, 0.48]
    assert (joint.unlocked, joint.winner) == (1, 2)


@pytest.mark.parametrize("seed", range(10))
def test_with_a_tolerance_the_required_limit_is_what_changes(seeded, build_problem, seed):
    """Each repair is put in as a requirement, and the tolerance applies to it anew."""
    generator = seeded(seed)
    measures = {number: {"a": generator.uniform(0.1, 0.4), "b": generator.uniform(6.0, 9.0)} for number in range(1, 9)}
    strict = build_problem(measures, thresholds=[("R-a", "a", ">=", 0.8), ("R-b", "b", "<=", 4.0)])

    def with_tolerance(limits):
        return dataclasses.replace(
            strict,
            thresholds=tuple(
                dataclasses.replace(one, value=limits.get(one.requirement, one.value)).tolerated(0.1)
                for one in strict.thresholds
            ),
        )

    conflicts = decide(with_tolerance({})).conflicts
    assert conflicts.joint_repairs
    for repair in conflicts.joint_repairs:
        assert [change.limit for change in repair.changes] == pytest.approx([0.8, 4.0][: len(repair.changes)])
        # Away from the present limit by less than any two quantities differ, so that rounding decides nothing.
        away = {"R-a": 1.0 - 1e-9, "R-b": 1.0 + 1e-9}
        then = decide(with_tolerance({one.requirement: one.needed * away[one.requirement] for one in repair.changes}))
        assert (then.counts.feasible, then.chosen) == (repair.unlocked, repair.winner)


@pytest.mark.parametrize(
    ("sense", "required", "quantity", "needed"),
    [
        (">=", 1.0, -1.0, -1.0 / 1.1),
        (">=", 0.0, -1.0, -1.0 / 1.1),
        (">=", 4.0, 1.0, 1.0 / 0.9),
        (">=", -1.0, -3.0, -3.0 / 1.1),
        ("<=", -1.0, 1.0, 1.0 / 1.1),
        ("<=", 0.0, 1.0, 1.0 / 1.1),
        ("<=", -4.0, -1.0, -1.0 / 0.9),
    ],
)
def test_a_tolerance_is_of_the_magnitude_on_either_side_of_zero(build_problem, sense, required, quantity, needed):
    """By hand: a tenth of a negative threshold takes it the other way than a tenth of a positive one."""
    strict = build_problem({1: {"a": quantity}}, thresholds=[("R-a", "a", sense, required)])
    tolerant = dataclasses.replace(strict, thresholds=(strict.thresholds[0].tolerated(0.1),))

    (repair,) = decide(tolerant).conflicts.repairs
    (change,) = repair.changes
    assert (change.limit, change.needed) == (required, pytest.approx(needed))
    for nudge, feasible in ((1e-6, 1), (-1e-6, 0)):
        value = change.needed - nudge if sense == ">=" else change.needed + nudge
        moved = dataclasses.replace(strict.thresholds[0], value=value).tolerated(0.1)
        assert decide(dataclasses.replace(strict, thresholds=(moved,))).counts.feasible == feasible
