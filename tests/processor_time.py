"""Processor time of tests, and the list of those that `make fast` leaves out for it.

``pytest --measure-slow`` notes the processor time of each test, that of the processes it starts
included, and writes the names of the tests that take long to `slow_tests.txt`. Processor time
depends on the machine far less than time by the clock, and with it a loaded machine makes the same
list. Tests that are not in the list, new ones among them, are taken for quick.
"""

from __future__ import annotations

import os
from collections import defaultdict
from functools import cache
from pathlib import Path

import pytest

LIST = Path(__file__).parent / "slow_tests.txt"
LONGEST_S, LONGEST_FILE_S = 0.1, 0.4
_HEAD = f"""\
# Tests whose mean processor time exceeds {LONGEST_S} s, and files whose other tests take more than {LONGEST_FILE_S} s
# together, what they share included; `make fast` leaves them out. Written by: pytest --measure-slow
"""
_PROPERTY, _SETUP = "processor_s", "setup_processor_s"


@cache
def slow_tests() -> frozenset[str]:
    """The names of the tests that take long, without their parameters, and of the files."""
    lines = LIST.read_text(encoding="utf-8").splitlines() if LIST.exists() else []
    return frozenset(line for line in lines if line and not line.startswith("#"))


def name_of(nodeid: str) -> str:
    """The name of a test without its parameters."""
    return nodeid.partition("[")[0]


def file_of(name: str) -> str:
    """The file of a test."""
    return name.partition("::")[0]


class ProcessorTimes:
    """Plugin that measures each test and writes the list at the end of the run."""

    def __init__(self) -> None:
        """Begin with no measurement."""
        self._begun_s: dict[str, float] = {}
        self._spent_s: dict[str, list[float]] = defaultdict(list)
        self._setup_s: dict[str, float] = defaultdict(float)

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        """Note the processor time at which a test begins."""
        self._begun_s[nodeid] = _processor_s()

    @pytest.hookimpl(hookwrapper=True)
    def pytest_runtest_makereport(self, item: pytest.Item, call: pytest.CallInfo[None]) -> None:
        """Attach what the test took to the report of its end, which reaches the process that writes the list."""
        outcome = yield
        if item.nodeid not in self._begun_s:
            return
        spent = _processor_s() - self._begun_s[item.nodeid]
        if call.when == "setup":
            outcome.get_result().user_properties.append((_SETUP, spent))
        elif call.when == "teardown":
            del self._begun_s[item.nodeid]
            outcome.get_result().user_properties.append((_PROPERTY, spent))

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Collect what a test took."""
        if report.when == "teardown":
            times = [spent for name, spent in report.user_properties if name == _PROPERTY]
            self._spent_s[name_of(report.nodeid)] += times
        elif report.when == "setup":
            # What several tests share is made by whichever comes first, and would only move to the next.
            times = [spent for name, spent in report.user_properties if name == _SETUP]
            file = file_of(report.nodeid)
            self._setup_s[file] = max([self._setup_s[file], *times])

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Write the list; tests that were not run keep their places."""
        if hasattr(session.config, "workerinput"):
            return
        kept = {name for name in slow_tests() if name not in self._spent_s and _exists(name, session.config.rootpath)}
        found = {name for name, times in self._spent_s.items() if times and sum(times) / len(times) > LONGEST_S}
        others: dict[str, float] = defaultdict(float)
        for name in self._spent_s.keys() - found:
            others[file_of(name)] += sum(self._spent_s[name])
        for file, spent in self._setup_s.items():
            others[file] = max(others[file], spent)
        files = {file for file, spent in others.items() if spent > LONGEST_FILE_S}
        files |= {one for one in kept if "::" not in one}
        tests = {name for name in kept | found if file_of(name) not in files}
        LIST.write_text(_HEAD + "".join(f"{name}\n" for name in sorted(files | tests)), encoding="utf-8")


def _exists(name: str, root: Path) -> bool:
    file, _, function = name.partition("::")
    path = root / file
    return path.exists() and (
        not function or f"def {function.rpartition('::')[2]}(" in path.read_text(encoding="utf-8")
    )


def _processor_s() -> float:
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system
