"""Measure how the work on requirements grows with their number; write a table in Markdown.

Run it from the repository's folder: ``python benchmarks/requirements_scale.py``. Each size is
measured in a process of its own, so that its memory is its own; times are processor times, which
other work on the machine disturbs least.
"""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from rgss.findings import Severity
from rgss.reports.table_files import to_csv
from rgss.reports.trace.files import tables_of
from rgss.reports.trace.formats import Selection, trace_format
from rgss.reports.trace.report import TraceReport, trace_report
from rgss.requirements import RequirementGroup, RequirementSet, load_requirements
from rgss.trace import MeasureKind, MeasureTrace, TraceModel, build_trace_model, check_trace
from rgss.trace.evidence.verdict_evidence import TraceEvidence
from rgss.trace.rules.review_stamps import stamped
from rgss.trace.views.chain import chain_of
from rgss.trace.views.impact import impact_of
from rgss.trace.views.metrics import trace_matrices

SIZES = (1_000, 2_000, 5_000, 10_000)
LINKS_EACH = 3
NEEDS_SHARE, BLOCKS_SHARE, BEHAVIOURS_SHARE = 20, 10, 10
CHAIN = 4
"""Of so many system requirements in a row, the first derives from a need and each other from the one before."""


def main() -> None:
    """Measure every size and write the table; with ``--one`` measure one size and write JSON."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, help="numbers of system requirements")
    parser.add_argument("--one", type=int, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one is not None:
        sys.stdout.write(json.dumps(measured(arguments.one)))
        return
    rows = [_in_own_process(size) for size in arguments.sizes]
    names = list(rows[0]["seconds"])
    out = sys.stdout
    out.write(f"| requirements | links | {' | '.join(f'{name} (s)' for name in names)} | memory (MB) |\n")
    out.write("|---" * (len(names) + 3) + "|\n")
    for row in rows:
        times = " | ".join(f"{row['seconds'][name]:.2f}" for name in names)
        out.write(f"| {row['requirements']} | {row['links']} | {times} | {row['memory_mb']:.0f} |\n")
    names = list(rows[0]["reports"])
    out.write(f"\n| requirements | {' | '.join(f'{name} (s, MB)' for name in names)} | memory (MB) |\n")
    out.write("|---" * (len(names) + 2) + "|\n")
    for row in rows:
        cells = " | ".join(f"{row['reports'][name][0]:.2f}, {row['reports'][name][1]:.1f}" for name in names)
        out.write(f"| {row['requirements']} | {cells} | {row['memory_with_reports_mb']:.0f} |\n")


def measured(size: int) -> dict[str, Any]:
    """Write a project of a size and time each stage of the work on it, in order.

    Args:
        size: Number of system requirements.
    """
    with tempfile.TemporaryDirectory() as folder:
        requirements_folder = write_project(Path(folder), size)
        begin = time.process_time()
        requirements = load_requirements(requirements_folder)
        seconds = {"load": time.process_time() - begin}
        for name, stage in STAGES.items():
            begin = time.process_time()
            stage(requirements)
            seconds[name] = time.process_time() - begin
        memory_mb = _peak_mb()
        report = trace_report(_model(requirements), TraceEvidence(), title="Scale")
        reports = {}
        for name, write in REPORTS.items():
            begin = time.process_time()
            written = write(report)
            reports[name] = (time.process_time() - begin, len(written) / 1e6)
    return {
        "requirements": len(requirements.system),
        "links": len(requirements.links),
        "seconds": seconds,
        "memory_mb": memory_mb,
        "reports": reports,
        "memory_with_reports_mb": _peak_mb(),
    }


def _peak_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def _digests(requirements: RequirementSet) -> None:
    for element in requirements.elements:
        requirements.content_digest(element.id)


def _check(requirements: RequirementSet) -> None:
    """Every rule, on a project that keeps all of them."""
    grave = [one for one in check_trace(requirements, [_measure(requirements)]) if one.severity is not Severity.INFO]
    if grave:
        raise ValueError(f"the project is not sound: {grave[0]}")


def _check_reviewed(requirements: RequirementSet) -> None:
    """Stamp a review of every requirement, and check again with all the links that can be suspect."""
    reviews = stamped(requirements, ["all"], "benchmark")
    _check(replace(requirements, reviews=reviews))


def _matrices(requirements: RequirementSet) -> None:
    """The graph anew, the three matrices, the verification matrix, every metric and every gap."""
    model = _model(requirements)
    matrix = trace_matrices(model).system_by_stakeholder
    if matrix.link_count != len(requirements.system):
        raise ValueError(f"each requirement goes back to one need, but there are {matrix.link_count} links")
    trace_report(model, TraceEvidence(), title="Scale")


def _chain_and_impact(requirements: RequirementSet) -> None:
    """One chain and one impact, of a need in the middle."""
    model = _model(requirements)
    name = requirements.stakeholder[len(requirements.stakeholder) // 2].id
    chain_of(model, TraceEvidence(), name)
    impact_of(model, TraceEvidence(), name)


def _model(requirements: RequirementSet) -> TraceModel:
    return build_trace_model(requirements, [_measure(requirements)])


def _measure(requirements: RequirementSet) -> MeasureTrace:
    """A measure that answers every need."""
    needs = tuple(need.id for need in requirements.stakeholder)
    return MeasureTrace(
        id="value", kind=MeasureKind.MOE, unit="1", traces=needs, observed=True, file="measures.yaml", line=1, column=1
    )


def _csv(report: TraceReport) -> bytes:
    return "".join(map(to_csv, tables_of(report, "csv"))).encode()


STAGES: Mapping[str, Callable[[RequirementSet], object]] = {
    "digests": _digests,
    "check": _check,
    "review and check": _check_reviewed,
    "matrices": _matrices,
    "chain, impact": _chain_and_impact,
}
"""What is timed after loading, by the name of its column."""


def _file(report: TraceReport, file_format: str) -> bytes:
    return trace_format(file_format).write_report(report, Selection())


REPORTS: Mapping[str, Callable[[TraceReport], bytes]] = {
    "HTML": lambda report: _file(report, "html"),
    "Markdown": lambda report: _file(report, "md"),
    "CSV": _csv,
    "Excel": lambda report: _file(report, "xlsx"),
    "JSON": lambda report: _file(report, "json"),
}
"""The reports whose time and size are measured, by the name of their column."""


def write_project(folder: Path, size: int) -> Path:
    """Write the requirements of a project that is sound and of the given size.

    Every system requirement has one link to what it derives from and two to what satisfies it;
    the texts keep the rules of wording. The same size gives the same files.

    Args:
        folder: Where the folder ``requirements`` is made.
        size: Number of system requirements; a multiple of 20.

    Returns:
        The folder ``requirements``.
    """
    requirements = folder / "requirements"
    (requirements / "system").mkdir(parents=True)
    needs, blocks, behaviours = size // NEEDS_SHARE, size // BLOCKS_SHARE, size // BEHAVIOURS_SHARE
    _write(requirements / "stakeholder.yaml", "requirements:", map(_need, range(needs)))
    groups = list(RequirementGroup)
    for index, group in enumerate(groups):
        first, last = index * size // len(groups), (index + 1) * size // len(groups)
        entries = (_requirement(n, group.value, needs, blocks, behaviours) for n in range(first, last))
        _write(requirements / "system" / f"{index + 1}-{group.value}.yaml", "requirements:", entries)
    _write(requirements / "architecture.yaml", "blocks:", map(_block, range(blocks)))
    with (requirements / "architecture.yaml").open("a", encoding="utf-8") as file:
        file.write("behaviours:\n")
        file.writelines(_behaviour(n, blocks) for n in range(behaviours))
    return requirements


def _write(path: Path, heading: str, entries: Iterator[str]) -> None:
    with path.open("w", encoding="utf-8") as file:
        file.write(f"{heading}\n")
        file.writelines(entries)


def _need(n: int) -> str:
    return f"""\
  - id: STK-{n:05}
    kind: {("design", "functional", "interface", "performance")[n % 4]}
    text: When order {n} is placed, the system shall serve order {n} within {n + 10} s.
    rationale: Guests of table {n} wait for their order.
    source: Interview {n}
    priority: high
    status: approved
    owner: restaurant operator
