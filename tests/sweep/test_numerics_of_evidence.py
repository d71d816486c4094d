"""Evidence that was computed with other numerics: told in one line, and never taken for non-determinism."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace

import pytest

from rgss.errors import EvidenceError, SimulationError
from rgss.evidence import EvidenceStore, Piece, PieceKind, Provenance
from rgss.evidence.records.provenance import provenance_from_json, provenance_to_json
from rgss.studies.expansion import trial_specs
from rgss.sweep.evidence_writer import Origin, TrialWriter
from rgss.sweep.running import sweep
from rgss.sweep.trial_keys import key_of
from rgss.sweep.workers import WorkerPool
from rgss.trials.code.numeric_probe import numerics
from tests.fixtures.processes import PATIENCE_S
from tests.fixtures.stored_inputs import put_inputs

OTHERS = {**numerics(), "libm": "another library 0123456789ab"}


@pytest.fixture
def store(tmp_path):
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as opened:
        yield opened


@pytest.fixture
def specs(shipped):
    designs = shipped.designs
    return trial_specs(shipped.with_fidelity("kinematic"), variants=[designs.variant(65)], seeds=[1, 2])


def test_a_provenance_keeps_the_numerics_and_that_of_an_earlier_rgss_has_none():
    origin = Provenance(inputs={"plan": "a"}, versions={}, numerics=OTHERS)
    text = provenance_to_json(origin)
    assert provenance_from_json(text) == origin
    earlier = '{"files":{},"inputs":{},"inputs_digest":"","machine":"m","revision":"","versions":{}}'
    assert provenance_from_json(earlier) == Provenance(inputs={}, versions={}, machine="m")
    without_study = earlier.replace('"revision"', '"numerics":{},"revision"')
    assert provenance_from_json(without_study) == Provenance(inputs={}, versions={}, machine="m")
    with pytest.raises(EvidenceError):
        provenance_from_json(earlier.replace('"machine":"m",', ""))


def test_another_result_of_other_numerics_is_told_as_such(store, specs, record_of):
    key, record = key_of(specs[0]), record_of(specs[0])
    origin = Provenance(inputs={}, versions={}, numerics=numerics())
    store.put(key, record, origin)
    deviating = replace(record, metrics={**record.metrics, "motion_time_s": 8.000001})
    with pytest.raises(EvidenceError, match=r"^non-determinism: trial"):
        store.put(key, deviating, origin)
    with pytest.raises(EvidenceError, match=r"^trial .* in the store was computed with other numerics \(libm: glibc"):
        store.put(key, deviating, replace(origin, numerics=OTHERS))
    # The same result is the same, whoever computed it.
    assert store.put(key, record, replace(origin, numerics=OTHERS)) is False


@pytest.mark.parametrize(("there", "expected"), [(OTHERS, "was computed with other numerics"), (numerics(), "non-d")])
def test_a_piece_that_another_sweep_has_put_with_other_numerics_is_told_as_such(
    store, specs, record_of, there, expected
):
    digest = "a" * 64
    store.put(key_of(specs[0]), record_of(specs[0]), Provenance(inputs={"plan": digest}, versions={}, numerics=there))
    store.put_many(pieces=[Piece(digest=digest, kind=PieceKind.PLAN, text="{}")])
    keeper = TrialWriter(store, Origin, on_kept=lambda *_: None, numerics=numerics)
    keeper.keep_piece(Piece(digest=digest, kind=PieceKind.PLAN, text="[]"))
    with pytest.raises(EvidenceError, match=expected) as caught:
        keeper.flush()
    assert ("non-determinism" in str(caught.value)) == (there == numerics())


@pytest.mark.engine
def test_a_sweep_says_with_what_it_computed_and_goes_on_only_with_the_same(store, specs, tmp_path):
    def run(which, store=store):
        sweep(which, store, jobs=0, on_finished=lambda _: None)

    run(specs[:1])
    (stored,) = store.all()
    assert stored.provenance.numerics == numerics()
    run(specs)
    assert len(store) == 2
    with EvidenceStore.open(tmp_path / "other.sqlite") as other:
        put_inputs(other, store.inputs(stored.provenance.inputs_digest))
        other.put(stored.key, stored.record, replace(stored.provenance, numerics=OTHERS))
        # With nothing to make there is nothing that could be mixed.
        run(specs[:1], other)
        with pytest.raises(EvidenceError, match=r"^the stored trial .* \(variant 65, seed 1\) was computed with other"):
            run(specs, other)
        assert len(other) == 1


def test_a_worker_that_was_started_with_other_kernels_refuses_to_begin(monkeypatch):
    monkeypatch.setattr("rgss.sweep.workers.numeric_environment_of_children", nullcontext)
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "8")
    with WorkerPool(divmod, size=1) as pool:
        pool.prepare_for(1)
        with pytest.raises(
            SimulationError, match="would compute with other kernels: OPENBLAS_NUM_THREADS is 8 instead"
        ):
            pool.wait(PATIENCE_S)
