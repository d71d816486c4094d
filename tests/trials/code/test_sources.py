"""The code that a piece depends on: found from imports, and held against what really runs."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest

from rgss.trials.code.code_fingerprint import SourceTree, own_sources
from rgss.trials.code.piece_versions import ENGINES, ENTRIES, code_of_trials, source_of

REPOSITORY = Path(__file__).parents[3]

MAKE_AND_WATCH = """
import json, os, sys
from pathlib import Path
from rgss.evidence import PieceKind
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.trials.pieces.pieces import TrialTask, make_piece, record_of, tasks_of
from rgss.trials.pieces.run import make
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.code.piece_versions import versions

ran, made, opened, watching = {}, {}, set(), []

def audit(event, arguments):
    if event == "open" and watching and isinstance(arguments[0], (str, bytes, os.PathLike)):
        opened.add(os.fsdecode(arguments[0]))

sys.addaudithook(audit)

def watched(name, function, *arguments):
    files = ran.setdefault(name, set())
    # A frame begins to run; the body of a module, which is only defined by it, is called <module>.
    note = lambda frame, event, _: files.add(frame.f_code.co_filename) if frame.f_code.co_name != "<module>" else None
    watching.append(name)
    sys.settrace(note)
    try:
        return function(*arguments)
    finally:
        sys.settrace(None)
        watching.clear()

for fidelity in ("kinematic", "dynamic", "contact"):
    project = load_project(Path(sys.argv[1])).with_fidelity(fidelity)
    (spec,) = trial_specs(project, variants=[project.designs.variant(65)], seeds=[1])
    pieces = {}
    for task in tasks_of(spec, digests_of(spec, versions())):
        made[task.digest] = pieces[task.kind] = watched(f"{task.kind.value} of {fidelity}", make_piece, task, made)
    watched(f"record of {fidelity}", record_of, spec, pieces)
    alone = TrialTask(digest="0" * 64, spec=spec)
    watched(f"trial of {fidelity}", make, alone, {})
print(json.dumps({"ran": {name: sorted(files) for name, files in ran.items()}, "opened": sorted(opened)}))
"""


@pytest.fixture
def package(tmp_path):
    """Writes the modules of a package and reads its sources."""

    def write(**modules: str) -> SourceTree:
        for name, text in modules.items():
            file = (tmp_path / "pack").joinpath(*name.split("__")).with_suffix(".py")
            file.parent.mkdir(parents=True, exist_ok=True)
            (file.parent / "__init__.py").touch()
            file.write_text(text, encoding="utf-8")
        return SourceTree(tmp_path / "pack")

    return write


def room(package, init: str) -> SourceTree:
    """A package with one room whose ``__init__`` is as given, and a module that takes a name from it."""
    tree = package(
        entry="from pack.room import wanted",
        room__wanted="from pack import base\nwanted = 1",
        room__other="import numpy\nother = 2",
        base="",
    )
    (tree._folder / "room" / "__init__.py").write_text(init, encoding="utf-8")
    return tree


def test_a_package_that_only_hands_on_is_followed_name_by_name(package):
    init = (
        '"""A room."""\nfrom pack.room.other import other\nfrom pack.room.wanted import wanted\n__all__ = ["other"]\n'
    )
    closure = room(package, init).closure_of(["pack.entry"])

    # The submodule ``wanted`` is what the name stands for in any case.
    assert closure.modules == ("pack.base", "pack.entry", "pack.room.wanted")
    assert closure.foreign == ()


def test_a_name_that_is_handed_on_under_another_one_is_followed(package):
    tree = package(
        entry="from pack import renamed",
        inner__part="value = 1",
        inner__unused="import scipy",
    )
    (tree._folder / "inner" / "__init__.py").write_text(
        "from pack.inner.part import value as given\nfrom pack.inner.unused import x\n", encoding="utf-8"
    )
    (tree._folder / "__init__.py").write_text("from pack.inner import given as renamed\n", encoding="utf-8")

    assert tree.closure_of(["pack.entry"]).modules == ("pack.entry", "pack.inner.part")


@pytest.mark.parametrize(
    "init",
    [
        "from pack.room.other import other\nfrom pack.room.wanted import *\n",
        "from pack.room.other import other\nshared = {}\n",
        "from pack.room.other import other\ndef missing(): ...\n",
    ],
)
def test_a_package_that_does_more_counts_with_all_that_it_imports(package, init):
    tree = room(package, init)
    (tree._folder / "entry.py").write_text("from pack.room import missing", encoding="utf-8")
    closure = tree.closure_of(["pack.entry"])

    assert {"pack.room", "pack.room.other"} <= {*closure.modules}
    assert closure.foreign == ("numpy",)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("import pack.base", {"pack.base"}),
        ("import pack.base as short", {"pack.base"}),
        ("from pack import base", {"pack.base"}),
        ("from . import base", {"pack.base"}),
        ("from .base import value", {"pack.base"}),
        ("def load():\n    from pack.base import value", {"pack.base"}),
        ("class A:\n    def load(self):\n        if True:\n            import pack.base", {"pack.base"}),
        ("try:\n    import pack.base\nexcept ImportError:\n    import pack.spare", {"pack.base", "pack.spare"}),
        ("import os.path\nfrom __future__ import annotations", set()),
        ("from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from pack.base import value", set()),
        ("import typing\nif typing.TYPE_CHECKING:\n    import pack.base\nelse:\n    import pack.spare", {"pack.spare"}),
        ("from pack.base import value\nimport pack.entry", {"pack.base"}),
    ],
)
def test_every_form_of_import_is_followed(package, text, expected):
    closure = package(entry=text, base="value = 1", spare="").closure_of(["pack.entry"])

    assert {*closure.modules} == {"pack.entry", *expected}
    assert closure.foreign == ()


def test_a_relative_import_in_a_room_is_followed(package):
    tree = package(room__entry="from .near import a\nfrom ..base import b\nimport scipy.linalg", room__near="", base="")
    closure = tree.closure_of(["pack.room.entry"])

    assert closure.modules == ("pack.base", "pack.room.entry", "pack.room.near")
    assert closure.foreign == ("scipy",)


def test_the_digest_is_of_the_texts_and_not_of_line_ends_or_the_rest(package):
    def digest(**modules):
        return package(**{"entry": "import pack.base", "base": "a = 1\n", "aside": "", **modules}).closure_of(
            ["pack.entry"]
        )

    first = digest()
    assert digest(aside="b = 2").digest == first.digest
    assert digest(base="a = 2\n").digest != first.digest
    tree = package()
    (tree._folder / "base.py").write_bytes(b"a = 1\r\n")
    assert tree.closure_of(["pack.entry"]).digest == first.digest


def test_a_module_that_is_not_there_is_an_error(package):
    with pytest.raises(ModuleNotFoundError, match=r"there is no module pack\.gone"):
        package(entry="").closure_of(["pack.gone"])


@pytest.fixture(scope="module")
def watched(project):
    """What ran and was opened while each piece was made, in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", MAKE_AND_WATCH, str(project.folder)], capture_output=True, text=True, check=True
    )
    return json.loads(done.stdout.splitlines()[-1])


