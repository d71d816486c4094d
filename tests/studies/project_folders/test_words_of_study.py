"""Words that name a study in a command: a shell reads them back as the study."""

from __future__ import annotations

import shlex

import pytest

from rgss.studies.project_folders import study_file, words_of_study


@pytest.mark.parametrize(
    "label",
    ["studies/cups.yaml", "studies/cups at night.yaml", "studies/more/cups.yaml", "cups.yaml", "studies/it's.yaml"],
)
def test_the_words_are_read_back_as_the_study(tmp_path, label):
    for name in ("studies/pick_place.yaml", label):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    verb, *words = shlex.split(f"sweep{words_of_study(label)}")
    assert (verb, len(words)) == ("sweep", 1)
    assert study_file(tmp_path, words[0]) == (tmp_path / label, label)


def test_the_default_study_needs_no_word():
    assert words_of_study("studies/pick_place.yaml") == ""
    assert words_of_study("studies/cups.yaml") == " cups"
