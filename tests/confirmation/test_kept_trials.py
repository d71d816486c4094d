"""Which stored trials are those of confirmations, and stay when the evidence is cleared up."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.confirmation import confirmation_settings, confirmation_trials
from rgss.confirmation.settings import Engine
from rgss.evidence import EvidenceStore, Provenance
from rgss.studies import named_inputs, trial_specs
from rgss.sweep.trial_keys import key_of


@pytest.fixture
def store(tmp_path):
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as opened:
        yield opened


def put(store, spec, record_of):
    """A made trial with the named inputs that a sweep would keep."""
    named = named_inputs(spec)
    provenance = Provenance(inputs={}, versions={}, inputs_digest=named.digest)
    store.put_many(trials=[(key_of(spec), record_of(spec), provenance)], inputs=[named.values])
    return key_of(spec)


def specs_with(project, **settings):
    """One trial of variant 28 under each setting of a confirmation but the study's own."""
    others = confirmation_settings(project, engines=[Engine.PYBULLET], **settings)[1:]
    return [trial_specs(one.of(project), variants=[project.designs.variant(28)], seeds=[2])[0] for one in others]


def test_trials_with_other_physics_are_those_of_confirmations(shipped, store, record_of):
    kept = {put(store, spec, record_of) for spec in specs_with(shipped)}
    kept |= {put(store, spec, record_of) for spec in specs_with(shipped, rate_hz=2000.0, iterations=77)}
    assert len(kept) == 4
    assert confirmation_trials([shipped], store) == kept


def test_trials_of_another_state_of_the_study_are_not(shipped, store, record_of):
    planning = shipped.study.planning
    planning = replace(planning, settings=replace(planning.settings, resolution_rad=0.031))
    other = replace(shipped, study=replace(shipped.study, planning=planning))
    keys = {put(store, spec, record_of) for spec in specs_with(other)}
    assert confirmation_trials([shipped], store) == frozenset()
    assert confirmation_trials([shipped, other], store) == keys


def test_the_name_of_the_scene_is_no_state_of_the_study(shipped, store, record_of):
    keys = {put(store, spec, record_of) for spec in specs_with(shipped)}
    renamed = replace(shipped, scene=replace(shipped.scene, id="lab"))
    assert confirmation_trials([renamed], store) == keys == {key_of(spec) for spec in specs_with(renamed)}


def test_seeds_before_the_first_are_not(shipped, store, record_of):
    keys = {put(store, spec, record_of) for spec in specs_with(shipped)}
    later = replace(shipped, study=replace(shipped.study, seed=9))
    assert confirmation_trials([later], store) == frozenset()
    assert confirmation_trials([later, shipped], store) == keys


def test_a_trial_whose_inputs_were_not_kept_is_not(shipped, store, record_of):
    (spec, *_) = specs_with(shipped)
    store.put(key_of(spec), record_of(spec), Provenance(inputs={}, versions={}))
    assert confirmation_trials([shipped], store) == frozenset()
