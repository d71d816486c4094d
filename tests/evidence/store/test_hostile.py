"""Stores that somebody has tampered with: whatever is in the file, it is refused or read as it was put."""

import hashlib
import json
import random
import sqlite3
import sys
import tracemalloc
import zlib

import pytest

from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, Piece, PieceKind, record_to_json
from rgss.evidence.records.packing import LARGEST_TEXT
from rgss.evidence.store.connection import LARGEST_ROW
from rgss.evidence.store.contents import contents_of
from rgss.evidence.store.verification import verify
from tests.fixtures.stored_inputs import put_inputs

DAMAGED = (
    "evidence.sqlite: trial {} is damaged: {} "
    "(run 'rgss evidence verify --mend' to remove it; the next sweep computes it again)"
)


def refusal(path, **options):
    with pytest.raises(EvidenceError) as caught, EvidenceStore.open(path, label="evidence.sqlite", **options) as store:
        store.all()
    assert "\n" not in str(caught.value)
    assert caught.value.hint
    return str(caught.value)


def packed(text):
    return zlib.compress(text.encode())


def forge(path, change, key, *, record, provenance):
    """Puts texts under a key with the digests that they should have."""
    content = hashlib.sha256(record.encode()).hexdigest()
    sealed = hashlib.sha256(json.dumps([key, content, provenance], separators=(",", ":")).encode()).hexdigest()
    statement = "UPDATE trials SET record = ?, content_digest = ?, provenance = ?, seal = ? WHERE key = ?"
    change(path, statement, packed(record), content, packed(provenance), sealed, key)


@pytest.mark.parametrize(
    ("column", "value", "problem"),
    [
        ("record", packed("{}"), "its record is not the one that was put"),
        ("record", b"", "its record cannot be unpacked"),
        ("record", b"\x80\x04K\x01.", "its record cannot be unpacked"),
        ("record", packed("{}") + b"more", "its record cannot be unpacked"),
        ("record", packed("{}")[:-1], "its record cannot be unpacked"),
        ("record", zlib.compress(b"\xff"), "its record is not UTF-8"),
        ("record", "{}", "its record is not of bytes"),
        ("record", 7, "its record is not of bytes"),
        ("content_digest", "x", "its record is not the one that was put"),
        ("content_digest", b"x", "its record is not the one that was put"),
        ("provenance", packed("{}"), "its record or provenance belongs to another row"),
        ("provenance", 1.5, "its provenance is not of bytes"),
        ("seal", "0" * 64, "its record or provenance belongs to another row"),
        ("seal", b"\x00", "its record or provenance belongs to another row"),
        ("variant", 77, "it is filed under another variant, seed or fidelity than its record has"),
        ("seed", "7th", "it is filed under another variant, seed or fidelity than its record has"),
        ("fidelity", "dynamic", "it is filed under another variant, seed or fidelity than its record has"),
    ],
)
def test_a_tampered_row_is_refused(filled, change, key, column, value, problem):
    change(filled, f"UPDATE trials SET {column} = ? WHERE key = ?", value, key(2))  # noqa: S608
    assert refusal(filled) == DAMAGED.format(key(2)[:12], problem)
    with EvidenceStore.open(filled) as store:
        with pytest.raises(EvidenceError, match="is damaged"):
            store.get(key(2))
        with pytest.raises(EvidenceError, match="is damaged"):
            store.records([key(1), key(2)])
        assert store.get(key(1)) is not None


def test_a_record_under_the_key_of_another_is_refused(filled, change, key):
    with EvidenceStore.open(filled) as store:
        first = store.database.one("SELECT * FROM trials WHERE key = ?", [key(1)])
    change(filled, "DELETE FROM trials WHERE key = ?", key(2))
    change(filled, "INSERT INTO trials VALUES (?, ?, ?, ?, ?, ?, ?, ?)", key(2), *first[1:])
    assert refusal(filled) == DAMAGED.format(key(2)[:12], "its record or provenance belongs to another row")


