"""What README.md and docs/ name is there: commands, options, targets of make, files."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rgss.cli.main import main

REPOSITORY = Path(__file__).resolve().parents[2]
PAGES = [REPOSITORY / "README.md", *sorted((REPOSITORY / "docs").glob("**/*.md"))]
FOLDERS = ["rgss", "tests", "docs", "requirements", "designs", "scenes", "studies", "benchmarks", ".ci"]

_FENCED = re.compile(r"^```[a-z]*\n(.*?)^```", re.MULTILINE | re.DOTALL)
_SPAN = re.compile(r"`([^`\n]+)`")
_COMMAND = re.compile(r"(?:^|[\s/])rgss ([a-z][a-z-]*)(?![a-z-]*[=.:])([^|;&#\n`]*)")
_LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")


def code_of(page: Path) -> list[str]:
    """The lines of fenced blocks, and the code spans outside of them."""
    text = page.read_text(encoding="utf-8")
    blocks = [line for block in _FENCED.findall(text) for line in block.splitlines()]
    return blocks + _SPAN.findall(_FENCED.sub("", text))


def named_commands() -> dict[str, set[str]]:
    """Each verb of the command line that a page names, with the options that it is given."""
    named: dict[str, set[str]] = {}
    for page in PAGES:
        for code in code_of(page):
            for verb, rest in _COMMAND.findall(code):
                named.setdefault(verb, set()).update(re.findall(r"(?<![\w-])--[a-z][a-z-]*", rest))
    return named


def test_the_main_job_is_in_the_first_screen_of_the_readme():
    first_screen = "\n".join(PAGES[0].read_text(encoding="utf-8").splitlines()[:40])

    assert "make study" in first_screen
    assert "make test" in first_screen


def test_commands_and_their_options_exist(capsys):
    missing = []
    for verb, options in sorted(named_commands().items()):
        with pytest.raises(SystemExit) as end:
            main([verb, "--help"])
        helped = capsys.readouterr().out
        known = set(re.findall(r"--[a-z][a-z-]*", helped)) if end.value.code == 0 else set()
        missing += [f"rgss {verb} {option}".strip() for option in sorted(options or {""}) if option not in {*known, ""}]
        missing += [f"rgss {verb}"] if end.value.code else []

    assert missing == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_targets_of_make_exist(page):
    targets = set(re.findall(r"^([a-z]+):", (REPOSITORY / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    named = {target for code in code_of(page) for target in re.findall(r"^(?:\$ )?make ([a-z]+)\b", code)}

    assert sorted(named - targets) == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_files_exist(page):
    links = [(page.parent, target) for target in _LINK.findall(page.read_text(encoding="utf-8")) if "://" not in target]
    folders = "|".join(map(re.escape, FOLDERS))
    # The files that the tutorial names are those of the project that its reader makes; its own test makes it.
    codes = [] if page.name == "tutorial.md" else code_of(page)
    paths = [
        (REPOSITORY, path)
        for code in codes
        for path in re.findall(rf"(?<![\w./-])(?:{folders})/[\w./*-]*(?![\w<{{])", code)
    ]
    missing = [
        target
        for base, target in [*links, *paths]
        if not (any(base.glob(target)) if "*" in target else (base / target).exists())
    ]

    assert missing == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_tables_begin_after_an_empty_line(page):
    lines = ["", *page.read_text(encoding="utf-8").splitlines()]
    rules = [number for number, line in enumerate(lines) if re.fullmatch(r"\|[-| :]+\|", line)]

    assert [lines[number - 1] for number in rules if not lines[number - 1].startswith("|")] == []
    assert [lines[number - 2] for number in rules if lines[number - 2].strip()] == []
