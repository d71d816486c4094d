"""What is printed fits a terminal; a file and a pipe get every line as it is."""

from __future__ import annotations

import fcntl
import os
import pty
import re
import signal
import struct
import subprocess
import sys
import termios
from contextlib import redirect_stdout
from io import StringIO

import pytest

from rgss.assessment import measure_variants
from rgss.cli.main import main
from rgss.cli.measured_tables import print_measures
from rgss.cli.output import print_lines, print_table
from rgss.cli.terminal import TerminalPage
from rgss.cli.terminal.pager import Pager
from rgss.cli.terminal.styles import STYLES
from rgss.cli.termination import TerminationRequest
from rgss.measures import Verdict
from rgss.reports.plain_text import aligned_table
from rgss.studies import load_project

STYLE = re.compile(r"\x1b\[[0-9;]*m")


@pytest.fixture
def shown(monkeypatch):
    """A function that gives what reaches a terminal of 40 characters."""
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.delenv("NO_COLOR", raising=False)

    def of(show):
        written = StringIO()
        with redirect_stdout(TerminalPage(written, width=40)):
            show()
        return written.getvalue()

    return of


def test_lines_are_broken_between_words_and_indented(shown):
    text = "This sentence has more than forty characters, and holds 10 % together; see"
    said = shown(lambda: print_lines([f"  {text} https://example.org/a-long-path-of-a-page."]))
    assert said.splitlines() == [
        "  This sentence has more than forty",
        "    characters, and holds 10 % together;",
        "    see",
        "    https://example.org/a-long-path-of-a-page.",
    ]


def test_a_number_keeps_its_percent_sign(shown):
    said = shown(lambda: print_lines(["x" * 36 + " 10 % of all"]))
    assert said.splitlines() == ["x" * 36, "  10 % of all"]


def test_a_question_is_shown_before_its_answer(shown):
    def ask():
        sys.stdout.write("Better? ")
        sys.stdout.flush()

    assert shown(ask) == "Better? "


def test_what_would_steer_the_terminal_is_escaped(shown):
    said = shown(lambda: print_lines(["a\x1b[2Jb", *aligned_table(["text"], [["c\x1b[2Jd"]])]))
    assert "\x1b[2J" not in said
    assert "c" in said


def test_tables_fit_and_verdicts_have_colours(shown):
    rows = [[f"SYS-{number:03}", "a text of some words that is long", verdict] for number, verdict in enumerate(STYLES)]
    said = shown(lambda: print_table(["requirement", "text", "verdict"], rows))
    lines = [STYLE.sub("", line) for line in said.splitlines()]
    assert max(map(len, lines)) <= 40
    assert "\x1b[32mmet" in said
    assert "\x1b[31mnot_met" in said
    for row in rows:
        assert any(row[0] in line for line in lines)


def test_no_colour_and_no_bold_where_none_is_wanted(shown, monkeypatch):
    monkeypatch.setenv("NO_COLOR", "1")
    said = shown(lambda: print_table(["requirement", "verdict"], [["SYS-001", "met"]]))
    assert "SYS-001" in said
    assert "\x1b" not in said


def test_every_verdict_has_a_style():
    assert {verdict.value for verdict in Verdict} <= set(STYLES)


def test_lines_around_a_table_stay_where_they_are(shown):
    said = shown(lambda: print_lines(["before", *aligned_table(["a", "b"], [["1", "2"]]), "behind", ""]))
    assert [line.rstrip() for line in STYLE.sub("", said).splitlines()] == [
        "before",
        "a  b",
        "────",
        "1  2",
        "behind",
        "",
    ]


def test_without_a_terminal_every_line_is_as_it_is(capsys):
    long = "word " * 60
    print_lines([long, *aligned_table(["a"], [["b" * 200]])])
    assert capsys.readouterr().out.splitlines() == [long, "a", "─" * 200, "b" * 200]


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """A new project, which is small and is only read."""
    folder = tmp_path_factory.mktemp("new") / "project"
    with redirect_stdout(StringIO()):
        assert main(["init", str(folder)]) == 0
    return folder


def on_terminal(project, *words, columns=80, **variables):
    """What a command prints on a terminal of so many columns, and its status."""
    leader, follower = pty.openpty()
    fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 40, columns, 0, 0))
    environment = {name: value for name, value in os.environ.items() if name not in ("COLUMNS", "NO_COLOR", "PAGER")}
    environment |= {"TERM": "xterm-256color", "RGSS_PAGER": "cat", **variables}
    with subprocess.Popen(
        [sys.executable, "-m", "rgss", *words],
        stdin=follower,
        stdout=follower,
        stderr=follower,
        cwd=project,
        env=environment,
    ) as process:
        os.close(follower)
        said = b""
        while True:
            try:
                part = os.read(leader, 65536)
            except OSError:
                break
            if not part:
                break
            said += part
    os.close(leader)
    return process.returncode, said.decode("utf-8").replace("\r\n", "\n")


