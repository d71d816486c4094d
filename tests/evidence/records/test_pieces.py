"""Pieces, named inputs and failures of the run in the store, and many things in one transaction."""

import json
import random
from dataclasses import replace

import pytest

from rgss.errors import EvidenceError
from rgss.evidence import (
    EvidenceStore,
    Fidelity,
    Piece,
    PieceKind,
    Provenance,
    RunFailure,
    RunFailureKind,
    inputs_digest,
    text_digest,
)
from rgss.evidence.records.packing import LARGEST_TEXT
from tests.fixtures.stored_inputs import put_inputs

PLAN = Piece(digest="a" * 64, kind=PieceKind.PLAN, text='{"path":[0.1,0.2]}')
TIMING = Piece(digest="b" * 64, kind=PieceKind.TIMING, text="[]")


def failure(name, **changes):
    values = {"what": "execution", "kind": RunFailureKind.CRASHED, "detail": "SIGSEGV", "attempts": 2}
    return RunFailure(key=name, **{**values, **changes})


def test_a_piece_is_found_again(store, path):
    assert store.put_many(pieces=[PLAN])
    assert store.piece(PLAN.digest) == PLAN
    assert store.piece(TIMING.digest) is None
    assert store.has_pieces([PLAN.digest, TIMING.digest]) == {PLAN.digest}
    with EvidenceStore.open(path) as again:
        assert again.piece(PLAN.digest) == PLAN


@pytest.mark.parametrize("kind", PieceKind)
def test_a_piece_of_every_kind(store, kind):
    store.put_many(pieces=[replace(PLAN, kind=kind)])
    assert store.piece(PLAN.digest).kind is kind


@pytest.mark.parametrize("text", ["", "é ☃ 𝄞", "x" * 3_000_000, json.dumps("\ud800")])
def test_a_piece_of_any_text(store, text):
    store.put_many(pieces=[replace(PLAN, text=text)])
    assert store.piece(PLAN.digest).text == text


def test_the_largest_piece_fits_though_it_hardly_compresses(store):
    noise = random.Random(1).randbytes(LARGEST_TEXT)  # noqa: S311
    text = noise.translate(bytes(byte & 0x7F for byte in range(256))).decode("ascii")
    store.put_many(pieces=[replace(PLAN, text=text)])
    assert store.piece(PLAN.digest).text == text


def test_the_same_piece_again_changes_nothing(store):
    assert store.put_many(pieces=[PLAN])
    assert not store.put_many(pieces=[PLAN])


@pytest.mark.parametrize("other", [replace(PLAN, text="{}"), replace(PLAN, text="{}", kind=PieceKind.TIMING)])
def test_another_content_of_the_same_inputs_is_non_determinism(store, other):
    store.put_many(pieces=[PLAN])
    with pytest.raises(EvidenceError) as caught:
        store.put_many(pieces=[other])
    assert str(caught.value) == (
        f"non-determinism: {other.kind.value} {'a' * 12} has another result than before (the same inputs must give "
        f"the same content; {text_digest(PLAN.text)[:12]} is stored, {text_digest('{}')[:12]} is not)"
    )
    assert store.piece(PLAN.digest) == PLAN


@pytest.mark.parametrize(
    ("piece", "message"),
    [
        (replace(PLAN, digest="a"), "the digest of a piece must be a SHA-256, got 'a' (use the SHA-256 of its inputs)"),
        (replace(PLAN, text="x" * (16 * 1024 * 1024 + 1)), "the piece has 16777217 bytes; at most 16777216 are kept"),
        (replace(PLAN, text="\ud800"), "the piece cannot be written as UTF-8: surrogates not allowed"),
    ],
)
def test_a_piece_that_cannot_be_kept(store, piece, message):
    with pytest.raises(EvidenceError) as caught:
        store.put_many(pieces=[piece])
    assert str(caught.value) == message


def test_named_inputs_are_kept_once_by_content(store):
    inputs = {"scene": {"clearance_m": 0.008, "bodies": ["leg"]}, "seed": 1}
    name = put_inputs(store, inputs)
    assert put_inputs(store, dict(reversed(inputs.items()))) == name == inputs_digest(inputs)
    assert store.inputs(name) == inputs
    assert store.inputs("f" * 64) is None
    assert store.database.rows("SELECT count(*) FROM inputs") == [(1,)]


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        ({"time": float("nan")}, "the inputs cannot be written: time is nan and has no canonical form"),
        ({"time": object()}, "the inputs cannot be written: time is of type object and has no canonical form"),
        ([1], "the inputs cannot be written: they are not a mapping"),
    ],
)
def test_inputs_that_are_not_plain_are_refused(store, inputs, message):
    with pytest.raises(EvidenceError) as caught:
        put_inputs(store, inputs)
    assert caught.value.message == message


def test_many_at_once(store, record, key):
    inputs = {"seed": 7}
    provenance = Provenance(inputs={"plan": PLAN.digest}, versions={}, inputs_digest=inputs_digest(inputs))
    trials = [(key(number), record(variant=number), provenance) for number in range(3)]
    assert store.put_many() == 0
    assert store.put_many(trials=iter(trials), pieces=iter([PLAN, TIMING]), inputs=iter([inputs])) == 5
    assert store.put_many(trials=trials, pieces=[PLAN]) == 0
    assert store.put_many(trials=[*trials, (key(3), record(variant=3), provenance)]) == 1
    assert len(store) == 4
    assert store.inputs(store.get(key(2)).provenance.inputs_digest) == inputs


