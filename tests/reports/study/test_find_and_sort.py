"""The libraries for search and sorting that a report carries."""

from __future__ import annotations

import json
from importlib import resources

from rgss.reports.study_page import find_and_sort_library

BUNDLES = resources.files("rgss.reports") / "bundles"


def test_the_bundle_is_of_the_pinned_packages_with_their_licences():
    package = json.loads(BUNDLES.joinpath("package.json").read_text(encoding="utf-8"))
    banner = find_and_sort_library().splitlines()[0]
    licence = BUNDLES.joinpath("find_and_sort", "LICENSE").read_text(encoding="utf-8")

    for name in ("minisearch", "fast-sort"):
        assert f"{name} {package['devDependencies'][name]}" in banner
        assert f"node_modules/{name}/" in licence
    assert licence.count("THE SOFTWARE IS PROVIDED") == 2


def test_the_bundle_cannot_end_its_element():
    assert "</script" not in find_and_sort_library()
    assert "<!--" not in find_and_sort_library()
