"""The regions of weights where alternatives win, against geometry and brute force."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.robustness.flip import weight_shifts
from rgss.tradeoff.weights import weight_region
from rgss.tradeoff.weights.weight_region import RegionKind, winning_regions
from rgss.tradeoff.weights.weight_set import WeightSet

CORNERS = np.eye(3)


def regions_of(values, feasible=None, weights=None):
    values = np.asarray(values, dtype=float)
    feasible = np.ones(len(values), dtype=bool) if feasible is None else np.asarray(feasible)
    return winning_regions(
        values, feasible, weights or WeightSet.simplex(values.shape[1]), generator=np.random.default_rng(0)
    )


def test_specialists_share_the_triangle():
    """Each of three alternatives is best where its own weight is largest: a kite of a third."""
    for place, region in enumerate(regions_of(CORNERS)):
        assert region.kind is RegionKind.OPEN
        assert region.share == pytest.approx(1 / 3)
        assert region.share_error == 0.0
        assert region.low[place] == pytest.approx(1 / 3)
        assert region.high[place] == pytest.approx(1.0)
        assert len(region.vertices) == 4


def test_a_compromise_wins_the_middle():
    """(½, ½, ½) is best where no weight exceeds a half: the triangle of the midpoints, a quarter."""
    *outer, middle = regions_of([*CORNERS, [0.5, 0.5, 0.5]])

    assert [region.share for region in outer] == pytest.approx([0.25] * 3)
    assert middle.share == pytest.approx(0.25)
    assert middle.centre == pytest.approx(np.full(3, 1 / 3))
    # The radius of the circle in a triangle of side √2 / 2.
    assert middle.radius == pytest.approx(np.sqrt(2) / 2 / (2 * np.sqrt(3)))
    assert sorted(map(tuple, np.round(middle.vertices, 9))) == [(0.0, 0.5, 0.5), (0.5, 0.0, 0.5), (0.5, 0.5, 0.0)]


def test_a_compromise_that_only_ties():
    """(⅓, ⅓, ⅓) reaches the best value only at equal weights."""
    tied = regions_of([*CORNERS, [1 / 3, 1 / 3, 1 / 3]])[3]

    assert (tied.kind, tied.share, tied.radius) == (RegionKind.TIES, 0.0, 0.0)
    assert tied.centre == pytest.approx(np.full(3, 1 / 3), abs=1e-6)
    assert tied.low == pytest.approx(tied.high, abs=1e-6)


def test_a_compromise_that_never_wins():
    beaten = regions_of([*CORNERS, [0.3, 0.3, 0.3]])[3]

    assert (beaten.kind, beaten.centre, beaten.low, beaten.share) == (RegionKind.EMPTY, None, None, 0.0)


def test_alternatives_that_are_alike_share_a_region():
    first, second, other = regions_of([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])

    assert first.share == second.share == pytest.approx(0.5)
    assert other.share == pytest.approx(0.5)


def test_what_is_not_feasible_wins_nothing_and_hides_nothing():
    regions = regions_of([[1.0, 1.0], [0.2, 0.6], [np.nan, 0.1]], feasible=[False, True, False])

    assert [region.kind for region in regions] == [RegionKind.EMPTY, RegionKind.OPEN, RegionKind.EMPTY]
    assert regions[1].share == pytest.approx(1.0)


def test_nothing_feasible():
    assert [region.kind for region in regions_of([[1.0, 1.0]], feasible=[False])] == [RegionKind.EMPTY]


def test_one_measure():
    best, other = regions_of([[0.8], [0.3]])

    assert (best.share, other.kind) == (1.0, RegionKind.EMPTY)
    assert best.centre == pytest.approx([1.0])


def test_two_measures_by_hand():
    """0.9 w = 0.3 w + 0.5 (1 - w) at w = 5/11."""
    first, second = regions_of([[0.9, 0.0], [0.3, 0.5]])
    crossing = Fraction(5, 11)

    assert first.low[0] == pytest.approx(float(crossing))
    assert first.share == pytest.approx(float(1 - crossing))
    assert second.high[0] == pytest.approx(float(crossing))


@pytest.mark.parametrize("size", [2, 3, 4, 5, 6])
def test_regions_tile_the_weights_as_brute_force_finds_them(size):
    """Shares sum to 1 and agree with the winners at random weights; bounds hold them all."""
    generator = np.random.default_rng(size)
    values = generator.random((40, size))
    feasible = generator.random(40) > 0.2
    regions = winning_regions(values, feasible, WeightSet.simplex(size), generator=generator)
    weights = generator.dirichlet(np.ones(size), 100_000)
    winners = np.where(feasible, weights @ values.T, -1.0).argmax(axis=1)

    assert sum(region.share for region in regions) == pytest.approx(1.0, abs=1e-9)
    for row, region in enumerate(regions):
        mine = weights[winners == row]
        assert region.share == pytest.approx(len(mine) / 100_000, abs=6e-3)
        if len(mine):
            assert (mine >= region.low - 1e-9).all()
            assert (mine <= region.high + 1e-9).all()
        if region.kind is RegionKind.OPEN:
            totals = np.where(feasible, values @ region.centre, -1.0)
            assert totals[row] == pytest.approx(totals.max(), abs=1e-9)


def test_corners_of_a_region_are_where_brute_force_on_a_grid_changes():
    """Every grid point of weights lies in the region of its winner, by its inequalities alone."""
    values = np.random.default_rng(7).random((12, 3))
    regions = regions_of(values)
    steps = np.array([(i, j, 60 - i - j) for i in range(61) for j in range(61 - i)]) / 60
    totals = steps @ values.T
    for row, region in enumerate(regions):
        wins = totals[:, row] >= totals.max(axis=1) - 1e-12
        if not wins.any():
            continue
        assert region.kind is not RegionKind.EMPTY
        assert (steps[wins] >= region.low - 1e-9).all()
        assert (steps[wins] <= region.high + 1e-9).all()


def test_many_measures_are_sampled_and_say_so():
    generator = np.random.default_rng(8)
    values = generator.random((10, 8))
    regions = regions_of(values)
    open_ones = [region for region in regions if region.kind is RegionKind.OPEN]
    weights = generator.dirichlet(np.ones(8), 200_000)
    shares = np.bincount((weights @ values.T).argmax(axis=1), minlength=10) / 200_000

    assert all(0.0 < region.share_error < 2e-3 for region in open_ones)
    assert sum(region.share for region in regions) == pytest.approx(1.0)
    for region, share in zip(regions, shares, strict=True):
        assert region.share == pytest.approx(share, abs=5 * max(region.share_error, 1e-4))
        assert region.vertices is None


def test_elicited_bounds_and_orders_are_the_whole():
    """With w1 >= w2 >= w3 the first specialist wins all but ties."""
    ordered = WeightSet.cut(np.array([[-1.0, 1.0, 0.0], [0.0, -1.0, 1.0]]), np.zeros(2))
    first, second, third = regions_of(CORNERS, weights=ordered)

    assert first.share == pytest.approx(1.0)
    assert first.centre[0] >= first.centre[1] >= first.centre[2]
    assert second.kind is third.kind is RegionKind.TIES


def test_shares_under_bounds_agree_with_rejection():
    generator = np.random.default_rng(9)
    values = generator.random((15, 4))
    rows = np.array([[0.0, 0.0, 1.0, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.0, -1.0, 0.0, 2.0]])
    limits = np.array([0.4, -0.1, 0.0])
    weights = generator.dirichlet(np.ones(4), 400_000)
    kept = weights[(weights @ rows.T <= limits).all(axis=1)]
    shares = np.bincount((kept @ values.T).argmax(axis=1), minlength=15) / len(kept)
    regions = regions_of(values, weights=WeightSet.cut(rows, limits))

    assert [region.share for region in regions] == pytest.approx(list(shares), abs=8e-3)


def test_a_fixed_weight():
    """With w3 = 0.2 only two weights move; the first wins where w1 > w2."""
    fixed = WeightSet.cut(np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]), np.array([0.2, -0.2]))
    first, second, third = regions_of(CORNERS, weights=fixed)

    assert (first.share, second.share) == pytest.approx((0.5, 0.5))
    assert (first.low[0], first.high[0]) == pytest.approx((0.4, 0.8))
    assert third.kind is RegionKind.EMPTY


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([[0.5, np.nan]], "the values have nan in row 0, column 1"),
        ([[0.5, 1.2]], "the values have 1.2 in row 0, column 1"),
        ([[], []], r"the values are not a table of alternatives by measures: their shape is \(2, 0\)"),
    ],
)
def test_values_that_are_none(values, message):
    with pytest.raises(TradeoffError, match=message):
        regions_of(values, weights=WeightSet.simplex(2))


def test_of_many_alternatives_only_those_that_none_dominates_count(monkeypatch):
    values = np.round(np.random.default_rng(8).random((60, 3)), 2)
    every = regions_of(values)
    shifts = weight_shifts(values, np.ones(60, dtype=bool), np.array([0.5, 0.3, 0.2]))
    monkeypatch.setattr(weight_region, "ALL_RIVALS_TO", 10)
    some = regions_of(values)
    fewer = weight_shifts(values, np.ones(60, dtype=bool), np.array([0.5, 0.3, 0.2]))

    assert [one.kind for one in some] == [one.kind for one in every]
    assert [one.share for one in some] == pytest.approx([one.share for one in every], abs=1e-9)
    assert sum(one.share for one in some) == pytest.approx(1.0)
    for one, other in zip(some, every, strict=True):
        if other.kind is RegionKind.OPEN:
            assert one.low == pytest.approx(other.low, abs=1e-7)
            assert one.high == pytest.approx(other.high, abs=1e-7)
    assert [one.rows for one in fewer] == [one.rows for one in shifts]
    assert [one.distance for one in fewer] == pytest.approx([one.distance for one in shifts], abs=1e-7)


def test_alternatives_that_can_only_tie_at_the_same_weights_are_solved_once(monkeypatch):
    """Equal in the first measure, beaten in the others: only all weight on the first lets them draw level."""
    generator = np.random.default_rng(3)
    costs = np.repeat([0.2, 0.6, 1.0], 20)
    values = np.column_stack([costs, 0.9 * generator.random((60, 2))])
    values = np.vstack([values, [1.0, 0.95, 0.95], [0.3, 1.0, 1.0]])
    here, all_of_them = np.array([0.2, 0.4, 0.4]), np.ones(len(values), dtype=bool)
    every, shifts = regions_of(values), weight_shifts(values, all_of_them, here)
    monkeypatch.setattr(weight_region, "ALL_RIVALS_TO", 10)
    solved = []
    polytope = weight_region.winning_polytope
    monkeypatch.setattr(
        weight_region, "winning_polytope", lambda values, row, *rest: solved.append(row) or polytope(values, row, *rest)
    )
    shared, fewer = regions_of(values), weight_shifts(values, all_of_them, here)

    # For both, the two that win, and one of the twenty that tie where all weight is on the first measure.
    assert solved == [40, 60, 61] * 2
    assert [one.kind for one in shared] == [one.kind for one in every]
    assert sum(one.kind is RegionKind.TIES for one in shared) == 20
    for one in shared[40:60]:
        assert (one.low, one.high) == (pytest.approx([1.0, 0.0, 0.0], abs=1e-7), pytest.approx([1, 0, 0], abs=1e-7))
    assert [one.share for one in shared] == pytest.approx([one.share for one in every], abs=1e-9)
    assert [one.rows for one in fewer] == [one.rows for one in shifts]
    assert [one.distance for one in fewer] == pytest.approx([one.distance for one in shifts], abs=1e-7)


def test_what_differs_by_a_hair_shares_no_region():
    values = np.array([[1.0, 0.5], [1.0, 0.2], [1.0 - 1e-9, 0.2], [0.4, 0.1]])
    keys = weight_region.shared_region_keys(values, values[:1])

    assert keys[0] is None
    assert keys[1] is not None
    assert keys[2] is None
    # Beaten in both: no weights are left, whatever the values.
    assert keys[3] == np.full(2, np.nan).tobytes()
    assert weight_region.shared_region_keys(values, None) == (None,) * 4
