"""The examples of docs/requirements.md are one project that loads, and show every key that there is."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from pydantic import TypeAdapter

from rgss.requirements import (
    ArchitectureFile,
    BehaviourKind,
    BlockLevel,
    BlockRelation,
    Comparison,
    FlowNodeKind,
    LinkKind,
    NeedKind,
    Priority,
    RequirementGroup,
    RequirementSet,
    ReviewsFile,
    RulesFile,
    StakeholderFile,
    StateKind,
    Statistic,
    Status,
    SystemFile,
    VerificationMethod,
    VerificationPhase,
    VerificationsFile,
    load_requirements,
)

PAGE = Path(__file__).parents[2] / "docs" / "requirements.md"
_EXAMPLE = re.compile(r"```yaml\n# (\S+\.yaml)\n(.*?)```", re.DOTALL)


@pytest.fixture(scope="module")
def examples():
    found = _EXAMPLE.findall(PAGE.read_text(encoding="utf-8"))
    assert len(found) == PAGE.read_text(encoding="utf-8").count("```yaml")
    return dict(found)


@pytest.fixture(scope="module")
def project(examples, tmp_path_factory) -> RequirementSet:
    folder = tmp_path_factory.mktemp("documented")
    for name, text in examples.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return load_requirements(folder)


def test_the_examples_are_one_project(project):
    assert [item.id for item in project.system] == ["SYS-1", "SYS-2", "SYS-3"]
    assert {behaviour.kind for behaviour in project.architecture.behaviours} == set(BehaviourKind)
    assert set(project.settings) == {"wording.R7", "wording.R19", "trace.idle-element"}
    assert set(project.reviews) == {"SYS-1"}
    assert set(project.records) == {"SYS-2"}


def test_they_state_every_relation(project):
    assert {link.kind for link in project.links} == set(LinkKind) - {LinkKind.VERIFY}


def test_every_key_is_shown(examples):
    shown = set(re.findall(r"\b(\w+):", "\n".join(examples.values())))
    files = (ArchitectureFile, ReviewsFile, RulesFile, StakeholderFile, SystemFile, VerificationsFile)
    schemas = [TypeAdapter(file).json_schema() for file in files]
    models = [schema for whole in schemas for schema in (whole, *whole["$defs"].values()) if "properties" in schema]
    assert len(models) >= 20
    assert {name for model in models for name in model["properties"]} - shown == set()


@pytest.mark.parametrize(
    "choices",
    [
        *(BehaviourKind, BlockLevel, BlockRelation, Comparison, FlowNodeKind, LinkKind, NeedKind, Priority),
        *(RequirementGroup, StateKind, Statistic, Status, VerificationMethod, VerificationPhase),
    ],
)
def test_every_choice_is_named(choices):
    text = PAGE.read_text(encoding="utf-8")
    assert [each.value for each in choices if not re.search(rf"(?<!\w){re.escape(each.value)}(?!\w)", text)] == []
