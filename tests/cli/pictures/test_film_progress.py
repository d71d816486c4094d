"""Progress of films: a bar with an estimate on a terminal, nothing elsewhere."""

from __future__ import annotations

import io
import re

import pytest

from rgss.cli.pictures.progress import film_parts_progress, film_progress
from rgss.cli.terminal.remaining_time import RemainingTime


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
    shown = lines(stream)

    assert any(re.match(r"Trials filmed .* 0/4 estimating", line) for line in shown)
    assert re.match(r"Trials filmed .* 4/4\s*$", shown[-1])
    assert "-:--" not in stream.getvalue()


def test_there_is_an_estimate_as_soon_as_a_part_of_the_first_film_is_done(monkeypatch):
    stream = Terminal()
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setattr("sys.stderr", stream)
    now = [100.0]
    with film_parts_progress(5, "Trials filmed", clock=lambda: now[0]) as reach:
        now[0] += 30.0
        reach(0.25)
    assert re.match(r"Trials filmed .* 0/5 9:30 left", lines(stream)[-1])


@pytest.mark.parametrize(
    ("done", "seconds", "words"),
    [(0.0, 40.0, "estimating"), (0.5, 20.0, "1:00 left"), (1.0, 20.0, "0:20 left"), (2.0, 50.0, "")],
)
def test_the_remaining_time_is_that_of_the_mean_pace(done, seconds, words):
    assert RemainingTime(total=2, begun_s=7.0, done=done, reached_s=7.0 + seconds).in_words == words


def lines(stream):
    return re.sub(r"\x1b\[[?0-9;]*[a-zA-Z]", "", stream.getvalue()).splitlines()


def test_a_file_gets_nothing(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr("sys.stderr", stream)
    with film_progress(4) as advance:
        advance()

    assert stream.getvalue() == ""
