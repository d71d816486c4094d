"""What a Dask worker answers is compared with its task before it is taken."""

from __future__ import annotations

import pytest

from rgss.evidence import RunFailureKind
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
