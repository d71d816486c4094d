"""The lock, the Makefile and the script of the build machine."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from packaging.version import Version

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


@pytest.fixture(scope="module")
def project(repository):
    return tomllib.loads((repository / "pyproject.toml").read_text(encoding="utf-8"))["project"]


@pytest.fixture(scope="module")
def lock(repository):
    return (repository / "requirements.lock").read_text(encoding="utf-8")


@pytest.fixture
def make(repository, tmp_path):
    """Run make in a copy of what it needs, in a folder whose name has a space."""
    folder = tmp_path / "a folder"
    folder.mkdir()
    for name in ("Makefile", "requirements.lock", "pyproject.toml"):
        shutil.copy(repository / name, folder)
    outer = ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "PYTHON")
    environment = {name: value for name, value in os.environ.items() if name not in outer}
    environment |= {"PIP_NO_INDEX": "1", "UV_OFFLINE": "1"}  # nothing is to be installed here

    def run(*arguments):
        return subprocess.run(
            ["make", *arguments], cwd=folder, env=environment, capture_output=True, text=True, check=False
        )

    return run


def test_lock_pins_what_the_project_asks_for(project, lock):
    pinned: dict[str, list[Version]] = {}
    for name, version in re.findall(r"^([a-z0-9._-]+)(?:\[[a-z,]+\])?==(\S+)", lock, re.MULTILINE):
        pinned.setdefault(canonicalize_name(name), []).append(Version(version))
    extras = [text for extra in ("sim", "docs", "dev") for text in project["optional-dependencies"][extra]]
    asked = [Requirement(text) for text in [*project["dependencies"], *extras]]

    for requirement in asked:
        versions = pinned[canonicalize_name(requirement.name)]
        assert all(requirement.specifier.contains(version) for version in versions), requirement


def test_the_extras_are_on_the_first_page_of_the_documentation(project, repository):
    page = (repository / "docs" / "index.md").read_text(encoding="utf-8")
    table = page.split("| extra | needed by |\n")[1].split("\n\n")[0]
    listed = {name for row in table.splitlines() for name in re.findall(r"`([a-z]+)`", row.split(" | ")[0])}

    # `exchange` is part of every installation, `dev` of a clone.
    assert listed == set(project["optional-dependencies"]) - {"exchange", "dev"}


def test_lock_has_hashes_and_no_place(lock):
    entries = re.split(r"^(?=[a-z0-9])", lock, flags=re.MULTILINE)[1:]

    assert all("--hash=sha256:" in entry for entry in entries)
    assert not re.search(r"https?:|file:|@ ", lock)


def test_make_lists_its_targets(make, repository):
    run = make()
    targets = re.findall(r"^([a-z]+):.*##", (repository / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)

    assert (run.returncode, run.stderr) == (0, "")
    assert [line.split()[:2] for line in run.stdout.splitlines()] == [["make", target] for target in targets]
    assert {"setup", "study", "check", "format", "test", "clean"} <= set(targets)


@pytest.mark.parametrize(
    ("says", "found"), [("echo 3.13.1", "3.13.1"), ("echo 3.9.18", "3.9.18"), ("exit 127", "none")]
)
def test_one_line_says_which_python_is_needed(make, tmp_path, says, found):
    python = tmp_path / "some python"
    python.write_text(f"#!/bin/sh\n{says}\n")
    python.chmod(0o755)
    run = make("setup", f"PYTHON={python}")

    assert run.returncode != 0
    assert run.stdout == ""
    (line,) = run.stderr.splitlines()
    assert f"rgss needs Python 3.10, 3.11 or 3.12; found {found}; set PYTHON=/path/to/python3.11" in line


def test_the_script_of_the_build_machine_checks_and_tests(repository):
    script = repository / ".ci" / "run"
    *_, check, test, regress = script.read_text(encoding="utf-8").splitlines()

    assert os.access(script, os.X_OK)
    assert subprocess.run(["bash", "-n", script], check=False).returncode == 0
    assert [line.partition("  #")[0] for line in (check, test, regress)] == [
        "make check",
        "make test EXCEPT=tests/repository",
        "make regress",
    ]


def test_only_what_the_check_has_run_is_left_out(make):
    check, whole, rest = (
        make("-n", *words).stdout for words in (["check"], ["test"], ["test", "EXCEPT=tests/a tests/b"])
    )

    assert "pytest --quiet tests/repository\n" in check
    assert all(each in check for each in ("/mypy\n", "/mkdocs build --strict", "/ruff check", "/lint-imports"))
    assert "--ignore" not in whole
    assert re.findall(r"--ignore=\S+", rest) == ["--ignore=tests/a", "--ignore=tests/b"]
