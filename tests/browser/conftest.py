"""A report of made evidence in headless Chromium, driven as a reader would."""

from __future__ import annotations

import importlib.util
import json
import os
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from selenium import webdriver

from rgss.assessment.evidence_status import evidence_state
from rgss.assessment.measuring import measure_variants
from rgss.decision.study_decision import decide_study
from rgss.decision.tracing import trace_evidence
from rgss.evidence import (
    EvidenceStore,
    Failure,
    PhaseOutcome,
    PhaseRecord,
    PlanningRecord,
    PlanOutcome,
    TrialRecord,
)
from rgss.reports.replay.packing import packed_replay
from rgss.reports.study.document import report_document
from rgss.reports.study_page import TrialPictures, study_report_to_html
from rgss.reports.trace.report import trace_report
from rgss.reports.trials import CaptionedPicture, write_video
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.trace.model.model import build_trace_model
from rgss.trials.metrics import METRICS
from tests.fixtures import made_replay
from tests.fixtures.eight_states import PLANNED_PHASES, Phase
from tests.fixtures.processes import PATIENCE_S
from tests.fixtures.shipped_project import copy_project
from tests.fixtures.stored_trials import put_trials

REPOSITORY = Path(__file__).parents[2]
PIXEL = bytes.fromhex(
    "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c4890000000d49444154789c6360f8ffff3f0005fe02fe"
    "a735818400000000049454e44ae426082"[:-1]
)


@dataclass(frozen=True, kw_only=True)
class Study:
    """A study with evidence: its document, its traceability, and its folder."""

    document: dict[str, Any]
    trace: Any
    folder: Path


def made_record(spec) -> TrialRecord:
    """A trial that was never run: STRIDE fails at the first move, some of TRRT drop the object."""
    dropped = spec.planner == "TRRT" and spec.variant % 7 == 0 and spec.seed == 2
    failure = Failure.PLANNING_LIMIT if spec.planner == "STRIDE" else Failure.OBJECT_DROPPED if dropped else None
    ended = {None: 8, Failure.PLANNING_LIMIT: 0, Failure.OBJECT_DROPPED: 2}[failure]
    time_s = (0.3 if spec.planner == "RRT" else 0.2) + 0.002 * spec.variant + 0.001 * spec.seed
    planned = sum(list(Phase).index(phase) < max(1, ended) for phase in PLANNED_PHASES) if ended else 0
    success = failure is None
    metrics = dict.fromkeys(METRICS) | {
        "success": int(success),
        "phases_completed": ended,
        "phases_total": 8,
        "planning_time_s": (time_s,) * planned + (None,) * (5 - planned),
        "path_length_m": (0.6,) * planned + (None,) * (5 - planned),
        "motion_time_s": 9.0 + 0.1 * spec.seed,
        "grasp_cycle_time_s": 1.9 if success else None,
        "task_time_s": 9.0 + 0.1 * spec.seed + 5 * time_s if success else None,
    }

    def outcome(place: int) -> PhaseOutcome:
        if place < ended:
            return PhaseOutcome.COMPLETED
        return PhaseOutcome.FAILED if place == ended and not success else PhaseOutcome.NOT_RUN

    return TrialRecord(
        variant=spec.variant,
        seed=spec.seed,
        fidelity=spec.fidelity,
        success=success,
        failure=failure,
        failed_phase=None if success else list(Phase)[ended],
        failure_detail="" if success else "no path",
        phases=tuple(
            PhaseRecord(
                phase=phase,
                outcome=outcome(place),
                duration_s=1.0 + 0.1 * place if place <= ended else None,
                metrics={},
            )
            for place, phase in enumerate(Phase)
        ),
        planning=tuple(
            PlanningRecord(
                subtask=phase,
                outcome=PlanOutcome.SOLVED
                if place < planned
                else PlanOutcome.BUDGET_SPENT
                if place == planned and failure is Failure.PLANNING_LIMIT
                else PlanOutcome.NOT_RUN,
                checks=100 + spec.variant,
                simplification_checks=0,
                time_s=time_s if place < planned else None,
                path_length_m=0.6 if place < planned else None,
            )
            for place, phase in enumerate(PLANNED_PHASES)
        ),
        metrics=metrics,
    )


def made_study(folder: Path) -> Study:
    """The study of a project with a made record for each of its trials."""
    project = load_project(folder)
    with EvidenceStore.open(project.evidence) as store:
        put_trials(store, trial_specs(project), made_record)
        measured = measure_variants(project, store)
        made = decide_study(project, measured, evidence="evidence.sqlite")
        document = report_document(project, measured, made, store)
    trace = trace_report(
        build_trace_model(project.requirements, project.measure_traces),
        trace_evidence(project, measured, evidence_state(project, measured)),
        title="Traceability",
        definitions=project.measures,
    )
    return Study(document=document, trace=trace, folder=folder)


