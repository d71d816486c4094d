"""Front doors: the one place that hands names on, and names nothing that does not exist."""

from __future__ import annotations

import ast


def names_defined_in(tree):
    """Names that a module binds other than by importing them."""
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id


def handed_on(sources):
    """Names that a module imports from one that is no package and does not define them: ``importer: module.name``."""
    trees = {name: ast.parse(text) for name, text in sources.items()}
    defined = {name: set(names_defined_in(tree)) for name, tree in trees.items() if not name.endswith(".__init__")}
    return [
        f"{name}: {node.module}.{imported.name}"
        for name, tree in sorted(trees.items())
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module in defined
        for imported in node.names
        if imported.name not in defined[node.module]
    ]


def test_a_name_is_imported_from_the_module_that_defines_it_or_from_a_front_door(modules, repository):
    sources = {
        ".".join(path.relative_to(repository).with_suffix("").parts): path.read_text(encoding="utf-8")
        for path in modules
    }

    assert handed_on(sources) == []


def test_a_name_that_a_module_hands_on_is_found():
    sources = {
        "pack.__init__": "from pack.one import A\n",
        "pack.one": "class A: ...\n",
        "pack.two": "from pack.one import A\nB = A\n",
        "pack.three": "from pack import A\nfrom pack.one import A\nfrom pack.two import B\n",
        "pack.four": "def f():\n    from pack.two import A\n",
    }

    assert handed_on(sources) == ["pack.four: pack.two.A"]
