"""Files that nothing reads, and characters that nobody sees, are found with their places."""

from __future__ import annotations

import errno
import os
import socket
from pathlib import Path

import pytest

from rgss.studies.scaffolding import write_scaffold
from rgss.studies.source_text import invisible_findings
from rgss.studies.unread_files import unread_findings


@pytest.fixture
def project(tmp_path):
    write_scaffold(tmp_path / "project")
    return tmp_path / "project"


def told(project):
    return [(each.file, each.severity.value, each.hint) for each in unread_findings(project)]


def test_a_new_project_has_none(project):
    assert unread_findings(project) == invisible_findings(project) == ()


@pytest.mark.parametrize(
    ("name", "text", "meant"),
    [
        ("requirements/sytem.yaml", "requirements: []\n", "requirements/system.yaml"),
        ("requirements/System.yaml", "requirements: []\n", "requirements/system.yaml"),
        ("requirements/rules.yml", "rules: {}\n", "requirements/rules.yaml"),
        ("requirements/rules.YAML", "rules: {}\n", "requirements/rules.yaml"),
        ("requirements/review.yaml", "reviews: {}\n", "requirements/reviews.yaml"),
        ("requirements/rules.yaml.txt", "rules: {}\n", "requirements/rules.yaml"),
        ("requirements/structure.yaml", "blocks: []\n", "requirements/architecture.yaml"),
        ("requirements/more.yaml", "requirements:\n  - {id: S, group: gripper}\n", "requirements/system.yaml"),
        ("requirements/kitchen.yaml", "bodies: []\n", "scenes/kitchen.yaml"),
        ("requirements/sytems/a.yaml", "requirements: []\n", "requirements/system.yaml"),
        ("scenes/other.yml", "bodies: []\n", "scenes/other.yaml"),
        ("scenes/study.yaml", "study: s\n", "studies/study.yaml"),
        ("studies/fast.yml", "study: s\n", "studies/fast.yaml"),
        ("studies/limits.yaml", "measures: []\n", "requirements/measures.yaml"),
        ("requirement/system.yaml", "requirements: []\n", "requirements/system.yaml"),
        ("Scenes/kitchen.yaml", "bodies: []\n", "scenes/kitchen.yaml"),
        ("system.yaml", "requirements: []\n", "requirements/system.yaml"),
    ],
)
def test_a_misnamed_file_is_a_warning_with_a_suggestion(project, name, text, meant):
    (project / name).parent.mkdir(exist_ok=True)
    (project / name).write_text(text)

    assert told(project) == [(name, "warning", f"is it meant to be {meant!r}?")]


def test_a_file_that_cannot_be_guessed(project):
    (project / "requirements" / "zzz.yaml").write_text("- [\n")
    (project / "designs" / "zzz.yaml").write_text("zzz: 1\n")

    assert told(project) == [
        ("designs/zzz.yaml", "warning", "name it in a study, or remove it"),
        (
            "requirements/zzz.yaml",
            "warning",
            (
                "requirements/ has stakeholder, system, architecture, measures, rules, reviews, verifications, "
                "each with the ending .yaml"
            ),
        ),
    ]


def test_a_scene_that_no_study_names_is_only_noted(project):
    (project / "scenes" / "second.yaml").write_text("bodies: []\n")
    assert told(project) == [("scenes/second.yaml", "info", "name it in a study")]

    study = project / "studies" / "second.yaml"
    study.write_text("study: second\nscene: scenes/second.yaml\n")
    assert told(project) == []


def test_nothing_is_noted_while_a_study_cannot_be_read(project):
    (project / "scenes" / "second.yaml").write_text("bodies: []\n")
    (project / "studies" / "broken.yaml").write_text("study: [\n")

    assert told(project) == []


def test_what_is_no_document_is_left_alone(project):
    for name in ("requirements/README.md", "scenes/.hidden.yaml", "studies/notes.txt", "mkdocs.yml"):
        (project / name).write_text("study: s\n")

    assert told(project) == []