@pytest.mark.parametrize("words", [("variants",), ("trace",), ("trace", "SYS-2"), ("schema",)])
def test_pages_fit_eighty_columns(project, words):
    status, said = on_terminal(project, *words)
    assert status == 0
    assert max(len(STYLE.sub("", line)) for line in said.splitlines()) <= (80 if words != ("schema",) else 200)


def test_what_programs_read_and_what_may_be_wide_is_not_broken(project):
    piped = subprocess.run(
        [sys.executable, "-m", "rgss", "trace"], cwd=project, capture_output=True, text=True, check=True
    ).stdout
    assert max(map(len, piped.splitlines())) > 80
    wide = STYLE.sub("", on_terminal(project, "trace", "--wide")[1])
    assert [line.rstrip() for line in wide.splitlines() if not line.startswith("─")] == [
        line for line in piped.splitlines() if not line.startswith("─")
    ]
    csv = on_terminal(project, "variants", "--format", "csv")[1]
    assert len({line.count(",") for line in csv.splitlines()}) == 1


def test_a_long_page_goes_through_the_pager(project, tmp_path):
    file = tmp_path / "page.txt"
    script = tmp_path / "pager"
    script.write_text(f'#!/bin/sh\ncat > "{file}"\n', encoding="utf-8")
    script.chmod(0o755)
    status, said = on_terminal(project, "trace", RGSS_PAGER=str(script))
    assert (status, said) == (0, "")
    assert "Traceability of the study pick_place" in file.read_text(encoding="utf-8")


@pytest.mark.parametrize(("own", "told"), [({}, "utf-8"), ({"LESSCHARSET": "latin1"}, "latin1")])
def test_less_is_told_the_encoding_of_a_page_in_any_locale(project, tmp_path, own, told):
    script = tmp_path / "pager"
    script.write_text('#!/bin/sh\ncat > /dev/null\necho "in $LESSCHARSET"\n', encoding="utf-8")
    script.chmod(0o755)
    _, said = on_terminal(project, "trace", RGSS_PAGER=str(script), LC_ALL="C", **own)
    assert f"in {told}" in said


def test_a_pager_that_is_left_early_ends_the_command(project):
    status, said = on_terminal(project, "trace", RGSS_PAGER="head -n 1")
    assert (status, said.count("\n")) == (0, 1)


def test_a_request_to_terminate_ends_the_pager_too(monkeypatch):
    """An interrupt is meant for the pager, which has the terminal; a request is meant for this process."""
    pager = Pager(("tail", "-f", "/dev/null"))
    pager.start()
    process, signals = pager._process, [KeyboardInterrupt, TerminationRequest]
    with monkeypatch.context() as patched:
        patched.setattr(process, "wait", lambda: (_ for _ in ()).throw(signals.pop(0)))
        with pytest.raises(TerminationRequest):
            pager.end()
    assert (signals, process.wait()) == ([], -signal.SIGTERM)


@pytest.mark.parametrize("asked", ["", "cat", "no-such-pager-here", "'"])
def test_no_pager(asked):
    assert Pager.of({"RGSS_PAGER": asked}) is None
    assert Pager.of({"RGSS_PAGER": "cat", "PAGER": "sh"}) is None
    assert Pager.of({"PAGER": "sh", "TERM": "dumb"}) is None
    assert Pager.of({"PAGER": "sh"}) is not None


def test_variants_that_show_the_same_share_a_row_on_a_terminal_only(shown, folder, filled, record_of):
    project = load_project(folder).with_replicates(1)
    measured = measure_variants(project, filled(project, lambda spec: record_of(spec, success=spec.variant != 2)))
    measures = [one for one in project.measures.measures if one.id == "S"]

    apart = StringIO()
    with redirect_stdout(apart):
        print_measures(measures, measured)
    together = STYLE.sub("", shown(lambda: print_measures(measures, measured)))

    count = len(measured)
    assert len(apart.getvalue().splitlines()) == count + 2
    assert len(together.splitlines()) < count + 2
    assert "variants" in together
    assert "variants" not in apart.getvalue()


def test_a_table_without_room_for_its_spare_columns_says_so_and_has_each_row_once(shown):
    titles, row = ["measure", "value", "name"], ["t_p_simulated", "12.25 s", "Total planning time of the five moves"]
    narrow = STYLE.sub("", shown(lambda: print_table(titles, [row], right=(1,), spare=(2,))))
    assert "Total" not in narrow
    assert narrow.count("t_p_simulated") == 1
    assert " ".join(narrow.split()).endswith("(no room for: name; --wide has all columns)")
    assert "no room" not in shown(lambda: print_table(titles[:2], [row[:2]]))
