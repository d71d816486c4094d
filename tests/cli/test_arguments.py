"""What stands on the command line: help, and complaints of one line."""

from __future__ import annotations

import re

import pytest

from rgss.cli.command_parser import BAD_INPUT
from rgss.cli.main import CLEAN, FINDINGS, INTERRUPTED, RUN_FAILED, VERBS
from rgss.cli.verbs import regress, replay
from tests.fixtures.shipped_project import REPOSITORY


def test_help(rgss):
    told = rgss("--help")

    assert (told.status, told.errors) == (0, "")
    assert all(f"\n    {verb}{end}" in told.output for verb in VERBS for end in [" " if len(verb) < 9 else "\n"])
    assert "Exit status: 0 clean, 1 findings" in " ".join(told.output.split())


@pytest.mark.parametrize("name", ["--help", "docs/commands.md"])
def test_every_exit_status_is_in_the_general_list(rgss, name):
    text = rgss("--help").output if name == "--help" else (REPOSITORY / name).read_text(encoding="utf-8")
    (line,) = re.findall(r"Exit status: (.*? interrupted)", " ".join(text.split()))
    listed = {int(number) for number in re.findall(r"(?:^|, )(\d+) ", line)}

    general = {CLEAN, FINDINGS, BAD_INPUT, RUN_FAILED, INTERRUPTED}
    assert listed == general | {regress.CHANGED, replay.WITHIN_TOLERANCE}


@pytest.mark.parametrize("verb", VERBS)
def test_help_of_a_verb(rgss, verb):
    told = rgss(verb, "--help")

    assert (told.status, told.errors) == (0, "")
    assert told.output.startswith(f"usage: rgss {verb} ")
    assert f"examples:\n  rgss {verb}" in told.output
    assert "--project DIR" in told.output
    assert "--json" in told.output


def test_version(rgss):
    told = rgss("--version")

    assert told.status == 0
    assert told.output.startswith("rgss ")


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["decide"], "rgss: argument VERB: invalid choice: 'decide' (choose from "),
        (["tradee"], "rgss: argument VERB: invalid choice: 'tradee' (did you mean 'trade'?) (see 'rgss --help')"),
        (["sweep", "--replicate=3", "--fidelty=contact"], "rgss sweep: unrecognized arguments: --fidelty=contact (did"),
        (["schema", "gripers"], "rgss schema: argument DOCUMENT: invalid choice: 'gripers' (did you mean 'gripper'?)"),
        (["check", "a.yaml", "b.yaml"], "rgss check: unrecognized arguments: b.yaml (see 'rgss check --help')"),
        (["run"], "rgss run: the following arguments are required: ID (see 'rgss run --help')"),
        (["run", "first"], "rgss run: argument ID: must be a whole number, got 'first' (see 'rgss run --help')"),
        (["variants", "--format", "xml"], "rgss variants: argument --format: invalid choice: 'xml' (choose from"),
        (
            ["sweep", "--jobs", "all"],
            "rgss sweep: argument --jobs: must be a whole number, got 'all' (see 'rgss sweep --help')",
        ),
        (["measure", "--fidelity", "high"], "rgss measure: argument --fidelity: invalid choice: 'high' (choose from"),
        (["check", "--x\ny"], "rgss check: unrecognized arguments: --x y (see 'rgss check --help')"),
        (["export", "csv", "-o", "a", "b.yaml", "c.yaml"], "rgss export: unrecognized arguments: b.yaml c.yaml (see"),
    ],
)
def test_words_that_are_not_understood(rgss, words, complaint):
    told = rgss(*words)

    assert (told.status, told.output) == (2, "")
    assert told.complaint.startswith(complaint)


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["run", "0"], "unknown variant 0 (ids of variants: from 1 to 72)"),
        (["run", "73"], "unknown variant 73 (ids of variants: from 1 to 72)"),
        (["run", "65", "--seed=-1"], "--seed must be from 0 to 2147483647, got -1 (omit it for the study's first)"),
        (
            ["run", "65", "--seed=2147483648"],
            "--seed must be from 0 to 2147483647, got 2147483648 (omit it for the study's first)",
        ),
        (["sweep", "--replicates=0"], "--replicates must be from 1 to 10000, got 0 (omit it for the study's number)"),
        (["sweep", "--replicates=10001"], "--replicates must be from 1 to 10000, got 10001 (omit it for the study's"),
        (["measure", "--replicates=0"], "--replicates must be from 1 to 10000, got 0 (omit it for the study's"),
        (["trade", "--replicates=-3"], "--replicates must be from 1 to 10000, got -3 (omit it for the study's"),
        (["sweep", "--jobs=0"], "--jobs must be at least 1 (omit it for one process a core)"),
        (["sweep", "--only=x"], "--only: 'x' is not an id or a range (write ids such as 1,5,60-72)"),
        (["sweep", "--only="], "--only: '' is not an id or a range (write ids such as 1,5,60-72)"),
        (["sweep", "--only=1,,2"], "--only: '' is not an id or a range (write ids such as 1,5,60-72)"),
        (["sweep", "--only=-5"], "--only: '-5' is not an id or a range (write ids such as 1,5,60-72)"),
        (["sweep", "--only=²"], "--only: '²' is not an id or a range (write ids such as 1,5,60-72)"),
        (["sweep", "--only=0"], "--only: unknown variant 0 (ids go from 1 to 72)"),
        (["sweep", "--only=73"], "--only: unknown variant 73 (ids go from 1 to 72)"),
        (["sweep", "--only=70-99999999999"], "--only: unknown variant 73 (ids go from 1 to 72)"),
        (["sweep", "--only=5-1"], "--only: unknown variant 5-1 (ids go from 1 to 72)"),
        (["measure"], "there is no evidence in "),
        (["trade"], "there is no evidence in "),
        (["measure", "--variant=99"], "unknown variant 99 (ids of variants: from 1 to 72)"),
    ],
)
def test_numbers_that_are_impossible(rgss, untouched, words, complaint):
    told = rgss(*words, "--project", untouched)

    assert (told.status, told.output) == (2, "")
    assert told.complaint.startswith(f"rgss: {complaint}")
    assert not (untouched / ".rgss").exists()


