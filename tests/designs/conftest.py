"""A small project to make mistakes in, and helpers that find where they stand."""

from pathlib import Path

import pytest

from rgss.designs import load_catalogue, load_design_space
from rgss.errors import DocumentError

CATALOGUE = """\
roles:
  - id: gripper
    name: Gripper
    properties: {force: N}
  - id: planner
    name: Planner
components:
  - id: small
    role: gripper
    name: Small
    manufacturer: Maker
    matches: {d1: 100 g}
    geometry: scenes/grippers/small.yaml
    cost: {value: 1 USD, assumption: true, rationale: Invented.}
    properties:
      force: {value: 5 N, source: A datasheet}
  - id: large
    role: gripper
    name: Large
    manufacturer: Maker
    matches: {d1: [200 g, 0.3 kg]}
    cost: {value: 2 USD, source: A quotation}
    properties:
      force: {value: 0.01 kN, source: A datasheet}
  - id: rrt
    role: planner
    name: Tree
    manufacturer: Library
    matches: {d3: RRT}
    cost: {value: 0 USD, source: Its licence}
  - id: prm
    role: planner
    name: Roadmap
    manufacturer: Library
    matches: {d3: PRM}
    cost: {value: 0 USD, source: Its licence}
"""

SPACE = """\
parameters:
  - {id: d1, name: mass, symbol: m, unit: kg, description: Mass.}
  - {id: d2, name: fingers, symbol: n, kind: count, description: Fingers.}
  - {id: d3, name: planner, symbol: p, kind: name, role: planner, description: Planner.}
  - {id: d4, name: force, symbol: F, unit: N, description: Force.}
constants:
  d4: 3 N
factors:
  - id: mass
    name: Mass
    levels:
      - {id: low, sets: {d1: 0.1 kg}}
      - {id: high, sets: {d1: 200 g}}
  - id: fingers
    name: Fingers
    levels:
      - {id: two, sets: {d2: 2}}
      - {id: three, sets: {d2: 3}}
  - id: planner
    name: Planner
    levels:
      - {id: rrt, sets: {d3: RRT}}
      - {id: prm, sets: {d3: PRM}}
"""

MARK = "¦"


class SmallProject:
    """Two files in a folder, with the place of expected findings marked in their text."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.catalogue_text = CATALOGUE
        self.space_text = SPACE

    def change(self, old: str, new: str) -> "SmallProject":
        """Replace a part that stands once in the files; ``¦`` in the new text marks a place."""
        assert (self.catalogue_text + self.space_text).count(old) == 1, old
        self.catalogue_text = self.catalogue_text.replace(old, new)
        self.space_text = self.space_text.replace(old, new)
        return self

    def load(self):
        catalogue = load_catalogue(self._write("catalogue.yaml", self.catalogue_text), label="catalogue.yaml")
        return load_design_space(self._write("space.yaml", self.space_text), catalogue, label="space.yaml")

    def findings(self) -> list[str]:
        with pytest.raises(DocumentError) as caught:
            self.load()
        assert all(finding.hint for finding in caught.value.findings)
        assert all("\n" not in str(finding) for finding in caught.value.findings)
        return [str(finding) for finding in caught.value.findings]

    def marks(self) -> list[str]:
        """Every marked place as ``file:line:column``."""
        return [
            f"{name}:{number}:{MARK.join(parts[:index]).replace(MARK, '').__len__() + 1}"
            for name, text in (("catalogue.yaml", self.catalogue_text), ("space.yaml", self.space_text))
            for number, line in enumerate(text.splitlines(), start=1)
            for parts in [line.split(MARK)]
            for index in range(1, len(parts))
        ]

    def _write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.write_text(text.replace(MARK, ""), encoding="utf-8")
        return path


@pytest.fixture
def project(tmp_path):
    return SmallProject(tmp_path)