def _socket(path):
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        with socket.socket(socket.AF_UNIX) as made:  # its names are short: a long path does not fit
            made.bind(f"/proc/self/fd/{folder}/{path.name}")
    finally:
        os.close(folder)


def _large(path):
    path.touch()
    os.truncate(path, 3 * 1024**3)


NO_DOCUMENTS = {
    "device": (lambda path: path.symlink_to("/dev/zero"), "it is a device, not a file"),
    "pipe": (os.mkfifo, "it is a pipe, not a file"),
    "socket": (_socket, "it is a socket, not a file"),
    "folder": (os.mkdir, "it is a folder, not a file"),
    "dangling link": (lambda path: path.symlink_to("nowhere.yaml"), "it is a link to what is not there"),
    "circle": (lambda path: path.symlink_to(path.name), "it is a circle of links"),
    "three gigabytes": (_large, "it is larger than the 16 MiB that are read"),
}


@pytest.mark.parametrize("name", ["requirements/zero.yaml", "scenes/zero.yml", "studies/zero.yaml"])
@pytest.mark.parametrize("kind", NO_DOCUMENTS)
def test_what_has_the_name_of_a_document_and_is_none_is_named_once(project, kind, name):
    make, message = NO_DOCUMENTS[kind]
    make(project / name)

    (finding,) = unread_findings(project)
    assert str(finding) == (
        f"{name}:1:1: warning: nothing reads this: {message} (put a YAML file in its place, or remove it) "
        "[document.unread]"
    )


def test_a_document_that_may_not_be_read_is_named(project, monkeypatch):
    path = project / "scenes" / "secret.yaml"
    path.write_text("bodies: []\n")
    path.chmod(0)

    def refused(name, *arguments):
        if Path(name) == path:
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        return opened(name, *arguments)

    opened = os.open
    monkeypatch.setattr(os, "open", refused)
    assert [each.message for each in unread_findings(project)] == [
        "nothing reads this: it cannot be read: Permission denied"
    ]


@pytest.mark.parametrize(
    ("line", "places"),
    [
        ("# a\u202eb", [(2, 4, "U+202E")]),
        ("x: a\u2066b\u2069", [(2, 5, "U+2066"), (2, 7, "U+2069")]),
        ("x: pass\u200bword", [(2, 8, "U+200B")]),
        ('x: "a\\u202Eb"', [(2, 6, "U+202E")]),
        ('x: "a\\U0000202eb"', [(2, 6, "U+202E")]),
        ('x: "a\\Lb"', [(2, 6, "U+2028")]),
        ("x: 'a\\u202Eb'", []),
        ('x: "a\\\\u202Eb"', []),
        ("x: Größe ≤ 5", []),
    ],
)
def test_invisible_characters_have_a_place(project, line, places):
    (project / "studies" / "other.yaml").write_bytes(f"study: s\n{line}\n".encode())

    found = invisible_findings(project)
    assert [(each.file, each.line, each.column) for each in found] == [
        ("studies/other.yaml", line, column) for line, column, _ in places
    ]
    assert [character in each.message for each, (_, _, character) in zip(found, places, strict=True)] == [True] * len(
        places
    )


def test_invisible_characters_of_a_robot(project):
    (project / "scenes" / "a.urdf").write_text('<robot name="a&#x202E;b">\n<!-- \u200f --></robot>')

    assert [(each.line, each.column) for each in invisible_findings(project)] == [(1, 15), (2, 6)]


@pytest.mark.parametrize("kind", ["pipe", "device"])
def test_what_is_no_regular_file_is_not_waited_for(project, kind):
    path = project / "scenes" / "endless.yaml"
    if kind == "pipe":
        os.mkfifo(path)
    else:
        path.symlink_to("/dev/zero")

    assert invisible_findings(project) == ()
