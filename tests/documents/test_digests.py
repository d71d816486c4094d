"""The canonical JSON of plain data, and its digest."""

import hashlib
import json
import math
import os
import subprocess
import sys
from enum import Enum
from types import MappingProxyType

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.documents.digests import canonical_json, digest
from rgss.errors import DefinitionError

plain = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
    max_leaves=15,
)


class Colour(str, Enum):
    RED = "red"


def test_keys_are_sorted_and_nothing_is_padded():
    assert canonical_json({"b": [1, 2.5, None], "a": True}) == '{"a":true,"b":[1,2.5,null]}'


@given(plain)
def test_it_reads_back_as_the_same_data(value):
    text = canonical_json(value)
    assert json.loads(text) == value
    assert text.isascii()


@given(st.dictionaries(st.text(), st.integers(), max_size=6), st.randoms(use_true_random=False))
def test_the_order_of_a_mapping_does_not_count(mapping, random):
    items = list(mapping.items())
    random.shuffle(items)
    assert canonical_json(dict(items)) == canonical_json(mapping)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_bit_of_a_float_counts(number):
    assert canonical_json(number) == repr(number)
    assert canonical_json(math.nextafter(number, math.inf if number < 0 else -math.inf)) != canonical_json(number)


def test_equal_values_of_other_types_are_told_apart():
    assert len({canonical_json(value) for value in (1, 1.0, True, "1", [1])}) == 5
    assert canonical_json(0.0) != canonical_json(-0.0)


def test_tuples_enumerations_and_other_mappings_are_written_as_what_they_stand_for():
    value = {"a": (1, 2), "b": Colour.RED, "c": MappingProxyType({"d": np.float64(0.1)})}
    assert canonical_json(value) == '{"a":[1,2],"b":"red","c":{"d":0.1}}'


def test_the_digest_is_the_sha256_of_the_text():
    assert digest({"a": 0.1}) == hashlib.sha256(b'{"a":0.1}').hexdigest()


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ({"a": [1.0, math.nan]}, "a[1] is nan and has no canonical form"),
        ({"a": {"b": math.inf}}, "a.b is inf and has no canonical form"),
        ({"a": {1, 2}}, "a is of type set and has no canonical form"),
        (np.int64(3), "the value is of type int64 and has no canonical form"),
        ({"a": {1: 2}}, "a has the key 1, which is not a text and has no canonical form"),
        ({Colour.RED: 2}, "the value has the key <Colour.RED: 'red'>, which is not a text and has no canonical form"),
    ],
)
def test_what_has_no_canonical_form_is_refused_by_its_place(value, message):
    with pytest.raises(DefinitionError) as caught:
        canonical_json(value)
    assert caught.value.message == message
    assert caught.value.hint == "use finite numbers, texts, lists and mappings"


def test_a_structure_that_contains_itself_is_refused():
    loop: list = []
    loop.append(loop)
    with pytest.raises(DefinitionError, match=r"is nested more than 60 deep and has no canonical form"):
        canonical_json(loop)


@pytest.mark.parametrize("seed", ["0", "1", "4242"])
def test_it_does_not_depend_on_the_hash_seed_of_the_process(seed):
    program = "from rgss.documents.digests import digest; print(digest({k: k for k in {'x', 'y', 'z', 'w'}}))"
    environment = {**os.environ, "PYTHONHASHSEED": seed}
    result = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True
    )
    assert result.stdout.strip() == digest({k: k for k in "wxyz"})
