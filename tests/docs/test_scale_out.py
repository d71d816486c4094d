"""What docs/scale-out.md shows to be copied: options that exist, a script that is one, manifests that fit together."""

from __future__ import annotations

import ast
import re
import subprocess
from pathlib import Path

import pytest
import yaml

PAGE = Path(__file__).parents[2] / "docs" / "scale-out.md"


def blocks(language: str) -> list[str]:
    found = re.findall(r"^```(\w*)\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    return [text for of, text in found if of == language]


def manifests(kind: str) -> dict[str, dict]:
    found = [each for block in blocks("yaml") for each in yaml.safe_load_all(block)]
    return {each["metadata"]["name"]: each for each in found if each["kind"] == kind}


def container(deployment: dict) -> dict:
    (one,) = deployment["spec"]["template"]["spec"]["containers"]
    return one


def commands() -> list[list[str]]:
    """Every call of Dask's commands on the page, as words, in scripts and in manifests."""
    shown = "\n".join([*blocks("bash"), *blocks("")]).replace("\\\n", " ")
    told = [line.partition("#")[0].split() for line in re.findall(r"(?m)\bdask (?:scheduler|worker)\b.*$", shown)]
    args = [container(each)["args"] for each in manifests("Deployment").values()]
    cluster = manifests("DaskCluster")["rgss"]["spec"]
    operator = [cluster[role]["spec"]["containers"][0]["args"] for role in ("scheduler", "worker")]
    return [*told, *args, *operator]


def test_dask_knows_every_option_that_the_page_gives_it():
    from distributed.cli.dask_scheduler import main as scheduler
    from distributed.cli.dask_worker import main as worker

    known = {
        name: {option for parameter in command.params for option in (*parameter.opts, *parameter.secondary_opts)}
        for name, command in (("scheduler", scheduler), ("worker", worker))
    }
    given = [(words[1], word) for words in commands() for word in words if word.startswith("--")]

    assert len(commands()) == 10
    assert {name for name, _ in given} == {"scheduler", "worker"}
    assert [(name, word) for name, word in given if word not in known[name]] == []


@pytest.mark.parametrize("number", range(3))
def test_the_shell_reads_each_script(number):
    assert len(blocks("bash")) == 3
    done = subprocess.run(["bash", "-n"], input=blocks("bash")[number], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


def test_dask_knows_every_setting_that_the_page_makes():
    import dask
    import distributed  # noqa: F401 - brings its settings along

    named = re.findall(r"(?m)\bexport (DASK_DISTRIBUTED__\w+)=", "\n".join(blocks("bash")))
    assert len(named) == 5
    for name in named:
        assert dask.config.get(name.removeprefix("DASK_").lower().replace("__", "."), "none") != "none", name


def test_jobs_of_slurm_that_share_a_node_do_not_share_a_scheduler():
    script = blocks("bash")[0]
    told = set()
    for job in ("7", "8"):
        lines = [line for line in script.splitlines() if line.startswith(("PORT=", "ADDRESS="))]
        told.add(
            subprocess.run(
                ["bash", "-c", "\n".join([*lines, 'echo "$PORT ${ADDRESS##*:}"'])],
                env={"SLURM_JOB_ID": job, "PATH": "/usr/bin:/bin"},
                capture_output=True,
                text=True,
                check=True,
            ).stdout
        )

    assert told == {"20007 20007\n", "20008 20008\n"}


def test_the_python_on_the_page_is_python():
    (program,) = blocks("python")
    assert ast.parse(program)


def test_the_manifests_fit_together():
    deployments, services = manifests("Deployment"), manifests("Service")
    labels = {name: each["spec"]["template"]["metadata"]["labels"] for name, each in deployments.items()}
    service = services["rgss-scheduler"]["spec"]
    scheduler, worker = (container(deployments[name])["args"] for name in ("rgss-scheduler", "rgss-worker"))
    (port,) = service["ports"]

    for name, each in deployments.items():
        assert each["spec"]["selector"]["matchLabels"] == labels[name]
    assert service["selector"] == labels["rgss-scheduler"]
    assert scheduler[scheduler.index("--port") + 1] == str(port["targetPort"])
    assert worker[2] == f"tcp://rgss-scheduler:{port['port']}"
    assert f"rgss sweep --dask {worker[2]}" in PAGE.read_text(encoding="utf-8")
    assert {container(each)["image"] for each in deployments.values()} == {"registry.example/rgss:1"}


def test_the_network_policy_lets_the_workers_and_the_command_speak_to_the_scheduler():
    policy = manifests("NetworkPolicy")["rgss-scheduler"]["spec"]
    labels = {name: each["spec"]["template"]["metadata"]["labels"] for name, each in manifests("Deployment").items()}
    (rule,) = policy["ingress"]
    let_in = [each["podSelector"]["matchLabels"] for each in rule["from"]]

    assert policy["podSelector"]["matchLabels"] == labels["rgss-scheduler"]
    assert let_in == [labels["rgss-worker"], {"app": "rgss-sweep"}]
    assert "labelled `app: rgss-sweep`" in PAGE.read_text(encoding="utf-8")


def test_each_thread_of_a_worker_has_the_memory_that_the_page_says():
    """2 GB for each thread and 0.2 GB for the Dask worker, in GiB as Kubernetes counts."""
    cluster = manifests("DaskCluster")["rgss"]["spec"]["worker"]["spec"]["containers"][0]
    for each in (container(manifests("Deployment")["rgss-worker"]), cluster):
        threads = int(each["args"][each["args"].index("--nthreads") + 1])
        memory = int(each["resources"]["limits"]["memory"].removesuffix("Gi"))
        assert memory >= 0.2 + 2.0 * threads
        assert each["resources"]["limits"] == each["resources"]["requests"]
