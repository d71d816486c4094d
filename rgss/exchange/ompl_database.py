"""Planning runs as a benchmark database of OMPL, for its tools that compare planners.

The tables are those that ``ompl_benchmark_statistics`` makes from the logs of OMPL's
``Benchmark`` class: an experiment is a problem, a planner configuration is a planner with its
settings, a run is one search. Properties that OMPL does not define are additional columns,
which the tools plot like any other.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from rgss.documents import is_disk_failure, replaced_file
from rgss.errors import EvidenceError, StorageError
from rgss.evidence import PlanOutcome
from rgss.evidence.records import PlanningRun

STATUSES = (
    "Unknown status",
    "Invalid start",
    "Invalid goal",
    "Unrecognized goal type",
    "Timeout",
    "Approximate solution",
    "Exact solution",
    "Crash",
    "Abort",
    "Infeasible",
)
"""Names of the planner statuses of OMPL, in its order."""

_STATUS_OF: Mapping[PlanOutcome, int] = MappingProxyType(
    {
        PlanOutcome.INVALID_START: 1,
        PlanOutcome.INVALID_GOAL: 2,
        PlanOutcome.BUDGET_SPENT: 4,
        PlanOutcome.SOLVED: 6,
        PlanOutcome.MOVE_BLOCKED: 9,
        PlanOutcome.MOVE_UNREACHABLE: 9,
        PlanOutcome.NOT_VERIFIED: 9,
    }
)

_TABLES = (
    """CREATE TABLE experiments
        (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512), totaltime REAL, timelimit REAL,
        memorylimit REAL, runcount INTEGER, version VARCHAR(128), hostname VARCHAR(1024),
        cpuinfo TEXT, date DATETIME, seed INTEGER, setup TEXT)""",
    "CREATE TABLE plannerConfigs (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512) NOT NULL, settings TEXT)",
    "CREATE TABLE enums (name VARCHAR(512), value INTEGER, description TEXT, PRIMARY KEY (name, value))",
    """CREATE TABLE runs
        (id INTEGER PRIMARY KEY AUTOINCREMENT, experimentid INTEGER, plannerid INTEGER,
        time REAL, status ENUM, solved BOOLEAN, correct_solution BOOLEAN, validity_checks INTEGER,
        simplification_checks INTEGER, tool_path_length REAL, seed INTEGER,
        FOREIGN KEY (experimentid) REFERENCES experiments(id) ON DELETE CASCADE,
        FOREIGN KEY (plannerid) REFERENCES plannerConfigs(id) ON DELETE CASCADE)""",
    """CREATE TABLE progress
        (runid INTEGER, time REAL, PRIMARY KEY (runid, time),
        FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE)""",
)


def write_ompl_database(
    path: Path, runs: Sequence[PlanningRun], *, name: str, seed: int, version: str, setup: Mapping[str, str]
) -> None:
    """Write planning runs as a benchmark database; an existing file is replaced atomically.

    The same runs give the same bytes. No date and no host are written: planning time is that of
    the planning clock, which does not depend on either.

    Args:
        path: The file to write.
        runs: The runs, in the order of seeds for each problem and planner.
        name: Name of the study, a prefix of the name of each problem.
        seed: The study's first seed.
        version: Version of OMPL that planned.
        setup: Settings that all runs share, by name.

    Raises:
        EvidenceError: There are no runs, or the file cannot be written.
        StorageError: The disk is full or fails.
    """
    if not runs:
        raise EvidenceError("there are no planning runs to export", hint="run 'rgss sweep' first")
    try:
        with replaced_file(path) as part:
            _fill(part, runs, name=name, seed=seed, version=version, setup=setup)
    except (OSError, sqlite3.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        if (isinstance(error, OSError) and is_disk_failure(error)) or "disk is full" in reason:
            raise StorageError(f"{path} cannot be written: {reason}", hint="free some space") from error
        raise EvidenceError(f"{path} cannot be written: {reason}", hint="choose a file that can be written") from error


def _fill(
    path: Path, runs: Sequence[PlanningRun], *, name: str, seed: int, version: str, setup: Mapping[str, str]
) -> None:
    problems = list(dict.fromkeys(run.problem for run in runs))
    planners = list(dict.fromkeys(run.planner for run in runs))
    settings = "\n".join(f"{key} = {value}" for key, value in setup.items())
    connection = sqlite3.connect(path)
    try:
        with connection:
            for table in _TABLES:
                connection.execute(table)
            connection.executemany(
                "INSERT INTO enums VALUES ('status', ?, ?)", [(value, text) for value, text in enumerate(STATUSES)]
            )
            connection.executemany(
                "INSERT INTO plannerConfigs VALUES (?, ?, ?)",
                [(number, planner, "") for number, planner in enumerate(planners, start=1)],
            )
            for number, problem in enumerate(problems, start=1):
                here = [run for run in runs if run.problem == problem]
                connection.execute(
                    "INSERT INTO experiments VALUES (?, ?, ?, ?, 0.0, ?, ?, '', '', '', ?, ?)",
                    (
                        number,
                        f"{name}: {problem}",
                        sum(run.time_s or 0.0 for run in here),
                        max(run.limit_s for run in here),
                        max(sum(run.planner == planner for run in here) for planner in planners),
                        f"OMPL {version}",
                        seed,
                        settings,
                    ),
                )
                connection.executemany(
                    "INSERT INTO runs VALUES (NULL, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                    [_row(run, number, planners.index(run.planner) + 1) for run in here],
                )
    finally:
        connection.close()


def _row(run: PlanningRun, experiment: int, planner: int) -> tuple[object, ...]:
    solved = run.outcome is PlanOutcome.SOLVED
    return (
        experiment,
        planner,
        run.time_s,
        _STATUS_OF.get(run.outcome, 0),
        solved,
        solved,
        run.checks,
        run.simplification_checks,
        run.path_length_m,
        run.seed,
    )
