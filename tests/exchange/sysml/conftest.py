"""The shipped project in the language, and an interpreter of another hand."""

from __future__ import annotations

import gc
from pathlib import Path

import longeron
import pytest

from rgss.exchange.sysml import sysml_text
from rgss.studies.project import load_project


@pytest.fixture(scope="session")
def shipped():
    return load_project(Path(__file__).resolve().parents[3])


@pytest.fixture(scope="session")
def written(shipped):
    return sysml_text(shipped.requirements, shipped.measures, title=shipped.study.id)


@pytest.fixture(scope="session")
def model(written):
    """The whole export as the interpreter reads it; it takes a minute, for its grammar runs in Python.

    What it makes is garbage at no time, and to look through it again and again takes a quarter more.
    """
    gc.disable()
    try:
        return longeron.loads(written)
    finally:
        gc.enable()


@pytest.fixture(scope="session")
def elements(model):
    return list(model.iter_tree())
