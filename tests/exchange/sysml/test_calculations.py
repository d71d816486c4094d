"""Measures as calculations."""

from __future__ import annotations

from rgss.exchange.sysml.measures import calculations


def test_a_row_is_computed_entry_by_entry(shipped):
    text = "\n".join(calculations(shipped.measures))

    assert "return 'result' : Real = (('t_p' + 't_gc') + sum('L'->collect {in x : Real; (x / 'v_m')}));" in text
    assert "in 'L' : Real[5] ordered nonunique" in text


def test_a_term_that_may_be_unknown_is_followed_by_what_stands_for_it(shipped):
    text = "\n".join(calculations(shipped.measures))

    assert "('P_max_m' - 'M_g'), (('bench_payload' / 'k_s') ?? 'P_max_g'))" in text
    assert "in 'bench_payload' : Real[0..1] {" in text
    assert "in 'P_max_g' : Real {" in text
