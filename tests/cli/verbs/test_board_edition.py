"""``rgss report --board``: the board edition, and one line for what is wrong."""

from __future__ import annotations

import pytest

from rgss.cli import printing
from rgss.cli.main import main
from rgss.errors import DefinitionError


def test_the_board_edition_names_the_choice_and_runs_nothing(with_evidence, tmp_path, capsys):
    file = tmp_path / "board.html"
    status = main(["report", "--project", str(with_evidence), "--board", "--no-film", "--out", str(file)])

    assert status == 0
    page = file.read_text(encoding="utf-8")
    assert "is chosen" in page
    assert page.count('class="sheet"') == 5
    assert f"Wrote {file}" in capsys.readouterr().out


def test_a_pdf_of_the_whole_report_is_refused(with_evidence, tmp_path, capsys):
    words = ["report", "--project", str(with_evidence), "--pdf", "--no-film", "--out", str(tmp_path / "a.html")]
    assert main(words) == 2
    assert "--pdf needs --board" in capsys.readouterr().err


def test_a_pdf_without_a_browser_is_refused_before_anything_is_made(with_evidence, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(printing.shutil, "which", lambda name: None)
    file = tmp_path / "board.html"
    words = ["report", "--project", str(with_evidence), "--board", "--pdf", "--no-film", "--out", str(file)]
    assert main(words) == 2
    assert "--pdf needs Chromium, which is not installed" in capsys.readouterr().err
    assert not file.exists()


def test_a_browser_that_prints_nothing_is_named(tmp_path):
    with pytest.raises(DefinitionError, match="true did not print the page"):
        printing.print_page(tmp_path / "page.html", "/bin/true")
