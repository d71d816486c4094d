"""What a Dask worker answers is compared with its task before it is taken."""

from __future__ import annotations

import logging
from types import SimpleNamespace

import distributed
import pytest

from rgss.errors import DefinitionError
from rgss.evidence import RunFailureKind
from rgss.sweep.dask import cluster
from rgss.sweep.dask.engines import Order
from rgss.sweep.dask.workers import DaskWorkers
from rgss.sweep.task_end import Ended
from tests.fixtures.processes import PATIENCE_S


class AnsweringClient:
    """A client of a cluster that gives each task the same answer at once."""

    def __init__(self, answer):
        self.answer = answer

    def nthreads(self):
        return {"tcp://x:1": 1}

    def submit(self, *_, **__):
        return self

    def add_done_callback(self, callback):
        callback(self)

    def result(self):
        return self.answer

    def release(self):
        pass


@pytest.mark.parametrize(
    "answer",
    [
        None,
        b"garbage",
        Ended(key="another", result=1, failure=None, took_s=0.1),
        Ended(key="k", result=1, failure=None, took_s=float("nan")),
        Ended(key="k", result=1, failure="trouble", took_s=0.1),
    ],
)
def test_a_wrong_answer_of_a_dask_worker_costs_the_task_and_not_the_sweep(answer):
    order = Order(name="one", environment={}, time_limit_s=5.0, memory_limit_bytes=1024**3)
    workers = DaskWorkers(AnsweringClient(answer), str, order, address="tcp://x:1", differs=str)
    workers.begin("k", ())
    (ended,) = workers.wait(PATIENCE_S)
    assert (ended.key, ended.result) == ("k", None)
    assert ended.failure.kind is RunFailureKind.WRONG_ANSWER
    assert ended.failure.detail == "the answer of a Dask worker belongs to another task"


ORDER = Order(name="one", environment={}, time_limit_s=5.0, memory_limit_bytes=1024**3)
FIT = Ended(key="", result="Linux, x86_64", failure=None, took_s=0.1)


def inspected(answers):
    client = SimpleNamespace(run=lambda *_, **__: answers)
    return cluster._inspected(client, "tcp://x:1", ORDER)


def test_a_worker_that_is_lost_while_workers_are_compared_leaves_the_others():
    assert inspected({"tcp://x:2": OSError("in <TCP>: Stream is closed"), "tcp://x:3": FIT}) == "Linux, x86_64"


def test_where_no_worker_is_left_to_answer_the_loss_is_told():
    with pytest.raises(DefinitionError, match="the Dask worker tcp://x:2 cannot run trials: OSError: closed"):
        inspected({"tcp://x:2": OSError("closed")})


@pytest.mark.parametrize("address", ["", "  ", "http://x", "nothing://x:1"])
def test_an_address_that_dask_does_not_have_is_refused_before_a_client_is_made(address, monkeypatch):
    monkeypatch.setattr(distributed, "Client", lambda *_, **__: pytest.fail("a client was made"))
    with (
        pytest.raises(DefinitionError, match="no Dask scheduler answers at"),
        cluster.dask_cluster(address, time_limit_s=5.0, memory_limit_bytes=1024**3),
    ):
        pass


def test_dask_is_quiet_below_its_own_logger_too():
    loggers = [logging.getLogger(name) for name in ("distributed", "distributed.client")]
    before = [logger.level for logger in loggers]
    loggers[1].setLevel(logging.WARNING)
    try:
        with cluster._quiet():
            assert [logger.isEnabledFor(logging.CRITICAL) for logger in loggers] == [False, False]
        assert loggers[1].level == logging.WARNING
    finally:
        for logger, level in zip(loggers, before, strict=True):
            logger.setLevel(level)
