"""Records as JSON: nothing is lost, nothing else is read."""

import hashlib
import json
import math
import os
import struct
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rgss.errors import EvidenceError
from rgss.evidence import Fidelity, record_digest, record_from_json, record_to_json, trial_key
from rgss.evidence.records.codec import read_json
from tests.fixtures.eight_states import Phase


@given(data=st.data())
def test_every_record_survives_the_round_trip_bit_for_bit(records, data):
    record = data.draw(records)
    text = record_to_json(record)
    again = record_from_json(text)
    assert again == record
    assert record_to_json(again) == text
    assert record_digest(again) == record_digest(record) == hashlib.sha256(text.encode()).hexdigest()


def test_what_was_drawn_is_in_the_text_only_where_something_was(record):
    plain, drawn = record(), record(workload="full", draws={"perception.x": 0.004})

    assert not {"workload", "draws"} & json.loads(record_to_json(plain)).keys()
    assert json.loads(record_to_json(drawn))["draws"] == {"perception.x": 0.004}
    assert record_from_json(record_to_json(drawn)) == drawn
    assert record_digest(drawn) != record_digest(plain)


def test_the_text_is_canonical(record):
    text = record_to_json(record())
    assert text == json.dumps(json.loads(text), sort_keys=True, separators=(",", ":"))


@given(number=st.floats(allow_nan=False, allow_infinity=False))
def test_one_bit_of_one_number_changes_the_digest(record, number):
    bits = struct.unpack("<q", struct.pack("<d", number))[0]
    (other,) = struct.unpack("<d", struct.pack("<q", bits ^ 1))
    assume(math.isfinite(other))
    digests = {record_digest(record(metrics={"slip_m": value})) for value in (number, other)}
    assert len(digests) == 2


def test_numbers_of_an_engine_are_kept_as_plain_numbers(record):
    kept = record_from_json(record_to_json(record(metrics={"slip_m": np.float64(0.1)})))
    assert type(kept.metrics["slip_m"]) is float
    assert kept.metrics["slip_m"] == 0.1


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            {"metrics": {"slip_m": math.nan}},
            "the record cannot be written: metrics.slip_m is nan and has no canonical form",
        ),
        ({"metrics": {"slip_m": (1.0, math.inf)}}, "the record cannot be written: metrics.slip_m[1] is inf and has no"),
        ({"metrics": {"n": np.int64(3)}}, "the record cannot be written: metrics.n is of type int64 and has no"),
        ({"metrics": {"success": True}}, "record.metrics.success is not one of float, int, none, list: True"),
        ({"metrics": {"name": "cup"}}, "record.metrics.name is not one of float, int, none, list: 'cup'"),
        ({"metrics": {"rows": ((1.0,),)}}, "record.metrics.rows[0] is not one of float, int, none: [1.0]"),
        ({"variant": 1.0}, "record.variant is not int: 1.0"),
        ({"success": 1}, "record.success is not bool: 1"),
        ({"failure": Phase.LIFT}, "record.failure is not a Failure: 'lift'"),
        ({"fidelity": "high"}, "record.fidelity is not a Fidelity: 'high'"),
        ({"failure_detail": None}, "record.failure_detail is not str: None"),
        ({"phases": {}}, "record.phases is not a list: {}"),
        ({"metrics": []}, "record.metrics is not a mapping: []"),
    ],
)
def test_what_could_not_be_read_is_not_written(record, changes, message):
    with pytest.raises(EvidenceError) as caught:
        record_to_json(record(**changes))
    assert str(caught.value).startswith(message)


