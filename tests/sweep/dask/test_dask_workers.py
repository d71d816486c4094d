"""Sweeps on a Dask cluster: the same records, whatever becomes of its workers."""

from __future__ import annotations

import os
import pickle
import signal
import sys
from pathlib import Path

import dask
import pytest
from distributed import Client, LocalCluster

from rgss.errors import DefinitionError, SimulationError
from rgss.evidence import EvidenceStore, RunFailureKind
from rgss.studies.expansion import trial_specs
from rgss.sweep.dask import cluster as dask_cluster_module
from rgss.sweep.dask.cluster import dask_cluster, difference
from rgss.sweep.dask.engines import Differs, Engines, Order
from rgss.sweep.dask.process_environment import are_alike, environment
from rgss.sweep.running import sweep
from rgss.sweep.task_end import TaskError
from rgss.sweep.trial_keys import trials_of
from tests.fixtures.processes import PATIENCE_S, is_running, wait_until

DOUBLES = Path(__file__).parents[1] / "doubles"
GIB = 1024**3
LIMITS = {"time_limit_s": PATIENCE_S, "memory_limit_bytes": 1 * GIB}
HINT = "every worker needs the same engines and the same rgss"


@pytest.fixture(scope="module")
def doubles(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(DOUBLES)
        patch.setenv("WORKER_DOUBLES_FOLDER", str(tmp_path_factory.mktemp("marks")))
        import dask_doubles

        yield dask_doubles


@pytest.fixture(scope="module")
def local(doubles):
    """Two Dask workers of one thread each, whose loss a task survives once."""
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 1}),
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=60) as cluster,
    ):
        yield cluster


@pytest.fixture(scope="module")
def threads(doubles):
    """A Dask worker of two threads in this process."""
    with LocalCluster(
        n_workers=1, threads_per_worker=2, processes=False, dashboard_address=":0", silence_logs=60
    ) as cluster:
        yield cluster


def digests_in(store):
    return {trial.key: trial.content_digest for trial in store.all()}


def test_a_cluster_goes_on_whatever_becomes_of_its_tasks(local, doubles, carried_out, troubles_of_tasks):
    names = ["who", "die", "memory_limit", "exit", "fail", "refuse", "threads", "parent"]
    with dask_cluster(local.scheduler_address, **LIMITS) as cluster:
        workers = cluster.workers(doubles.act)
        assert (workers.size, workers.free) == (2, 4)
        ended = carried_out(workers, {name: (name,) for name in names})
        workers.close()
    dask_workers = {worker.process.pid for worker in local.workers.values()}

    assert ended["who"].failure is None
    assert ended["who"].result not in {*dask_workers, os.getpid()}
    assert ended["parent"].result in dask_workers
    assert ended["memory_limit"].result == GIB
    assert ended["threads"].result == "1"
    troubles = {name: each.failure for name, each in ended.items() if each.failure is not None}
    assert troubles == {name: each for name, each in troubles_of_tasks.items() if name != "hang"}
    assert not is_running(ended["who"].result)


def test_a_task_that_hangs_is_ended_at_its_limit(local, doubles, carried_out, troubles_of_tasks):
    # Alone, for on a busy machine any task may take as long as this limit.
    with dask_cluster(local.scheduler_address, time_limit_s=5.0, memory_limit_bytes=1 * GIB) as cluster:
        ended = carried_out(cluster.workers(doubles.act), {"hang": ("hang",)})
    assert ended["hang"].failure == troubles_of_tasks["hang"]


def test_a_task_that_costs_one_dask_worker_after_another_is_given_up(local, doubles, carried_out):
    with dask_cluster(local.scheduler_address, **LIMITS) as cluster:
        workers = cluster.workers(doubles.act)
        ended = carried_out(workers, {"rob": ("rob",)})
        again = carried_out(workers, {"who": ("who",)})

    assert ended["rob"].failure == TaskError(
        kind=RunFailureKind.CRASHED, detail="2 Dask workers were lost at it", may_pass=True
    )
    assert again["who"].failure is None


