"""The plugin of pytest in a project of a user's own: what a run of its tests writes, and how long that holds."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from rgss.assessment import failed_verifications, project_marks
from rgss.assessment.evidence_status import project_tests
from rgss.measures import StaleCause, Verdict
from rgss.studies import load_project
from rgss.trace.evidence import read_junit

REPOSITORY = Path(__file__).parents[3]
JUNIT = ".rgss/junit.xml"
TEST = """\
import pytest
from logger import LOGS


@pytest.mark.verifies("SYS-003")
@pytest.mark.parametrize("order", [1, 2])
def test_each_order_is_logged(order):
    assert LOGS
"""


@pytest.fixture
def folder(tmp_path):
    """The shipped project with a program and a test of its own, and without the plugins of this repository."""
    for name in ("requirements", "designs", "scenes", "studies"):
        shutil.copytree(REPOSITORY / name, tmp_path / name)
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests/test_logger.py").write_text(TEST, encoding="utf-8")
    (tmp_path / "logger.py").write_text("LOGS = True\n", encoding="utf-8")
    return tmp_path


def run(folder, *options, within="."):
    """Run the tests as a user does; returns pytest's status."""
    command = [sys.executable, "-m", "pytest", "-q", "-W", "error", "--strict-markers", *options]
    environment = {"PYTHONPATH": str(folder), "PATH": "/usr/bin:/bin"}
    ended = subprocess.run(command, cwd=folder / within, capture_output=True, text=True, check=False, env=environment)
    return ended.returncode, ended.stdout + ended.stderr


def evidence(folder):
    project = load_project(folder)
    return project_tests(folder, project.requirements, project_marks(folder) or ())["SYS-003"]


def failed(folder):
    return failed_verifications(load_project(folder)).tests


def test_a_result_holds_until_the_tested_code_or_the_requirement_changes(folder):
    assert evidence(folder).verdict is Verdict.NOT_RUN
    assert failed(folder) == ()
    status, output = run(folder, f"--junitxml={JUNIT}")
    assert status == 0, output
    assert evidence(folder).verdict is Verdict.MET
    assert [one.test.partition("::")[0] for one in evidence(folder).tests] == ["tests/test_logger.py"] * 2

    (folder / "logger.py").write_text("LOGS = False\n", encoding="utf-8")
    assert (evidence(folder).verdict, evidence(folder).causes) == (Verdict.STALE, (StaleCause.CODE,))
    # A failure of other code than that of the project says nothing yet.
    status, output = run(folder, f"--junitxml={JUNIT}")
    assert status == 1, output
    assert evidence(folder).verdict is Verdict.NOT_MET
    assert failed(folder) == ("SYS-003",)

    (folder / "logger.py").write_text("LOGS = True\n", encoding="utf-8")
    assert failed(folder) == ()


def test_a_run_from_the_folder_of_the_tests_names_them_as_the_project_does(folder):
    status, output = run(folder, f"--junitxml={folder / JUNIT}", "--rootdir=.", within="tests")
    assert status == 0, output
    assert evidence(folder).verdict is Verdict.MET


def test_a_run_without_the_plugin_is_stale(folder):
    (folder / "pytest.ini").write_text("[pytest]\nmarkers =\n    verifies(*ids): requirements\n", encoding="utf-8")
    status, output = run(folder, f"--junitxml={JUNIT}", "-p", "no:rgss.cli.pytest_plugin")
    assert status == 0, output
    assert (evidence(folder).verdict, evidence(folder).causes) == (Verdict.STALE, (StaleCause.UNRECORDED,))
    assert failed(folder) == ()


def test_outside_of_a_project_nothing_is_noted(folder, tmp_path_factory):
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    (elsewhere / "test_logger.py").write_text(TEST, encoding="utf-8")
    (elsewhere / "logger.py").write_text("LOGS = True\n", encoding="utf-8")
    status, output = run(elsewhere, "--junitxml=junit.xml")
    assert status == 0, output
    report = read_junit(elsewhere / "junit.xml")
    assert dict(report.properties) == {}
    assert [test.requirements for test in report.tests] == [(), ()]


def test_a_broken_project_does_not_stop_its_tests(folder):
    (folder / "requirements/system.yaml").write_text("requirements: [\n", encoding="utf-8")
    status, output = run(folder, f"--junitxml={JUNIT}")
    assert status == 0, output
    assert dict(read_junit(folder / JUNIT).properties) == {}


def test_a_result_that_cannot_be_read_fails_nothing(folder):
    (folder / ".rgss").mkdir()
    (folder / JUNIT).write_text("no XML", encoding="utf-8")
    assert failed(folder) == ()