def test_a_row_under_no_key_is_refused(filled, change, key):
    change(filled, "UPDATE trials SET key = 'k' WHERE key = ?", key(2))
    assert refusal(filled) == DAMAGED.format("'k'", "its key is none")
    with EvidenceStore.open(filled) as store, pytest.raises(EvidenceError, match="a trial has an invalid key"):
        contents_of(store.database)


@pytest.mark.parametrize(
    ("text", "origin", "problem"),
    [
        ('{"variant":1}', "{}", "record lacks 'seed'"),
        ("[" * 100_000, "{}", "the record is not JSON: maximum recursion depth exceeded"),
        ('{"variant":NaN}', "{}", "the record is not JSON: NaN is not a finite number"),
        ('{"variant":' + "9" * 5000 + "}", "{}", "the record is not JSON: an integer has 5000 digits"),
        (None, '{"inputs":{}}', "provenance lacks 'versions'"),
        (None, '{"inputs":{},"versions":{"rgss":1}}', "provenance.versions.rgss is not str: 1"),
        (None, '{"inputs":{},"versions":{},"more":1}', "provenance lacks 'inputs_digest'"),
        (None, '{"inputs":1e999,"versions":{}}', "the provenance is not JSON: 1e999 is not a finite number"),
    ],
)
def test_a_row_forged_with_its_digests_is_still_read_strictly(filled, record, change, key, text, origin, problem):
    forge(filled, change, key(2), record=text or record_to_json(record(variant=2)), provenance=origin)
    assert refusal(filled).startswith(f"evidence.sqlite: trial {key(2)[:12]} is damaged: {problem}")


def test_what_unpacks_to_more_than_is_read_is_refused_without_being_unpacked(filled, change, key):
    bomb = zlib.compress(b" " * (8 * LARGEST_TEXT))
    change(filled, "UPDATE trials SET record = ? WHERE key = ?", bomb, key(2))
    tracemalloc.start()
    message = refusal(filled)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert message == DAMAGED.format(key(2)[:12], f"its record is longer than the {LARGEST_TEXT} bytes that are read")
    # The buffer of what is unpacked grows in steps; the whole would be eight times the bound.
    assert peak < 4 * LARGEST_TEXT


@pytest.mark.parametrize("column", ["record", "provenance", "seal", "content_digest"])
def test_a_value_that_is_too_large_is_refused(filled, change, key, column):
    change(filled, f"UPDATE trials SET {column} = zeroblob(?) WHERE key = ?", LARGEST_ROW + 1, key(2))  # noqa: S608
    message = refusal(filled)
    # SQLite itself can be told the bound since Python 3.11; before, the row is read and then refused.
    if sys.version_info >= (3, 11):
        assert message.startswith("the evidence store evidence.sqlite cannot be used: string or blob too big")
    else:
        assert "is damaged" in message
    found = verify(filled, label="evidence.sqlite")
    assert [(damage.what, damage.row) for damage in found.damages] == [("trial", 2)]
    assert found.sound["trial"] == 2


@pytest.mark.parametrize(
    ("column", "problem"),
    [
        ("seal", "its record or provenance belongs to another row"),
        ("content_digest", "its record is not the one that was put"),
        ("record", "its record is not of bytes"),
        ("fidelity", "it is filed under another variant, seed or fidelity than its record has"),
    ],
)
def test_a_text_that_is_not_unicode_is_refused(filled, change, key, column, problem):
    change(filled, f"UPDATE trials SET {column} = CAST(x'ff0a1b' AS TEXT) WHERE key = ?", key(2))  # noqa: S608
    assert refusal(filled) == DAMAGED.format(key(2)[:12], problem)


def test_a_key_that_is_not_unicode_is_refused(filled, change, key):
    change(filled, "UPDATE trials SET key = CAST(x'ff1b' AS TEXT) WHERE key = ?", key(2))
    assert refusal(filled) == DAMAGED.format(r"'\udcff\x1b'", "its key is none")