@pytest.mark.verifies("SYS-026")
def test_a_dask_worker_that_is_killed_costs_nothing_but_time(local, doubles, shipped, tmp_path):
    import task_doubles
    import worker_doubles

    project = shipped.with_fidelity("kinematic").with_replicates(5)
    specs = trial_specs(project, variants=[project.designs.variant(number) for number in (1, 10, 65)])
    with (
        EvidenceStore.open(tmp_path / "here.sqlite") as here,
        EvidenceStore.open(tmp_path / "there.sqlite") as there,
        dask_cluster(local.scheduler_address, **LIMITS) as cluster,
    ):
        sweep(specs, here, jobs=0, on_finished=lambda _: None, maker=worker_doubles.quick)
        result = sweep(
            specs, there, jobs=0, on_finished=lambda _: None, maker=doubles.robbed, workers_for=cluster.workers
        )
        again = sweep(specs, there, jobs=0, on_finished=lambda _: None, workers_for=lambda _: pytest.fail("asked"))

        assert not task_doubles.is_first_time("robbed")
        assert result.lost == ()
        assert again.made == {}
        assert len(there) == 15
        assert digests_in(there) == digests_in(here)


@pytest.mark.engine
@pytest.mark.verifies("SYS-021", "SYS-026")
def test_a_cluster_that_loses_a_worker_makes_the_same_records(local, shipped, tmp_path):
    project = shipped.with_fidelity("kinematic").with_replicates(3)
    specs = trial_specs(project, variants=[project.designs.variant(number) for number in (58, 64, 65)])
    victims = []

    def kill_once(state):
        if state.made and not victims:
            victims.append(next(iter(local.workers.values())).process.pid)
            os.kill(victims[0], signal.SIGKILL)

    limits = {"time_limit_s": PATIENCE_S, "memory_limit_bytes": 2 * GIB}
    with (
        EvidenceStore.open(tmp_path / "here.sqlite") as here,
        EvidenceStore.open(tmp_path / "there.sqlite") as there,
        dask_cluster(local.scheduler_address, **limits) as cluster,
    ):
        sweep(specs, here, jobs=0, on_finished=lambda _: None)
        result = sweep(
            specs, there, jobs=0, on_finished=lambda _: None, on_state=kill_once, workers_for=cluster.workers
        )

        assert (result.lost, len(victims), len(there)) == ((), 1, 9)
        assert result.made["plan"] == len({trial.digests.plan for trial in trials_of(specs)})
        assert digests_in(there) == digests_in(here)


def test_stopping_ends_what_is_being_done_at_once(local, doubles, carried_out):
    # No limit would ever end what hangs.
    with dask_cluster(local.scheduler_address, time_limit_s=1e6, memory_limit_bytes=0) as cluster:
        workers = cluster.workers(doubles.act)
        pid = carried_out(workers, {"who": ("who",)})["who"].result
        for number in range(4):
            workers.begin(f"{number}", ("hang",))
        workers.close()
        wait_until(lambda: not is_running(pid))
        workers.close()


def test_each_thread_of_a_dask_worker_has_a_process_of_its_own(threads, doubles, carried_out):
    with dask_cluster(threads.scheduler_address, time_limit_s=PATIENCE_S, memory_limit_bytes=0) as cluster:
        workers = cluster.workers(doubles.act)
        assert workers.size == 2
        # Each waits for the other to begin.
        ended = carried_out(workers, {name: ("meet", name) for name in ("a", "b")})
    assert [each.failure for each in ended.values()] == [None, None]
    assert len({each.result for each in ended.values()} - {os.getpid()}) == 2


def test_a_cluster_without_workers_in_the_middle_is_left_in_the_end(doubles, carried_out):
    with LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0", silence_logs=60
    ) as local:
        address = local.scheduler_address
        with dask_cluster(address, time_limit_s=PATIENCE_S, memory_limit_bytes=0) as cluster:
            workers = cluster.workers(doubles.act, without_workers_s=0.1)
            workers.begin("hang", ("hang",))
            local.scale(0)
            with pytest.raises(SimulationError) as caught:
                carried_out(workers, {"never": ("who",)})
            workers.close()
    assert str(caught.value) == (
        f"the Dask cluster at {address} has had no workers for 0.1 s "
        "(what was finished is kept; start workers and run the sweep again)"
    )