@pytest.fixture(scope="module")
def ran(watched):
    """The modules of this package whose functions ran while each piece was made at each fidelity."""
    return {name: {found for file in files if (found := module_of(file))} for name, files in watched["ran"].items()}


def module_of(file: str) -> str | None:
    path = Path(file)
    if not path.is_relative_to(REPOSITORY / "rgss"):
        return None
    return ".".join(path.relative_to(REPOSITORY).with_suffix("").parts)


# What works out by which digest a trial that shares nothing keeps its pieces, while it is run: each value is one.
DIGESTING = {
    "rgss.documents.digests",
    "rgss.trials.pieces.plain_values",
    "rgss.trials.code.closure_cache",
    "rgss.trials.code.code_fingerprint",
    "rgss.trials.pieces.input_digests",
    "rgss.trials.pieces.scene_digests",
    "rgss.trials.code.canonical_syntax",
    # Whether a trial has a bench, and which, is an input of its digest.
    "rgss.trials.payload_bench.of_trial",
    "rgss.trials.code.piece_versions",
    "rgss.engines",
}
BEFORE = {"timing": ["plan"], "execution": ["plan", "timing"], "record": ["plan", "timing", "execution"]}


def covered_by(piece: str) -> set[str]:
    """The modules in the digest of a piece, which covers those that it is made from."""
    return {module for name in (piece, *BEFORE.get(piece, ())) for module in source_of(name).modules}


@pytest.mark.engine
@pytest.mark.parametrize("fidelity", ["kinematic", "dynamic", "contact"])
@pytest.mark.parametrize("piece", ENTRIES)
def test_whatever_runs_while_a_piece_is_made_is_in_its_digest(ran, piece, fidelity):
    if (piece, fidelity) in {("bench", "kinematic"), ("bench", "dynamic")}:
        assert f"{piece} of {fidelity}" not in ran
        return
    name = f"{piece} of {fidelity}"
    assert "rgss.trials.pieces.pieces" in ran[name]
    assert ran[name] - covered_by(piece) == set()


@pytest.mark.engine
@pytest.mark.parametrize("fidelity", ["kinematic", "dynamic", "contact"])
def test_whatever_runs_in_a_trial_that_shares_nothing_is_in_its_key(ran, fidelity):
    pieces = [*ENTRIES] if fidelity == "contact" else [name for name in ENTRIES if name != "bench"]
    covered = {module for piece in pieces for module in covered_by(piece)}

    assert {"rgss.trials.pieces.pieces", "rgss.trials.pieces.run"} <= ran[f"trial of {fidelity}"] & covered
    assert ran[f"trial of {fidelity}"] - covered - DIGESTING == set()