def _damaged(text, change):
    data = json.loads(text)
    change(data)
    return json.dumps(data)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda data: data.pop("seed"), "record lacks 'seed'"),
        (lambda data: data.update(extra=1), "record has an unknown 'extra'"),
        (lambda data: data.update(seed="7"), "record.seed is not int: '7'"),
        (lambda data: data.update(seed=True), "record.seed is not int: True"),
        (lambda data: data.update(fidelity=["contact"]), "record.fidelity is not a Fidelity: ['contact']"),
        (lambda data: data.update(failure="vanished"), "record.failure is not a Failure: 'vanished'"),
        (lambda data: data.update(failure=0), "record.failure is not one of Failure, none: 0"),
        (lambda data: data["phases"].append(3), "record.phases[8] is not a mapping: 3"),
        (
            lambda data: data["phases"][2].update(duration_s="1"),
            "record.phases[2].duration_s is not one of float, none: '1'",
        ),
        (lambda data: data["planning"][0].update(checks=None), "record.planning[0].checks is not int: None"),
        (lambda data: data["planning"][0].update({"x" * 100: 1}), f"record.planning[0] has an unknown '{'x' * 59}…'"),
        (lambda data: data.update(draws={}), "record.draws must be omitted if empty"),
        (lambda data: data.update(workload=""), "record.workload must be omitted if empty"),
        (lambda data: data.update(draws={"perception.x": "1"}), "record.draws.perception.x is not float: '1'"),
        (lambda data: data.update(failure_detail=["x" * 100]), f"record.failure_detail is not str: ['{'x' * 57}…"),
    ],
)
def test_a_damaged_text_is_refused_by_the_part_that_is_wrong(record, change, message):
    with pytest.raises(EvidenceError) as caught:
        record_from_json(_damaged(record_to_json(record()), change))
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the record is not JSON: Expecting value: line 1 column 1 (char 0)"),
        ("[1, 2]", "record is not a mapping: [1, 2]"),
        ("null", "record is not a mapping: None"),
        ('{"a": 1, "a": 2}', "the record is not JSON: a key occurs twice"),
        ('{"a": NaN}', "the record is not JSON: NaN is not a finite number"),
        ('{"a": -Infinity}', "the record is not JSON: -Infinity is not a finite number"),
        ("[" * 200_000, "the record is not JSON: maximum recursion depth exceeded"),
        ("\x80\x04K\x01.", "the record is not JSON: Expecting value"),
        (" " * (16 * 1024 * 1024 + 1), "the record has 16777217 characters; at most 16777216 are read"),
    ],
)
def test_what_is_no_record_is_refused(text, message):
    with pytest.raises(EvidenceError) as caught:
        record_from_json(text)
    assert str(caught.value).startswith(message)
    assert "\n" not in str(caught.value)


def test_numbers_beyond_all_floats_are_refused(record):
    text = record_to_json(record(metrics={"slip_m": 0.5})).replace('"slip_m":0.5', '"slip_m":1e999')
    with pytest.raises(EvidenceError, match=r"^record\.metrics\.slip_m is not a finite number: inf$"):
        record_from_json(text)


@given(st.text() | st.recursive(st.none() | st.integers() | st.text(), st.lists, max_leaves=5).map(json.dumps))
def test_no_text_does_more_than_be_refused(text):
    with pytest.raises(EvidenceError):
        record_from_json(text)


def test_the_key_of_a_trial_is_the_digest_of_its_inputs():
    inputs = {"plan": "a" * 64, "versions": {"rgss": "0.1.0"}, "seed": 7}
    text = '{"plan":"%s","seed":7,"versions":{"rgss":"0.1.0"}}' % ("a" * 64)
    assert trial_key(inputs) == trial_key(dict(reversed(inputs.items()))) == hashlib.sha256(text.encode()).hexdigest()
    assert trial_key({**inputs, "seed": 8}) != trial_key(inputs)


def test_a_key_of_what_is_no_number_is_refused():
    with pytest.raises(
        EvidenceError, match=r"^no key for a trial: time_s is nan and has no canonical form \(use finite"
    ):
        trial_key({"time_s": math.nan})


@pytest.mark.parametrize("seed", ["0", "99"])
def test_digests_are_the_same_in_every_process(record, seed):
    text = record_to_json(record())
    program = (
        "import sys; from rgss.evidence import *; text = sys.stdin.read()\n"
        "print(record_digest(record_from_json(text)))\n"
        "print(trial_key({name: name for name in {'plan', 'timing', 'variant'}}))"
    )
    environment = {**os.environ, "PYTHONHASHSEED": seed}
    command = [sys.executable, "-c", program]
    result = subprocess.run(command, input=text, env=environment, capture_output=True, text=True, check=True)
    assert result.stdout.split() == [
        record_digest(record()),
        trial_key({name: name for name in ("plan", "timing", "variant")}),
    ]


def test_a_record_equals_itself_only(record):
    assert record_digest(record()) == record_digest(record())
    assert record_digest(replace(record(), fidelity=Fidelity.DYNAMIC)) != record_digest(record())


@dataclass(frozen=True, slots=True, kw_only=True)
class Inner:
    lengths: Mapping[str, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Outer:
    inner: Inner | None
    names: Mapping[str, str] | None


def test_parts_that_may_be_missing_are_read_as_what_they_are():
    text = '{"inner":{"lengths":{"a":1.5}},"names":{"b":"c"}}'
    assert read_json(text, Outer, "text") == Outer(inner=Inner(lengths={"a": 1.5}), names={"b": "c"})
    assert read_json('{"inner":null,"names":null}', Outer, "text") == Outer(inner=None, names=None)
    with pytest.raises(EvidenceError, match=r"^text\.names is not one of Mapping, none: 3$"):
        read_json('{"inner":null,"names":3}', Outer, "text")


def test_records_share_the_names_of_their_metrics(record):
    """A hundred thousand records do not hold a hundred thousand copies of every name."""
    text = record_to_json(record(metrics={"slip_m": 0.1, "a_metric": None}))
    first, second = record_from_json(text), record_from_json(text)
    assert first.metrics
    assert all(one is other for one, other in zip(first.metrics, second.metrics, strict=True))
