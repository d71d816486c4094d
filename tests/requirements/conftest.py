"""A minimal sound project in a temporary folder, to be broken in one place by each test."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from rgss.errors import DocumentError
from rgss.requirements import RequirementSet, load_requirements

FILES = {
    "stakeholder.yaml": """\
requirements:
  - id: STK-1
    kind: functional
    text: The system shall lift cups.
    rationale: Cups wait to be lifted.
    source: interview
    priority: high
    status: approved
    owner: cook
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
    satisfied_by: [BLK-1, ACT-1]
    verification: analysis
    criterion: {measure: P, statistic: low, comparison: ">=", threshold: "800 g"}
""",
    "architecture.yaml": """\
blocks:
  - {id: BLK-0, name: System, level: system, text: The whole.}
  - {id: BLK-1, name: Gripper, level: subsystem, parent: BLK-0, relation: kind, text: A part.}
behaviours:
  - {id: UC-1, name: Lift, kind: use_case, allocated_to: [BLK-0], text: Cups are lifted.}
  - {id: ACT-1, name: Lift, kind: activity, allocated_to: [BLK-1], refines: [UC-1], includes: [ACT-2], text: Lifts.}
  - {id: ACT-2, name: Close, kind: activity, text: Closes.}
""",
}


@dataclass(frozen=True)
class Project:
    folder: Path

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

    def position(self, name: str, start_of: str) -> str:
        """Where a text that is there once starts, as a finding says it."""
        text = (self.folder / name).read_text(encoding="utf-8")
        assert text.count(start_of) == 1, f"{start_of!r} is not there exactly once"
        before = text[: text.index(start_of)]
        return f"requirements/{name}:{before.count(chr(10)) + 1}:{len(before) - before.rfind(chr(10))}"

    def load(self) -> RequirementSet:
        return load_requirements(self.folder)

    def findings(self) -> list[str]:
        with pytest.raises(DocumentError) as caught:
            self.load()
        return [str(finding) for finding in caught.value.findings]


@pytest.fixture
def project(tmp_path: Path) -> Project:
    folder = tmp_path / "requirements"
    folder.mkdir()
    for name, text in FILES.items():
        (folder / name).write_text(text, encoding="utf-8")
    return Project(folder)
