"""Measure the report's page: its size, and how long a browser takes to open it.

Run it from the repository's folder: ``python benchmarks/report_page.py [FOLDER]``, after ``rgss sweep``
in the project of that folder (this one by default). It needs Chromium, its driver and selenium. A
study of 10,000 variants is made of the project's own by repeating its variants with other figures.
Seconds of the clock depend on what else the machine does; the best of three counts.
"""

from __future__ import annotations

import json
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

VARIANTS = 10_000
REPEATS = 3


def enlarged(document: dict[str, Any], count: int, *, seed: int = 1) -> dict[str, Any]:
    """A report's document with so many variants, which repeat those there with other figures.

    Estimates, worths and values are moved by up to 5 %, each by itself, so that no two columns are
    alike; every variant keeps its verdicts, its place and as many trials as it had.

    Args:
        document: The document of a study.
        count: How many variants it shall have.
        seed: Of the random moves.
    """
    generator = random.Random(seed)  # noqa: S311 - figures to measure with, no secret
    large = json.loads(json.dumps(document))
    before = len(large["variants"]["id"])
    places = [place % before for place in range(count)]

    def moved(value: Any) -> Any:
        if not isinstance(value, (int, float)):
            return value
        return float(f"{value * generator.uniform(0.95, 1.05):.{max(5, len(repr(value)) - 2)}g}")

    def column(owner: dict[str, Any], *names: str, move: bool = False) -> None:
        for name in names:
            if isinstance(owner.get(name), list):
                owner[name] = [moved(owner[name][place]) if move else owner[name][place] for place in places]

    variants = large["variants"]
    column(variants, "feasible", "pareto", "violates", "trials", "succeeded")
    column(variants, "value", move=True)
    variants["id"] = list(range(1, count + 1))
    # A front of as many points as a real one may have: of each variant that was on it, one in ten.
    variants["pareto"] = [one if place < 10 * before else None for place, one in enumerate(variants["pareto"])]
    feasible = [place for place in range(count) if variants["feasible"][place]]
    order = sorted(feasible, key=lambda place: (-(variants["value"][place] or 0.0), place))
    ranks = {place: rank for rank, place in enumerate(order, start=1)}
    variants["rank"] = [ranks.get(place) for place in range(count)]
    for parameter in large["parameters"]:
        column(parameter, "values", move=True)
    for named in large["filters"]:
        column(named, "entries")
    for measure in large["measures"]:
        column(measure, "value", "low", "high", move=True)
        column(measure, "n")
    for requirement in large["requirements"]:
        column(requirement, "verdict")
    for weighted in large["weights"]["measures"]:
        column(weighted, "worth", move=True)
    for factor in large["factors"]:
        column(factor, "level")
    _repeat_trials(large["trials"], places, generator)
    return large


def _repeat_trials(trials: dict[str, Any], places: list[int], generator: random.Random) -> None:
    """Give each new variant the trials of the one that it repeats."""
    of_place: dict[int, list[int]] = {}
    for trial, place in enumerate(trials["variant"]):
        of_place.setdefault(place, []).append(trial)
    rows = [(new, old) for new, place in enumerate(places) for old in of_place.get(place, [])]
    for name in ("seed", "failure", "failed_phase"):
        if isinstance(trials[name], list):
            trials[name] = [trials[name][old] for _, old in rows]
    trials["variant"] = [new for new, _ in rows]
    trials["key"] = [f"{generator.getrandbits(48):012x}" for _ in rows]
    trials["timelines"] = {str(one["trial"]): trials["timelines"][str(one["trial"])] for one in trials["notable"]}
    trials["every_timeline"] = False


def opening_times(page: Path) -> tuple[float, float, float, float]:
    """Open a page.

    Returns:
        Seconds to the first paint, to where its own script is done, to the end of loading, and seconds
        of the processor that the page's main thread took until then.
    """
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    options.binary_location = str(shutil.which("chromium"))
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu"):
        options.add_argument(argument)
    service = webdriver.ChromeService(str(shutil.which("chromedriver")))
    driver = webdriver.Chrome(options=options, service=service)
    try:
        driver.set_window_size(1400, 900)
        driver.execute_cdp_cmd("Performance.enable", {"timeDomain": "threadTicks"})
        driver.get(page.as_uri())
        metrics = driver.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]
        processor = next(float(one["value"]) for one in metrics if one["name"] == "TaskDuration")
        script = (
            "const page = performance.getEntriesByType('navigation')[0];"
            "return [performance.getEntriesByType('paint')[0].startTime,"
            " performance.getEntriesByName('rgss-report')[0].startTime, page.loadEventEnd]"
        )
        first, own, loaded = (float(value) / 1000.0 for value in driver.execute_script(script))
        return first, own, loaded, processor
    finally:
        driver.quit()


def main() -> None:
    """Write a table in Markdown."""
    out = sys.stdout
    from rgss.assessment.evidence_status import evidence_state
    from rgss.assessment.measuring import measure_variants
    from rgss.decision.tracing import trace_evidence
    from rgss.reports.study_page import study_report_to_html
    from rgss.reports.trace.report import trace_report
    from rgss.studies.project import load_project
    from rgss.trace.model.model import build_trace_model

    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    command = [sys.executable, "-m", "rgss.cli.main", "report", "--no-film", "--no-planners", "--json"]
    command += ["--project", str(folder)]
    with tempfile.TemporaryDirectory() as place:
        small = Path(place) / "small.html"
        words = [*command, "--out", str(small), *sys.argv[2:]]
        done = subprocess.run(words, capture_output=True, check=True, text=True)  # noqa: S603
        document = json.loads(done.stdout)["report"]
        project = load_project(folder)
        measured = measure_variants(project, None)
        trace = trace_report(
            build_trace_model(project.requirements, project.measure_traces),
            trace_evidence(project, measured, evidence_state(project, measured)),
            title="Traceability",
            definitions=project.measures,
        )
        large = Path(place) / "large.html"
        large.write_text(study_report_to_html(enlarged(document, VARIANTS), trace), encoding="utf-8")
        out.write("| variants | size | first paint | own script done | loaded | processor |\n")
        out.write("|---|---|---|---|---|---|\n")
        for page, count in ((small, len(document["variants"]["id"])), (large, VARIANTS)):
            times = [opening_times(page) for _ in range(REPEATS)]
            first, own, loaded, processor = min(times, key=lambda found: max(found[:3]))
            size = page.stat().st_size / 1e6
            out.write(
                f"| {count:,} | {size:.1f} MB | {first:.2f} s | {own:.2f} s | {loaded:.2f} s | {processor:.2f} s |\n"
            )


if __name__ == "__main__":
    main()
