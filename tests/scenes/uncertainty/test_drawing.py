"""Draws: a function of seed and name alone, uniform, independent of each other unless they go together."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from scipy import stats

from rgss.scenes.uncertainty import QUANTITIES, Correlation, Normal, Uncertainty, UncertainValue, draws_of, white_noise
from rgss.scenes.uncertainty.drawing import uniform_of

STANDARD = Normal(mean=0.0, sd=1.0)


def standard(*names, correlations=()):
    values = tuple(UncertainValue(quantity=name, distribution=STANDARD) for name in names)
    return Uncertainty(values=values, correlations=correlations)


def test_a_draw_depends_on_neither_order_nor_company():
    alone = draws_of(standard("perception.x"), 7)["perception.x"]

    together = draws_of(standard("workpiece.y", "perception.y", "perception.x"), 7)
    backwards = draws_of(standard("perception.x", "perception.y", "workpiece.y"), 7)
    assert together["perception.x"] == alone
    assert dict(together) == dict(backwards)
    assert list(together) == list(backwards)


def test_draws_are_the_same_in_another_process():
    script = (
        "from rgss.scenes.uncertainty.drawing import uniform_of, white_noise\n"
        "print(uniform_of(3, 'perception.x'), white_noise(3, 'noise', 2).tolist())"
    )
    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout

    assert found.strip() == f"{uniform_of(3, 'perception.x')} {white_noise(3, 'noise', 5).tolist()[:2]}"


def test_draws_are_recorded_values_that_no_release_may_change():
    # Evidence of an earlier version is replayed: a change here makes all of it stale.
    assert dict(draws_of(standard("perception.x", "workpiece.x"), 1)) == {
        "workpiece.x": 1.91018165,
        "perception.x": 0.21148981,
    }


def test_names_and_seeds_are_independent():
    table = np.array([[uniform_of(seed, name) for name in QUANTITIES] for seed in range(300)])

    assert stats.kstest(table.ravel(), "uniform").pvalue > 0.01
    correlations = np.corrcoef(table, rowvar=False)
    assert np.abs(correlations - np.eye(len(QUANTITIES))).max() < 0.25
    assert abs(np.corrcoef(table[:-1].ravel(), table[1:].ravel())[0, 1]) < 0.05


def test_each_joint_is_drawn_by_itself():
    draws = draws_of(standard("robot.joint_offset"), 1, joints=6)

    assert list(draws) == [f"robot.joint_offset.{joint}" for joint in range(1, 7)]
    assert len(set(draws.values())) == 6


def test_a_group_has_its_correlations_and_leaves_the_others_alone():
    group = Correlation(quantities=("perception.x", "perception.y"), matrix=((1.0, 0.8), (0.8, 1.0)))
    names = ("perception.x", "perception.y", "workpiece.x")

    apart = [draws_of(standard(*names), seed) for seed in range(400)]
    together = [draws_of(standard(*names, correlations=(group,)), seed) for seed in range(400)]

    def correlation(rows, first, second):
        return np.corrcoef([row[first] for row in rows], [row[second] for row in rows])[0, 1]

    assert correlation(apart, *names[:2]) == pytest.approx(0.0, abs=0.15)
    assert correlation(together, *names[:2]) == pytest.approx(0.8, abs=0.06)
    assert [row["workpiece.x"] for row in together] == [row["workpiece.x"] for row in apart]
    for name in names[:2]:
        assert stats.kstest([row[name] for row in together], "norm").pvalue > 0.01


def test_a_group_that_is_declared_in_part_has_no_effect():
    group = Correlation(quantities=("perception.x", "perception.y"), matrix=((1.0, 0.8), (0.8, 1.0)))

    assert dict(draws_of(standard("perception.x", correlations=(group,)), 1)) == dict(
        draws_of(standard("perception.x"), 1)
    )


def test_a_draw_has_nine_digits_so_that_every_processor_draws_it():
    draw = draws_of(standard("perception.x"), 1)["perception.x"]

    assert draw == float(f"{draw:.9g}")
