"""Checking a whole store, and mending what can be mended."""

import sqlite3
from dataclasses import replace

import pytest

from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, Piece, PieceKind, RunFailure, RunFailureKind
from rgss.evidence.store import verification
from rgss.evidence.store.tables import FAILURES
from rgss.evidence.store.verification import Damage, remove_damaged_rows, salvage, verify
from tests.fixtures.stored_inputs import put_inputs


@pytest.fixture
def whole(path, record, provenance, key):
    """The path of a store with something in each of its tables."""
    with EvidenceStore.open(path) as store:
        origin = replace(
            provenance, inputs={"plan": "a" * 64, "trial": "f" * 64}, inputs_digest=put_inputs(store, {"seed": 7})
        )
        put_inputs(store, {"seed": 8})
        store.put_many(
            trials=[(key(number), record(variant=number), origin) for number in range(20)],
            pieces=[Piece(digest=letter * 64, kind=PieceKind.PLAN, text="{}") for letter in "abc"],
        )
        store.put_failure(
            RunFailure(key="d" * 64, what="plan", kind=RunFailureKind.TIMED_OUT, detail="60 s", attempts=2)
        )
    return path


def test_a_sound_store(whole):
    found = verify(whole, label="it")
    assert found.damages == ()
    assert not found.pages_are_damaged
    assert found.sound == {"trial": 20, "piece": 3, "inputs": 2, "failure": 1}
    # What nothing refers to is no damage: a sweep may have been interrupted.
    assert (found.orphaned_pieces, found.orphaned_inputs) == (2, 1)


def test_an_empty_store(path):
    EvidenceStore.open(path).close()
    assert verify(path, label="it").sound == {"trial": 0, "piece": 0, "inputs": 0, "failure": 0}


def test_a_store_that_is_not_there_is_not_made(path):
    with pytest.raises(EvidenceError) as caught:
        verify(path, label="it")
    assert str(caught.value) == "there is no evidence in it (run the sweep first)"
    assert not path.exists()


def test_every_damaged_row_is_told_in_a_line_and_taken_away(whole, change, key):
    for statement, value in (
        ("UPDATE trials SET variant = 99 WHERE key = ?", key(3)),
        ("UPDATE trials SET record = zeroblob(9) WHERE key = ?", key(4)),
        ("UPDATE trials SET key = ? WHERE variant = 5", "k"),
        ("UPDATE trials SET fidelity = CAST(x'ff' AS TEXT) WHERE key = ?", key(6)),
        ("UPDATE pieces SET content = x'00' WHERE digest = ?", "a" * 64),
        ("UPDATE inputs SET digest = ? WHERE digest NOT IN (SELECT min(digest) FROM inputs)", "e" * 64),
        ("UPDATE failures SET attempts = 9 WHERE key = ?", "d" * 64),
    ):
        change(whole, statement, value)
    found = verify(whole, label="it")
    lines = [str(damage) for damage in found.damages]
    filed = "it is filed under another variant, seed or fidelity than its record has"
    assert f"trial {key(3)[:12]}: {filed}" in lines
    assert f"trial {key(4)[:12]}: its record cannot be unpacked" in lines
    assert "trial 'k': its key is none" in lines
    assert f"trial {key(6)[:12]}: {filed}" in lines
    assert f"piece {'a' * 12}: its content cannot be unpacked" in lines
    assert f"inputs {'e' * 12}: its content is not the one that was put" in lines
    assert f"failure {'d' * 12}: it is not the one that was put" in lines
    assert not any("\n" in line for line in lines)
    assert not found.pages_are_damaged
    assert found.sound["trial"] == 16

    assert remove_damaged_rows(whole, label="it") == len(found.damages)
    again = verify(whole, label="it")
    assert again.damages == ()
    # If it was the inputs of the trials that were damaged, the trials go with them.
    assert again.sound["trial"] == (0 if len(found.damages) > 7 else 16)


def test_trials_whose_inputs_are_gone_are_damaged(whole, change, key):
    change(whole, "DELETE FROM inputs")
    found = verify(whole, label="it")
    assert len(found.damages) == 20
    assert found.damages[0].what == "trial"
    assert found.damages[0].problem.startswith("its inputs ")
    assert found.damages[0].problem.endswith(" are missing")
    assert remove_damaged_rows(whole, label="it") == 20
    assert verify(whole, label="it").damages == ()


def test_rows_that_were_deleted_are_told_and_mended_by_a_new_ledger(whole, tamper):
    for table in ("pieces", "inputs", "failures"):
        tamper(whole, f"DELETE FROM {table}")  # noqa: S608 - a table's name
    found = verify(whole, label="it")
    assert [str(damage) for damage in found.damages[:3]] == [
        "ledger pieces: 3 rows were stored, 0 are present",
        "ledger inputs: 2 rows were stored, 0 are present",
        "ledger failures: 1 rows were stored, 0 are present",
    ]
    assert not found.pages_are_damaged
    with pytest.raises(EvidenceError) as caught:
        EvidenceStore.open(whole, label="it")
    assert str(caught.value) == (
        "it was changed outside rgss: table pieces: 3 rows were stored, 0 are present "
        "(run 'rgss evidence verify' to see the damage, and with --mend to keep the valid rows)"
    )
    # The trials had inputs that are gone.
    assert remove_damaged_rows(whole, label="it") == 20
    assert verify(whole, label="it").damages == ()
    with EvidenceStore.open(whole) as store:
        assert len(store) == 0


