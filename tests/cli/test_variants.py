"""``rgss variants``: choosing some, and what makes none."""

from __future__ import annotations

import pytest


@pytest.fixture
def limited(tmp_path, untouched):
    """The shipped project with a rule on weight."""
    import shutil

    folder = tmp_path / "limited"
    for name in ("requirements", "designs", "scenes", "studies"):
        shutil.copytree(untouched / name, folder / name)
    space = folder / "designs/grasping_system.yaml"
    rule = "  - {id: light, rationale: So., constraint: d1 * d2 + d3 <= 1.2 kg}\n"
    space.write_text(space.read_text(encoding="utf-8").rstrip() + "\n" + rule, encoding="utf-8")
    return folder


def test_only_some_are_listed(rgss, untouched):
    told = rgss("variants", "--format", "csv", "--project", untouched, "--only", "d8=RRT", "--only", "1/3")
    rows = told.output.splitlines()[1:]
    assert len(rows) == 8
    assert {row.split(",")[8] for row in rows} == {"RRT"}


def test_what_a_constraint_excludes_is_counted(rgss, limited):
    told = rgss("variants", "--json", "--project", limited)
    assert [row["id"] for row in told.document] == list(range(19, 73))
    assert told.complaint == "rgss: 18 combinations make no design, by rule: light 18"
