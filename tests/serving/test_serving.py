"""The page of a running sweep: its routes, its states, and the process from start to end."""

from __future__ import annotations

import json
import re
import signal
import socket
import subprocess
import sys
import urllib.request
from datetime import date

import pytest
from starlette.testclient import TestClient

from rgss.assessment import record_verdicts
from rgss.errors import DefinitionError
from rgss.evidence import EvidenceStore, Provenance
from rgss.evidence.store import observed
from rgss.reports.live import live_page_to_html
from rgss.requirements import RecordedResult
from rgss.serving import StudyObserver, TrialReplays, listen, require_server, study_application
from rgss.serving.pace import Pace
from rgss.serving.replays import MOST_KEPT
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.sweep.trial_keys import key_of
from rgss.trace.evidence import JUNIT_FILE, new_record, with_record, write_records


@pytest.fixture
def project(folder):
    return load_project(folder).with_replicates(2)


@pytest.fixture
def observer(project):
    return StudyObserver(
        project.folder,
        lambda: load_project(project.folder).with_replicates(2),
        evidence=project.evidence,
        label="the evidence",
    )


@pytest.fixture
def replays(observer):
    return TrialReplays(observer.project)


@pytest.fixture
def client(observer, project, replays):
    page = live_page_to_html(project.study.id)
    return TestClient(study_application(observer, page, replays), base_url="http://127.0.0.1")


@pytest.fixture
def sweep(project, record_of):
    """Puts the trials of some variants into the store, as a sweep does that is held there."""

    def put(variants, *, success=True):
        specs = [spec for spec in trial_specs(project) if spec.variant in variants]
        with EvidenceStore.open(project.evidence) as store:
            none = Provenance(inputs={}, versions={})
            store.put_many(trials=[(key_of(spec), record_of(spec, success=success), none) for spec in specs])

    return put


def test_a_study_without_evidence(observer):
    observer.look()
    assert observer.state()["problem"] == "There is no evidence in the evidence yet; 'rgss sweep' makes it."
    assert observer.state()["study"] is None


def test_a_sweep_that_is_held_part_way(observer, sweep, project):
    sweep({1, 2, 3})
    sweep({4}, success=False)
    before = {each.name: each.read_bytes() for each in project.evidence.parent.iterdir()}
    observer.look()
    found = observer.state()["study"]
    count = len(project.designs.expand())
    assert found["progress"]["sentence"] == f"8 of {2 * count} trials have evidence; in 2 of them the task failed."
    assert found["decision"]["standing"] == f"Not final. As of 8 trials, decided among 4 of {count} variants."
    assert not found["decision"]["is_complete"]
    by_id = {one["id"]: (one["done"], one["failed"], one["missing"]) for one in found["variants"]}
    assert [by_id[variant] for variant in (1, 4, 5)] == [(2, 0, 0), (2, 2, 0), (0, 0, 2)]
    assert sorted({one["trial"].split("/")[0] for one in found["failures"]}) == ["4"]
    assert {each.name: each.read_bytes() for each in project.evidence.parent.iterdir()} == before


def test_a_sweep_that_is_done(observer, sweep, project):
    count = len(project.designs.expand())
    sweep({variant.id for variant in project.designs.expand()})
    observer.look()
    decision = observer.state()["study"]["decision"]
    assert decision["is_complete"]
    assert decision["standing"].startswith(
        f"As of {2 * count} trials, decided among {count} of {count} variants. Every"
    )


def test_only_a_change_is_read_again(observer, sweep):
    sweep({1})
    observer.look()
    version = observer.state()["version"]
    observer.look()
    assert observer.state()["version"] == version
    assert "study" not in observer.state(seen=version)
    sweep({2})
    observer.look()
    assert observer.state(seen=version)["study"]["progress"]["done"] == 4


def test_evidence_that_is_damaged_and_removed(observer, sweep, project):
    sweep({1})
    observer.look()
    project.evidence.write_bytes(b"not a database" * 100)
    observer.look()
    assert "the evidence" in observer.state()["problem"]
    assert observer.state()["study"] is None
    project.evidence.unlink()
    observer.look()
    assert observer.state()["problem"].startswith("There is no evidence")