@pytest.mark.engine
def test_no_data_file_of_the_package_is_read_while_a_piece_is_made(watched):
    package = REPOSITORY / "rgss"
    read = {Path(file) for file in watched["opened"] if Path(file).is_relative_to(package)}

    # Modules may be imported late. Whatever else is read must become an input of the piece's digest.
    assert {file for file in read if file.suffix not in {".py", ".pyc"} and not file.is_dir()} == set()


@pytest.mark.parametrize("module", sorted(code_of_trials()))
def test_no_code_of_a_trial_looks_at_docstrings_or_at_annotations_that_do_not_count(module):
    file = REPOSITORY.joinpath(*module.split("."))
    text = next(one for one in (file.with_suffix(".py"), file / "__init__.py") if one.exists()).read_text("utf-8")
    looked_at = {"__doc__", "getdoc", "__annotations__", "get_annotations", "get_type_hints", "getsource", "signature"}
    names = {
        getattr(node, "attr", None) or getattr(node, "id", None) or getattr(node, "name", None)
        for node in ast.walk(ast.parse(text))
    }

    # Readers of evidence look at the annotations of classes, which do count.
    allowed = {"get_type_hints"} if module.startswith("rgss.evidence.") else set()
    assert names & looked_at <= allowed


@pytest.mark.parametrize("module", sorted(code_of_trials()))
def test_no_code_of_a_trial_adds_numbers_by_a_function_that_another_python_rounds_otherwise(module):
    """The built-in ``sum`` of floats is another one from Python 3.12 on; ``math.fsum`` is exact on all."""
    file = REPOSITORY.joinpath(*module.split("."))
    text = next(one for one in (file.with_suffix(".py"), file / "__init__.py") if one.exists()).read_text("utf-8")
    tree = ast.parse(text)
    counts = {ast.unparse(node) for node in ast.walk(tree) if isinstance(node, ast.Call) and counts_only(node)}
    used = {ast.unparse(node) for node in ast.walk(tree) if isinstance(node, ast.Call) and called(node) == "sum"}

    assert used <= counts
    # Nor is it handed on, as to map.
    assert sum(isinstance(node, ast.Name) and node.id == "sum" for node in ast.walk(tree)) == sum(
        isinstance(node, ast.Call) and called(node) == "sum" for node in ast.walk(tree)
    )


def called(node: ast.Call) -> str:
    return node.func.id if isinstance(node.func, ast.Name) else ""


def counts_only(node: ast.Call) -> bool:
    """A sum of truth values, of ones, of lengths, or of what was found to be whole numbers."""
    (argument,) = node.args[:1] or [None]
    if isinstance(argument, ast.Call) and called(argument) == "map":
        return ast.unparse(argument.args[0]) == "len"
    if isinstance(argument, ast.GeneratorExp):
        whole = any(
            "isinstance" in ast.unparse(test) and "int" in ast.unparse(test)
            for one in argument.generators
            for test in one.ifs
        )
        return whole or isinstance(argument.elt, (ast.Compare, ast.Constant))
    return ast.unparse(argument) == "touches" if argument is not None else False


@pytest.mark.parametrize("piece", ENTRIES)
def test_what_makes_no_piece_is_in_no_digest(piece):
    modules = {*source_of(piece).modules}

    assert not {name for name in modules if name.split(".")[1] in ("cli", "reports", "studies", "tradeoff", "trace")}
    assert not modules & {
        "rgss.evidence.store.store",
        "rgss.physics.pictures.camera",
        "rgss.physics.pictures.rendering",
        "rgss.scenes.scene_file",
        "rgss.trials.filming",
        "rgss.trials.lifecycle",
        "rgss.trials.tracing",
    }


def test_a_bench_needs_no_planner_and_a_plan_no_physics():
    assert "pybullet" in source_of("bench").foreign
    assert not {"ompl", "toppra", "pinocchio"} & {*source_of("bench").foreign}
    assert "ompl" in source_of("plan").foreign
    assert "rgss.physics.world" not in source_of("plan").modules


def test_no_reader_of_documents_is_in_the_key_of_evidence():
    of_documents = {module for module in code_of_trials() if module.split(".")[:2] == ["rgss", "documents"]}

    assert of_documents == {"rgss.documents.digests"}
    assert "pydantic" not in {name for piece in ENTRIES for name in source_of(piece).foreign}


@pytest.mark.parametrize("piece", ENTRIES)
def test_every_engine_has_its_version_told(piece):
    assert {*source_of(piece).foreign} <= {*ENGINES}


def test_the_code_of_trials_is_that_of_all_pieces():
    assert {*code_of_trials()} == {module for piece in ENTRIES for module in source_of(piece).modules}
    assert (
        code_of_trials()["rgss.trials.planning.plan"] == own_sources().module_digest("rgss.trials.planning.plan")[:12]
    )