def test_a_scheduler_that_goes_is_an_error(doubles, carried_out):
    with LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0", silence_logs=60
    ) as local:
        address = local.scheduler_address
        with dask_cluster(address, time_limit_s=PATIENCE_S, memory_limit_bytes=0) as cluster:
            workers = cluster.workers(doubles.act)
            workers.begin("hang", ("hang",))
            local.close()
            with pytest.raises(SimulationError) as caught:
                carried_out(workers, {"never": ("who",)})
            workers.close()
    assert str(caught.value) == (
        f"the Dask scheduler at {address} has stopped or has dropped the sweep's tasks "
        "(what was finished is kept; run the sweep again to go on)"
    )


def test_a_worker_that_would_make_other_records_is_refused_before_the_first_task(local, monkeypatch):
    here = {**environment(), "ompl": "1.6.0", "rgss-plan": "a" * 64}
    monkeypatch.setattr(dask_cluster_module, "environment", lambda: here)
    with pytest.raises(DefinitionError) as caught, dask_cluster(local.scheduler_address, **LIMITS):
        pytest.fail("it was accepted")

    addresses = [worker.worker_address for worker in local.workers.values()]
    assert str(caught.value) in {
        f"the Dask worker {address} would make other records: it has ompl 1.7.0 instead of 1.6.0, "
        f"other code of rgss (plan) ({HINT})"
        for address in addresses
    }


def test_a_worker_that_comes_later_and_differs_ends_the_sweep(local, doubles, carried_out):
    with dask_cluster(local.scheduler_address, **LIMITS) as cluster:
        order = Order(name="later", environment={**environment(), "numpy": "1.0"}, **LIMITS)
        workers = cluster.workers(doubles.act)
        workers._order = order
        workers.begin("who", ("who",))
        with pytest.raises(SimulationError, match=r"^the Dask worker tcp://.* would make other records: .*same rgss"):
            carried_out(workers, {"never": ("who",)})


def test_a_worker_without_rgss_is_refused():
    with (
        LocalCluster(
            n_workers=1,
            threads_per_worker=1,
            dashboard_address=":0",
            silence_logs=60,
            preload="import sys; sys.modules['rgss'] = None",
        ) as local,
        pytest.raises(DefinitionError) as caught,
        dask_cluster(local.scheduler_address, **LIMITS),
    ):
        pytest.fail("it was accepted")
    assert caught.value.message.startswith("the Dask worker tcp://")
    assert " has no rgss that can be used: " in caught.value.message
    assert caught.value.hint == HINT


def test_a_cluster_that_has_no_workers_is_refused(monkeypatch):
    # Patient with the scheduler, which answers in the end, and not with the workers, which never come.
    wait = Client.wait_for_workers
    monkeypatch.setattr(Client, "wait_for_workers", lambda client, number, timeout: wait(client, number, 0.2))
    with LocalCluster(n_workers=0, processes=False, dashboard_address=":0", silence_logs=60) as local:
        address = local.scheduler_address
        with pytest.raises(DefinitionError) as caught, dask_cluster(address, **LIMITS, patience_s=PATIENCE_S):
            pytest.fail("it was accepted")
    assert str(caught.value) == (
        f"the Dask cluster at {address} has no workers (start some, such as 'dask worker {address} --nthreads 1')"
    )


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", "no-such-host.invalid:8786", "what://ever", ""])
def test_an_address_where_no_scheduler_answers_is_refused(address):
    with pytest.raises(DefinitionError) as caught, dask_cluster(address, **LIMITS, patience_s=0.2):
        pytest.fail("it was accepted")
    assert str(caught.value) == (
        f"no Dask scheduler answers at {address} (start one with 'dask scheduler', or correct the address)"
    )


