"""The page of `rgss serve` in a browser, as a reader sees it while a sweep runs."""

from __future__ import annotations

import threading

import pytest
import uvicorn
from selenium.webdriver.common.by import By

from rgss.evidence import EvidenceStore, Provenance
from rgss.reports.live import live_page_to_html
from rgss.serving import StudyObserver, TrialReplays, listen, study_application
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.sweep.trial_keys import key_of
from tests.fixtures.processes import wait_until

pytestmark = pytest.mark.browser


@pytest.fixture
def address(folder, record_of, monkeypatch):
    """The address of a server of a study of which four variants have evidence, one by failures alone."""
    monkeypatch.setattr("rgss.serving.replays.replay_page", lambda _, variant, seed: f"<p>Replay {variant}/{seed}</p>")
    monkeypatch.setattr("rgss.serving.observer.can_replay", lambda _: True)
    project = load_project(folder).with_replicates(2)
    none = Provenance(inputs={}, versions={})
    with EvidenceStore.open(project.evidence) as store:
        specs = [spec for spec in trial_specs(project) if spec.variant <= 4]
        store.put_many(
            trials=[(key_of(spec), record_of(spec, success=spec.variant != 4), none) for spec in specs], pieces=()
        )
    observer = StudyObserver(
        project.folder, lambda: load_project(folder).with_replicates(2), evidence=project.evidence, label="the evidence"
    )
    application = study_application(observer, live_page_to_html(project.study.id), TrialReplays(observer.project))
    server = uvicorn.Server(uvicorn.Config(application, lifespan="off", log_level="error", ws="none"))
    listening = listen(0)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]})
    observer.start()
    thread.start()
    yield f"http://127.0.0.1:{listening.getsockname()[1]}/"
    server.should_exit = True
    thread.join()
    listening.close()


def test_failures_lead_to_their_replays(reader, address):
    reader.driver.get(address)
    reader.until("return document.querySelectorAll('#failures a').length === 2")
    assert "8 of 144 trials have evidence; in 2 of them the task failed." in reader.text("#progress")
    assert [row[1:4] for row in reader.rows("[aria-labelledby=variants-title]")[:5]] == [
        ["2", "0", "0"],
        ["2", "0", "0"],
        ["2", "0", "0"],
        ["2", "2", "0"],
        ["0", "0", "2"],
    ]
    before = reader.driver.current_window_handle
    reader.driver.find_element(By.CSS_SELECTOR, "#failures a").click()
    wait_until(lambda: len(reader.driver.window_handles) == 2)
    (opened,) = set(reader.driver.window_handles) - {before}
    reader.driver.switch_to.window(opened)
    reader.until("return document.body.textContent === 'Replay 4/1'")
    assert reader.driver.current_url == f"{address}replay/4/1"
    reader.driver.close()
    reader.driver.switch_to.window(before)


@pytest.mark.parametrize("width", [390, 1440])
def test_it_has_no_serious_finding_and_asks_its_own_server_alone(reader, address, width):
    reader.driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600},
    )
    reader.complaints()
    reader.requests()
    reader.driver.get(address)
    reader.until("return document.querySelectorAll('#failures a').length === 2")
    assert reader.script("return document.documentElement.scrollWidth <= document.documentElement.clientWidth")
    assert reader.accessibility_findings() == []
    assert [message for message in reader.complaints() if "favicon" not in message] == []
    assert [url for url in reader.requests() if not url.startswith(address)] == []
