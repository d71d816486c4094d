"""What a traceability report gathers, and its tables for text files and the terminal."""

from __future__ import annotations

import pytest

from rgss.errors import DefinitionError
from rgss.measures import StaleCause
from rgss.reports.trace.report import trace_report
from rgss.reports.trace.tables import chain_table, impact_table, matrix_table, report_tables
from rgss.reports.trace.terminal import chain_lines, impact_lines, table_lines, terminal_tables
from rgss.trace.evidence.verdict_evidence import TraceEvidence
from rgss.trace.views.chain import chain_of
from rgss.trace.views.impact import impact_of


@pytest.fixture
def model(tmp_path, story):
    return story.model(story.write(tmp_path / "requirements"))


@pytest.fixture
def report(model, story):
    return trace_report(model, story.evidence(), title="Traceability")


def table_of(report, name, **options):
    (table,) = [one for one in report_tables(report, **{"widest_grid": 10, **options}) if one.name == name]
    return table


def test_gaps_are_told_element_by_element(report):
    assert [(gap.id, gap.lacks) for gap in report.gaps] == [
        ("SYS-4", (
            "no stakeholder requirement",
            "no allocation",
            "no verification method",
            "no success criterion",
            "no evidence that holds now",
        )),
        ("SYS-3", ("no allocation", "no evidence that holds now")),
    ]  # fmt: skip
    assert not report.is_complete


def test_a_grid_has_a_mark_for_each_link_and_no_other(report):
    for part in report.matrices:
        table = matrix_table(part, widest_grid=10)
        for (row, text, *cells), name in zip(table.rows, part.matrix.rows, strict=True):
            linked = set(part.matrix.linked_to_row(name))
            assert (row, text) == (name, part.row_texts[name])
            assert cells == ["x" if column in linked else None for column in table.heads[2:]]
        assert sum(cell == "x" for row in table.rows for cell in row[2:]) == part.matrix.link_count


def test_a_matrix_that_is_too_wide_is_a_list(report):
    table = table_of(report, "system-architecture", widest_grid=2)

    assert table.heads == ("id", "text", "links", "is satisfied by")
    assert [row[0::3] for row in table.rows[:3]] == [
        ("SYS-1", "BLK-gripper ACT-lift"),
        ("SYS-2", "BLK-finger"),
        ("SYS-3", ""),
    ]
    assert table.note == (
        "4 system requirements, 6 blocks and behaviours, 3 links. Rows without a link: SYS-3, SYS-4. "
        "3 columns have no link, which is allowed: BLK-system, BLK-hook, UC-serve."
    )


def test_the_verification_table_has_the_columns_of_the_handbook(report, story):
    table = table_of(report, "verification")
    first, second, third, fourth = (dict(zip(table.heads, row, strict=True)) for row in table.rows)

    assert table.heads[:8] == (
        "requirement",
        "text",
        "success criterion",
        "method",
        "facility",
        "phase",
        "evidence",
        "verdict",
    )
    assert first == {
        "requirement": "SYS-1",
        "text": "The gripper shall lift at least 0.8 kg.",
        "success criterion": "P >= 800 g",
        "method": "analysis",
        "facility": "Simulation",
        "phase": "qualification",
        "evidence": "; ".join(
            f"trial {key[:12]} (variant 7, seed {seed}): rgss replay {key[:12]}"
            for seed, key in story.KEYS.items()
            if seed < 3
        ),
        "verdict": "met",
        "measured": "0.865 kg (0.86 to 0.87), 2 trials",
        "variants": "2 met, 1 not met",
        "document": "requirements/system.yaml:2",
        "responsible": "engineer",
    }
    assert (second["evidence"], second["verdict"]) == ("tests/test_gripper.py::test_it_opens[fast]: passed", "met")
    assert (third["evidence"], third["verdict"]) == ("tests/test_x.py::t: not run", "not run")
    assert (fourth["evidence"], fourth["method"], fourth["success criterion"]) == ("", "", "")


def test_gaps_only_leaves_out_what_is_met(report):
    tables = {table.name: table for table in report_tables(report, widest_grid=10, gaps_only=True)}

    assert list(tables) == ["coverage", "gaps", "verification"]
    assert [row[0] for row in tables["verification"].rows] == ["SYS-3", "SYS-4"]


