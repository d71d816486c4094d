"""Front doors: the one place that hands names on, and names nothing that does not exist."""

from __future__ import annotations

import ast
import importlib
import re
import sys

import pytest


def parsed(sources):
    """The syntax tree of each module."""
    return {name: ast.parse(text) for name, text in sources.items()}


@pytest.fixture(scope="module")
def trees(files, repository):
    """The syntax tree of each Python file of the repository, by the name of its module."""
    return parsed(
        {
            ".".join(path.relative_to(repository).with_suffix("").parts): path.read_text(encoding="utf-8")
            for path in files
            if path.suffix == ".py"
        }
    )


def names_defined_in(tree):
    """Names that a module binds other than by importing them."""
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id


def statements(tree):
    """The statements of a module at every depth; imports are among them, and expressions, which are many, are not."""
    for node in ast.iter_child_nodes(tree):
        if not isinstance(node, ast.expr):
            yield node
            yield from statements(node)


def handed_on(trees):
    """Names that a module imports from one that is no package and does not define them: ``importer: module.name``."""
    defined = {name: set(names_defined_in(tree)) for name, tree in trees.items() if not name.endswith(".__init__")}
    return [
        f"{name}: {node.module}.{imported.name}"
        for name, tree in sorted(trees.items())
        for node in statements(tree)
        if isinstance(node, ast.ImportFrom) and node.module in defined
        for imported in node.names
        if imported.name not in defined[node.module]
    ]


def test_a_name_is_imported_from_the_module_that_defines_it_or_from_a_front_door(trees):
    assert handed_on({name: tree for name, tree in trees.items() if name.startswith("rgss.")}) == []


def test_a_name_that_a_module_hands_on_is_found():
    sources = {
        "pack.__init__": "from pack.one import A\n",
        "pack.one": "class A: ...\n",
        "pack.two": "from pack.one import A\nB = A\n",
        "pack.three": "from pack import A\nfrom pack.one import A\nfrom pack.two import B\n",
        "pack.four": "def f():\n    from pack.two import A\n",
    }

    assert handed_on(parsed(sources)) == ["pack.four: pack.two.A"]


def unused_exports(trees, texts=()):
    """Names that the front door of a package hands on and nothing outside it imports: ``package: name``."""
    imports = [
        (name, node.module, imported.name)
        for name, tree in trees.items()
        for node in statements(tree)
        if isinstance(node, ast.ImportFrom) and node.module
        for imported in node.names
    ]
    used = {(module, name) for importer, module, name in imports if importer != f"{module}.__init__"}
    for text in texts:
        for module, names in re.findall(r"from (rgss[.\w]*) import \(?([\w, \\n]+)", text):
            used |= {(module, name) for name in re.findall(r"\w+", names)}
    return [
        f"{importer.removesuffix('.__init__')}: {name}"
        for importer, module, name in imports
        if importer.startswith("rgss.") and importer.endswith(".__init__") and module.startswith("rgss.")
        if name != "lazy_exports" and (importer.removesuffix(".__init__"), name) not in used
    ]


def test_what_a_front_door_hands_on_is_imported_somewhere(trees, files):
    texts = [path.read_text(encoding="utf-8") for path in files if path.suffix in {".md", ".ipynb"}]

    # The package itself is the interface of Python.
    assert [entry for entry in unused_exports(trees, texts) if not entry.startswith("rgss: ")] == []


def test_an_export_that_nothing_imports_is_found():
    sources = {
        "rgss.pack.__init__": "from rgss.pack.one import A, B, C\n",
        "rgss.pack.one": "class A: ...\nclass B: ...\nclass C: ...\n",
        "rgss.two": "from rgss.pack import A\n",
        "tests.three": "from rgss.pack.one import B\n",
    }

    assert unused_exports(parsed(sources), ["```python\nfrom rgss.pack import C\n```"]) == ["rgss.pack: B"]


def test_a_lazy_package_gives_a_star_import_what_it_exports(files, repository):
    packages = [
        ".".join(path.parent.relative_to(repository).parts)
        for path in files
        if path.name == "__init__.py" and "lazy_exports(__name__" in path.read_text(encoding="utf-8")
    ]
    exported = {name: importlib.import_module(name).__all__ for name in packages}

    assert len(packages) > 30
    assert [name for name, names in exported.items() if not names or set(names) - set(dir(sys.modules[name]))] == []
    assert "decide" in exported["rgss.tradeoff"]
