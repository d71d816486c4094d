"""The documented range of the payload bench is the one that it keeps."""

from __future__ import annotations

from pathlib import Path

import pytest

from rgss.trials.payload_bench.range import VALIDATED, VALIDATED_CUP

PAGE = Path(__file__).parents[2] / "docs" / "grasping.md"


@pytest.mark.parametrize("validated", [VALIDATED, VALIDATED_CUP], ids=["fingers", "cup"])
def test_the_page_has_a_row_for_each_validated_quantity(validated):
    text = PAGE.read_text(encoding="utf-8")
    rows = [f"| {one.name} | {one.lowest:g} | {one.highest:g} | {one.unit} |" for one in validated]
    assert "\n".join(rows) in text
