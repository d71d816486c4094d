"""A minimal sound project in a temporary folder, to be broken in one place by each test."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import pytest

from rgss.errors import DocumentError
from rgss.findings import Finding
from rgss.requirements import load_requirements
from rgss.trace import MeasureKind, MeasureTrace, TraceModel, build_trace_model, check_trace
from rgss.trace.evidence.evidence_state import EvidenceState
from rgss.trace.evidence.test_marks import MarkedTest

FILES = {
    "stakeholder.yaml": """\
requirements:
  - id: STK-1
    kind: functional
    text: When a cup is ordered, the system shall serve the cup.
    rationale: R
    source: S
    priority: high
    status: draft
    owner: O
""",
    "system.yaml": """\
requirements:
  - id: SYS-1
    group: gripper
    text: The gripper shall lift at least 0.8 kg.
    rationale: A cup has less.
    source: catalogue
    priority: medium
    status: draft
    owner: engineer
    derived_from: [STK-1]
    satisfied_by: [BLK-1]
    verification: analysis
    facility: desk
    phase: development
    criterion: {measure: P, comparison: ">=", threshold: "800 g"}
""",
    "architecture.yaml": """\
blocks:
  - {id: BLK-1, name: Gripper, level: subsystem, text: Grips.}
""",
    "rules.yaml": """\
rules:
  review.missing: {enabled: false, reason: no test but its own is about reviews}
""",
}


def measure(measure_id: str, kind: MeasureKind, line: int, **changes: object) -> MeasureTrace:
    sound = MeasureTrace(id=measure_id, kind=kind, unit="kg", file="requirements/measures.yaml", line=line, column=5)
    return replace(sound, **changes)


@dataclass
class Project:
    folder: Path
    measures: list[MeasureTrace] = field(default_factory=list)
    marked: Sequence[MarkedTest] | None = None
    evidence: EvidenceState | None = None

    def edit(self, name: str, old: str, new: str) -> Project:
        path = self.folder / name
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{old!r} is not there exactly once"
        path.write_text(text.replace(old, new), encoding="utf-8")
        return self

    def append(self, name: str, text: str) -> Project:
        path = self.folder / name
        path.write_text(path.read_text(encoding="utf-8") + text, encoding="utf-8")
        return self

    def write(self, name: str, text: str) -> Project:
        (self.folder / name).write_text(text, encoding="utf-8")
        return self

    def position(self, name: str, start_of: str) -> str:
        """Where a text that is there once starts, as a finding says it."""
        text = (self.folder / name).read_text(encoding="utf-8")
        assert text.count(start_of) == 1, f"{start_of!r} is not there exactly once"
        before = text[: text.index(start_of)]
        return f"requirements/{name}:{before.count(chr(10)) + 1}:{len(before) - before.rfind(chr(10))}"

    def change(self, measure_id: str, **changes: object) -> Project:
        self.measures = [replace(item, **changes) if item.id == measure_id else item for item in self.measures]
        return self

    def add(self, measure_id: str, kind: MeasureKind, **changes: object) -> Project:
        self.measures.append(measure(measure_id, kind, 2 + len(self.measures), **changes))
        return self

    def model(self) -> TraceModel:
        return build_trace_model(load_requirements(self.folder), self.measures)

    def found(self) -> tuple[Finding, ...]:
        """What is found, while the files are read or afterwards."""
        try:
            requirements = load_requirements(self.folder)
        except DocumentError as error:
            return error.findings
        return check_trace(requirements, self.measures, marked=self.marked, evidence=self.evidence)

    def findings(self) -> list[str]:
        return [str(finding) for finding in self.found()]

    def rules(self) -> list[str]:
        """The rules that are broken."""
        return [finding.rule for finding in self.found()]


@pytest.fixture
def project(tmp_path: Path) -> Project:
    folder = tmp_path / "requirements"
    folder.mkdir()
    for name, text in FILES.items():
        (folder / name).write_text(text, encoding="utf-8")
    project = Project(folder)
    project.add("P", MeasureKind.MOE, traces=("STK-1",))
    return project.add("P_g", MeasureKind.MOP, contributes_to=("P",))
