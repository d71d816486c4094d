"""Progress of films: a bar with an estimate on a terminal, nothing elsewhere."""

from __future__ import annotations

import io
import re

from rgss.cli.pictures.progress import film_progress


class Terminal(io.StringIO):
    """A stream that says that it is a terminal."""

    def isatty(self) -> bool:
        return True


def test_a_terminal_shows_what_is_done_and_what_is_left(monkeypatch):
    stream = Terminal()
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setattr("sys.stderr", stream)
    with film_progress(4, "Trials filmed") as advance:
        for _ in range(4):
            advance()
    shown = re.sub(r"\x1b\[[?0-9;]*[a-zA-Z]", "", stream.getvalue()).splitlines()

    assert any(re.match(r"Trials filmed .* 0/4 +-:--:--", line) for line in shown)
    assert re.match(r"Trials filmed .* 4/4 +0:00:00", shown[-1])


def test_a_file_gets_nothing(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr("sys.stderr", stream)
    with film_progress(4) as advance:
        advance()

    assert stream.getvalue() == ""
