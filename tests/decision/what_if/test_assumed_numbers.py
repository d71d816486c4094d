"""Which numbers of a project are assumed, so that their ranges are followed."""

from __future__ import annotations

from dataclasses import replace

from rgss.decision.what_if.numbers import assumed_numbers


def test_a_constant_with_a_source_is_assumed_where_an_assumption_is_about_it(shipped):
    measures = shipped.measures
    known = next(one for one in measures.constants if one.source)
    assert f"measures.{known.id}" not in {one.id for one in assumed_numbers(shipped)}
    about = measures.assumptions[0].model_copy(update={"concerns": (known.id,)})
    taken = replace(shipped, measures=replace(measures, assumptions=(*measures.assumptions, about)))
    (number,) = (one for one in assumed_numbers(taken) if one.id == f"measures.{known.id}")
    assert (number.rationale, number.value) == (about.rationale, known.value)
