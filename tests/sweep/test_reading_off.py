"""Trials under another charge of a check or other limits, read off stored searches and compared with running them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.evidence import EvidenceStore
from rgss.motion import PlanningClock
from rgss.studies import load_project, trial_settings, trial_specs
from rgss.sweep import StoredSearches, key_of, sweep
from rgss.trials.pieces import Pieces
from tests.cli.conftest import made_record
from tests.fixtures.shipped_project import REPOSITORY
from tests.fixtures.stored_trials import put_trials

pytestmark = pytest.mark.engine

VARIANTS = (28, 36)
SEEDS = (1, 2)


def project_with(**settings):
    """The varied world without contact, so that only planning takes time, under another planning section."""
    project = load_project(REPOSITORY).with_fidelity("kinematic")
    planning = project.study.planning
    planning = replace(planning, settings=replace(planning.settings, **settings))
    return replace(project, study=replace(project.study, planning=planning))


def limited(specs, limit_s):
    """Trials that all have one planning limit, and search as long."""
    settings = specs[0].settings
    same = replace(settings, planning=replace(settings.planning, search_limit_s=limit_s))
    return tuple(replace(spec, planning_limit_s=limit_s, settings=same) for spec in specs)


def specs_of(project):
    return trial_specs(project, variants=[project.designs.variant(number) for number in VARIANTS], seeds=SEEDS)


@pytest.fixture(scope="module")
def searched(tmp_path_factory):
    """A store with the trials of four designs as the study says."""
    project = project_with()
    with EvidenceStore.open(tmp_path_factory.mktemp("searched") / "evidence.sqlite") as store:
        sweep(specs_of(project), store, jobs=0, on_finished=lambda trial: None)
        yield project, store


@pytest.fixture(scope="module")
def compared(searched):
    """Compares what is read off with what running gives; returns how many were read off, and how many are missing."""
    project, store = searched
    own = trial_settings(project).planning

    def compare(specs):
        read_off = missing = 0
        pieces = Pieces()
        for spec in specs:
            found = StoredSearches(store, own).find([spec])
            missing += len(found.missing)
            for record in found.records.values():
                assert record == pieces.record(spec)
            read_off += found.read_off
        return read_off, missing

    return compare


@pytest.mark.parametrize("charge_s", [0.0005, 0.00004])
def test_another_charge(compared, charge_s):
    read_off, _ = compared(specs_of(project_with(clock=PlanningClock(charge_s=charge_s))))
    assert read_off >= 1


@pytest.mark.parametrize("limit_s", [0.2, 1.0])
def test_another_planning_limit(compared, searched, limit_s):
    read_off, missing = compared(limited(specs_of(searched[0]), limit_s))
    assert (read_off, missing) == (len(VARIANTS) * len(SEEDS), 0)


@pytest.mark.parametrize("limit_s", [1.5, 10.0])
def test_another_limit_of_the_simplification(compared, limit_s):
    read_off, _ = compared(specs_of(project_with(simplification_limit_s=limit_s)))
    assert read_off >= 1


def test_a_limit_that_always_decided_the_simplification_needs_trials(searched):
    """No search for shortcuts fits, so that the paths would be others."""
    project, store = searched
    specs = specs_of(project_with(simplification_limit_s=0.05))
    found = StoredSearches(store, trial_settings(project).planning).find(specs)
    assert found.missing == specs
    assert not found.records


def test_a_search_that_ended_at_its_limit_does_not_tell_what_a_longer_one_finds(tmp_path):
    project = project_with()
    short = limited(specs_of(project), 0.3)
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        sweep(short, store, jobs=0, on_finished=lambda trial: None)
        searches = StoredSearches(store, short[0].settings.planning)
        found = searches.find(limited(short, 6.0))
        keys = {(spec.variant, spec.seed): key_of(spec) for spec in short}
        records = store.records(keys.values())
    ended = {name for name, key in keys.items() if not records[key].success}
    assert {(spec.variant, spec.seed) for spec in found.missing} == ended
    assert ended


def test_another_resolution_needs_every_trial(searched):
    project, store = searched
    specs = specs_of(project_with(resolution_rad=0.04))
    found = StoredSearches(store, trial_settings(project).planning).find(specs)
    assert (found.missing, found.read_off) == (specs, 0)


def test_trials_that_are_stored_are_taken_as_they_are(searched):
    project, store = searched
    found = StoredSearches(store, trial_settings(project).planning).find(specs_of(project))
    assert (found.stored, found.read_off, found.missing) == (len(VARIANTS) * len(SEEDS), 0, ())


def test_a_variant_with_the_inputs_of_another_one_has_its_record(tmp_path):
    """Under one planning limit variants 16 and 18 do not differ; the store has neither pieces nor the trial of 18."""
    project = project_with()
    variants = [project.designs.variant(number) for number in (16, 18)]
    specs = limited(trial_specs(project, variants=variants, seeds=[1]), 4.0)
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        put_trials(store, specs[:1], made_record)
        found = StoredSearches(store, trial_settings(project).planning).find(specs)
        (stored,) = store.records([key_of(specs[0])]).values()
    assert (found.stored, found.read_off, found.missing) == (1, 1, ())
    assert found.records[key_of(specs[1])] == replace(stored, variant=18)