@pytest.mark.parametrize(
    ("statement", "problem"),
    [
        ("UPDATE trials SET fidelity = 'divine'", "a trial has an invalid key, variant, seed or fidelity"),
        ("UPDATE trials SET seed = 1.5", "a trial has an invalid key, variant, seed or fidelity"),
        ("INSERT INTO pieces VALUES ('d', CAST(x'ff' AS TEXT), 'c', 's', x'00')", "a piece has an unknown kind"),
    ],
)
def test_a_summary_of_what_is_no_sound_store_is_refused(filled, change, statement, problem):
    change(filled, statement)
    with EvidenceStore.open(filled, label="it") as store, pytest.raises(EvidenceError) as caught:
        contents_of(store.database)
    assert str(caught.value) == f"it: {problem} (run 'rgss evidence verify' to find it, and with --mend to remove it)"


@pytest.mark.parametrize(
    ("statement", "problem"),
    [
        ("UPDATE pieces SET content = x'00'", "its content cannot be unpacked"),
        ("UPDATE pieces SET kind = 'timing'", "its content belongs to another piece"),
        ("UPDATE pieces SET kind = 'photograph'", "unknown kind 'photograph'"),
        ("UPDATE pieces SET content_digest = 'x'", "its content is not the one that was put"),
        ("UPDATE pieces SET seal = 'x'", "its content belongs to another piece"),
        ("UPDATE pieces SET kind = x'00'", "unknown kind b'\\x00'"),
    ],
)
def test_a_tampered_piece_is_refused(path, change, statement, problem):
    with EvidenceStore.open(path) as store:
        store.put_many(pieces=[Piece(digest="a" * 64, kind=PieceKind.PLAN, text="{}")])
    change(path, statement)
    with EvidenceStore.open(path, label="evidence.sqlite") as store, pytest.raises(EvidenceError) as caught:
        store.piece("a" * 64)
    assert caught.value.message == f"evidence.sqlite: piece {'a' * 12} is damaged: {problem}"


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        (packed('{"a":2}'), "its content is not the one that was put"),
        (b"", "its content cannot be unpacked"),
        (None, "its content is not a mapping"),
    ],
)
def test_tampered_inputs_are_refused(path, change, content, problem):
    with EvidenceStore.open(path) as store:
        name = put_inputs(store, {"a": 1})
    if content is None:
        name = hashlib.sha256(b"[1]").hexdigest()
        change(path, "UPDATE inputs SET digest = ?, content = ?", name, packed("[1]"))
    else:
        change(path, "UPDATE inputs SET content = ?", content)
    with EvidenceStore.open(path, label="evidence.sqlite") as store, pytest.raises(EvidenceError) as caught:
        store.inputs(name)
    assert caught.value.message == f"evidence.sqlite: inputs {name[:12]} is damaged: {problem}"


@pytest.mark.parametrize(
    "statement",
    [
        "CREATE TRIGGER t AFTER INSERT ON trials BEGIN DELETE FROM trials; END",
        "CREATE TRIGGER sqlite AFTER INSERT ON pieces BEGIN DELETE FROM trials; END",
        "CREATE VIEW v AS SELECT load_extension('x')",
        "CREATE TABLE other (name TEXT)",
        "CREATE INDEX other ON trials (seed)",
        "ALTER TABLE trials ADD COLUMN more TEXT",
        "ALTER TABLE trials ADD COLUMN more TEXT AS (upper(key))",
        "ALTER TABLE pieces RENAME COLUMN kind TO sort",
        "DROP TABLE trials",
        "DROP INDEX trials_by_variant",
        "ANALYZE",
    ],
)
def test_a_schema_with_surprises_is_refused(filled, change, statement):
    change(filled, statement)
    assert refusal(filled) == ("evidence.sqlite has a foreign schema (move the file away and run the sweep again)")


TRIGGER = "CREATE TRIGGER sqlite_t AFTER INSERT ON trials BEGIN DELETE FROM trials; END"
VIEW = "CREATE VIEW sqlite_v AS SELECT randomblob(1000000000)"


