"""Measures as calculations."""

from __future__ import annotations

from rgss.exchange.sysml.measures import calculations


def test_a_row_is_computed_entry_by_entry(shipped):
    text = "\n".join(calculations(shipped.measures))

    assert "return 'result' : Real = (('t_p' + 't_gc') + sum('L'->collect {in x : Real; (x / 'v_m')}));" in text
    assert "in 'L' : Real[5] ordered nonunique" in text