def test_a_mistake_in_the_project_is_shown_until_it_is_mended(observer, sweep, project):
    sweep({1})
    observer.look()
    path = project.folder / "studies" / "pick_place.yaml"
    text = path.read_text(encoding="utf-8")
    path.write_text(f"{text}\nno_such_key: 1\n", encoding="utf-8")
    observer.look()
    assert "no_such_key" in observer.state()["problem"]
    path.write_text(text, encoding="utf-8")
    observer.look()
    assert observer.state()["problem"] == ""
    assert observer.state()["study"]["progress"]["done"] == 2


def test_a_page_of_an_earlier_server_gets_the_study_again(observer, sweep, project):
    sweep({1})
    observer.look()
    later = StudyObserver(project.folder, lambda: project, evidence=project.evidence, label="the evidence")
    later.look()
    assert later.state(seen=observer.state()["version"])["study"] == later.state()["study"] is not None


def test_verdicts_that_are_recorded_after_the_last_trial_are_read(observer, sweep, project):
    sweep({1})
    observer.look()
    before = observer.state()["version"]
    observed(project.evidence, lambda store: record_verdicts(project, store), label="the evidence")
    observer.look()
    assert observer.state()["version"] != before


def test_a_mark_and_a_file_of_a_record_are_read(observer, sweep, project):
    sweep({1})
    protocol = project.folder / "protocol.md"
    protocol.write_text("The cable was inspected.", encoding="utf-8")
    found = {"result": RecordedResult.MET, "by": "Reader", "on": "2026-05-12", "today": date(2026, 5, 12)}
    record = new_record(project.folder, **found, files=[str(protocol)])
    write_records(project.folder / "requirements", with_record(project.requirements, ["SYS-001"], record))
    junit = project.folder / JUNIT_FILE
    junit.parent.mkdir(exist_ok=True)
    junit.write_text("<testsuites/>", encoding="utf-8")
    observer.look()

    def is_read_again() -> bool:
        before = observer.state()["version"]
        observer.look()
        return observer.state()["version"] != before

    assert not is_read_again()
    tests = project.folder / "tests" / "test_cable.py"
    tests.parent.mkdir(exist_ok=True)
    tests.write_text("import pytest\n", encoding="utf-8")
    assert is_read_again()
    assert not is_read_again()
    protocol.write_text("The cable was inspected again.", encoding="utf-8")
    assert is_read_again()
    assert not is_read_again()


def test_an_unforeseen_error_is_shown_and_the_next_change_is_read(observer, sweep, monkeypatch):
    sweep({1})

    def break_off(*_, **__):
        raise KeyError("P_max")

    with monkeypatch.context() as broken:
        broken.setattr("rgss.serving.observer.live_study_document", break_off)
        observer.look()
    assert observer.state()["problem"] == "The study cannot be shown: KeyError: 'P_max'"
    assert observer.state()["study"] is None
    sweep({2})
    observer.look()
    assert observer.state()["problem"] == ""
    assert observer.state()["study"]["progress"]["done"] == 4


def test_routes(client):
    page = client.get("/")
    policy = page.headers["content-security-policy"]
    assert page.status_code == client.head("/").status_code == 200
    assert "default-src 'none'" in policy
    assert "connect-src 'self'" in policy
    assert len(re.findall("'sha256-", policy)) == page.text.count("<script>") == 2
    assert not re.search(r"(src|href)=.?https?:", page.text)
    version = client.get("/state.json?seen=x").json()["version"]
    assert "study" in client.get("/state.json?seen=x").json()
    assert "study" not in client.get(f"/state.json?seen={version}").json()


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "PATCH"])
def test_only_reading_is_answered(client, method):
    assert client.request(method, "/").status_code == 405
    assert client.request(method, "/state.json").status_code == 405


@pytest.mark.parametrize(
    "path", ["/../pyproject.toml", "/%2e%2e/pyproject.toml", "/studies/pick_place.yaml", "//etc/passwd"]
)
def test_no_file_is_served(client, path):
    assert client.get(path).status_code == 404


@pytest.mark.parametrize("host", ["attacker.example", "127.0.0.1.attacker.example", ""])
def test_another_name_of_the_host_is_refused(client, host):
    assert client.get("/state.json", headers={"host": host}).status_code == 400


