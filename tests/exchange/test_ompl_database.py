"""Planning runs as a database of OMPL's benchmarking."""

from __future__ import annotations

import sqlite3

import pytest

from rgss.errors import EvidenceError, StorageError
from rgss.evidence import PlanOutcome
from rgss.evidence.records.planning_runs import PlanningRun
from rgss.exchange.ompl_database import STATUSES, write_ompl_database
from rgss.motion.engine import load_engine


def run_of(problem="kg_2: move_to_grasp", planner="RRT", seed=1, outcome=PlanOutcome.SOLVED, time_s=0.5):
    solved = outcome is PlanOutcome.SOLVED
    return PlanningRun(
        problem=problem,
        planner=planner,
        seed=seed,
        limit_s=8.0,
        outcome=outcome,
        checks=2000,
        simplification_checks=1500 if solved else 0,
        time_s=time_s,
        path_length_m=1.25 if solved else None,
    )


RUNS = (
    run_of(),
    run_of(seed=2, outcome=PlanOutcome.BUDGET_SPENT, time_s=8.0),
    run_of(planner="STRIDE", time_s=1.5),
    run_of(problem="kg_3: move_to_place", outcome=PlanOutcome.INVALID_GOAL, time_s=None),
)


def write(path, runs=RUNS):
    write_ompl_database(path, runs, name="pick", seed=1, version="1.7.0", setup={"resolution": "0.01 rad"})
    return path


def select(path, query):
    connection = sqlite3.connect(path)
    try:
        return connection.execute(query).fetchall()
    finally:
        connection.close()


def test_each_problem_is_an_experiment(tmp_path):
    path = write(tmp_path / "planning.db")

    assert select(path, "SELECT name, totaltime, timelimit, runcount, version, seed, setup FROM experiments") == [
        ("pick: kg_2: move_to_grasp", 10.0, 8.0, 2, "OMPL 1.7.0", 1, "resolution = 0.01 rad"),
        ("pick: kg_3: move_to_place", 0.0, 8.0, 1, "OMPL 1.7.0", 1, "resolution = 0.01 rad"),
    ]


def test_each_search_is_a_run(tmp_path):
    path = write(tmp_path / "planning.db")
    rows = select(
        path,
        """SELECT experiments.name, plannerConfigs.name, runs.seed, time, description, solved, validity_checks,
        tool_path_length FROM runs JOIN experiments ON experimentid = experiments.id
        JOIN plannerConfigs ON plannerid = plannerConfigs.id
        JOIN enums ON enums.name = 'status' AND enums.value = status ORDER BY runs.id""",
    )

    assert rows == [
        ("pick: kg_2: move_to_grasp", "RRT", 1, 0.5, "Exact solution", 1, 2000, 1.25),
        ("pick: kg_2: move_to_grasp", "RRT", 2, 8.0, "Timeout", 0, 2000, None),
        ("pick: kg_2: move_to_grasp", "STRIDE", 1, 1.5, "Exact solution", 1, 2000, 1.25),
        ("pick: kg_3: move_to_place", "RRT", 1, None, "Invalid goal", 0, 2000, None),
    ]


def test_the_tables_are_those_that_the_tools_of_ompl_read(tmp_path):
    path = write(tmp_path / "planning.db")
    columns = {
        table: {row[1]: row[2] for row in select(path, f"PRAGMA table_info({table})")}
        for table in ("experiments", "plannerConfigs", "enums", "runs", "progress")
    }

    assert list(columns["plannerConfigs"]) == ["id", "name", "settings"]
    assert list(columns["enums"]) == ["name", "value", "description"]
    assert list(columns["runs"])[:3] == ["id", "experimentid", "plannerid"]
    # The type of a column decides how the tools plot it.
    assert columns["runs"]["status"] == "ENUM"
    assert columns["runs"]["solved"] == "BOOLEAN"
    assert columns["runs"]["time"] == "REAL"


def test_the_same_runs_give_the_same_bytes(tmp_path):
    assert write(tmp_path / "one.db").read_bytes() == write(tmp_path / "two.db").read_bytes()


def test_a_file_is_replaced_as_a_whole(tmp_path):
    path = tmp_path / "planning.db"
    path.write_text("something else")

    write(path)

    assert len(select(path, "SELECT * FROM runs")) == len(RUNS)
    assert [entry.name for entry in tmp_path.iterdir()] == ["planning.db"]


def test_no_runs_are_refused(tmp_path):
    with pytest.raises(EvidenceError, match="there are no planning runs to export") as caught:
        write(tmp_path / "planning.db", runs=())

    assert caught.value.hint == "run 'rgss sweep' first"
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_not_there_is_one_line(tmp_path):
    with pytest.raises(EvidenceError, match=r"planning\.db cannot be written: No such file or directory"):
        write(tmp_path / "missing" / "planning.db")


@pytest.mark.engine
def test_the_statuses_are_those_of_ompl():
    base = load_engine().base
    status = base.PlannerStatus
    known = [status(status.StatusType(value)).asString() for value in range(8)]

    assert known == [*STATUSES[:8]]
    # OMPL has no words for its last two, only their names.
    assert [status.StatusType(8), status.StatusType(9)] == [status.ABORT, status.INFEASIBLE]
    assert status.StatusType(len(STATUSES)) == status.TYPE_COUNT


def test_a_full_disk_is_a_failure_of_the_run(tmp_path, monkeypatch):
    def fills(*_, **__):
        raise sqlite3.OperationalError("database or disk is full")

    monkeypatch.setattr("rgss.exchange.ompl_database._fill", fills)
    with pytest.raises(StorageError, match=r"planning\.db cannot be written: database or disk is full"):
        write(tmp_path / "planning.db")
    assert list(tmp_path.iterdir()) == []
