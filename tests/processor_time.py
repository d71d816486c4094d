"""Processor time of tests, and the list of those that `make fast` leaves out for it.

``pytest --measure-slow`` notes the processor time of each test, that of the processes it starts
included, and writes the names of the tests that take long to `slow_tests.txt`. Processor time
depends on the machine far less than time by the clock, and with it a loaded machine makes the same
list. Tests that are not in the list, new ones among them, are taken for quick.

Several processes take a file each, those of most tests first. `long_files.txt` names the files that take
longest, by the same measurement; they are begun before the others, so that no process works on one
alone while the others have nothing left.

The cost of a test is what it takes by itself and its share of what it uses with others: a fixture
of a module or of the session is divided among the quick tests that use it. Tests of an engine or a
browser take no share, since `make fast` leaves them out anyway.
"""

from __future__ import annotations

import resource
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

LIST = Path(__file__).parent / "slow_tests.txt"
LONGEST_S = 0.015
LONG_FILES = Path(__file__).parent / "long_files.txt"
LONG_FILE_S = 8.0
_HEAD = f"""\
# Tests whose mean processor time exceeds {LONGEST_S} s, their share of what tests use together included, and files
# that have no others; `make fast` leaves them out. Written by: pytest --measure-slow
"""
_LONG_HEAD = f"""\
# Files of tests that take more than {LONG_FILE_S:g} s of processor time, the longest first; processes that share the
# tests begin with them. Written by: pytest --measure-slow
"""
_OWN, _MADE, _USED = "processor_s", "shared_processor_s", "shared"


@cache
def slow_tests() -> frozenset[str]:
    """The names of the tests that take long, without their parameters, and of the files."""
    lines = LIST.read_text(encoding="utf-8").splitlines() if LIST.exists() else []
    return frozenset(line for line in lines if line and not line.startswith("#"))


@cache
def long_files() -> tuple[str, ...]:
    """The files whose tests take longest, the longest first."""
    lines = LONG_FILES.read_text(encoding="utf-8").splitlines() if LONG_FILES.exists() else []
    return tuple(line for line in lines if line and not line.startswith("#"))


def name_of(nodeid: str) -> str:
    """The name of a test without its parameters."""
    return nodeid.partition("[")[0]


def file_of(name: str) -> str:
    """The file of a test."""
    return name.partition("::")[0]


@dataclass(frozen=True, kw_only=True)
class Measured:
    """Processor time of one test.

    Attributes:
        name: Its name, without parameters.
        own_s: What it took, without what it shares.
        shared: Names of the fixtures that it shares with other tests; None if `make fast` leaves it out anyway.
    """

    name: str
    own_s: float
    shared: tuple[str, ...] | None


def slow_names(measured: Iterable[Measured], shared_s: dict[str, float]) -> set[str]:
    """The names of the tests that take long.

    Args:
        measured: All tests that were run.
        shared_s: Processor time of each fixture that tests share.

    Returns:
        The names whose mean time exceeds the limit. A test that is left out pays for nothing, so that the share of
        the others grows, until each that stays is quick with its share.
    """
    tests = defaultdict(list)
    for test in measured:
        tests[test.name].append(test)
    found: set[str] = set()
    while True:
        users: dict[str, int] = defaultdict(int)
        for name in tests.keys() - found:
            for test in tests[name]:
                for each in test.shared or ():
                    users[each] += 1
        more = {name for name in tests.keys() - found if _mean_s(tests[name], users, shared_s) > LONGEST_S}
        if not more:
            return found
        found |= more


def longest_first(file_s: dict[str, float]) -> list[str]:
    """The files that take long, the longest first.

    Args:
        file_s: Processor time of each file.
    """
    return sorted(
        (file for file, spent in file_s.items() if spent > LONG_FILE_S), key=lambda file: (-file_s[file], file)
    )


def _mean_s(tests: list[Measured], users: dict[str, int], shared_s: dict[str, float]) -> float:
    shares = (shared_s.get(each, 0.0) / users[each] for test in tests for each in test.shared or ())
    return (sum(test.own_s for test in tests) + sum(shares)) / len(tests)


