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


def test_what_is_the_same_in_all_designs_is_so_whatever_is_listed(rgss, untouched):
    """Two designs of one planner keep the planner's column, for others have another."""
    told = rgss("variants", "--project", untouched, "--only", "1,2").output.splitlines()
    assert told[:4] == [
        "id  d1  d2 [kg]  d3 [kg]  d7 [m/s]   d8  d9 [s]",
        "──  ──  ───────  ───────  ────────  ───  ──────",
        " 1   3      0.3      0.4       0.5  RRT       4",
        " 2   3      0.3      0.4       0.5  RRT       6",
    ]


def test_columns_have_their_full_names_where_these_fit(rgss, tmp_path):
    rgss("init", tmp_path / "new")
    head, _, *rows = rgss("variants", "--project", tmp_path / "new").output.splitlines()
    assert head == "id  fingers  tool_speed_m_s"
    assert [row.split() for row in rows[:4]] == [["1", "2", "0.5"], ["2", "2", "1"], ["3", "3", "0.5"], ["4", "3", "1"]]
    assert rows[5].startswith("The same in all designs: finger mass 0.2 kg, base mass 0.4 kg, ")


def test_columns_that_find_no_room_go_on_in_another_table(rgss, untouched, monkeypatch):
    from rgss.reports.variants import table as variants_table

    monkeypatch.setattr(variants_table, "WIDEST", 30)
    lines = rgss("variants", "--project", untouched, "--only", "1-2").output.splitlines()
    assert [line.rstrip() for line in lines[:9]] == [
        "id  d1  d2 [kg]  d3 [kg]",
        "──  ──  ───────  ───────",
        " 1   3      0.3      0.4",
        " 2   3      0.3      0.4",
        "",
        "id  d7 [m/s]   d8  d9 [s]",
        "──  ────────  ───  ──────",
        " 1       0.5  RRT       4",
        " 2       0.5  RRT       6",
    ]
    assert max(map(len, lines[:9])) <= 30


def test_every_column_is_shown_where_all_fit(rgss, untouched, monkeypatch):
    from rgss.reports.variants import table as variants_table

    monkeypatch.setattr(variants_table, "WIDEST", 250)
    head, _, *rows = rgss("variants", "--project", untouched).output.splitlines()
    written = rgss("variants", "--format", "csv", "--project", untouched).output.splitlines()
    assert ["design_" + ",".join(head.split()), *(",".join(row.split()) for row in rows)] == written