def test_all_of_many_or_none(store, record, provenance, key):
    store.put_many(pieces=[PLAN])
    for trials, pieces in (
        ([(key(1), record(), provenance)], [TIMING, replace(PLAN, text="[]")]),
        ([(key(1), record(), provenance), (key(1), record(seed=8), provenance)], [TIMING]),
        ([(key(1), record(), provenance), ("k", record(), provenance)], [TIMING]),
        ([(key(1), record(), provenance), (key(2), record(), replace(provenance, inputs_digest="c" * 64))], [TIMING]),
    ):
        with pytest.raises(EvidenceError):
            store.put_many(trials=trials, pieces=pieces, inputs=[{"seed": 7}])
        assert (len(store), store.has_pieces([TIMING.digest])) == (0, set())
        assert store.inputs(inputs_digest({"seed": 7})) is None
    assert store.put_many(trials=[(key(1), record(), provenance)]) == 1


def test_a_trial_cannot_refer_to_inputs_that_are_not_kept(store, record, provenance, key):
    with pytest.raises(EvidenceError) as caught:
        store.put(key(1), record(), replace(provenance, inputs_digest="c" * 64))
    assert str(caught.value) == (
        f"trial {key(1)[:12]} of variant 1, seed 7 refers to inputs that are not stored (store its inputs first)"
    )


@pytest.mark.parametrize("changes", [{"variant": 2**63}, {"seed": -(2**63)}])
def test_a_trial_of_an_impossible_number_is_refused(store, record, provenance, key, changes):
    with pytest.raises(EvidenceError, match=r"^record\.(variant|seed) is beyond 64 bits: -?9223372036854775808$"):
        store.put(key(1), record(**changes), provenance)


def test_trials_of_a_variant_and_seed(store, record, provenance, key):
    newer = replace(provenance, inputs_digest=put_inputs(store, {"seed": 7}))
    for number in range(4):
        store.put(key(number), record(metrics={"slip_m": number}), newer if number > 1 else provenance)
    store.put(key(5), record(seed=8), provenance)
    store.put(key(6), record(variant=2), provenance)
    store.put(key(7), record(fidelity=Fidelity.DYNAMIC), provenance)
    found = [trial.key for trial in store.trials_of(1, 7, Fidelity.CONTACT)]
    assert found == sorted([key(2), key(3)]) + sorted([key(0), key(1)])
    assert [trial.key for trial in store.trials_of(1, 7, Fidelity.DYNAMIC)] == [key(7)]
    assert store.trials_of(1, 9, Fidelity.CONTACT) == ()


def test_failures_of_the_run(store, path):
    crashed, slow = failure("a" * 64), failure("b" * 64, kind=RunFailureKind.TIMED_OUT, detail="60 s")
    assert store.put_failure(slow)
    assert store.put_failure(crashed)
    with EvidenceStore.open(path) as again:
        assert list(again.failures(["a" * 64, "c" * 64, "b" * 64]).items()) == [("a" * 64, crashed), ("b" * 64, slow)]
    assert store.put_failure(replace(slow, attempts=3))
    assert store.failures(["b" * 64])["b" * 64].attempts == 3


def test_what_has_been_made_has_not_failed(store, record, provenance, key):
    store.put_failure(failure(PLAN.digest))
    store.put_failure(failure(key(1), what="trial"))
    store.put_many(pieces=[PLAN], trials=[(key(1), record(), provenance)])
    assert store.failures([PLAN.digest, key(1)]) == {}
    assert not store.put_failure(failure(PLAN.digest))
    assert not store.put_failure(failure(key(1)))
    assert store.failures([PLAN.digest, key(1)]) == {}


def test_a_failure_is_one_line_of_bounded_length(store):
    store.put_failure(failure("a" * 64, detail="MemoryError:\n  at line 3\t" + "x" * 1000, what="\ud800"))
    (kept,) = store.failures(["a" * 64]).values()
    assert kept.detail == ("MemoryError: at line 3 " + "x" * 1000)[:499] + "…"
    assert kept.what == "�"


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"key": "k"}, "the key of a trial or piece must be a SHA-256, got 'k' (use the digest of its inputs)"),
        ({"attempts": 0}, "the number of attempts must be from 1 to 2147483647, got 0"),
        ({"attempts": True}, "the number of attempts must be from 1 to 2147483647, got True"),
        ({"attempts": 2**31}, "the number of attempts must be from 1 to 2147483647, got 2147483648"),
    ],
)
def test_a_failure_that_cannot_be_kept(store, changes, message):
    with pytest.raises(EvidenceError) as caught:
        store.put_failure(replace(failure("a" * 64), **changes))
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("statement", "problem"),
    [
        ("UPDATE failures SET detail = 'all well'", "it is not the one that was put"),
        ("UPDATE failures SET seal = 'x'", "it is not the one that was put"),
        ("UPDATE failures SET kind = 'laughed'", "it is not of a key, texts and a count"),
        ("UPDATE failures SET attempts = 'many'", "it is not of a key, texts and a count"),
        ("UPDATE failures SET detail = x'00'", "it is not of a key, texts and a count"),
    ],
)
def test_a_tampered_failure_is_refused(path, change, statement, problem):
    with EvidenceStore.open(path) as store:
        store.put_failure(failure("a" * 64))
    change(path, statement)
    with EvidenceStore.open(path, label="it") as store, pytest.raises(EvidenceError) as caught:
        store.failures(["a" * 64])
    assert caught.value.message == f"it: failure {'a' * 12} is damaged: {problem}"


@pytest.mark.parametrize("use", ["piece", "inputs", "has_pieces", "failures"])
def test_a_malformed_digest_is_refused(store, use):
    with pytest.raises(EvidenceError, match="the key of a trial must be"):
        getattr(store, use)("k" if use in ("piece", "inputs") else ["k"])
