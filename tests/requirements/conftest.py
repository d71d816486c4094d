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

BEHAVIOURS = {
    "flow": """\
  - id: ACT-9
    name: Lift
    kind: activity
    text: A cup is lifted.
    flow:
      nodes:
        - {id: start, kind: initial}
        - {id: close, kind: action, text: Close., does: ACT-2}
        - {id: firm, kind: decision, text: "Is it firm?"}
        - {id: again, kind: merge}
        - {id: both, kind: fork}
        - {id: lift, kind: action, text: Lift.}
        - {id: look, kind: action, text: Look.}
        - {id: done, kind: join}
        - {id: end, kind: final, text: The cup is up.}
      edges:
        - {source: start, target: again}
        - {source: again, target: close}
        - {source: close, target: firm}
        - {source: firm, target: again, guard: not yet}
        - {source: firm, target: both, guard: it is}
        - {source: both, target: lift}
        - {source: both, target: look}
        - {source: lift, target: done}
        - {source: look, target: done}
        - {source: done, target: end}
""",
    "interaction": """\
  - id: SEQ-9
    name: Lift
    kind: sequence
    text: A cup is lifted.
    interaction:
      lifelines: [BLK-0, BLK-1]
      messages:
        - {id: lift, source: BLK-0, target: BLK-1, text: Lift., does: ACT-1}
        - {id: close, source: BLK-1, target: BLK-1, text: Close.}
        - {id: up, source: BLK-1, target: BLK-0, text: It is up., reply: true}
      timings:
        - {first: lift, last: up, criterion_of: SYS-1, text: How long it takes.}
""",
    "machine": """\
  - id: STM-9
    name: Lift
    kind: state_machine
    text: A cup is lifted.
    machine:
      states:
        - {id: start, kind: initial, name: Before}
        - {id: lifting, kind: state, name: Lifting, phase: lift, does: ACT-1}
        - {id: up, kind: final, name: Up}
        - {id: dropped, kind: failed, name: Dropped}
      transitions:
        - {source: start, target: lifting}
        - {source: lifting, target: up, guard: at the top}
        - {source: lifting, target: dropped, failure: object_dropped}
""",
}
"""One behaviour of each kind that has a detail, to be appended to the architecture."""


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

    def write(self, name: str, text: str) -> Project:
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
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


@pytest.fixture
def written() -> dict[str, str]:
    """A behaviour of each kind of detail, as a file says it."""
    return BEHAVIOURS


@pytest.fixture
def detailed(project: Project) -> Project:
    """A project with every kind of behaviour in detail."""
    return project.append("architecture.yaml", "".join(BEHAVIOURS.values()))
