"""Searches of compared planners that are kept beside the evidence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import PlanOutcome
from rgss.motion import ClockKind
from rgss.studies import load_project, trial_specs
from rgss.sweep import KeptSearches
from rgss.sweep import kept_searches as module
from rgss.trials import PlannedMove, TaskPlan
from tests.fixtures.shipped_project import REPOSITORY


@pytest.fixture(scope="module")
def spec():
    """The first trial of the reference study."""
    return trial_specs(load_project(REPOSITORY), seeds=(1,))[0]


@pytest.fixture
def searched(monkeypatch):
    """The trials that were searched; each search finds the seed times a third."""
    seen = []

    def search(function, spec):
        seen.append(spec)
        move = PlannedMove(
            phase="move_to_grasp",
            outcome=PlanOutcome.SOLVED,
            checks=spec.seed,
            simplification_checks=0,
            search_time_s=0.1,
            time_s=0.1,
            path_rad=np.full((2, 6), spec.seed / 3),
            path_length_m=1.0,
        )
        return TaskPlan(moves={move.phase: move}, direct={}, clock=spec.settings.planning.clock)

    monkeypatch.setattr(module, "compute", search)
    return seen


def path_of(plan):
    return plan.moves["move_to_grasp"].path_rad.tobytes()


def test_a_search_is_made_once_and_read_back_bit_for_bit(tmp_path, spec, searched):
    kept = KeptSearches.beside(tmp_path / "evidence.sqlite")
    first, again = kept.plan(spec), KeptSearches.beside(tmp_path / "evidence.sqlite").plan(spec)

    assert len(searched) == 1
    assert path_of(again) == path_of(first)
    assert again.clock == first.clock
    assert [one.parent.name for one in tmp_path.rglob("*.json")] == ["evidence.searches"]


def test_whatever_a_plan_depends_on_is_searched_again(tmp_path, spec, searched):
    kept = KeptSearches.beside(tmp_path / "evidence.sqlite")
    finer = replace(spec.settings.planning, resolution_rad=spec.settings.planning.resolution_rad / 2)
    others = [
        replace(spec, seed=2),
        replace(spec, planner="PRM", planner_settings=None),
        replace(spec, settings=replace(spec.settings, planning=finer)),
    ]
    for one in (spec, *others, *others):
        kept.plan(one)

    assert searched == [spec, *others]


@pytest.mark.parametrize("damage", ["", "{", "[]", '{"plan": "{}", "sha256": "0"}'])
def test_a_damaged_file_is_searched_again_and_replaced(tmp_path, spec, searched, damage):
    kept = KeptSearches(tmp_path)
    kept.plan(spec)
    (file,) = tmp_path.iterdir()
    sound = file.read_bytes()
    file.write_text(damage, encoding="utf-8")
    kept.plan(spec)

    assert len(searched) == 2
    assert file.read_bytes() == sound


def test_times_of_a_wall_clock_are_not_kept(tmp_path, spec, searched):
    clock = replace(spec.settings.planning.clock, kind=ClockKind.WALL)
    timed = replace(spec, settings=replace(spec.settings, planning=replace(spec.settings.planning, clock=clock)))
    for _ in range(2):
        KeptSearches(tmp_path).plan(timed)

    assert len(searched) == 2
    assert not list(tmp_path.iterdir())


def test_where_nothing_can_be_kept_it_is_searched(tmp_path, spec, searched):
    (tmp_path / "file").touch()
    for folder in (None, tmp_path / "file", tmp_path / "missing" / "folder"):
        KeptSearches(folder).plan(spec)

    assert len(searched) == 3


def test_the_oldest_are_removed(tmp_path, spec, searched, monkeypatch):
    monkeypatch.setattr(module, "MOST_KEPT", 2)
    for seed in (1, 2, 3):
        KeptSearches(tmp_path).plan(replace(spec, seed=seed))
    assert len(list(tmp_path.iterdir())) == 2
    KeptSearches(tmp_path).plan(replace(spec, seed=3))
    assert len(searched) == 3
