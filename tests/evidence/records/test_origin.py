"""Revision of the code, machine and input files, as a provenance tells them."""

import hashlib
import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from rgss.errors import EvidenceError
from rgss.evidence import Provenance
from rgss.evidence.records import origin
from rgss.evidence.records.origin import code_revision, file_digests, machine
from rgss.evidence.records.provenance import provenance_from_json, provenance_to_json

GIT = [
    shutil.which("git") or "git",
    "-c",
    "user.name=t",
    "-c",
    "user.email=t@example.org",
    "-c",
    "init.defaultBranch=m",
]


def git(folder, *words):
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    done = subprocess.run([*GIT, *words], cwd=folder, capture_output=True, text=True, check=True, env=environment)
    return done.stdout.strip()


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A folder in version control that stands for the one that rgss lies in."""
    folder = tmp_path / "checkout" / "rgss"
    folder.mkdir(parents=True)
    (folder / "__init__.py").write_text("", encoding="utf-8")
    monkeypatch.setattr(origin, "_PACKAGE", folder)
    git(folder.parent, "init")
    return folder


def test_the_revision_of_a_checkout(package):
    git(package, "add", ".")
    git(package, "commit", "--message", "first")
    revision = git(package, "rev-parse", "HEAD")
    assert code_revision() == revision
    (package / "__init__.py").write_text("changed = True", encoding="utf-8")
    assert code_revision() == f"{revision}+changes"
    git(package, "checkout", "--", ".")
    (package / "new.py").write_text("", encoding="utf-8")
    assert code_revision() == f"{revision}+changes"


def test_the_revision_of_a_repository_around_the_code_is_none_of_ours(package, monkeypatch):
    (package.parent / "theirs.py").write_text("", encoding="utf-8")
    git(package.parent, "add", "theirs.py")
    git(package.parent, "commit", "--message", "first")
    monkeypatch.setattr(origin, "_installed_from", lambda: "what it was installed from")
    assert code_revision() == "what it was installed from"


def test_without_git_and_without_a_note_nothing_is_known(monkeypatch):
    monkeypatch.setattr(origin.shutil, "which", lambda name: None)
    monkeypatch.setattr(origin.importlib.metadata, "distribution", lambda name: Noted(None))
    assert code_revision() == ""


class Noted:
    def __init__(self, text):
        self.text = text

    def read_text(self, name):
        assert name == "direct_url.json"
        return self.text


@pytest.mark.parametrize(
    ("text", "revision"),
    [
        ('{"url": "u", "vcs_info": {"vcs": "git", "commit_id": "abc"}}', "abc"),
        ('{"url": "u", "dir_info": {"editable": true}}', ""),
        ("nonsense", ""),
        ("[]", ""),
    ],
)
def test_what_a_package_was_installed_from(monkeypatch, text, revision):
    monkeypatch.setattr(origin.importlib.metadata, "distribution", lambda name: Noted(text))
    assert origin._installed_from() == revision


def test_a_git_that_fails_or_hangs_is_no_trouble(tmp_path, monkeypatch):
    slow = tmp_path / "git"
    slow.write_text("#!/bin/sh\nsleep 60\n", encoding="utf-8")
    slow.chmod(0o755)
    monkeypatch.setattr(origin, "_PATIENCE_S", 0.05)
    monkeypatch.setattr(origin.shutil, "which", lambda name: str(slow))
    assert origin._git(tmp_path, "status") is None
    monkeypatch.setattr(origin.shutil, "which", lambda name: str(tmp_path / "none"))
    assert origin._git(tmp_path, "status") is None


def test_the_machine_is_told_without_its_name():
    told = machine()
    assert "\n" not in told
    assert f"Python {platform.python_version()}" in told
    assert platform.machine() in told
    assert platform.node() not in told.split(", ")


def test_a_machine_without_that_file_of_linux(monkeypatch):
    monkeypatch.setattr(origin, "Path", lambda name: Path(os.devnull) / "none")
    monkeypatch.setattr(origin.platform, "processor", lambda: "Some Processor")
    assert ", Some Processor, " in machine()


def test_digests_of_files_and_folders(tmp_path):
    (tmp_path / "scenes" / "meshes").mkdir(parents=True)
    (tmp_path / "scenes" / ".hidden").mkdir()
    for name, content in (
        ("studies.yaml", b"a"),
        ("scenes/b.yaml", b"b"),
        ("scenes/meshes/c.stl", b"\x00\xff"),
        ("scenes/.hidden/d", b"d"),
        ("scenes/.swp", b"d"),
    ):
        (tmp_path / name).write_bytes(content)
    found = file_digests(tmp_path, ["studies.yaml", "scenes", "scenes/b.yaml"])
    assert list(found.items()) == [
        ("scenes/b.yaml", hashlib.sha256(b"b").hexdigest()),
        ("scenes/meshes/c.stl", hashlib.sha256(b"\x00\xff").hexdigest()),
        ("studies.yaml", hashlib.sha256(b"a").hexdigest()),
    ]
    with pytest.raises(EvidenceError) as caught:
        file_digests(tmp_path, ["scenes", "none.yaml"])
    assert str(caught.value) == "the input file none.yaml cannot be read: No such file or directory"


def test_a_provenance_is_read_as_it_was_written():
    whole = Provenance(
        inputs={"plan": "a" * 64},
        versions={"rgss": "0.1.0"},
        inputs_digest="b" * 64,
        files={"scenes/a.yaml": "c" * 64},
        revision="d" * 40,
        machine=machine(),
    )
    assert provenance_from_json(provenance_to_json(whole)) == whole
    # What schema 1 wrote has none of the rest.
    assert provenance_from_json('{"inputs":{"plan":"x"},"versions":{}}') == Provenance(
        inputs={"plan": "x"}, versions={}
    )
    with pytest.raises(EvidenceError, match=r"^provenance has an unknown 'more'$"):
        provenance_from_json(provenance_to_json(whole)[:-1] + ',"more":1}')


def test_this_code_knows_where_it_comes_from():
    known = subprocess.run(
        [sys.executable, "-c", "from rgss.evidence.records.origin import code_revision; print(code_revision())"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert known.stdout.strip() == code_revision()