def test_a_failure_that_a_sweep_removes_meanwhile_is_no_damage(whole, monkeypatch):
    row_numbers = verification.row_numbers

    def then_made(connection, table):
        listed = row_numbers(connection, table)
        if table is FAILURES:
            with EvidenceStore.open(whole) as sweep:
                sweep.put_many(pieces=[Piece(digest="d" * 64, kind=PieceKind.PLAN, text="{}")])
        return listed

    monkeypatch.setattr(verification, "row_numbers", then_made)
    assert verify(whole, label="it").damages == ()


def test_a_row_that_another_process_has_made_again_meanwhile_stays(whole, change, key, record, provenance):
    change(whole, "UPDATE trials SET record = zeroblob(9) WHERE key = ?", key(19))
    (damage,) = verify(whole, label="it").damages
    # Another process mends the store first, and a sweep makes the trial again: with the number of the last row.
    assert remove_damaged_rows(whole, label="it") == 1
    with EvidenceStore.open(whole) as store:
        assert store.put(key(19), record(variant=19), provenance)
        assert store.database.rows("SELECT rowid FROM trials WHERE key = ?", [key(19)]) == [(damage.row,)]
    assert remove_damaged_rows(whole, label="it") == 0
    assert verify(whole, label="it").sound["trial"] == 20


def test_an_empty_file_has_nothing_left(whole, tmp_path):
    whole.write_bytes(b"")
    found = verify(whole, label="it")
    assert [str(damage) for damage in found.damages] == ["pages: the file is empty, but an evidence store never is"]
    with pytest.raises(EvidenceError, match="nothing of it can be read"):
        salvage(whole, found, tmp_path / "saved.sqlite", label="it")
    assert whole.stat().st_size == 0


def leaf_of_trials(path):
    """The number of a page that holds trials, found by the text of a seal on it."""
    connection = sqlite3.connect(path)
    seals = [seal.encode() for (seal,) in connection.execute("SELECT seal FROM trials")]
    connection.close()
    content = path.read_bytes()
    pages = [content[start : start + 4096] for start in range(0, len(content), 4096)]
    return next(number for number, page in enumerate(pages) if any(seal in page for seal in seals) and page[0] == 0x0D)


def test_damaged_pages_are_told_and_the_sound_rows_saved(whole, tmp_path, key):
    page = leaf_of_trials(whole)
    content = bytearray(whole.read_bytes())
    content[page * 4096 : page * 4096 + 16] = b"\xff" * 16
    whole.write_bytes(content)
    found = verify(whole, label="it")
    assert found.pages_are_damaged
    assert all("\n" not in str(damage) for damage in found.damages)

    saved = tmp_path / "saved.sqlite"
    count = salvage(whole, found, saved, label="it")
    again = verify(saved, label="saved")
    assert again.damages == ()
    assert sum(again.sound.values()) == count
    assert 0 < again.sound["trial"] < 20
    assert again.sound["piece"] == 3
    assert whole.read_bytes() == bytes(content)
    with pytest.raises(EvidenceError) as caught:
        salvage(whole, found, saved, label="it")
    assert str(caught.value) == f"{saved} already exists (move it away first)"


def test_a_file_that_was_cut_short_gives_what_is_before_the_cut(whole, tmp_path):
    saved = []
    size = whole.stat().st_size
    for number, pages in enumerate((size // 4096 - 1, size // 4096 // 2, 1)):
        whole.write_bytes(whole.read_bytes()[: pages * 4096])
        found = verify(whole, label="it")
        assert found.pages_are_damaged
        assert str(found.damages[0]) == "pages: database disk image is malformed"
        saved.append(salvage(whole, found, tmp_path / str(number), label="it"))
        assert verify(tmp_path / str(number), label="new").damages == ()
    assert 0 < saved[1] < saved[0] < 26
    assert saved[2] == 0


@pytest.mark.parametrize("length", [100, 3000])
def test_a_file_without_its_first_page_is_lost(whole, tmp_path, length):
    whole.write_bytes(whole.read_bytes()[:length])
    found = verify(whole, label="it")
    assert [str(damage) for damage in found.damages] == ["pages: database disk image is malformed"]
    assert found.sound == {}
    with pytest.raises(EvidenceError) as caught:
        salvage(whole, found, tmp_path / "saved.sqlite", label="it")
    assert str(caught.value) == (
        "nothing of it can be read (move it and the files beside it that begin with its name, and run the sweep again)"
    )
    assert not (tmp_path / "saved.sqlite").exists()


def test_an_index_without_its_entries_is_damage_of_the_pages(whole, tmp_path):
    connection = sqlite3.connect(whole, isolation_level=None)
    connection.execute("PRAGMA writable_schema = ON")
    connection.execute("CREATE TABLE other (key TEXT)")
    connection.execute(
        "UPDATE sqlite_master SET rootpage = (SELECT rootpage FROM sqlite_master WHERE name = 'other')"
        " WHERE name = 'trials_by_variant'"
    )
    connection.execute("DELETE FROM sqlite_master WHERE name = 'other'")
    connection.close()
    found = verify(whole, label="it")
    assert found.pages_are_damaged
    assert salvage(whole, found, tmp_path / "saved.sqlite", label="it") == 26


def test_damage_says_what_it_is():
    assert str(Damage(what="pages", key="", problem="p", row=None)) == "pages: p"
    assert str(Damage(what="trial", key="abc", problem="p", row=3)) == "trial abc: p"
