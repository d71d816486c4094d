"""What a verb prints goes through one place, where nothing of it can steer a terminal."""

from __future__ import annotations

import ast
import io
import json
import sys
from pathlib import Path

import pytest

from rgss.cli import main as main_module
from rgss.cli.main import main
from rgss.cli.output import print_lines
from rgss.cli.safe_output import data_stream, own_stream, safe_output, typeset
from rgss.documents.steering import has_control_characters
from rgss.errors import DefinitionError, SimulationError

HOSTILE = "\x1b]0;owned\x07\x1b[2J\u202eabc\u2066 \x9b31m [bold red]🤖"


@pytest.fixture
def verb(monkeypatch):
    """Lets the verb ``schema`` do something else."""

    def let(handler):
        from rgss.cli.verbs import schema as schema_verb

        monkeypatch.setattr(schema_verb, "run", handler)
        return main(["schema"])

    return let


def test_what_is_printed_steers_nothing_and_json_says_the_same(verb, capsys):
    def handler(options):
        sys.stdout.write(json.dumps({"detail": HOSTILE}, ensure_ascii=False) + "\n")
        sys.stderr.write(f"{HOSTILE}\n")
        sys.stderr.writelines([HOSTILE, "\n"])
        return 0

    assert verb(handler) == 0
    captured = capsys.readouterr()
    assert not has_control_characters(captured.out + captured.err)
    assert json.loads(captured.out) == {"detail": HOSTILE}
    assert captured.err == 2 * ("\\u001b]0;owned\\u0007\\u001b[2J\\u202eabc\\u2066 \\u009b31m [bold red]🤖\n")


@pytest.mark.parametrize("error", [DefinitionError(HOSTILE, hint=HOSTILE), SimulationError(HOSTILE)])
def test_so_it_is_with_complaints(verb, capsys, error):
    def handler(options):
        raise error

    assert verb(handler) in {2, 3}
    assert not has_control_characters(capsys.readouterr().err)


def test_the_streams_are_what_they_were_afterwards(verb):
    before = sys.stdout, sys.stderr
    verb(lambda options: 0)
    assert (sys.stdout, sys.stderr) == before
    with safe_output():
        assert sys.stdout is not before[0]
        assert own_stream(sys.stdout) is before[0]
        assert own_stream(before[0]) is before[0]
    assert (sys.stdout, sys.stderr) == before


def test_the_content_of_a_file_is_as_it_is_but_on_a_terminal(capsys, monkeypatch):
    with safe_output():
        data_stream().write(HOSTILE)
        assert capsys.readouterr().out == HOSTILE
        monkeypatch.setattr(own_stream(sys.stdout), "isatty", lambda: True)
        data_stream().write(HOSTILE)
        assert not has_control_characters(capsys.readouterr().out)


@pytest.fixture
def in_ascii(monkeypatch):
    """Calls something with standard output in ASCII, as in the locale C; returns its result and the output."""

    def call(function):
        stream = io.TextIOWrapper(io.BytesIO(), encoding="ascii", write_through=True)
        with monkeypatch.context() as patched:
            patched.setattr(sys, "stdout", stream)
            result = function()
        return result, stream.detach().getvalue().decode("ascii")

    return call


def test_what_the_encoding_lacks_is_escaped(verb, in_ascii):
    def handler(options):
        sys.stdout.write(json.dumps({"detail": f"a{HOSTILE}…µ"}, ensure_ascii=False))
        return 0

    status, output = in_ascii(lambda: verb(handler))
    assert status == 0
    assert json.loads(output) == {"detail": f"a{HOSTILE}…µ"}


@pytest.mark.parametrize("words", [["--help"], *([name, "--help"] for name in main_module.VERBS)])
def test_help_is_printed_in_ascii(words, in_ascii):
    def ask():
        with pytest.raises(SystemExit) as left:
            main(words)
        return left.value.code

    status, output = in_ascii(ask)
    assert status == 0
    assert "usage: rgss" in output


def test_rules_and_marks_of_a_page_have_signs_of_ascii(verb, in_ascii):
    def handler(options):
        print_lines(["── a–b ≤ 3 × 2 …", "ä"])
        return 0

    assert in_ascii(lambda: verb(handler)) == (0, "-- a-b <= 3 x 2 ...\n\\u00e4\n")
    assert typeset("3 × 2 ── ä", "latin-1") == "3 × 2 -- ä"
    assert typeset("3 × 2 ── ä", "utf-8") == "3 × 2 ── ä"


def test_the_content_of_a_file_is_not_changed_for_an_encoding(verb, in_ascii, capsys):
    def handler(options):
        data_stream().write("5 × 3")
        return 0

    assert in_ascii(lambda: verb(handler)) == (3, "")
    said = "the output has the character '\\xd7', which ascii lacks (write it to a file, or set PYTHONIOENCODING=utf-8)"
    assert capsys.readouterr().err == f"rgss: {said}\n"


def test_no_verb_goes_round_it():
    """Nothing in the command line takes the streams that Python keeps beside these, or their descriptors."""
    found = [
        f"{path.name}:{node.lineno}"
        for path in Path(main_module.__file__).parent.glob("*.py")
        for node in ast.walk(ast.parse(path.read_bytes()))
        if isinstance(node, ast.Attribute) and node.attr in {"__stdout__", "__stderr__", "buffer"}
    ]
    assert found == []
