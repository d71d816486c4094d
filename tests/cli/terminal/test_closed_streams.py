"""Progress where standard error is closed, as by ``2>&-``."""

from __future__ import annotations

import sys

import pytest

from rgss.cli.pictures.progress import film_progress
from rgss.cli.safe_output import errors_are_seen
from rgss.cli.sweep.progress import SweepProgress
from rgss.cli.terminal import stage_progress


@pytest.fixture(autouse=True)
def _closed(monkeypatch):
    monkeypatch.setattr(sys, "stderr", None)


def test_nobody_sees_what_is_written_there():
    assert not errors_are_seen()


def test_the_progress_of_a_sweep_is_silent():
    with SweepProgress(3):
        pass


def test_the_progress_of_stages_is_silent():
    with stage_progress("search") as begin:
        begin("first stage")


def test_the_progress_of_a_film_is_silent():
    with film_progress(2) as advance:
        advance()
