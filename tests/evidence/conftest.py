"""Records to keep, of every kind that a trial can leave."""

import contextlib
import hashlib
import json
import os
import sqlite3
from collections.abc import Iterable
from pathlib import Path

import pytest
from hypothesis import strategies as st

from rgss.evidence import (
    EvidenceStore,
    Failure,
    Fidelity,
    PhaseOutcome,
    PhaseRecord,
    PlanningRecord,
    PlanOutcome,
    Provenance,
    TrialRecord,
    record_to_json,
    trial_key,
)
from rgss.evidence.store.ledger import write_ledger
from tests.fixtures.eight_states import PLANNED_PHASES, Phase


def make_record(variant: int = 1, seed: int = 7, **changes: object) -> TrialRecord:
    values = {
        "variant": variant,
        "seed": seed,
        "fidelity": Fidelity.CONTACT,
        "success": False,
        "failure": Failure.OBJECT_DROPPED,
        "failed_phase": Phase.LIFT,
        "failure_detail": "slipped 31 mm",
        "phases": tuple(
            PhaseRecord(
                phase=phase,
                outcome=PhaseOutcome.COMPLETED if index < 2 else PhaseOutcome.NOT_RUN,
                duration_s=0.1 * index if index < 2 else None,
                metrics={"slip_m": 1e-3 / 7, "grip_margin_min": None},
            )
            for index, phase in enumerate(Phase)
        ),
        "planning": tuple(
            PlanningRecord(
                subtask=phase,
                outcome=PlanOutcome.SOLVED,
                checks=300 + variant,
                simplification_checks=1000,
                time_s=0.3,
                path_length_m=0.1 + 0.2,
            )
            for phase in PLANNED_PHASES
        ),
        "metrics": {"planning_time_s": (0.3, 0.3, None, 0.1, 2), "success": 0, "task_time_s": 12.5},
    }
    return TrialRecord(**{**values, **changes})


def random_records() -> st.SearchStrategy[TrialRecord]:
    number = st.floats(allow_nan=False, allow_infinity=False)
    scalar = st.none() | st.integers() | number
    metrics = st.dictionaries(st.text(), scalar | st.lists(scalar, max_size=5).map(tuple), max_size=5)
    optional_number = st.none() | number | st.integers(0, 9)
    phases = st.builds(
        PhaseRecord,
        phase=st.sampled_from(Phase),
        outcome=st.sampled_from(PhaseOutcome),
        duration_s=optional_number,
        metrics=metrics,
    )
    planning = st.builds(
        PlanningRecord,
        subtask=st.sampled_from(Phase),
        outcome=st.sampled_from(PlanOutcome),
        checks=st.integers(),
        simplification_checks=st.integers(),
        time_s=optional_number,
        path_length_m=optional_number,
    )
    return st.builds(
        TrialRecord,
        variant=st.integers(),
        seed=st.integers(),
        fidelity=st.sampled_from(Fidelity),
        success=st.booleans(),
        failure=st.none() | st.sampled_from(Failure),
        failed_phase=st.none() | st.sampled_from(Phase),
        failure_detail=st.text(),
        phases=st.lists(phases, max_size=2).map(tuple),
        planning=st.lists(planning, max_size=2).map(tuple),
        metrics=metrics,
        workload=st.text(max_size=5),
        draws=st.dictionaries(st.text(), number, max_size=3),
    )


@pytest.fixture(scope="session")
def record():
    return make_record


@pytest.fixture(scope="session")
def records():
    return random_records()


@pytest.fixture
def provenance():
    inputs = {name: f"{index}" * 64 for index, name in enumerate(["plan", "timing", "execution", "variant"])}
    return Provenance(inputs=inputs, versions={"rgss": "0.1.0", "pybullet": "3.2.7"})


FIRST_DDL = """CREATE TABLE trials (
    key TEXT NOT NULL PRIMARY KEY,
    content_digest TEXT NOT NULL,
    seal TEXT NOT NULL,
    record TEXT NOT NULL,
    provenance TEXT NOT NULL
)"""


def make_first_store(path: Path, numbers: Iterable[int]) -> None:
    """Writes a store as schema 1 had it, with the standard library alone."""
    connection = sqlite3.connect(path, isolation_level=None)
    connection.execute(FIRST_DDL)
    connection.execute("PRAGMA application_id = 1919382387")
    connection.execute("PRAGMA user_version = 1")
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("BEGIN")
    for number in numbers:
        key = hashlib.sha256(f'{{"trial":{number}}}'.encode()).hexdigest()
        text = record_to_json(make_record(variant=number))
        origin = json.dumps({"inputs": {"plan": "a" * 64}, "versions": {"rgss": "0.1.0"}}, separators=(",", ":"))
        content = hashlib.sha256(text.encode()).hexdigest()
        seal = hashlib.sha256(json.dumps([key, content, origin], separators=(",", ":")).encode()).hexdigest()
        connection.execute("INSERT INTO trials VALUES (?, ?, ?, ?, ?)", (key, content, seal, text, origin))
    connection.execute("COMMIT")
    connection.close()


@pytest.fixture(scope="session")
def first_store():
    return make_first_store


@pytest.fixture
def path(tmp_path):
    return tmp_path / "evidence.sqlite"


@pytest.fixture
def store(path):
    with EvidenceStore.open(path, label="evidence.sqlite") as store:
        yield store


@pytest.fixture(scope="session")
def key():
    """The key of a trial that has but a number."""
    return lambda number: trial_key({"trial": number})


@pytest.fixture
def filled(path, record, provenance, key):
    """The path of a closed store with three trials."""
    with EvidenceStore.open(path) as store:
        for number in (1, 2, 3):
            store.put(key(number), record(variant=number), provenance)
    return path


def run_statement(path, statement, *values):
    connection = sqlite3.connect(path, isolation_level=None)
    connection.execute(statement, values)
    connection.close()


@pytest.fixture(scope="session")
def tamper():
    """Changes a database file behind the back of the store."""
    return run_statement


@pytest.fixture(scope="session")
def change():
    """Changes a database file behind the back of the store and writes its ledger anew, as a forger would."""

    def run(path, statement, *values):
        run_statement(path, statement, *values)
        connection = sqlite3.connect(path, isolation_level=None)
        connection.text_factory = lambda content: content.decode("utf-8", "surrogateescape")
        with contextlib.suppress(sqlite3.Error):
            write_ledger(connection)
        connection.close()

    return run


@pytest.fixture
def as_ordinary_user():
    """Lays down the rights of root, for whom no folder is read-only."""
    if os.geteuid() != 0:
        yield
        return
    os.seteuid(65534)
    try:
        yield
    finally:
        os.seteuid(0)
