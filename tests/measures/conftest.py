from __future__ import annotations

import textwrap
from collections.abc import Callable
from pathlib import Path

import pytest

from rgss.errors import DocumentError
from rgss.findings import Finding
from rgss.measures import MeasureSet, load_measures

PROJECT = Path(__file__).parents[2]

HEAD = """\
title: Test
constants:
  - {id: g, value: 10 m/s^2, unit: m/s^2, definition: Gravity., source: Test}
inputs:
  - {id: m, source: design.d2, unit: kg, definition: Mass.}
  - {id: v, source: design.d7, unit: m/s, definition: Speed.}
  - {id: row, source: trial.path_length_m, unit: m, length: 5, definition: Lengths.}
  - {id: pair, source: trial.pair, unit: m, length: 2, definition: Two lengths.}
  - {id: time, source: trial.task_time_s, unit: s, definition: Time.}
  - {id: share, source: trial.share, unit: "1", definition: A share.}
"""


@pytest.fixture(scope="session")
def reference() -> MeasureSet:
    """The project's own measures."""
    return load_measures(PROJECT / "requirements/measures.yaml", label="requirements/measures.yaml")


@pytest.fixture
def load(tmp_path: Path) -> Callable[[str], MeasureSet]:
    """Loads a whole measures file from its text."""

    def read(text: str) -> MeasureSet:
        path = tmp_path / "measures.yaml"
        path.write_text(textwrap.dedent(text), encoding="utf-8")
        return load_measures(path, label="measures.yaml")

    return read


@pytest.fixture
def load_entries(load: Callable[[str], MeasureSet]) -> Callable[..., MeasureSet]:
    """Loads measures, written one to a line, behind a head with constants and inputs; after is what follows."""

    def read(*entries: str, after: str = "") -> MeasureSet:
        return load(HEAD + "measures:\n" + "".join(f"  - {entry}\n" for entry in entries) + after)

    return read


@pytest.fixture
def findings_of() -> Callable[..., tuple[Finding, ...]]:
    """Calls a loader and returns the findings that it raises."""

    def call(loader: Callable[..., MeasureSet], *args: str, **kwargs: str) -> tuple[Finding, ...]:
        with pytest.raises(DocumentError) as caught:
            loader(*args, **kwargs)
        return caught.value.findings

    return call


@pytest.fixture
def entry() -> Callable[..., str]:
    """Writes one supplementary measure as a flow mapping; None leaves a key out."""

    def write(name: str, formula: str, measured_in: str = "kg", /, **more: str | None) -> str:
        keys: dict[str, str | None] = {
            "id": name,
            "kind": "supplementary",
            "name": "Name",
            "definition": "Text.",
            "unit": f'"{measured_in}"',
            "better": "none",
            "expression": f'"{formula}"',
            **more,
        }
        return "{" + ", ".join(f"{key}: {value}" for key, value in keys.items() if value is not None) + "}"

    return write
