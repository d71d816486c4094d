"""What all tests share: repeatable examples, and which tests are read and run.

What a run writes down about itself is in ``rgss.cli.pytest_plugin``, which projects of users have too.
"""

from __future__ import annotations

import gc
import os
import re
import signal
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import HealthCheck, settings

from rgss.trials.code.kernel_environment import is_in_force, numeric_environment

from .in_shares import files_of_share
from .processor_time import ProcessorTimes, file_of, long_files, name_of, slow_tests

PROJECT = Path(__file__).parents[1]

pytest_plugins = ["rgss.cli.pytest_plugin", "tests.fixtures.shipped_project"]

# On a busy machine examples are drawn as slowly as anything else, which is no mistake of a test.
settings.register_profile(
    "repeatable",
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("repeatable")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Options that measure which tests take long, and that leave tests to other processes."""
    parser.addoption("--measure-slow", action="store_true", help="write the tests that take long to slow_tests.txt")
    parser.addoption("--share", metavar="K/N", help="read the K-th of N shares of the files only, from 0")


def pytest_configure(config: pytest.Config) -> None:
    """Let the tests compute as trials do, and let the processes that they start be interrupted.

    Kernels of the mathematics are chosen when a process starts, so that this one begins again where it has others.
    The processes of pytest-xdist inherit what this one is started with. In the background of a shell an interrupt
    is ignored by what is started there.
    """
    if not is_in_force():
        capture = config.pluginmanager.getplugin("capturemanager")
        if capture is not None:
            capture.stop_global_capturing()
        sys.stdout.flush()
        sys.stderr.flush()
        words = [sys.executable, *sys.orig_argv[1:]]
        os.execve(sys.executable, words, numeric_environment(os.environ))  # noqa: S606 - this very program
    if config.getoption("--measure-slow"):
        config.pluginmanager.register(ProcessorTimes())
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


_ALL_NEED_AN_ENGINE = re.compile(r"^pytestmark = \[?pytest\.mark\.(engine|browser)\b", re.MULTILINE)


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave out files of which nothing would be run, where slow tests or engines are not wanted: reading takes long."""
    if collection_path.suffix != ".py":
        return None
    wanted, share = config.option.markexpr, config.getoption("--share")
    if _has_none(collection_path, wanted):
        return True
    is_anothers = share and collection_path.match("test_*.py") and collection_path not in _share(share, wanted)
    return True if is_anothers else None


def _has_none(file: Path, wanted: str) -> bool:
    """True if none of a file's tests would be run."""
    if "not slow" in wanted and file.relative_to(PROJECT).as_posix() in slow_tests():
        return True
    return "not engine and not browser" in wanted and bool(_ALL_NEED_AN_ENGINE.search(file.read_text("utf-8")))


@cache
def _share(named: str, wanted: str) -> frozenset[Path]:
    number, _, count = named.partition("/")
    files = [file for file in (PROJECT / "tests").rglob("test_*.py") if not _has_none(file, wanted)]
    return files_of_share(files, int(number), int(count))


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark the tests that are known to take long, and let several processes begin with the longest files."""
    if hasattr(config, "workerinput"):
        place = {file: at for at, file in enumerate(long_files())}
        items.sort(key=lambda item: place.get(file_of(item.nodeid), len(place)))
    slow = slow_tests()
    for item in items:
        if name_of(item.nodeid) in slow or file_of(item.nodeid) in slow:
            item.add_marker(pytest.mark.slow)


@pytest.hookimpl(wrapper=True)
def pytest_collection(session: pytest.Session) -> Iterator[None]:
    """Let the collector of garbage pass over what stays until the end.

    Thousands of tests and what they import are garbage at no time, and it takes long to look through them again
    and again.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()
        gc.freeze()


@pytest.fixture(scope="session")
def story() -> ModuleType:
    """A small project with evidence, whose every link is known by heart."""
    from . import story as story_module

    return story_module
