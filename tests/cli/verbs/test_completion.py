"""Shell completion, asked of bash itself."""

from __future__ import annotations

import shlex
import subprocess
import sys

import pytest

from rgss.cli.main import VERBS
from rgss.cli.verbs.completion import SHELLS

ASK = """
source "$1"
shift
spec=$(complete -p rgss)
[[ $spec =~ -F\\ ([^ ]+) ]]
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
COMP_LINE="$*"
COMP_POINT=${#COMP_LINE}
"${BASH_REMATCH[1]}" rgss "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
printf '%s\\n' "${COMPREPLY[@]}"
"""


@pytest.fixture
def completed(rgss, tmp_path):
    """What bash offers for the last of some words."""
    told = rgss("completion", "bash")
    assert (told.status, told.errors) == (0, "")
    script = tmp_path / "rgss.bash"
    script.write_text(told.output, encoding="utf-8")
    inside = tmp_path / "inside"
    (inside / "folder").mkdir(parents=True)
    (inside / "file.html").write_text("")

    def ask(*words: str) -> set[str]:
        answer = subprocess.run(
            ["bash", "--norc", "-c", ASK, "ask", script, *words],
            cwd=inside,
            capture_output=True,
            text=True,
            check=True,
        )
        assert answer.stderr == ""
        return {word.strip() for word in answer.stdout.splitlines() if word.strip()}

    return ask


def test_verbs(completed):
    assert set(VERBS) <= completed("rgss", "")
    assert {verb for verb in VERBS if verb.startswith("tra")} == completed("rgss", "tra")


def test_options_of_a_verb(completed):
    offered = completed("rgss", "sweep", "--")

    assert {"--fidelity", "--replicates", "--only", "--dry-run", "--project", "--json"} <= offered
    assert "--what-if" not in offered
    assert completed("rgss", "sweep", "--rep") == {"--replicates"}


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        (["sweep", "--fidelity", ""], {"kinematic", "dynamic", "contact"}),
        (["run", "--fidelity", "k"], {"kinematic"}),
        (["variants", "--format", ""], {"table", "csv", "json"}),
        (["schema", "g"], {"gripper"}),
        (["completion", ""], set(SHELLS)),
        (["evidence", "ex"], {"export"}),
        (["export", "re"], {"reqif"}),
        (["sweep", "--until", ""], {"decided"}),
    ],
)
def test_choices(completed, words, offered):
    assert completed("rgss", *words) == offered


def test_files_and_folders(completed):
    assert completed("rgss", "trace", "-o", "fi") == {"file.html"}
    assert completed("rgss", "check", "--project", "f") in ({"folder"}, {"folder/"})


@pytest.mark.parametrize("shell", SHELLS)
def test_a_script_for_each_shell(rgss, shell):
    told = rgss("completion", shell)

    assert (told.status, told.errors) == (0, "")
    assert "--fidelity" in told.output or "fidelity" in told.output
    assert told.output == rgss("completion", shell).output
    document = rgss("completion", shell, "--json").document
    assert document == {"shell": shell, "script": told.output.removesuffix("\n")}


def test_the_script_is_that_of_a_process_of_its_own(rgss, rgss_process):
    assert rgss_process("completion", "bash").stdout == rgss("completion", "bash").output


def test_a_shell_that_is_not_there(rgss):
    told = rgss("completion", "csh")

    assert (told.status, told.output) == (2, "")
    assert told.complaint.startswith("rgss completion: argument SHELL: invalid choice: 'csh' (choose from")


def test_a_project_has_no_part_in_it(rgss):
    told = rgss("completion", "zsh", "--project", "x")

    assert told.status == 2
    assert told.complaint == "rgss: --project has no effect on completion (rgss completion zsh)"


def test_without_the_package(rgss, monkeypatch):
    monkeypatch.setitem(sys.modules, "shtab", None)
    told = rgss("completion", "bash")

    assert (told.status, told.output) == (2, "")
    assert told.complaint == f"rgss: completion needs shtab (run {shlex.quote('pip install shtab')})"
