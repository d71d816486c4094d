from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import Alternative, EvidenceTable, decide
from rgss.tradeoff.problem.evidence_table import tabulated


def test_a_table_reads_like_the_alternatives():
    alternatives = (
        Alternative(variant=9, measures={"a": 1.0, "b": None}, samples={"a": (1.0, None, 3.0)}),
        Alternative(variant=2, measures={"a": 2.0, "b": 5.0}, samples={"a": (2.0,)}),
    )
    table = tabulated(alternatives)
    assert tuple(table) == tuple(reversed(alternatives))
    assert table[-1] == alternatives[0]
    assert table[:1] == (alternatives[1],)
    assert len(table) == 2
    assert table.column("b").tolist()[0] == 5.0
    assert table.replicates("a").ran.tolist() == [[True, False, False], [True, True, True]]
    assert table.replicates("b").values.tolist()[0] == [5.0]
    assert tuple(table.rows(np.array([1]))) == (alternatives[0],)
    assert tabulated(table) is table


def test_the_same_decision_as_from_alternatives(payload_and_time):
    alternatives = payload_and_time.alternatives
    table = EvidenceTable.of(
        np.array([one.variant for one in alternatives]),
        {name: np.array([one.measures[name] for one in alternatives]) for name in ("P", "t", "cost")},
    )
    assert decide(dataclasses.replace(payload_and_time, alternatives=table)) == decide(payload_and_time)


def test_what_is_unknown_is_not_looked_at():
    table = EvidenceTable.of(np.array([1, 2]), {"a": np.array([math.nan, 3.0])}, known={"a": np.array([False, True])})
    assert [one.measures["a"] for one in table] == [None, 3.0]


@pytest.mark.parametrize(
    ("variants", "column", "message"),
    [
        ([1, 1], [0.0, 0.0], "variant 1 is given twice"),
        ([1, 2], [0.0, math.nan], "'a' of variant 2 must be finite or None, got nan"),
        ([7, 2], [math.inf, 0.0], "'a' of variant 7 must be finite or None, got inf"),
        ([1, 2], [0.0], "'a' has the shape (1,) for 2 alternatives"),
    ],
)
def test_columns_that_are_wrong(variants, column, message):
    with pytest.raises(TradeoffError) as error:
        EvidenceTable.of(np.array(variants), {"a": np.array(column)})
    assert error.value.message == message


def test_an_empty_table_is_no_choice(payload_and_time):
    with pytest.raises(TradeoffError, match="there are no alternatives"):
        dataclasses.replace(payload_and_time, alternatives=EvidenceTable.of(np.array([], dtype=int), {}))


def test_a_table_lacks_a_measure(payload_and_time):
    table = EvidenceTable.of(np.array([1]), {"P": np.array([1.0]), "t": np.array([1.0])})
    with pytest.raises(TradeoffError, match="R-2 names the unknown measure 'cost'"):
        dataclasses.replace(payload_and_time, alternatives=table)


def test_replicates_that_are_not_numbers(build_problem):
    bad = Alternative(variant=4, measures={"a": 1.0}, samples={"a": (1.0, math.nan)})
    with pytest.raises(TradeoffError, match="'a' of variant 4 must be finite or None, got nan"):
        build_problem({}, alternatives=(bad,))