def test_an_address_that_needs_certificates_is_refused_without_them():
    with pytest.raises(DefinitionError) as caught, dask_cluster("tls://127.0.0.1:1", **LIMITS, patience_s=0.2):
        pytest.fail("it was accepted")
    assert str(caught.value) == (
        "tls://127.0.0.1:1 uses TLS, but Dask's settings name no certificates for a client "
        "(set distributed.comm.tls.ca-file, client.cert and client.key, as docs/scale-out.md shows)"
    )


def test_a_memory_limit_that_is_too_low_is_the_same_error_as_here(threads):
    with (
        pytest.raises(SimulationError, match=r"^a worker process cannot start: .* \(is its memory limit too low\?\)$"),
        dask_cluster(threads.scheduler_address, time_limit_s=600.0, memory_limit_bytes=1024),
    ):
        pytest.fail("it was accepted")


def test_a_time_limit_that_is_too_short_is_told_by_the_tasks(threads, doubles, carried_out):
    with dask_cluster(threads.scheduler_address, time_limit_s=1e-4, memory_limit_bytes=0) as cluster:
        ended = carried_out(cluster.workers(doubles.act), {"who": ("who",)})
    assert cluster.machine == ""
    assert ended["who"].failure.detail == "not done after 0.0001 s"


def test_without_dask_it_is_said_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(DefinitionError) as caught, dask_cluster("tcp://127.0.0.1:1", **LIMITS):
        pytest.fail("it was accepted")
    assert str(caught.value) == (
        "--dask needs the package distributed, which is not installed (pip install 'rgss[dask]')"
    )


def test_engine_processes_that_nobody_asks_end(doubles):
    engines = Engines(idle_s=0.2)
    order = Order(name="one", environment=environment(), **LIMITS)
    ended = engines.carry_out(order, "who", pickle.dumps((doubles.act, ("who",))))
    assert (ended.key, ended.failure) == ("who", None)
    wait_until(lambda: engines.idle == 0 and not is_running(ended.result))

    engines.stop("one")
    stopped = engines.carry_out(order, "who", pickle.dumps((doubles.act, ("who",))))
    assert stopped.failure.detail == "the sweep was stopped"
    other = Order(name="two", environment=environment(), **LIMITS)
    # These have a minute, which no other process takes from them.
    engines = Engines()
    pid = engines.carry_out(other, "who", pickle.dumps((doubles.act, ("who",)))).result
    assert engines.idle == 1
    assert is_running(pid)
    engines.close()
    assert not is_running(pid)


def test_a_worker_whose_mathematics_computes_otherwise_is_refused(local, monkeypatch):
    here = {**environment(), "numerics of libm": "glibc 2.17 0123456789ab"}
    monkeypatch.setattr(dask_cluster_module, "environment", lambda: here)
    with pytest.raises(DefinitionError) as caught, dask_cluster(local.scheduler_address, **LIMITS):
        pytest.fail("it was accepted")

    there = environment()["numerics of libm"]
    expected = f" would make other records: it has numerics of libm {there} instead of glibc 2.17 0123456789ab ("
    assert expected in str(caught.value)


def test_what_computes_the_same_under_another_name_is_alike():
    here = environment()
    digest = here["numerics of libm"].split()[-1]
    assert are_alike(here, {**here, "numerics of libm": f"another library {digest}"})
    assert not are_alike(here, {**here, "numerics of libm": "another library 0123456789ab"})
    assert not are_alike(here, {**here, "ompl": "1.6.0"})


def test_a_difference_is_told_in_one_line():
    here = {"ompl": "1.7.0", "rgss-plan": "a", "rgss-timing": "b", "python": "3.11"}
    there = Differs(found={"ompl": "1.7.0", "rgss-plan": "b", "rgss-timing": "c"}, where="tcp://x:1")

    assert difference(there, here) == (
        "the Dask worker tcp://x:1 would make other records: it has python nothing instead of 3.11, "
        "other code of rgss (plan, timing)"
    )
    missing = Differs(found={}, why="No package metadata was found for ompl", where="tcp://x:1")
    assert difference(missing, here) == (
        "the Dask worker tcp://x:1 cannot run trials: No package metadata was found for ompl"
    )