class ProcessorTimes:
    """Plugin that measures each test and writes the list at the end of the run."""

    def __init__(self) -> None:
        """Begin with no measurement."""
        self._begun_s: dict[str, float] = {}
        self._made_s: dict[str, float] = {}
        self._within_s = 0.0
        self._measured: list[Measured] = []
        self._shared_s: dict[str, float] = {}
        self._file_s: dict[str, float] = defaultdict(float)

    @pytest.hookimpl(hookwrapper=True)
    def pytest_fixture_setup(self, fixturedef: pytest.FixtureDef[object]) -> Iterator[None]:
        """Measure the making of a fixture that tests share."""
        if fixturedef.scope == "function":
            yield
            return
        # Each under its own name only, although the making of one may ask for another.
        before, outer_s, name = _processor_s(), self._within_s, _fixture_name(fixturedef)
        self._within_s = 0.0
        yield
        spent = _processor_s() - before
        self._made_s[name] = self._made_s.get(name, 0.0) + spent - self._within_s
        self._within_s = outer_s + spent

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        """Note the processor time at which a test begins."""
        self._begun_s[nodeid] = _processor_s()
        self._made_s, self._within_s = {}, 0.0

    @pytest.hookimpl(hookwrapper=True)
    def pytest_runtest_makereport(self, item: pytest.Item, call: pytest.CallInfo[None]) -> Iterator[None]:
        """Attach what the test took to the report of its end, which reaches the process that writes the list."""
        outcome = yield
        if call.when != "teardown" or item.nodeid not in self._begun_s:
            return
        own_s = _processor_s() - self._begun_s.pop(item.nodeid) - sum(self._made_s.values())
        left_out = any(item.get_closest_marker(mark) for mark in ("engine", "browser"))
        used = None if left_out else _shared_fixtures(item)
        outcome.get_result().user_properties += [(_OWN, own_s), (_MADE, self._made_s), (_USED, used)]

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Collect what a test took."""
        found = dict(report.user_properties)
        if report.when != "teardown" or _OWN not in found:
            return
        used = found[_USED]
        shared = None if used is None else tuple(used)
        self._measured.append(Measured(name=name_of(report.nodeid), own_s=found[_OWN], shared=shared))
        self._file_s[file_of(report.nodeid)] += found[_OWN] + sum(found[_MADE].values())
        for name, spent in found[_MADE].items():
            self._shared_s[name] = max(self._shared_s.get(name, 0.0), spent)

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Write the lists; tests that were not run keep their places."""
        if hasattr(session.config, "workerinput"):
            return
        if not session.config.option.markexpr:  # otherwise few of the long tests were run
            LONG_FILES.write_text(_LONG_HEAD + "".join(f"{file}\n" for file in longest_first(self._file_s)), "utf-8")
        run = {test.name for test in self._measured}
        slow = slow_names(self._measured, self._shared_s)
        quick_files = {file_of(name) for name in run - slow}
        kept = {name for name in slow_tests() if name not in run and _exists(name, session.config.rootpath)}
        files = {name for name in kept if "::" not in name} - quick_files
        files |= {file_of(name) for name in slow} - quick_files - {file_of(name) for name in kept}
        tests = {name for name in kept | slow if "::" in name and file_of(name) not in files}
        LIST.write_text(_HEAD + "".join(f"{name}\n" for name in sorted(files | tests)), encoding="utf-8")

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Say what the tests that are not in the list take together, what they share included."""
        slow = slow_names(self._measured, self._shared_s)
        quick = [test for test in self._measured if test.name not in slow and test.shared is not None]
        shared = {each for test in quick for each in test.shared or ()}
        spent = sum(test.own_s for test in quick) + sum(self._shared_s.get(each, 0.0) for each in shared)
        terminalreporter.write_line(f"{len(quick)} quick tests take {spent:.1f} s of processor time")


def _fixture_name(fixture: pytest.FixtureDef[object]) -> str:
    return f"{fixture.baseid}::{fixture.argname}"


def _shared_fixtures(item: pytest.Item) -> list[str]:
    """The fixtures of a test that other tests use too, by where they are defined."""
    found = getattr(item, "_fixtureinfo", None)
    fixtures = [] if found is None else [each[-1] for each in found.name2fixturedefs.values() if each]
    return [_fixture_name(each) for each in fixtures if each.scope != "function"]


def _exists(name: str, root: Path) -> bool:
    file, _, function = name.partition("::")
    path = root / file
    return path.exists() and (
        not function or f"def {function.rpartition('::')[2]}(" in path.read_text(encoding="utf-8")
    )


def _processor_s() -> float:
    """Processor time of this process and of those that it has waited for; that of `os.times` is in hundredths."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)