@pytest.mark.parametrize(
    "forged",
    [
        f"INSERT INTO sqlite_master VALUES ('trigger', 'sqlite_t', 'trials', 0, '{TRIGGER}')",  # noqa: S608
        f"INSERT INTO sqlite_master VALUES ('view', 'sqlite_v', 'sqlite_v', 0, '{VIEW}')",  # noqa: S608
        "UPDATE sqlite_master SET sql = replace(sql, 'NULL,', 'NULL CHECK (abs(key)),') WHERE name = 'failures'",
        "UPDATE sqlite_master SET sql = replace(sql, 'NULL,', 'NULL DEFAULT (hex(9)),') WHERE name = 'pieces'",
    ],
)
def test_a_schema_forged_by_hand_is_refused(filled, forged):
    connection = sqlite3.connect(filled, isolation_level=None)
    connection.execute("PRAGMA writable_schema = ON")
    connection.execute(forged)
    connection.close()
    assert refusal(filled)


def read_or_refused(path, honest):
    """Whether the store is refused; what is read of it must be what was put, though some may not be found."""
    try:
        with EvidenceStore.open(path, label="it") as store:
            assert all(honest.get(trial.key) == trial for trial in store.iterate())
    except EvidenceError as error:
        return "\n" not in str(error)
    return False


def test_any_bytes_changed_are_found_or_do_no_harm(filled, tmp_path):
    with EvidenceStore.open(filled) as store:
        honest = {trial.key: trial for trial in store.iterate()}
    content = filled.read_bytes()
    used = [place for place, byte in enumerate(content) if byte]
    choose = random.Random(5)  # noqa: S311
    refused = 0
    for _ in range(100):
        changed = bytearray(content)
        start = choose.choice(used)
        for place in range(start, min(start + choose.choice([1, 1, 4, 64, 1024]), len(content))):
            changed[place] = choose.randrange(256)
        (tmp_path / "changed.sqlite").write_bytes(changed)
        refused += read_or_refused(tmp_path / "changed.sqlite", honest)
        for left in tmp_path.glob("changed.sqlite*"):
            left.unlink()
    assert refused > 50


@pytest.mark.parametrize(
    "content",
    [
        b"not a database at all, but long enough to look\n" * 100,
        b"\x80\x04K\x01.",
        b"SQLite format 3\x00" + b"\xff" * 2000,
    ],
)
def test_a_file_of_something_else_is_refused_and_left_as_it_is(path, content):
    path.write_bytes(content)
    message = (
        "the evidence store evidence.sqlite cannot be used: file is not a database "
        "(use another file; this one is unchanged)"
    )
    assert refusal(path) == message
    with pytest.raises(EvidenceError) as caught:
        verify(path, label="evidence.sqlite")
    assert str(caught.value) == message
    assert path.read_bytes() == content


def test_the_database_of_another_program_is_refused_and_left_as_it_is(path, change):
    change(path, "CREATE TABLE addresses (name TEXT)")
    content = path.read_bytes()
    assert refusal(path) == "evidence.sqlite is not an evidence store (use another file; this one is unchanged)"
    assert path.read_bytes() == content


@pytest.mark.parametrize(("version", "age"), [(4, "newer"), (2**31 - 1, "newer"), (0, "unknown"), (-1, "unknown")])
def test_another_schema_is_refused(filled, change, version, age):
    change(filled, f"PRAGMA user_version = {version}")
    assert refusal(filled) == (
        f"evidence.sqlite has the {age} schema {version}; this rgss reads 3 "
        "(use the rgss that wrote it, or another file)"
    )


def test_a_truncated_file_is_refused(filled):
    filled.write_bytes(filled.read_bytes()[:9000])
    assert refusal(filled) == (
        "the evidence store evidence.sqlite cannot be used: database disk image is malformed "
        "(run 'rgss evidence verify' to see what can be recovered)"
    )


def test_a_file_with_a_damaged_page_is_refused(filled):
    content = bytearray(filled.read_bytes())
    content[4096:4196] = b"\xff" * 100
    filled.write_bytes(content)
    message = refusal(filled)
    assert "evidence.sqlite" in message
    assert "rgss evidence verify" in message
