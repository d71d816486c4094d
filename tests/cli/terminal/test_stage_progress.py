"""The stage of a long search: a line on a terminal, nothing elsewhere."""

from __future__ import annotations

import io
import re

from rgss.cli.terminal import stage_progress


class Terminal(io.StringIO):
    """A stream that says that it is a terminal."""

    def isatty(self) -> bool:
        return True


def test_a_terminal_shows_the_last_stage_and_clears_the_line(monkeypatch):
    stream = Terminal()
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "60")
    monkeypatch.setattr("sys.stderr", stream)
    with stage_progress("arm[1].urdf") as on_stage:
        on_stage("layout 1")
        on_stage("a stage [bold]with a name that is longer than the terminal is wide")
    lines = re.sub(r"\x1b\[[?0-9;]*[a-zA-Z]", "\n", stream.getvalue()).splitlines()
    shown = [line.strip() for line in lines if "0:00:0" in line or "urdf" in line]

    assert any("arm[1].urdf: a stage [bold]with a name" in line for line in shown)
    assert max(len(line) for line in shown) <= 60
    assert stream.getvalue().endswith("\x1b[2K")


def test_a_file_gets_nothing(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr("sys.stderr", stream)
    with stage_progress("arm.urdf") as on_stage:
        on_stage("layout 1")

    assert stream.getvalue() == ""
