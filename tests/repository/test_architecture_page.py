"""The page of the architecture: its rooms are the packages, and its layers those that import-linter checks."""

from __future__ import annotations

import re


def test_each_package_and_module_is_a_room(repository):
    page = (repository / "docs" / "architecture.md").read_text(encoding="utf-8")
    rooms = re.findall(r"^\| `(rgss/\w+(?:\.py)?)` \|", page, re.MULTILINE)
    packages = [f"rgss/{path.parent.name}" for path in (repository / "rgss").glob("*/__init__.py")]
    modules = [f"rgss/{path.name}" for path in (repository / "rgss").glob("*.py") if not path.name.startswith("__")]

    assert sorted(rooms) == sorted([*packages, *modules])


def test_the_layers_are_those_that_are_checked(repository):
    page = (repository / "docs" / "architecture.md").read_text(encoding="utf-8")
    settings = (repository / "pyproject.toml").read_text(encoding="utf-8")
    (told,) = re.findall(r"^## Layers$.*?^```\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    (checked,) = re.findall(r"^layers = \[\n(.*?)^\]", settings, re.MULTILINE | re.DOTALL)

    assert ["__main__", *told.splitlines()] == re.findall(r'"(.+)"', checked)