def test_a_missing_package(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(DefinitionError) as caught:
        require_server()
    assert str(caught.value) == (
        "rgss serve needs starlette and uvicorn, which is not installed (pip install 'rgss[serve]')"
    )


def test_a_port_that_cannot_be():
    with pytest.raises(DefinitionError) as caught:
        listen(70000)
    assert str(caught.value) == "--port must be from 0 to 65535, got 70000 (0 takes any free port)"


def command(folder, *words):
    return [sys.executable, "-m", "rgss", "serve", "--project", str(folder), *words]


def test_a_port_in_use(folder):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        done = subprocess.run(command(folder, "--port", str(port)), capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        f"rgss: port {port} of 127.0.0.1 cannot be used: Address already in use (--port 0 takes any free port)\n"
    )


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGTERM])
def test_a_process_from_start_to_end(folder, end):
    with subprocess.Popen(
        command(folder, "--port", "0"), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        try:
            address = process.stdout.readline().strip()
            assert re.fullmatch(r"http://127\.0\.0\.1:\d+/", address)
            with urllib.request.urlopen(f"{address}state.json") as answer:  # noqa: S310 - the loopback
                assert {"version", "problem", "sentence"} <= json.load(answer).keys()
            process.send_signal(end)
            output, errors = process.communicate()
        finally:
            process.kill()
    assert (process.returncode, output, errors) == (0, "", "")
    assert not (folder / ".rgss").exists()


def test_a_replay_is_made_once_and_shown(client, observer, project, sweep, monkeypatch):
    sweep({4}, success=False)
    observer.look()
    made = []

    def page_of(of, variant, seed):
        made.append((variant, seed))
        return f"<p>{of.study.id} {variant}/{seed}</p>"

    monkeypatch.setattr("rgss.serving.replays.replay_page", page_of)
    first, again = client.get("/replay/4/1"), client.get("/replay/4/1")
    assert first.text == again.text == f"<p>{project.study.id} 4/1</p>"
    assert made == [(4, 1)]
    assert "frame-ancestors 'none'" in first.headers["content-security-policy"]
    for seed in range(2, 2 + MOST_KEPT):
        client.get(f"/replay/4/{seed}")
    client.get("/replay/4/1")
    assert made.count((4, 1)) == 2


def test_only_the_own_page_opens_a_replay(client, monkeypatch):
    monkeypatch.setattr("rgss.serving.replays.replay_page", lambda *_: "<p>made</p>")
    for site, status in (("cross-site", 403), ("same-site", 403), ("same-origin", 200), ("none", 200)):
        assert client.get("/replay/4/1", headers={"sec-fetch-site": site}).status_code == status


@pytest.mark.parametrize(
    ("trial", "said"),
    [
        ("999/1", "999"),
        ("4/2147483648", "seed must be from 0 to 2147483647, got 2147483648"),
    ],
)
def test_a_trial_that_is_not_there_has_no_replay(client, trial, said):
    answer = client.get(f"/replay/{trial}")
    assert answer.status_code == 404
    assert said in answer.text


def test_a_replay_that_cannot_be_made_says_why(client, monkeypatch):
    def fail(*_):
        raise ValueError("the mesh has no faces")

    monkeypatch.setattr("rgss.serving.replays.replay_page", fail)
    answer = client.get("/replay/4/1")
    assert (answer.status_code, answer.text) == (
        500,
        "The replay cannot be made: ValueError: the mesh has no faces\n",
    )
    assert answer.headers["content-type"].startswith("text/plain")


def test_a_trial_is_run_again_for_its_replay(client, project):
    before = sorted(project.folder.rglob("*"))
    answer = client.get("/replay/1/1")
    assert answer.status_code == 200
    assert "Replay: Variant 1, seed 1" in answer.text
    assert sorted(project.folder.rglob("*")) == before


def test_the_time_that_is_left():
    pace = Pace()
    assert pace.left(0.0, 0, 100) == ""
    assert pace.left(5.0, 10, 100) == ""
    assert pace.left(60.0, 10, 100) == "At this pace about 9 minutes are left."
    assert pace.left(400.0, 40, 100) == "At this pace about 11 minutes are left."
    assert pace.left(405.0, 99, 100) == "At this pace less than a minute is left."
    assert pace.left(410.0, 100, 100) == ""
    assert pace.left(411.0, 3, 100) == ""
