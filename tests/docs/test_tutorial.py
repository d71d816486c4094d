"""The tutorial, word for word: every command is run, every change is made, every line shown is compared."""

from __future__ import annotations

import itertools
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from contextlib import ExitStack, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

import pytest

from rgss.cli.main import main
from tests.fixtures.processes import PATIENCE_S

REPOSITORY = Path(__file__).parents[2]
PAGE = REPOSITORY / "docs" / "tutorial.md"
INSTALL = ["make setup", "source .venv/bin/activate"]
"""What the build machine does before it runs this test, and what is therefore not run by it."""

_FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_NAMED_FILE = re.compile(r"`([\w./-]+\.yaml)`")
_ELIDED = "…"


@dataclass(frozen=True)
class Step:
    """A fenced block of the page.

    Attributes:
        language: The word behind the fence.
        text: What is in the block.
        before: The paragraph before it, and for a block that follows another one directly, that of the first.
        line: Where it begins.
    """

    language: str
    text: str
    before: str
    line: int


def steps() -> list[Step]:
    page = PAGE.read_text(encoding="utf-8")
    found: list[Step] = []
    end, before = 0, ""
    for match in _FENCE.finditer(page):
        prose = page[end : match.start()].strip()
        before = prose.rpartition("\n\n")[2] if prose else before
        found.append(Step(match[1], match[2], before, page.count("\n", 0, match.start()) + 1))
        end = match.end()
    return found


def commands(block: str) -> list[tuple[str, list[str]]]:
    """Each command of a console block with the lines that are shown under it."""
    found: list[tuple[str, list[str]]] = []
    for line in block.splitlines():
        if line.startswith("$ "):
            found.append((line[2:], []))
        else:
            found[-1][1].append(line)
    return found


def missing_line(shown: list[str], told: list[str]) -> str | None:
    """The first line that is shown and was not told, in this order and with nothing else between; None if all were.

    A line `…` stands for any lines; a line that ends in `…` for any that begin so.
    """
    place, anywhere = 0, False
    for line in shown:
        if line == _ELIDED:
            anywhere = True
            continue
        candidates = range(place, len(told)) if anywhere else range(place, min(place + 1, len(told)))
        beginning = line.removesuffix(_ELIDED).rstrip()
        found = next(
            (n for n in candidates if (told[n].startswith(beginning) if line.endswith(_ELIDED) else told[n] == line)),
            None,
        )
        if found is None:
            return line
        place, anywhere = found + 1, False
    return None if anywhere or place == len(told) or not shown else f"(more than is shown: {told[place]!r})"


def changed(text: str, change: str) -> str:
    """A text after a change as a diff shows it, whose old lines stand in the text exactly once."""
    lines = change.splitlines()
    assert all(line[:1] in ("+", "-", " ") for line in lines), change
    old = "".join(f"{line[1:]}\n" for line in lines if line[0] != "+")
    new = "".join(f"{line[1:]}\n" for line in lines if line[0] != "-")
    assert old
    places = [match.start() for match in re.finditer(rf"^(?={re.escape(old)})", text, re.MULTILINE)]
    assert len(places) == 1, f"stands not exactly once in the file: {old}"
    return text[: places[0]] + new + text[places[0] + len(old) :]


class Reader:
    """Who follows the page."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._state = folder / ".reader-is-in"

    def run(self, command: str) -> tuple[int, list[str]]:
        """Run a command as a shell would that goes on from the last one; one of rgss alone in this process."""
        if re.match(r"rgss [^;|>$]*$", command):
            return self._run_here(shlex.split(command)[1:])
        scripts = Path(sys.executable).parent
        environment = {**os.environ, "PATH": f"{scripts}{os.pathsep}{os.environ['PATH']}", "LC_ALL": "C.UTF-8"}
        wrapped = f'{command}\nstatus=$?; pwd > "{self._state}"; exit $status'
        done = subprocess.run(
            ["bash", "-c", wrapped],
            cwd=self.folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
            check=False,
            timeout=PATIENCE_S,
        )
        self.folder = Path(self._state.read_text(encoding="utf-8").strip())
        return done.returncode, [line.rstrip() for line in done.stdout.splitlines()]

    def _run_here(self, words: list[str]) -> tuple[int, list[str]]:
        """Run the command line in this process, which has imported what each process has to import."""
        with ExitStack() as stack:
            stack.callback(os.chdir, Path.cwd())
            os.chdir(self.folder)
            file = stack.enter_context(tempfile.TemporaryFile("w+", encoding="utf-8", buffering=1))
            # What the engines write goes to the descriptors, and what Python writes to the streams.
            for descriptor in (1, 2):
                kept = os.dup(descriptor)
                stack.callback(os.close, kept)
                stack.callback(os.dup2, kept, descriptor)
                os.dup2(file.fileno(), descriptor)
            for redirect in (redirect_stdout, redirect_stderr):
                stack.enter_context(redirect(file))
            status = main(words)
            file.flush()
            size = os.fstat(file.fileno()).st_size
            said = os.pread(file.fileno(), size, 0).decode("utf-8")
        return status, [line.rstrip() for line in said.splitlines()]

    def change(self, step: Step) -> None:
        """Make the change that a block shows to the file that is named before it."""
        path = self.folder / _NAMED_FILE.findall(step.before)[-1]
        text = path.read_text(encoding="utf-8")
        if step.language == "yaml":
            assert "At the end of" in " ".join(step.before.split())
            path.write_text(text + step.text, encoding="utf-8")
        else:
            path.write_text(changed(text, step.text), encoding="utf-8")


def verdicts(page: list[str]) -> dict[str, dict[str, str]]:
    """What `rgss measure` prints below the counts of verdicts: each variant's cells by the head of their columns."""
    begin = next(number for number, line in enumerate(page) if re.match(r"\s*variant {2,}", line))
    table = itertools.takewhile(str.strip, page[begin:])
    head, _, *rows = ([cell.strip() for cell in re.split(r" {2,}", line.strip())] for line in table)
    return {row[0]: dict(zip(head, row, strict=True)) for row in rows}


