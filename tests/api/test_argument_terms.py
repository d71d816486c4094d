"""Errors of the Python interface name arguments; those of the command line name options."""

from __future__ import annotations

import ast
import re

import pytest

import rgss
from rgss.api.argument_terms import TERMS, ErrorsNameArguments
from rgss.api.suppositions import suppositions_of
from rgss.errors import DefinitionError, DocumentError, EvidenceError
from tests.fixtures.shipped_project import REPOSITORY

from .conftest import ASKED

OF_A_SHELL = re.compile(r"(?<![\w-])--[a-z]|'rgss |\brgss (?:sweep|trade|check|variants|run)\b")
ROOMS = ("assessment", "decision", "designs", "documents", "studies", "tradeoff")
"""Packages whose errors an analyst meets."""

ELSEWHERE = (
    "add --run to run them",
    "give --reviewer NAME",
    "run 'rgss check ",
    "'rgss trade --time-limit' allows",
    "--case: ",
    "--junit is given",
)
"""Hints of verbs that the Python interface does not have, or for which it has its own."""


def test_missing_trials(swept):
    study = rgss.load_study(swept, fidelity="kinematic", replicates=3)
    with pytest.raises(EvidenceError, match=r"8 of 24 trials have no evidence .* \(call sweep\(\) first\)"):
        _ = study.trade().decision
    with pytest.raises(EvidenceError, match=r"call sweep\(\) first"):
        _ = study.trade().pareto


def test_truth_values_of_suppositions_are_words():
    assert suppositions_of({"uncertainty.nominal": True, "weight.t_p": 0.5}) == [
        "uncertainty.nominal=true",
        "weight.t_p=0.5",
    ]


def test_suppositions(study):
    with pytest.raises(EvidenceError, match=r"the suppositions need .* \(call trade\(…, run=True\) to run them\)"):
        study.trade({"planning.resolution": "0.025 rad"})
    with pytest.raises(DefinitionError, match=r"^what_if: "):
        study.trade({"weight.nothing": 0.4})
    with pytest.raises(DefinitionError, match=r"^what_if: supposition must be NAME=VALUE"):
        study.trade("weight")


def test_a_folder_without_a_project(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(DefinitionError, match=r"no project here or above \(name its folder: load_study\('DIR'\)\)"):
        rgss.load_study()


def test_a_study_that_is_not_there(swept):
    with pytest.raises(DocumentError, match=r"no such file \(check the name and the folder\)"):
        rgss.load_study(swept, "studies/none.yaml", **ASKED)


def test_an_error_keeps_its_type_and_its_data():
    with pytest.raises(KeyError, match="sweep"), ErrorsNameArguments():
        raise KeyError("run 'rgss sweep' first")
    error = EvidenceError("one", hint="run 'rgss sweep' first")
    with pytest.raises(EvidenceError) as caught, ErrorsNameArguments():
        raise error
    assert caught.value is error
    assert error.hint == "call sweep() first"


def test_every_text_that_speaks_of_a_shell_has_its_terms():
    """A new hint with an option in it is put into TERMS, or its verb is one that Python does not have."""
    left = []
    for room in ROOMS:
        for path in sorted((REPOSITORY / "rgss" / room).rglob("*.py")):
            if "robot_project" in path.parts:  # of `rgss init` alone
                continue
            for text in _raised(ast.parse(path.read_text(encoding="utf-8"))):
                told = text
                for said, better in TERMS:
                    told = told.replace(said, better)
                if OF_A_SHELL.search(told) and not any(one in told for one in ELSEWHERE):
                    left.append(f"{path.relative_to(REPOSITORY)}: {text}")
    assert not left, "\n".join(left)


def _raised(tree):
    """The texts in what is raised."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Raise) and node.exc is not None:
            for part in ast.walk(node.exc):
                if isinstance(part, ast.JoinedStr):
                    yield "".join(each.value if isinstance(each, ast.Constant) else "X" for each in part.values)
                elif isinstance(part, ast.Constant) and isinstance(part.value, str):
                    yield part.value
