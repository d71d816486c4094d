"""The canonical form of source: what counts, what does not, and that every Python finds the same."""

from __future__ import annotations

import ast
import hashlib
import shutil
import subprocess
import sys

import pytest

from rgss.trials.code.canonical_syntax import canonical_form
from rgss.trials.code.code_fingerprint import SourceTree, own_sources
from rgss.trials.code.piece_versions import ENTRIES, source_of, sources_in

# Something of every kind of syntax that Python 3.10 has.
EVERYTHING = '''
"""A docstring."""
from __future__ import annotations
import os.path as p, sys
from typing import TYPE_CHECKING
if TYPE_CHECKING:
    import decimal
X: int = 1
Y = [1, 2.5e-300, 1j, -0.0, b"b\\\\0", "s\\\\ud800", u"u", r"\\\\d", ..., None, True, 10**20, 0x10, 1_000]
"""About Y."""
class A(Exception, metaclass=type):
    """Doc."""
    a: dict[str, int]
    b: int = 2
    @property
    def c(self, /, d: int, *e, f=1, g, **h) -> int:
        """Doc."""
        local: int
        other: int = 3
        return f"a{d!r:>{self.b}}" "b" f"" f"{d=}" + f"{d}" "c"
    async def i(self):
        async with x as y, z: await (yield)
        async for q in r: pass
        else: return [s async for s in t if u]
def j(*, k: "str" = 'x'):
    global l
    try: raise ValueError from None
    except (A, B) as error: ...
    except C: pass
    else: del l
    finally: assert k, "m"
    while (n := 1) < 2 <= 3 != 4 is not None not in o: break
    else: continue
    for x, *y in z: nonlocal_ = {**a, 'b': 1} if a else {1, *b}
    match a:
        case {"k": [1, *rest], **others} | A(b=c) if d: pass
        case -1 | None | "s" | _: pass
    return lambda x=1, *y: (x[1:2, ..., ::3], not x, ~x, x @ y ** -z // 2)
'''
FORM = "ec1d83812b042b134071ec9d2931dbf411d078db20e3fa3d655e11f64559a71b"


def form(text: str) -> str:
    return canonical_form(ast.parse(text))


def test_every_python_finds_one_form():
    """The digest was taken once; the same is wanted from each Python that the suite is run on."""
    assert hashlib.sha256(form(EVERYTHING).encode()).hexdigest() == FORM


@pytest.mark.parametrize("flags", [[], ["-OO"], ["-X", "utf8"]])
def test_every_way_to_start_python_finds_the_same_digests(flags):
    script = (
        "from rgss.trials.code.code_fingerprint import own_sources\n"
        "from rgss.trials.code.piece_versions import sources_in\n"
        "for closure in sources_in(own_sources()).closures.values(): print(closure.digest)"
    )
    done = subprocess.run([sys.executable, *flags, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.split() == [source_of(piece).digest for piece in ENTRIES]


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("a = 1", "# why\na  =  (\n1)"),
        ("a = D(name='x', meaning='b')", "a = D(name='x', meaning='c')"),
        ("def f(): pass", 'def f():\n    """Doc."""'),
        ("def f(a, b=1): return a", "def f(a: int, b: str = 1) -> int: return a"),
        ("def f():\n a = 1", "def f():\n a: int = 1"),
        ("def f():\n return 1", "def f():\n b: int\n return 1"),
        ("class A:\n a = 1", 'class A:\n """Doc."""\n a = 1\n "about a"'),
        ("a = 'x'", 'a = """x"""'),
        ("a = 0x10", "a = 16"),
        ("a = 1", "a = 1\nif TYPE_CHECKING:\n import b"),
        ("a = f'{b}cd'", "a = f'{b}' 'c' f'd'"),
        ("if a: b = 1", "if a:\n pass\n b = 1"),
    ],
)
def test_what_does_nothing_does_not_count(one, other):
    assert form(one) == form(other)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("a = 1", "a = 2"),
        ("a = 1", "a = 1.0"),
        ("a = 1", "a = True"),
        ("a = 'b'", "a = b'b'"),
        ("a = 'b'", "a = b"),
        ("a = 0.1", "a = 0.1000000000000001"),
        ("a = 1\nb = 2", "b = 2\na = 1"),
        ("a + b", "a - b"),
        ("a + (b + c)", "(a + b) + c"),
        ("f(a, b)", "f(a, b=b)"),
        ("f(*a)", "f(**a)"),
        ("class A:\n a: int", "class A:\n a: float"),
        ("class A:\n a: int", "class A:\n pass"),
        ("a: int = 1", "a: float = 1"),
        ("def f(a, b): pass", "def f(b, a): pass"),
        ("def f(a, /): pass", "def f(a): pass"),
        ("def f(*, a, b=1): pass", "def f(*, a=1, b): pass"),
        ("async def f(): pass", "def f(): pass"),
        ("f'{a}'", "f'{a!r}'"),
        ("f'{a:1}'", "f'{a:2}'"),
        ("if a: b()\nelse: c()", "if a: c()\nelse: b()"),
        ("if a: b()\nc()", "if a:\n b()\n c()"),
        ("while a: b()", "if a: b()"),
        ("{**a, 'b': 1}", "{'b': 1, **a}"),
        ("[x for x in y if z]", "[x for x in y]"),
        ("from a import b", "from c import b"),
        ("a[1:2]", "a[1:2:1]"),
        ("x = (yield)", "x = (yield 1)"),
        ("return_ = lambda: 1", "return_ = lambda a: 1"),
        ("try: a()\nexcept B: c()", "try: a()\nexcept C: c()"),
    ],
)
def test_what_does_something_counts(one, other):
    assert form(one) != form(other)


