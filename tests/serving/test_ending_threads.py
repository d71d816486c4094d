"""The threads of the server end before the interpreter does."""

from __future__ import annotations

import threading

import pytest

from rgss.serving.ending_thread import EndingThread
from rgss.serving.observer import StudyObserver
from rgss.serving.replays import TrialReplays


@pytest.fixture
def endless():
    """Begins an endless computation; its event is set once it runs."""
    running = threading.Event()

    def compute(*_):
        while True:
            running.set()

    return running, compute


def test_a_computation_is_ended_without_a_message(endless, capfd):
    running, compute = endless
    thread = EndingThread(compute, name="endless")
    thread.start()
    assert running.wait(600)
    assert thread.end(600)
    assert not thread.is_alive()
    assert capfd.readouterr() == ("", "")
    assert thread.end()


def test_a_thread_that_waits_outside_of_python_is_not_waited_for():
    held = threading.Event()
    thread = EndingThread(held.wait, name="held")
    thread.start()
    assert not thread.end(0.01)
    held.set()
    thread.join(600)
    assert not thread.is_alive()


def test_one_that_was_never_started_has_ended():
    assert EndingThread(print, name="new").end()


def test_the_observer_ends_while_it_reads_and_while_it_waits(tmp_path, endless):
    running, compute = endless
    observer = StudyObserver(tmp_path, compute, evidence=tmp_path / "e.sqlite", label="e.sqlite")
    observer.end()
    observer.start()
    observer.state()
    assert running.wait(600)
    observer.end()
    assert not observer._thread.is_alive()
    idle = StudyObserver(tmp_path, compute, evidence=tmp_path / "e.sqlite", label="e.sqlite")
    idle.start()
    idle.end()
    assert not idle._thread.is_alive()


def test_replays_that_are_being_made_end(endless, monkeypatch):
    running, compute = endless
    monkeypatch.setattr("rgss.serving.replays.replay_page", compute)
    replays = TrialReplays(object)
    replays.page(4, 1)
    assert running.wait(600)
    replays.end()
    assert not any(thread.is_alive() for thread in replays._threads)
