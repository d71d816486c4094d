"""A small project to exchange, with whatever elements may have."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from rgss.errors import DocumentError
from rgss.exchange.applying import planned, written
from rgss.exchange.comparison import ImportDefaults, compare
from rgss.exchange.content import Content, content_of
from rgss.requirements import load_requirements

STAKEHOLDER = """\
# What the owner wants.
requirements:
  - id: STK-1
    kind: functional # what it speaks of
    text: When an order is placed, the system shall serve the cup upright.
    rationale: '=HYPERLINK("http://example.org"; "Guests <b>want</b> & get it")'
    source: Interview
    priority: high
    status: approved
    owner: restaurant operator

  - id: STK-2
    parent: STK-1
    kind: performance
    text: When an order is placed, the system shall serve the cup within 60 s.
    rationale: "Coffee gets cold.\\n\\nSee the report; page 2 \\\\ 3.  Two  blanks."
    source: Interview
    priority: medium
    status: proposed
    owner: restaurant operator
    exempt:
      - {rule: wording.R35, reason: "The owner counts; from \\"now\\"."}
"""
SYSTEM = """\
requirements:
  # The clock of the owner.
  - id: SYS-1
    group: manipulator
    text: >-
      When a task is ordered, the system shall execute the task
      within 25 s.
    rationale: Two tasks serve one order.
    source: Estimate
    derived_from: [STK-2] # the need
    satisfied_by: [BLK-arm, SEQ-lift]
    verification: analysis
    facility: Simulation
    phase: qualification
    criterion: {measure: t_e, comparison: "<=", threshold: 25 s}
    priority: high
    status: approved
    owner: systems engineer

  - id: SYS-2
    group: gripper
    parent: SYS-1
    text: The gripper shall close within 2 s.
    rationale: '@The rest of the time is for the arm.'
    source: Catalogue
    derived_from: [STK-2, SYS-1]
    traces: [STK-1]
    satisfied_by: [BLK-gripper, ACT-close]
    verification: demonstration
    success: A stop-watch shows at most 2 s.
    priority: low
    status: draft
    owner: gripper engineer
# The end.
"""
ARCHITECTURE = """\
blocks:
  - {id: BLK-all, name: Context, level: context, text: Everything.}
  - {id: BLK-guest, name: Guest, level: system, parent: BLK-all, actor: true, text: Orders.}
  - {id: BLK-arm, name: Arm, level: subsystem, parent: BLK-all, text: Moves.}
  - {id: BLK-gripper, name: Gripper, level: element, parent: BLK-arm, relation: kind, text: Holds.}
behaviours:
  - id: UC-lift
    name: Lift
    kind: use_case
    allocated_to: [BLK-arm]
    actors: [BLK-guest]
    refines: [STK-1]
    includes: [ACT-close]
    text: The cup is raised.
  - id: ACT-close
    name: Close
    kind: activity
    allocated_to: [BLK-gripper]
    text: The gripper closes.
    flow:
      nodes:
        - {id: start, kind: initial}
        - {id: close, kind: action, text: 'Close "slowly" > 0'}
        - {id: end, kind: final}
      edges:
        - {source: start, target: close}
        - {source: close, target: end}
  - id: SEQ-lift
    name: Lift in time
    kind: sequence
    allocated_to: [BLK-arm]
    text: Order and answer.
    interaction:
      lifelines: [BLK-guest, BLK-arm]
      messages:
        - {id: m1, source: BLK-guest, target: BLK-arm, text: order}
        - {id: m2, source: BLK-arm, target: BLK-guest, text: done, reply: true}
      timings:
        - {first: m1, last: m2, criterion_of: SYS-1, text: The whole}
  - id: STM-lift
    name: States
    kind: state_machine
    allocated_to: [BLK-arm]
    text: One after the other.
    machine:
      states:
        - {id: a, kind: initial, name: Start}
        - {id: b, kind: final, name: End}
      transitions:
        - {source: a, target: b}
"""
MEASURES = {"t_e": "The time of <one> task & its return."}


@dataclass(frozen=True, kw_only=True)
class Project:
    """A folder with requirements."""

    folder: Path

    @property
    def requirements(self):
        return load_requirements(self.folder / "requirements")

    @property
    def content(self) -> Content:
        return content_of(self.requirements, MEASURES)

    def file(self, name: str) -> Path:
        return self.folder / "requirements" / name

    def compare(self, foreign: Content, **assumed):
        return compare(self.content, foreign, ImportDefaults(**{"part": None, "defaults": {}, **assumed}))

    def plan(self, foreign: Content, *, remove: bool = True, contents=None, **assumed):
        changes = self.compare(foreign, **assumed)
        return planned(self.folder, self.requirements, changes, remove=remove, contents=contents)

    def apply(self, foreign: Content, *, remove: bool = True, **assumed) -> None:
        written(self.folder, self.plan(foreign, remove=remove, **assumed))


@pytest.fixture
def project(tmp_path) -> Project:
    folder = tmp_path / "project"
    (folder / "requirements").mkdir(parents=True)
    for name, text in (("stakeholder", STAKEHOLDER), ("system", SYSTEM), ("architecture", ARCHITECTURE)):
        (folder / "requirements" / f"{name}.yaml").write_text(text, encoding="utf-8")
    return Project(folder=folder)


@pytest.fixture
def refused():
    """The lines of what is wrong with a file."""

    def lines(call, *arguments, **named):
        with pytest.raises(DocumentError) as caught:
            call(*arguments, **named)
        return [str(finding) for finding in caught.value.findings]

    return lines
