"""What differs between two values, and where."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.sweep.input_changes import ABSENT, Change, changes_between, input_changes, values_by_name


@pytest.mark.parametrize(
    ("then", "now", "expected"),
    [
        ({"a": 1}, {"a": 1}, []),
        ({"a": 1}, {"a": 2}, [("a", "1", "2")]),
        ({"a": 1}, {"a": 1.0}, [("a", "1", "1.0")]),
        ({"a": 0.0}, {"a": -0.0}, [("a", "0.0", "-0.0")]),
        ({"a": {"b": "x"}}, {"a": {"b": "y"}}, [("a.b", "'x'", "'y'")]),
        ({"a": [1, 2]}, {"a": [1, 3, 4]}, [("a[1]", "2", "3"), ("a[2]", "–", "4")]),
        ({"a": 1, "b": 2}, {"b": 2, "c": 3}, [("a", "1", "–"), ("c", "–", "3")]),
        ({"a": {}}, {"a": {"b": 1}}, [("a", "{}", "–"), ("a.b", "–", "1")]),
        ({"a": []}, {"a": None}, [("a", "[]", "None")]),
        ({"a": 1}, {"a": 1, "b": None}, [("b", "–", "None")]),
        ({"a": 1, "b": []}, {"a": 1}, [("b", "[]", "–")]),
        ({"a": 1, "b": None}, {"a": 1, "b": "None"}, [("b", "None", "'None'")]),
        (
            {"bodies": [{"id": "table", "friction": 0.5}, {"id": "floor", "friction": 0.5}]},
            {"bodies": [{"id": "table", "friction": 0.5}, {"id": "floor", "friction": 0.6}]},
            [("bodies[floor].friction", "0.5", "0.6")],
        ),
        (
            {"phases": [{"phase": "lift", "s": 1}]},
            {"phases": [{"phase": "lift", "s": 2}]},
            [("phases[lift].s", "1", "2")],
        ),
        (
            {"joints": [{"name": "elbow", "speed": 3.0}]},
            {"joints": [{"name": "elbow", "speed": 2.0}]},
            [("joints[elbow].speed", "3.0", "2.0")],
        ),
        (
            {"scene": {"bodies": [{"id": "floor", "s": 1}, {"id": "post", "s": 2}, {"id": "table", "s": 3}]}},
            {"scene": {"bodies": [{"id": "post", "s": 2}, {"id": "floor", "s": 1}, {"id": "table", "s": 3}]}},
            [("order of scene.bodies", "floor, post", "post, floor")],
        ),
        (
            [{"id": "arm", "joints": [{"name": "a", "s": 1}, {"name": "b", "s": 1}]}],
            [{"id": "arm", "joints": [{"name": "b", "s": 1}, {"name": "a", "s": 2}]}],
            [("[arm].joints[a].s", "1", "2"), ("order of [arm].joints", "a, b", "b, a")],
        ),
        ([{"id": "p", "a": 1}, {"id": "p", "b": 2}], [{"id": "p", "a": 3}, {"id": "p", "b": 2}], [("[p].a", "1", "3")]),
        (1, 2, [("", "1", "2")]),
    ],
)
def test_every_difference_is_named_by_its_place(then, now, expected):
    assert [(change.name, change.then, change.now) for change in changes_between(then, now)] == expected


@pytest.mark.parametrize(
    ("then", "now", "expected"),
    [
        ({"a": 1}, {"a": 1, "b": None, "c": {"d": None}}, []),
        ({"a": 1, "b": None}, {"a": 1}, []),
        ({"a": 1}, {"a": 1, "b": "", "c": [], "d": {}}, []),
        ({"a": {}}, {"a": {"b": 1}}, [("a.b", "–", "1")]),
        ({"a": 1, "b": "x"}, {"a": 2, "b": ""}, [("a", "1", "2"), ("b", "'x'", "''")]),
        ({"a": []}, {"a": None}, [("a", "[]", "None")]),
    ],
)
def test_an_input_that_is_empty_is_the_same_as_one_that_is_absent(then, now, expected):
    assert [(change.name, change.then, change.now) for change in input_changes(then, now)] == expected


def test_changes_come_in_the_order_of_what_was_and_then_of_what_is_new():
    assert changes_between({"b": 1, "a": 1}, {"c": 1, "a": 2, "b": 2}) == (
        Change(name="b", then="1", now="2"),
        Change(name="a", then="1", now="2"),
        Change(name="c", then="–", now="1"),
    )


LEAVES = st.sampled_from([None, 0, 1, 1.0, True, "", "x", -0.0, float("nan")])
TREES = st.recursive(
    LEAVES,
    lambda parts: (
        st.lists(parts, max_size=3)
        | st.dictionaries(st.sampled_from(["", "a", "b", "id"]), parts, max_size=3)
        | st.lists(st.fixed_dictionaries({"id": st.sampled_from(["p", "q"]), "s": parts}), max_size=3)
    ),
    max_leaves=12,
)


@given(TREES, TREES)
def test_no_difference_is_passed_over_with_what_is_the_same(then, now):
    """Whatever is named on one side alone, or with another text, differs; nothing else does."""
    before, after = values_by_name(then), values_by_name(now)
    names = [name for name in {**before, **after} if before.get(name) != after.get(name)]

    found = [change for change in changes_between(then, now) if not change.name.startswith("order of ")]
    assert found == [Change(name=name, then=before.get(name, ABSENT), now=after.get(name, ABSENT)) for name in names]