def test_a_verdict_that_is_stale_and_one_that_differs(model, story):
    stale = trace_report(model, story.evidence(causes=(StaleCause.CODE,)), title="T")
    differing = trace_report(model, story.evidence(shown=False), title="T")

    assert table_of(stale, "verification").rows[0][7] == "stale (code)"
    assert table_of(differing, "verification").rows[0][7:10] == ("differs among variants", "", "2 met, 1 not met")


def test_a_chain_as_a_table_counts_upwards_below_nought(model, story):
    table = chain_table(chain_of(model, story.evidence(), "SYS-1"))

    assert [row[:3] for row in table.rows][:4] == [
        (-1, "derives from", "STK-1"),
        (0, "", "SYS-1"),
        (1, "is decided by", "P"),
        (2, "is computed from", "P_g"),
    ]


def test_an_impact_as_a_table(model, story):
    rows = impact_table(impact_of(model, story.evidence(), "SYS-2")).rows

    assert rows == [
        ("stakeholder requirement to compare with", "STK-1", ""),
        ("block or behaviour", "BLK-finger", ""),
        ("verdict to renew", "SYS-2", "met"),
        ("test to run again", "tests/test_gripper.py::test_it_opens[fast]", ""),
    ]


def test_the_terminal_shows_the_same_in_few_words(report):
    tables = {table.name: table for table in terminal_tables(report)}

    assert "gaps" not in tables
    assert tables["stakeholder-moe"].rows == [("STK-1", "x", ""), ("STK-2", "", "x")]
    assert tables["verification"].rows[0] == (
        "SYS-1",
        "analysis",
        "P >= 800 g",
        "0.865 kg (0.86 to 0.87), 2 trials",
        "met",
    )
    assert [row[3] for row in tables["verification"].rows[1:]] == ["1 test passed", "1 test not run", "none"]
    (gaps,) = terminal_tables(report, table="gaps")
    assert gaps.rows[1] == ("SYS-3", "no allocation, no evidence that holds now", "The script shall keep a record.")


def test_the_terminal_shows_links_of_a_wide_matrix_row_by_row(tmp_path, story):
    more = "".join(f"\n  - {{id: BLK-{n}, name: N, level: element, parent: BLK-system, text: T.}}" for n in range(12))
    hook = "  - {id: BLK-hook, name: Hook, level: element, parent: BLK-gripper, relation: kind, text: Hangs.}"
    folder = story.write(tmp_path / "more", {"architecture.yaml": {hook: hook + more}})
    report = trace_report(story.model(folder), TraceEvidence(), title="T")
    (table,) = terminal_tables(report, table="system-architecture")

    assert table.heads == ("system requirements", "is satisfied by")
    assert table.rows[0] == ("SYS-1", "BLK-gripper ACT-lift")


def test_no_text_of_a_file_steers_the_terminal(tmp_path, story):
    folder = story.write(
        tmp_path / "hostile", {"system.yaml": {"The gripper shall open.": '"\\e[31mThe gripper\\e]0;x\\a shall open."'}}
    )
    report = trace_report(story.model(folder), story.evidence(choice="a\x1b[2J"), title="T")
    chain = chain_of(story.model(folder), story.evidence(), "SYS-1")
    lines = [*table_lines(terminal_tables(report, gaps_only=True)), *chain_lines(chain)]

    assert any("shall open" in line for line in lines)
    assert not [line for line in lines if not line.isprintable()]


def test_the_lines_of_a_chain_and_of_an_impact(model, story):
    chain = chain_lines(chain_of(model, story.evidence(), "SYS-1"))
    impact = impact_lines(impact_of(model, story.evidence(), "SYS-1"))

    assert chain[0] == "SYS-1 (system requirement) [met by variant 7; asked for: P >= 800 g]"
    assert "  is decided by P [0.865 kg (0.86 to 0.87), 2 trials]" in chain
    assert f"    is observed in {story.KEYS[1][:12]}: variant 7, seed 1, contact: success" in "\n".join(chain)
    assert impact[0] == "Impact of a change to SYS-1 (system requirement)"
    assert "  SYS-1 (met, 3 variants), SYS-2 (met), SYS-3 (not run)" in impact


def test_a_table_that_is_not_there(report):
    with pytest.raises(DefinitionError, match="unknown table 'nothing'"):
        terminal_tables(report, table="nothing")