@pytest.fixture
def package(tmp_path):
    def write(**modules: str) -> SourceTree:
        for name, text in modules.items():
            file = (tmp_path / "pack").joinpath(*name.split("__")).with_suffix(".py")
            file.parent.mkdir(parents=True, exist_ok=True)
            (file.parent / "__init__.py").touch()
            file.write_text(text, encoding="utf-8")
        return SourceTree(tmp_path / "pack")

    return write


def test_a_module_that_moves_costs_nothing_and_what_is_put_in_its_place_does(package):
    before = package(entry="from pack.base import f\nf()", base="def f(): return 1", other="def f(): return 2")
    digest = before.closure_of(["pack.entry"]).digest
    moved = package(entry="from pack.room.moved import f\nf()", room__moved="def f(): return 1")
    assert moved.closure_of(["pack.entry"]).digest == digest
    replaced = package(entry="from pack.other import f\nf()")
    assert replaced.closure_of(["pack.entry"]).digest != digest


def test_two_functions_that_change_places_are_found(package):
    texts = {"base": "def f(): return 1\ndef g(): return 2", "other": "def f(): return 3"}
    one = package(entry="from pack.base import f\nfrom pack.other import f as h\nf(), h()", **texts)
    first = one.closure_of(["pack.entry"]).digest
    two = package(entry="from pack.other import f\nfrom pack.base import f as h\nf(), h()", **texts)
    assert two.closure_of(["pack.entry"]).digest != first
    three = package(entry="from pack.base import g as f\nfrom pack.other import f as h\nf(), h()", **texts)
    assert three.closure_of(["pack.entry"]).digest != first


def test_a_function_counts_with_the_imports_that_it_uses(package):
    tree = package(
        entry=(
            "from pack.base import f\nfrom pack.other import g\nimport numpy as np\nimport scipy\n"
            "_TABLE = {1: g}\n"
            "def make(): return _helped()\n"
            "def _helped():\n from pack.late import z\n return f(np)\n"
            "def unrelated(): return _TABLE, scipy"
        ),
        base="",
        other="",
        late="",
    )
    closure = tree.closure_of(["pack.entry:make"])
    assert closure.modules == ("pack.base", "pack.entry", "pack.late")
    assert closure.foreign == ("numpy",)
    assert tree.closure_of(["pack.entry:unrelated"]).modules == ("pack.entry", "pack.other")
    assert tree.closure_of(["pack.entry:"]).modules == ("pack.entry",)
    with pytest.raises(LookupError, match=r"pack\.entry defines no gone"):
        tree.closure_of(["pack.entry:gone"])


SPEED = "conditions_of(spec).tool_speed_m_s"


@pytest.mark.parametrize(
    ("file", "old", "new", "pieces"),
    [
        ("trials/timing.py", SPEED, f"{SPEED} / 2", {"timing", "execution", "record"}),
        ("trials/pieces/pieces.py", "timing_of(spec, plan", "timing_of(_slow(spec), plan", {*ENTRIES}),
        ("trials/pieces/run.py", "Pieces().record(task", "Pieces(bench=run_bench).record(task", {"record"}),
        ("trials/code/kernel_environment.py", 'KERNEL = "Nehalem"', 'KERNEL = "Haswell"', {*ENTRIES}),
        ("trials/pieces/run.py", "Run one trial; only", "Run a trial; only", set()),
        ("trials/metrics/task_metrics.py", "number of states of the task", "number of phases", set()),
        ("trials/metrics/task_metrics.py", "trial=Aggregation.LEAST", "trial=Aggregation.LAST", {"record"}),
        ("trials/planning/task_stops.py", "# The task is planned up to", "# It is planned up to", set()),
    ],
)
def test_a_change_of_the_code_reaches_the_pieces_that_run_it(tmp_path, file, old, new, pieces):
    copy = shutil.copytree(own_sources()._folder, tmp_path / "rgss", ignore=shutil.ignore_patterns("__pycache__"))
    text = (copy / file).read_text(encoding="utf-8")
    assert old in text
    (copy / file).write_text(text.replace(old, new, 1), encoding="utf-8")
    changed = sources_in(SourceTree(copy)).closures
    assert {piece for piece in ENTRIES if changed[piece].digest != source_of(piece).digest} == pieces
