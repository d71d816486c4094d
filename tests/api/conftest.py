"""A small project with evidence from real kinematic trials, and the studies that ask for it."""

from __future__ import annotations

import contextlib
import io
import json
import shutil
from pathlib import Path

import pytest

import rgss
from rgss.cli.main import main
from tests.fixtures.shipped_project import copy_project, with_few_designs

ASKED = {"fidelity": "kinematic", "replicates": 2}
OPTIONS = ("--fidelity", "kinematic", "--replicates", "2")


def copied(to: Path, *, small: bool = False) -> Path:
    """A copy of the shipped project; a small one has 8 designs, of one planner and one limit."""
    copy_project(to)
    return with_few_designs(to) if small else to


@pytest.fixture
def empty(tmp_path) -> Path:
    """A small project without evidence that the test may change."""
    return copied(tmp_path / "project", small=True)


@pytest.fixture(scope="session")
def swept(tmp_path_factory) -> Path:
    """A small project with evidence, which no test changes."""
    folder = copied(tmp_path_factory.mktemp("swept") / "project", small=True)
    rgss.load_study(folder, **ASKED).sweep(jobs=0)
    return folder


@pytest.fixture
def changeable(swept, tmp_path) -> Path:
    """A copy of it, with its evidence."""
    return Path(shutil.copytree(swept, tmp_path / "changeable"))


@pytest.fixture(scope="session")
def study(swept):
    """The study with its evidence; frames are made anew at each access."""
    return rgss.load_study(swept, **ASKED)


@pytest.fixture(scope="session")
def told():
    """Runs the command line in this process and gives the JSON document that it prints."""

    def run(*words: object):
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            assert main([str(word) for word in words]) in (0, 1)
        return json.loads(output.getvalue())

    return run


@pytest.fixture(scope="session")
def traded(told, swept):
    """What ``rgss trade --json`` says of the small project."""
    return told("trade", "--project", swept, *OPTIONS, "--json")
