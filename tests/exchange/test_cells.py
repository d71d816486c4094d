"""Entries to texts and back."""

from __future__ import annotations

from dataclasses import fields

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.exchange.attributes import ATTRIBUTES, MODELS, Part
from rgss.exchange.cells import CellError, cells_of, entry_of, ids_in

REASONS = st.text(st.sampled_from("ab;\\: \n"), min_size=1).map(str.strip).filter(bool)


@given(reasons=st.lists(REASONS, min_size=1, max_size=3))
def test_reasons_with_any_signs_come_back(reasons):
    entry = {"id": "A", "exempt": [{"rule": "wording.R1", "reason": reason} for reason in reasons]}
    assert entry_of(Part.STAKEHOLDER, cells_of(Part.STAKEHOLDER, entry)) == entry


def test_every_key_of_every_model_is_an_attribute():
    """Otherwise an exchange would lose what is added to the files one day."""
    for part, model in MODELS.items():
        assert {attribute.path[0] for attribute in ATTRIBUTES[part]} == {field.name for field in fields(model)}


def test_ids_are_set_apart_by_semicolons():
    assert ids_in(" SYS-1;SYS-2 ; SYS-1;; ") == ("SYS-1", "SYS-2")


@pytest.mark.parametrize(
    ("part", "name", "cell", "complaint"),
    [
        (Part.BLOCK, "actor", "perhaps", "true or false is expected"),
        (Part.BEHAVIOUR, "flow", "{", "JSON is expected"),
        (Part.BEHAVIOUR, "flow", "[" * 100_000, "JSON is expected"),
        (Part.BEHAVIOUR, "flow", "[]", "a JSON object is expected"),
        (Part.BLOCK, "ports", "{}", "a JSON list is expected"),
        (Part.SYSTEM, "exempt", "wording.R1", "each entry is 'rule: reason'"),
    ],
)
def test_a_text_that_is_not_what_it_should_be(part, name, cell, complaint):
    with pytest.raises(CellError, match=complaint):
        entry_of(part, {name: cell})


def test_words_of_a_closed_list_may_be_in_capitals():
    assert entry_of(Part.SYSTEM, {"status": " Approved "}) == {"status": "approved"}
    assert entry_of(Part.SYSTEM, {"status": "Frozen"}) == {"status": "Frozen"}
    assert entry_of(Part.BLOCK, {"actor": "TRUE"}) == {"actor": True}
    assert entry_of(Part.BLOCK, {"actor": "false"}) == {}
