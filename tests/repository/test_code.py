"""Rules of the code that no linter of ours holds."""

from __future__ import annotations

import ast
import re

LONGEST_FILE = 400
"""Of tests too; test_rooms.py bounds the files of the package more tightly."""
# Without a browser, its tests are skipped, but on a build machine; test_browser_tests.py holds both.
MAY_SKIP = {"tests/browser/conftest.py"}


def test_only_the_command_line_prints(modules, repository):
    prints = [
        f"{path.relative_to(repository)}:{node.lineno}"
        for path in modules
        if not path.is_relative_to(repository / "rgss" / "cli")
        for node in ast.walk(ast.parse(path.read_bytes()))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("print", "input")
    ]

    assert prints == []


# What writes files that no verb delivers: temporary ones, and the new files of a new project.
OWN_WRITERS = {
    "rgss/documents/output_files.py",
    "rgss/physics/engine.py",
    "rgss/exchange/applying.py",
    "rgss/exchange/journal.py",
    "rgss/exchange/project_copy.py",
    "rgss/studies/robot_project/draft.py",
    "rgss/studies/robot_project/drafted_gripper.py",
    "rgss/studies/robot_project/fitting.py",
    "rgss/studies/robot_project/fingers_of_urdf.py",
    "rgss/studies/robot_project/writing.py",
    "rgss/studies/scaffolding.py",
    "rgss/sweep/worker_process.py",
}


def test_every_output_is_written_by_one_mechanism(modules, repository):
    """Files are written within `replaced_file`, which calls its temporary file ``part``."""

    def writes(call):
        name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
        modes = [each.value for each in call.args if isinstance(each, ast.Constant)]
        opens = name in ("open", "fdopen") and any(isinstance(mode, str) and set(mode) & set("wax+") for mode in modes)
        makes = name in ("write_text", "write_bytes", "mkstemp", "NamedTemporaryFile")
        to_part = isinstance(call.func, ast.Attribute) and getattr(call.func.value, "id", "") == "part"
        return (opens or makes) and not to_part

    writers = [
        f"{path.relative_to(repository)}:{node.lineno}"
        for path in modules
        if path.relative_to(repository).as_posix() not in OWN_WRITERS
        for node in ast.walk(ast.parse(path.read_bytes()))
        if isinstance(node, ast.Call) and writes(node)
    ]

    assert writers == []


def test_no_file_is_long(files, repository):
    lengths = {
        str(path.relative_to(repository)): len(path.read_text(encoding="utf-8").splitlines())
        for path in files
        if path.suffix == ".py"
    }

    assert {name: length for name, length in lengths.items() if length > LONGEST_FILE} == {}


def test_every_module_says_what_it_is(modules, repository):
    silent = [
        str(path.relative_to(repository))
        for path in modules
        if path.stat().st_size and not ast.get_docstring(ast.parse(path.read_bytes()))
    ]

    assert silent == []


def test_no_test_is_left_out(files, repository):
    ways_out = {"skip", "skipif", "xfail", "importorskip", "expectedFailure"}
    left_out = [
        f"{path.relative_to(repository)}:{node.lineno}"
        for path in files
        if path.suffix == ".py" and path.is_relative_to(repository / "tests")
        if path.relative_to(repository).as_posix() not in MAY_SKIP
        for node in ast.walk(ast.parse(path.read_bytes()))
        if isinstance(node, ast.Attribute) and node.attr in ways_out
    ]

    assert left_out == []


def test_nothing_names_a_machine_or_a_registry(files, repository):
    folders = "|".join(["work", "root", "home", "opt"])
    hosts = "|".join(["files.python" + "hosted", "py" + "pi[.]org"])
    pattern = re.compile(rf"(?<![\w.*/-])/(?:{folders})/|{hosts}")
    named = [
        f"{path.relative_to(repository)}:{number}"
        for path in files
        for number, line in enumerate(path.read_bytes().decode("utf-8", errors="replace").splitlines(), start=1)
        if pattern.search(line)
    ]

    assert named == []