@pytest.fixture(scope="session")
def study(tmp_path_factory) -> Study:
    """The shipped study with a made record for each of its trials."""
    return made_study(copy_project(tmp_path_factory.mktemp("report") / "project"))


@pytest.fixture(scope="session")
def lone_study(tmp_path_factory) -> Study:
    """The shipped study with rules that leave one variant."""
    folder = copy_project(tmp_path_factory.mktemp("lone") / "project")
    others = ["gripper_mass: light", "fingers: two", "velocity: slow"]
    others += ["planner: rrt", "planner: stride", "planning_time: short", "planning_time: medium"]
    with (folder / "designs" / "grasping_system.yaml").open("a", encoding="utf-8") as file:
        for place, level in enumerate(others):
            file.write(f"\n  - {{id: leave-{place}, rationale: One is enough., exclude: {{{level}}}}}\n")
    return made_study(folder)


@pytest.fixture(scope="session")
def pictures(tmp_path_factory) -> tuple[TrialPictures, ...]:
    """A filmstrip of one pixel, a film of four seconds that goes from black to white, and a replay."""
    film = tmp_path_factory.mktemp("film") / "film.webm"
    write_video(
        film,
        lambda index: CaptionedPicture(picture=np.full((150, 200, 3), 8 * index, dtype=np.uint8), caption=""),
        count=32,
        rate_hz=8.0,
    )
    player = packed_replay(
        made_replay.made_record(), made_replay.made_trace(), made_replay.made_scene(), joints=made_replay.JOINTS
    )
    return (
        TrialPictures(
            title="Variant 28",
            note="It succeeded.",
            replay="rgss replay 0",
            filmstrip=PIXEL,
            film=film.read_bytes(),
            player=player,
        ),
    )


@pytest.fixture(scope="session")
def page(study, pictures, tmp_path_factory) -> Path:
    """The report as a file."""
    file = tmp_path_factory.mktemp("page") / "report.html"
    file.write_text(study_report_to_html(study.document, study.trace, pictures=pictures), encoding="utf-8")
    return file