def test_no_project(rgss, tmp_path, monkeypatch):
    told = rgss("check", "--project", tmp_path / "nowhere")
    assert (told.status, told.output) == (2, "")
    assert "is not a project: it has no folder requirements/ (a project has requirements/," in told.complaint

    monkeypatch.chdir(tmp_path)
    assert rgss("variants").complaint == (
        "rgss: no project here or above (go into a project or name it with --project DIR)"
    )


@pytest.mark.parametrize("study", ["studies/none.yaml", "x" * 5000, "scenes"])
def test_a_study_that_is_not_there(rgss, untouched, study):
    told = rgss("variants", study, "--project", untouched)

    assert (told.status, told.output) == (2, "")
    assert ":1:1: error: " in told.complaint


def test_the_study_may_stand_after_the_options(rgss, folder, tmp_path):
    (folder / "studies" / "other.yaml").write_bytes(
        (folder / "studies" / "pick_place.yaml").read_bytes().replace(b"study: pick_place", b"study: other", 1)
    )
    before = rgss("export", "sysml", "studies/other.yaml", "--project", folder, "-o", tmp_path / "before.sysml")
    after = rgss("export", "sysml", "--project", folder, "-o", tmp_path / "after.sysml", "studies/other.yaml")
    without = rgss("export", "sysml", "--project", folder, "-o", tmp_path / "without.sysml")

    assert [told.status for told in (before, after, without)] == [0, 0, 0]
    assert (tmp_path / "before.sysml").read_bytes() == (tmp_path / "after.sysml").read_bytes()
    assert (tmp_path / "without.sysml").read_bytes() != (tmp_path / "after.sysml").read_bytes()
    missing = rgss("export", "sysml", "--project", folder, "-o", tmp_path / "none.sysml", "studies/none.yaml")
    assert missing.complaint.startswith("studies/none.yaml:1:1: error: no such file")


def test_a_study_that_has_not_the_default_name_is_to_be_named(rgss, folder):
    (folder / "studies" / "pick_place.yaml").rename(folder / "studies" / "serving.yaml")
    told = rgss("variants", "--project", folder)

    assert (told.status, told.output) == (2, "")
    assert told.complaint == (
        "rgss: the project has no studies/pick_place.yaml, which is the default "
        f"(name the study, such as studies/{min(path.name for path in (folder / 'studies').glob('*.yaml'))})"
    )
    assert rgss("variants", "studies/serving.yaml", "--project", folder).status == 0


def test_a_study_is_meant_by_its_name(rgss, folder):
    by_file = rgss("variants", "studies/straight_moves.yaml", "--project", folder)
    by_name = rgss("variants", "straight_moves", "--project", folder)
    assert (by_name.status, by_name.output) == (0, by_file.output)
    told = rgss("variants", "straight_mvs", "--project", folder)
    assert (told.status, told.complaint) == (
        2,
        "rgss: there is no study 'straight_mvs' (did you mean 'straight_moves'?)",
    )
    far = rgss("variants", "zzz", "--project", folder)
    assert far.complaint.startswith("rgss: there is no study 'zzz' (studies: ")


def test_a_study_that_is_a_circle_of_links_is_not_its_own_suggestion(rgss, folder):
    (folder / "studies" / "self.yaml").symlink_to("self.yaml")
    told = rgss("variants", "self", "--project", folder)

    assert told.status == 2
    assert told.complaint.startswith("studies/self.yaml:1:1: error: cannot be read: Too many levels of symbolic links")


def test_the_only_study_needs_no_name(rgss, folder):
    for path in (folder / "studies").glob("*.yaml"):
        if path.name != "straight_moves.yaml":
            path.unlink()
    assert rgss("variants", "--project", folder).status == 0
    (folder / "studies" / "straight_moves.yaml").unlink()
    told = rgss("variants", "--project", folder)
    assert told.complaint.startswith("studies/pick_place.yaml:1:1: error: no such file")
