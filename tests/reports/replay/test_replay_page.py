"""The page of a replay: it carries what it needs, small and the same every time; and the licence of its library."""

from __future__ import annotations

import json
import re
from importlib import resources

import pytest

from rgss.reports.replay.packing import packed_replay
from rgss.reports.replay.replay_page import rendering_library, replay_to_html
from tests.fixtures.made_replay import JOINTS, made_record, made_scene, made_trace

BUNDLES = resources.files("rgss.reports") / "bundles"


@pytest.fixture(scope="module")
def packed():
    return packed_replay(made_record(), made_trace(), made_scene(), joints=JOINTS)


def test_the_same_trial_gives_the_same_page(packed):
    again = packed_replay(made_record(), made_trace(), made_scene(), joints=JOINTS)
    assert replay_to_html([again]) == replay_to_html([packed])


def test_texts_of_a_trial_close_no_element(packed):
    html = replay_to_html([packed])
    assert "it slipped" not in html
    assert html.count("</script>") == html.count("<script")


def test_a_page_has_one_trial_or_two(packed):
    for count in (0, 3):
        with pytest.raises(AssertionError, match="a replay shows 1 to 2 trials"):
            replay_to_html([packed] * count)


def test_the_library_is_the_pinned_one_with_its_licence():
    wanted = json.loads((BUNDLES / "package.json").read_text(encoding="utf-8"))["devDependencies"]["three"]
    locked = json.loads((BUNDLES / "package-lock.json").read_text(encoding="utf-8"))["packages"]["node_modules/three"]
    library = rendering_library()

    assert re.fullmatch(r"0\.(\d+)\.\d+", wanted)
    assert locked["version"] == wanted
    assert library.startswith(f"/* three.js {wanted}, MIT licence")
    assert f'"{wanted.split(".")[1]}"' in library  # its REVISION
    assert "SPDX-License-Identifier: MIT" in library
    assert "</script" not in library.lower()
    assert (BUNDLES / "three" / "LICENSE").read_text(encoding="utf-8").startswith("The MIT License")


def test_the_library_names_no_address_that_a_page_would_fetch():
    assert not re.search(r"import\(['\"]https?:", rendering_library())