@pytest.mark.engine
def test_the_tutorial_word_for_word(tmp_path):
    clone = tmp_path / "rgss"
    clone.mkdir()
    reader = Reader(clone)
    for step in steps():
        if step.language == "console":
            for command, shown in commands(step.text):
                if command in INSTALL:
                    assert shown == []
                    continue
                status, told = reader.run(command)
                place = f"docs/tutorial.md:{step.line}: {command}"
                said = "\n".join(told)
                assert status == 0, f"{place}\n{said}"
                assert missing_line(shown, told) is None, f"{place}\n{said}"
        else:
            assert step.language in ("diff", "yaml"), step.line
            reader.change(step)

    assert reader.folder == tmp_path / "my_project"
    assert [path.name for path in clone.iterdir()] == [".reader-is-in"]
    assert (reader.folder / "jug.png").read_bytes().startswith(b"\x89PNG")
    page = " ".join(PAGE.read_text(encoding="utf-8").split())
    _, told = reader.run("rgss measure --json")
    value = {(entry["variant"], entry["measure"]): entry["value"] for entry in json.loads("\n".join(told))}
    assert f"payload of {value[2, 'payload']:.2f} kg violates your requirement" in page
    assert f"variants 3 and 4 hold {value[4, 'payload']:.2f} kg" in page
    assert f"cost {value[4, 'cost'] - value[6, 'cost']:.0f} USD more than your gripper" in page
    assert f"The {value[6, 'payload']:.2f} kg of your gripper do not meet 1.2 kg" in page
    assert value[2, "cost"] < value[6, "cost"]
    assert value[4, "task_time"] > value[6, "task_time"]
    first, more = (verdicts(reader.run(f"rgss measure{words}")[1]) for words in (" --replicates 2", ""))
    few, many = (re.search(r"\((.*)\)", table["6"]["task_time [s]"])[1] for table in (first, more))
    assert f"task time was {few} s and is now {many} s." in page
    for requirement in ("SYS-2", "SYS-3"):
        assert {row[requirement] for row in (*first.values(), *more.values())} == {"inconclusive"}
    assert "1 better variant is infeasible: SYS-5 (1)." in reader.run("rgss trade --section --replicates 2")[1]
    assert max(float(row["success [1]"].split()[0]) for row in more.values()) == 1.0


def test_the_installation_is_what_the_build_machine_does():
    first = commands(steps()[0].text)
    setup = subprocess.run(
        ["make", "-n", "check"], cwd=REPOSITORY, capture_output=True, text=True, check=False, env={**os.environ}
    )

    assert [command for command, _ in first] == INSTALL
    assert setup.returncode == 0
    assert "make check" in (REPOSITORY / ".ci" / "run").read_text(encoding="utf-8")
    assert re.search(r"^check:.*\bsetup\b|^check:.*\.venv", (REPOSITORY / "Makefile").read_text(), re.MULTILINE)


def test_every_block_is_followed():
    languages = [step.language for step in steps()]

    assert set(languages) == {"console", "diff", "yaml"}
    assert len(languages) == PAGE.read_text(encoding="utf-8").count("\n```") / 2


@pytest.mark.parametrize(
    ("shown", "told", "missing"),
    [
        (["a", "b"], ["a", "b"], None),
        ([], ["a"], None),
        (["a", "…"], ["a", "b"], None),
        (["…", "b"], ["a", "b"], None),
        (["a…"], ["abc"], None),
        (["b"], ["a", "b"], "b"),
        (["a", "…", "a"], ["a", "b"], "a"),
        (["a"], ["a", "b"], "(more than is shown: 'b')"),
        (["a", "b"], ["a"], "b"),
    ],
)
def test_lines_are_compared(shown, told, missing):
    assert missing_line(shown, told) == missing


def test_a_change_needs_its_place():
    assert changed("a\nb\nc\n", " a\n-b\n+B\n") == "a\nB\nc\n"
    with pytest.raises(AssertionError, match="not exactly once"):
        changed("a\na\n", "-a\n+b\n")
    with pytest.raises(AssertionError, match="not exactly once"):
        changed("aa\n", "-a\n+b\n")
