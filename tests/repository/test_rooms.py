"""Sizes of folders, files and functions, and the front door of every package.

What is larger than its bound and should be has a comment with the reason: ``# long file: …`` among the first lines
of the file, ``# long function: …`` on the line above the function.
"""

from __future__ import annotations

import ast
import re
from collections import Counter

import pytest

MOST_FILES = 25
LONGEST_FILE = 300
LONGEST_FUNCTION = 60
"""Lines of code; the docstring is not counted."""

NO_FRONT_DOOR = {
    "rgss/cli": "a program, of which nothing is imported",
    "rgss/cli/verbs": "its modules are loaded by the names of the verbs",
}

_FILE_MARK = re.compile(r"^# long file: \w.+", re.MULTILINE)
_FUNCTION_MARK = re.compile(r"^\s*# long function: \w.+")


def too_long(lengths: dict[str, int], bound: int) -> dict[str, int]:
    """Entries that are longer than the bound."""
    return {name: length for name, length in lengths.items() if length > bound}


def lengths_of_functions(text: str) -> dict[str, int]:
    """The lines of each function that has no mark, without its docstring."""
    lines, lengths = text.splitlines(), {}
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            first = min(each.lineno for each in (node, *node.decorator_list))
            if first > 1 and _FUNCTION_MARK.match(lines[first - 2]):
                continue
            described = node.body[0] if ast.get_docstring(node) is not None else None
            length = node.end_lineno - node.lineno + 1
            lengths[node.name] = length - (described.end_lineno - described.lineno + 1 if described else 0)
    return lengths


@pytest.mark.parametrize("root", ["rgss", "tests"])
def test_no_folder_has_many_files(files, repository, root):
    python = [path for path in files if path.suffix == ".py" and path.is_relative_to(repository / root)]
    counts = Counter(str(path.parent.relative_to(repository)) for path in python)

    assert {name: count for name, count in counts.items() if count > MOST_FILES} == {}


def test_no_file_is_long_without_a_reason(modules, repository):
    texts = {path.relative_to(repository).as_posix(): path.read_text(encoding="utf-8") for path in modules}
    lengths = {name: len(text.splitlines()) for name, text in texts.items() if not _FILE_MARK.search(text)}

    assert too_long(lengths, LONGEST_FILE) == {}


def test_no_function_is_long_without_a_reason(modules, repository):
    lengths = {
        f"{path.relative_to(repository).as_posix()}:{name}": length
        for path in modules
        for name, length in lengths_of_functions(path.read_text(encoding="utf-8")).items()
    }

    assert too_long(lengths, LONGEST_FUNCTION) == {}


def test_a_function_is_measured_without_its_docstring_and_may_be_marked():
    body = "    x = 1\n" * 59
    assert lengths_of_functions(f'def f():\n    """One.\n\n    Two.\n    """\n{body}') == {"f": 60}
    assert lengths_of_functions(f"def f():\n{body}    return x\n") == {"f": 61}
    assert lengths_of_functions(f"# long function: a table\n@cached\ndef f():\n{body}") == {}
    assert lengths_of_functions(f"# long function:\ndef f():\n{body}") == {"f": 60}


def test_every_package_has_a_docstring_and_a_front_door(modules, repository):
    folders = sorted({path.parent for path in modules})
    closed = []
    for folder in folders:
        name, door = folder.relative_to(repository).as_posix(), folder / "__init__.py"
        tree = ast.parse(door.read_bytes()) if door.exists() else ast.Module(body=[], type_ignores=[])
        exports = any(isinstance(node, (ast.ImportFrom, ast.FunctionDef)) for node in ast.walk(tree))
        if not ast.get_docstring(tree) or not (name in NO_FRONT_DOOR or exports):
            closed.append(name)

    assert closed == []
