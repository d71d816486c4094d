"""What is said of a metric, from its pairs."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

from rgss.regression import paired
from rgss.regression.comparing import Guard, Outcome
from rgss.regression.judging import judge, pair, weights_of
from rgss.regression.looking import settle

TIMES = [2.0, 2.5, 1.5, 3.0, 2.2, 1.9]


def outcome_of(*candidates, level=0.05):
    return [one.outcome for one in judge(candidates, level=level, look=1)]


@pytest.mark.parametrize(
    ("by", "higher", "expected"),
    [
        (0.0, False, Outcome.SAME),
        (0.5, False, Outcome.SAME),
        (1.5, False, Outcome.WORSE),
        (-1.5, False, Outcome.BETTER),
        (1.5, True, Outcome.BETTER),
        (-1.5, True, Outcome.WORSE),
        (1.0, False, Outcome.INCONCLUSIVE),
    ],
)
def test_a_shift_against_its_margin(candidate, by, higher, expected):
    new = [each + by + 0.001 * place for place, each in enumerate(TIMES)]
    if by == 1.0:
        new = [each + by + 0.1 * (-1) ** place for place, each in enumerate(TIMES)]
    assert outcome_of(candidate(TIMES, new, higher=higher)) == [expected]


@pytest.mark.parametrize(("by", "expected"), [(1.5, Outcome.MOVED), (-1.5, Outcome.MOVED), (0.2, Outcome.SAME)])
def test_where_neither_direction_is_better_a_move_either_way_is_one(candidate, by, expected):
    new = [each + by + 0.001 * place for place, each in enumerate(TIMES)]
    assert outcome_of(candidate(TIMES, new, both=True)) == [expected]


def test_the_same_excludes_both_directions(candidate):
    """Times a sixtieth of what they were are not the same, whichever direction is better."""
    new = [each / 60.0 for each in TIMES]
    assert outcome_of(candidate(TIMES, new, margin=1.0)) == [Outcome.BETTER]
    assert outcome_of(candidate(TIMES[:3], new[:3], margin=1.9)) == [Outcome.INCONCLUSIVE]


def test_a_margin_in_per_cent_of_the_baseline():
    guard = Guard(unit="s", higher_is_better=False, margin=0.1, is_success=False, relative=0.2)
    assert [guard.for_baseline(mean).margin for mean in (None, 0.0, 0.4, -2.0, 5.0)] == [0.1, 0.1, 0.1, 0.4, 1.0]


def test_what_is_bit_for_bit_the_same_costs_no_other_comparison_its_part(candidate):
    worse = candidate([1.0] * 9, [0.0] * 9, success=True, higher=True, margin=0.2)
    same = [candidate(TIMES, TIMES, metric=f"m{place}", identical=True) for place in range(200)]
    (alone,) = judge([worse], level=0.05, look=1)
    assert judge([worse, *same], level=0.05, look=1)[0].p_values == alone.p_values


def test_the_success_of_whole_trials_has_half_of_the_error_rate(candidate):
    whole = candidate([1.0] * 9, [0.0] * 9, success=True, higher=True, margin=0.2, phase="trial")
    others = [candidate(TIMES, [each + 9.0 for each in TIMES], metric=f"m{place}") for place in range(200)]
    assert weights_of([whole, *others])[0] == 0.5
    (alone,) = judge([whole], level=0.05, look=1)
    assert judge([whole, *others], level=0.05, look=1)[0].p_values["worse"] <= 2.0 * alone.p_values["worse"] + 1e-12


def test_noise_beyond_the_margin_is_inconclusive(candidate):
    assert outcome_of(candidate([0.0, 9.0, 3.0, 5.0], [9.0, 0.0, 5.0, 3.0])) == [Outcome.INCONCLUSIVE]


def test_variants_of_a_seed_are_one_draw(candidate):
    one = candidate({1: [1.0, 2.0], 2: [3.0, 4.0]}, {1: [2.0, 2.0], 2: [6.0, 4.5]})
    pairs = pair(one.baseline, one.current, one.seeds, one.guard)
    assert pairs.worsening.tolist() == [2.0, 0.25]
    assert (pairs.count, pairs.lost) == (4, 0)
    # Ten copies of a variant say no more than one.
    noisy = np.random.default_rng(1).normal(0.8, 1.0, size=8).tolist()
    zeros = [0.0] * 8
    (single,) = judge([candidate(zeros, noisy)], level=0.05, look=1)
    copies = dict.fromkeys(range(1, 11), noisy)
    (many,) = judge([candidate(dict.fromkeys(copies, zeros), copies)], level=0.05, look=1)
    assert many.p_values == pytest.approx(single.p_values)


def test_what_no_trial_tells_any_more_is_missing(candidate):
    (found,) = judge([candidate(TIMES, [None] * 6)], level=0.05, look=1)
    assert (found.outcome, found.lost, found.worsening) == (Outcome.MISSING, 6, None)


def test_what_some_trials_tell_no_more_is_counted(candidate):
    (found,) = judge([candidate([*TIMES, None], [*TIMES[:4], None, None, 1.0])], level=0.05, look=1)
    assert (found.outcome, found.pairs, found.lost) == (Outcome.SAME, 4, 2)


@pytest.mark.parametrize(("seeds", "expected"), [(8, Outcome.INCONCLUSIVE), (30, Outcome.SAME)])
def test_a_mean_is_not_the_same_while_seeds_that_move_by_much_may_be_unseen(candidate, seeds, expected):
    """Every seventh seed may move by seven margins, which eight seeds leave out in three of ten cases."""
    old = [0.0, 7.0] * (seeds // 2)
    assert outcome_of(candidate(old, [value + 1e-6 for value in old])) == [expected]


def test_seeds_of_the_baseline_that_are_not_compared_tell_by_how_much_a_seed_may_move(candidate):
    old = [1.0] * 8 + [8.0]
    one = candidate(old, [value + 1e-6 for value in old])
    assert outcome_of(replace(one, seeds=tuple(range(8)))) == [Outcome.INCONCLUSIVE]
    assert outcome_of(candidate(old[:8], [value + 1e-6 for value in old[:8]])) == [Outcome.SAME]


def test_the_same_is_rarely_said_where_a_few_seeds_got_much_worse(candidate):
    """One of twenty seeds is worse by 24 margins, so that the mean is worse by 1.2; eight seeds are looked at first."""
    draw, said = np.random.default_rng(3), []
    for _ in range(40):
        old = draw.gamma(2.0, 1.0, 64)
        new = old + np.where(draw.random(64) < 0.05, 24.0, 1e-6)
        whole = candidate(old.tolist(), new.tolist())
        found = settle(
            lambda look, _, one=whole: [replace(one, seeds=tuple(range((8, 64)[look - 1])))], looks=2, error_rate=0.05
        )
        said.append(found.comparisons[whole.subject].outcome)
    # The range of the baseline's seeds is less than 24 margins: of 64 seeds none is worse in 4 % of the cases.
    assert said.count(Outcome.SAME) <= 4


def test_one_pair_is_inconclusive(candidate):
    assert outcome_of(candidate([1.0], [9.0])) == [Outcome.INCONCLUSIVE]


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ([1.0] * 12, [0.0] * 12, Outcome.WORSE),
        ([0.0] * 12, [1.0] * 12, Outcome.BETTER),
        ([1.0] * 12, [1.0] * 12, Outcome.SAME),
        # Nothing changed in four seeds, which proves little of a probability.
        ([1.0] * 4, [1.0] * 4, Outcome.INCONCLUSIVE),
        ([1.0] * 4, [0.0] * 4, Outcome.INCONCLUSIVE),
        # Six of thirty are worse and none is better: a loss of the margin is as likely to show as 6 as as 9.
        ([1.0] * 30, [0.0] * 6 + [1.0] * 24, Outcome.WORSE),
        # Six of sixty are significant, too, but less than half of the margin, which is excluded.
        ([1.0] * 60, [0.0] * 6 + [1.0] * 54, Outcome.SAME),
        ([0.0] * 30, [1.0] * 6 + [0.0] * 24, Outcome.BETTER),
    ],
)
def test_success(candidate, old, new, expected):
    assert outcome_of(candidate(old, new, success=True, higher=True, margin=0.25)) == [expected]


def test_what_is_bit_for_bit_the_same_needs_no_statistics(candidate):
    one = candidate([1.0] * 2, [1.0] * 2, success=True, higher=True, margin=0.1, identical=True)
    assert outcome_of(one) == [Outcome.SAME]


def test_many_comparisons_ask_for_more(candidate):
    # A p-value of about 2^-8: enough alone, not among ten.
    worse = candidate([1.0] * 7, [0.0] * 7, success=True, higher=True, margin=0.2)
    assert outcome_of(worse) == [Outcome.WORSE]
    others = [candidate(TIMES, TIMES, metric=f"m{place}") for place in range(9)]
    assert outcome_of(worse, *others)[0] is Outcome.INCONCLUSIVE
    assert set(outcome_of(worse, *others)[1:]) == {Outcome.SAME}


def test_looks_go_on_until_nothing_is_inconclusive(candidate):
    asked, told = [], []

    def at(look, runs):
        asked.append((look, runs))
        count = 4 * look
        return [
            candidate([1.0] * count, [0.0] * count, success=True, higher=True, margin=0.2, run="grasp"),
            candidate(TIMES, TIMES, run="other"),
        ]

    found = settle(at, looks=5, error_rate=0.05, on_look=lambda *seen: told.append(seen))
    assert asked == [(1, None), (2, {"grasp"}), (3, {"grasp"})][: found.looks]
    assert told == [(1, 0), (2, 1), (3, 1)][: found.looks]
    by_run = {subject.run: one for subject, one in found.comparisons.items()}
    assert (by_run["grasp"].outcome, by_run["other"].outcome) == (Outcome.WORSE, Outcome.SAME)
    # What was decided at the first look keeps what it was decided by.
    assert by_run["other"].look == 1
    assert by_run["grasp"].look == found.looks


@pytest.mark.parametrize(
    ("moved", "expected"),
    [([9.0] * 8, Outcome.WORSE), ([4.0] * 4 + [0.1] * 4, Outcome.INCONCLUSIVE), ([0.1] * 8, Outcome.SAME)],
)
def test_seeds_that_another_comparison_asks_for_may_refute_the_same(candidate, moved, expected):
    old = TIMES + TIMES[:2]
    new = [value + 0.001 for value in old]

    def at(look, _runs):
        of_all = [
            candidate(old * 2, new + [value + by for value, by in zip(old, moved, strict=True)]),
            candidate([0.0, 5.0] * 8, [5.0, 0.0] * 8, metric="open"),
        ]
        return [replace(one, seeds=tuple(range(8 * look))) for one in of_all]

    found = settle(at, looks=2, error_rate=0.05)
    (same, _) = found.comparisons.values()
    assert (same.outcome, same.look, same.seeds) == (expected, 2, 16)


def test_what_was_bit_for_bit_the_same_is_compared_where_it_is_so_no_longer(candidate):
    def at(look, _runs):
        first = candidate(TIMES * look, TIMES * look if look == 1 else [9.0] * 12, identical=look == 1)
        return [first, candidate([0.0, 5.0] * look, [5.0, 0.0] * look, metric="open")]

    found = settle(at, looks=2, error_rate=0.05)
    (first, _) = found.comparisons.values()
    assert (first.outcome, first.identical) == (Outcome.WORSE, False)


def test_a_seed_that_moved_by_more_than_the_range_tells_by_how_much_others_may(candidate):
    """One of 64 seeds moved by 24 margins: of such seeds the mean is 1.2 margins worse if every twentieth is one."""
    old = [1.0 + 0.01 * place for place in range(64)]
    new = [value + (24.0 if place == 5 else 1e-6) for place, value in enumerate(old)]
    (found,) = judge([candidate(old, new)], level=0.05, look=1)
    assert found.p_values["same"] >= (1.0 - 1.0 / 24.0) ** 64


def test_the_last_look_may_leave_it_open(candidate):
    found = settle(lambda look, runs: [candidate([0.0, 5.0] * look, [5.0, 0.0] * look)], looks=3, error_rate=0.05)
    assert found.looks == 3
    assert [one.outcome for one in found.comparisons.values()] == [Outcome.INCONCLUSIVE]


@pytest.mark.slow
def test_false_alarms_of_200_guards_over_all_looks(candidate, monkeypatch):
    """Both sides from one distribution, and then worse by exactly the margin: few are called worse."""
    monkeypatch.setattr(paired, "DRAWS", 4_000)
    monkeypatch.setattr(paired, "_counts", lru_cache(paired._counts.__wrapped__))
    generator = np.random.default_rng(11)
    for shift, limit in ((0.0, 0.05), (1.0, 0.05 + 2.0 * (0.05 * 0.95 / 200) ** 0.5)):
        alarms = 0
        for _ in range(200):
            draws = generator.exponential(size=(5, 2, 16))

            def at(look, _runs, draws=draws, shift=shift):
                count = 8 * look
                return [
                    candidate(old[:count].tolist(), (new[:count] + shift).tolist(), metric=f"m{place}")
                    for place, (old, new) in enumerate(draws)
                ]

            found = settle(at, looks=2, error_rate=0.05)
            alarms += any(one.outcome is Outcome.WORSE for one in found.comparisons.values())
        assert alarms / 200 <= limit
