"""Closures of pieces are kept for exactly the sources that they were found in."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.trials.code.closure_cache import PieceSources, cached_sources
from rgss.trials.code.code_fingerprint import SourceClosure, own_sources
from rgss.trials.code.piece_versions import ENTRIES, code_of_trials, source_of, sources_in

FOUND = PieceSources(
    closures={"plan": SourceClosure(modules=("pack.one", "pack.two"), foreign=("ompl",), digest="a" * 64)},
    modules={"pack.one": "b" * 64, "pack.two": "c" * 64},
)


@pytest.fixture
def package(tmp_path) -> Path:
    (tmp_path / "pack" / "inner").mkdir(parents=True)
    for name in ("one.py", "two.py", "inner/__init__.py"):
        (tmp_path / "pack" / name).write_text(f"NAME = {name!r}\n", encoding="utf-8")
    return tmp_path / "pack"


@pytest.fixture
def kept(tmp_path, package, monkeypatch) -> Path:
    """A file that keeps the closures of the package."""
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    file = tmp_path / "compiled" / "closures.json"
    assert cached_sources(package, lambda: FOUND, file=file) == FOUND
    return file


def never() -> PieceSources:
    pytest.fail("found again")


def again(package, kept) -> bool:
    """True if the closures are found again, and then kept."""
    other = replace(FOUND, modules={"pack.one": "d" * 64})
    found = cached_sources(package, lambda: other, file=kept)
    assert found in (FOUND, other)
    if found == other:
        assert cached_sources(package, never, file=kept) == other
    return found == other


def test_they_are_found_once(package, kept):
    assert cached_sources(package, never, file=kept) == FOUND
    assert [*kept.parent.iterdir()] == [kept]


CHANGES = {
    "a changed file": lambda package: (package / "one.py").write_text("NAME = 'One.py'\n", encoding="utf-8"),
    "a new file": lambda package: (package / "three.py").touch(),
    "a new package": lambda package: (package / "more").mkdir() or (package / "more" / "__init__.py").touch(),
    "a lost file": lambda package: (package / "two.py").unlink(),
    "another name": lambda package: (package / "two.py").rename(package / "too.py"),
    "another folder": lambda package: (package / "two.py").rename(package / "inner" / "two.py"),
    "two that changed places": lambda package: [
        (package / "one.py").rename(package / "kept.py"),
        (package / "two.py").rename(package / "one.py"),
        (package / "kept.py").rename(package / "two.py"),
    ],
}


@pytest.mark.parametrize("change", CHANGES)
def test_other_sources_have_others_even_with_the_same_times(package, kept, change):
    CHANGES[change](package)
    for path in package.rglob("*.py"):
        os.utime(path, (0, 0))
    assert again(package, kept)


def test_another_python_finds_them_again(package, kept, monkeypatch):
    monkeypatch.setattr(sys, "version", f"{sys.version} patched")
    assert again(package, kept)


def test_what_is_no_source_changes_nothing(package, kept):
    (package / "notes.md").touch()
    (package / "__pycache__").mkdir()
    (package / "__pycache__" / "one.py").touch()
    assert not again(package, kept)


def changed(text: str, **values: object) -> str:
    return json.dumps({**json.loads(text), **values})


@pytest.mark.parametrize(
    "damage",
    [
        lambda text: "",
        lambda text: text[:-20],
        lambda text: "[" * 100_000,
        lambda text: "[]",
        lambda text: "{}",
        lambda text: text.replace("a" * 64, "a" * 63 + "b"),
        lambda text: text.replace("pack.two", "pack.too"),
        lambda text: changed(text, sources=None),
        lambda text: changed(text, checksum="e" * 64),
    ],
)
def test_a_damaged_file_is_written_anew(package, kept, damage):
    kept.write_text(damage(kept.read_text(encoding="utf-8")), encoding="utf-8")
    assert again(package, kept)


def test_where_nothing_can_be_written_they_are_found_each_time(package, tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    file = tmp_path / "file" / "closures.json"
    assert again_without_keeping(package, file)

    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    file = tmp_path / "closures.json"
    assert again_without_keeping(package, file)
    assert not file.exists()


def again_without_keeping(package, file) -> bool:
    found = []
    for _ in range(2):
        assert cached_sources(package, lambda: found.append(1) or FOUND, file=file) == FOUND
    return len(found) == 2


def test_sources_that_change_while_they_are_read_are_not_kept(package, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    file = tmp_path / "closures.json"

    def compute() -> PieceSources:
        (package / "one.py").write_text("NAME = 'new'\n", encoding="utf-8")
        return FOUND

    assert cached_sources(package, compute, file=file) == FOUND
    assert not file.exists()


def test_those_in_use_are_those_of_the_sources():
    found = sources_in(own_sources())
    assert {piece: source_of(piece) for piece in ENTRIES} == dict(found.closures)
    assert code_of_trials() == {module: digest[:12] for module, digest in found.modules.items()}


def test_a_second_process_parses_no_source():
    code = (
        "import ast, sys\n"
        "from rgss.trials.code.piece_versions import versions, code_of_trials\n"
        "if sys.argv[1:]: ast.parse = None\n"
        "print(sorted(versions().items()), code_of_trials())"
    )
    first, second = (
        subprocess.run([sys.executable, "-c", code, *words], capture_output=True, text=True, check=True)
        for words in ([], ["without"])
    )
    assert first.stdout == second.stdout