@pytest.fixture(scope="session")
def large_page(study, tmp_path_factory) -> Path:
    """The report of 10,000 variants as a file."""
    path = REPOSITORY / "benchmarks" / "report_page.py"
    spec = importlib.util.spec_from_file_location("report_page_benchmark", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    file = tmp_path_factory.mktemp("large") / "report.html"
    file.write_text(
        study_report_to_html(module.enlarged(study.document, module.VARIANTS), study.trace), encoding="utf-8"
    )
    return file


SHOWN_PLOTS = "Array.from(document.querySelectorAll('.plot')).filter((one) => !one.closest('[hidden]'))"


class Reader:
    """A browser with a page open."""

    def __init__(self, driver: webdriver.Chrome) -> None:
        self.driver = driver

    def open(self, page: Path, *, width: int = 1400) -> None:
        """Open a page and wait until its script is done."""
        self.driver.execute_cdp_cmd(
            "Emulation.setDeviceMetricsOverride",
            {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600},
        )
        self.driver.get_log("browser")
        self.driver.get_log("performance")
        self.driver.get(page.as_uri())
        self.until("return document.documentElement.dataset.ready === 'yes'")

    def script(self, text: str, *arguments: Any) -> Any:
        """Run a script in the page."""
        return self.driver.execute_script(text, *arguments)

    def until(self, text: str, *arguments: Any) -> None:
        """Wait until a script says true."""
        from selenium.webdriver.support.wait import WebDriverWait

        WebDriverWait(self.driver, PATIENCE_S, poll_frequency=0.05).until(lambda _: self.script(text, *arguments))

    def see_all_plots(self) -> None:
        """Scroll through the page until every plot is drawn or says that there is nothing to draw."""
        count = self.script(f"return {SHOWN_PLOTS}.length")
        for place in range(count):
            self.script(f"{SHOWN_PLOTS}[arguments[0]].scrollIntoView()", place)
            self.until(f"return {SHOWN_PLOTS}[arguments[0]].children.length > 0", place)
        self.until(f"return {SHOWN_PLOTS}.every((one) => one.querySelector('.main-svg, p') !== null)")

    def text(self, selector: str) -> str:
        """The text of an element."""
        return self.script("return document.querySelector(arguments[0]).textContent", selector)

    def rows(self, selector: str) -> list[list[str]]:
        """The cells of the rows of a table."""
        return self.script(
            "return Array.from(document.querySelectorAll(arguments[0] + ' tbody tr'))"
            ".map((row) => Array.from(row.cells).map((cell) => cell.textContent.trim()))",
            selector,
        )

    def complaints(self) -> list[str]:
        """What the console has to say."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self) -> list[str]:
        """What the page asked for beyond itself and what it carries."""
        messages = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        asked = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
        return [url for url in asked if not url.startswith(("data:", "blob:")) and not url.endswith("/report.html")]

    def accessibility_findings(self, *, without: tuple[str, ...] = ()) -> list[str]:
        """What axe-core finds that is serious or critical, in all elements but those of some selectors.

        An audit takes as long for each row of a table: of rows that are alike it sees a few, and the page loses the
        others. What their ids alone say is looked at before.
        """
        repeated = self.script(IDS_OF_SEVERAL)
        self.script(KEEP_FOUR_ROWS_OF_A_KIND)
        axe = resources.files("axe_core_python").joinpath("axe.min.js").read_text(encoding="utf-8")
        self.script(axe)
        found = self.driver.execute_async_script(
            "const [without, done] = arguments;"
            "axe.run({include: [['html']], exclude: without.map((one) => [one])}, {resultTypes: ['violations']})"
            ".then((result) => done(result.violations.map((one) =>"
            " [one.impact, one.id, one.nodes.length, one.nodes[0].html.slice(0, 160)])))",
            list(without),
        )
        return [*repeated, *(str(one) for one in found if one[0] in ("serious", "critical"))]


IDS_OF_SEVERAL = """
const ids = Array.from(document.querySelectorAll('[id]'), (one) => one.id);
return Array.from(new Set(ids.filter((id, place) => ids.indexOf(id) !== place)), (id) => `id of several: ${id}`);
"""

KEEP_FOUR_ROWS_OF_A_KIND = """
// Elements are alike with the same kinds of elements in them, whatever their texts say.
const kind = (one) => {
  const names = one.getAttributeNames().filter((name) => name !== 'class' && name !== 'id').sort();
  const within = one.children.length ? new Set(Array.from(one.children, kind)) : [one.textContent.trim() !== ''];
  return `<${one.tagName} ${one.getAttribute('class')} ${names} ${one.getAttribute('style')}>${[...within].sort()}`;
};
for (const table of document.querySelectorAll('tbody')) {
  const seen = new Map();
  for (const row of Array.from(table.rows)) {
    const count = (seen.get(kind(row)) ?? 0) + 1;
    seen.set(kind(row), count);
    if (count > 4) row.remove();
  }
}
"""


WEBGL = "--enable-unsafe-swiftshader"
"""Draws in three dimensions by software; the pages are ours, so that it is safe."""

CHROMIUM = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
WITHOUT_BROWSER = (
    "needs Chromium and its driver, on Debian: apt-get install chromium chromium-driver, "
    "on Ubuntu: apt-get install chromium-browser chromium-chromedriver"
)


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip where there is no browser, before evidence is made for it; on a build machine that is a failure."""
    if item.get_closest_marker("browser") is None or (_found(*CHROMIUM) and _found("chromedriver")):
        return
    if os.environ.get("CI"):
        pytest.fail(WITHOUT_BROWSER, pytrace=False)
    pytest.skip(WITHOUT_BROWSER)


def _found(*names: str) -> str | None:
    """The path of the first of some programs that is installed."""
    return next(filter(None, map(shutil.which, names)), None)


@pytest.fixture(scope="session")
def browser() -> Iterator[webdriver.Chrome]:
    """Headless Chromium."""
    options = webdriver.ChromeOptions()
    options.binary_location = str(_found(*CHROMIUM))
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-background-networking", WEBGL):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    service = webdriver.ChromeService(_found("chromedriver"))
    driver = webdriver.Chrome(options=options, service=service)
    # On a busy machine an audit takes minutes; the client gives up after two by itself.
    driver.command_executor.client_config.timeout = 900
    driver.set_script_timeout(900)
    yield driver
    driver.quit()


@pytest.fixture
def reader(browser) -> Iterator[Reader]:
    """A reader with the browser; no page stays open, since one that moves takes a third of a processor."""
    yield Reader(browser)
    browser.get("about:blank")


@pytest.fixture
def searcher(browser, page) -> Reader:
    """A reader with the report open, where nothing was done but to search: tests that only search need no other.

    The report takes a second to open, and stays as the last such test left it.
    """
    reader = Reader(browser)
    if browser.current_url != page.as_uri() or not reader.script("return window.isForSearches === true"):
        reader.open(page)
        reader.script("window.isForSearches = true")
    reader.script(
        "for (const field of document.querySelectorAll('#find, #verdict-table input')) {"
        " field.value = ''; field.dispatchEvent(new Event('input', {bubbles: true})); }"
        "document.activeElement.blur(); scrollTo(0, 0);"
    )
    return reader