"""


def _requirement(n: int, group: str, needs: int, blocks: int, behaviours: int) -> str:
    parent = f"STK-{n // CHAIN % needs:05}" if n % CHAIN == 0 else f"SYS-{n - 1:05}"
    return f"""\
  - id: SYS-{n:05}
    group: {group}
    text: >-
      When order {n} is picked, the {group} of station {n} shall keep the tray of order {n} within
      {n % 90 + 10} mm of the serving position.
    rationale: A tray that stands elsewhere is not found by the waiter of order {n}.
    source: Drawing {n}, revision {n % 7}
    derived_from: [{parent}]
    satisfied_by: [BLK-{n % blocks:05}, ACT-{n % behaviours:05}]
    verification: test
    facility: Laboratory {n % 5}
    phase: qualification
    success: The tray of order {n} is found within the limit in 20 of 20 runs.
    priority: medium
    status: approved
    owner: {group} engineer
"""


def _block(n: int) -> str:
    parent = f"\n    parent: BLK-{(n - 1) // 4:05}" if n else ""
    return f"""\
  - id: BLK-{n:05}
    name: Station {n}
    level: {"element" if n else "system"}{parent}
    text: Where order {n} is prepared.
"""


def _behaviour(n: int, blocks: int) -> str:
    return f"""\
  - id: ACT-{n:05}
    name: Serve order {n}
    kind: activity
    allocated_to: [BLK-{n % blocks:05}]
    text: The tray of order {n} is brought.
    flow:
      nodes:
        - {{id: start, kind: initial}}
        - {{id: bring, kind: action, text: Bring the tray of order {n}.}}
        - {{id: end, kind: final}}
      edges:
        - {{source: start, target: bring}}
        - {{source: bring, target: end}}
"""


def _in_own_process(size: int) -> Any:
    command = [sys.executable, str(Path(__file__).resolve()), "--one", str(size)]
    run = subprocess.run(command, check=True, capture_output=True, text=True)  # noqa: S603 - this very file
    return json.loads(run.stdout)


if __name__ == "__main__":
    main()
