"""The section ``until_decided`` of a study: each key read, each finding at its place, defaults as they were."""

from __future__ import annotations

import pytest

from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.sweep.trial_keys import key_of
from rgss.tradeoff.sequential import SequentialRule

STUDY = "studies/pick_place.yaml"
SECTION = """\
until_decided:
  error_rate: 1 %
  margin: 0.02
  slack: 4 %
  pilot: 10
  batch: 6
  cap: 90
  verdict_cap: 30
"""


@pytest.fixture
def section(edit):
    """Puts a section before the planning."""
    return lambda text: edit(STUDY, "planning:\n", f"{text}planning:\n")


def test_what_it_says(folder, section):
    section(SECTION)
    assert load_project(folder).study.until_decided == SequentialRule(
        error_rate=0.01, margin=0.02, slack=0.04, pilot=10, batch=6, cap=90, verdict_cap=30
    )


def test_what_is_left_away_is_as_it_always_was(shipped, folder, section):
    section("until_decided: {cap: 60}\n")
    assert shipped.study.until_decided == SequentialRule(
        error_rate=0.05, margin=0.05, slack=0.1, pilot=8, batch=4, cap=200, verdict_cap=16
    )
    assert load_project(folder).study.until_decided == SequentialRule(cap=60)


def test_with_a_budget_a_sweep_goes_on_until_decided(shipped, folder, section):
    section("until_decided: {budget: 900, cap: 60}\n")
    study = load_project(folder).study
    # The pilot are the replicates that the study has of every variant.
    assert study.until_decided == SequentialRule(cap=60, budget=900, pilot=study.replicates)
    assert study.sweeps_until_decided
    assert not load_project(folder).with_replicates(4).study.sweeps_until_decided
    assert not shipped.study.is_sequential


def test_without_a_budget_a_sweep_does_not(folder, section):
    section("until_decided: {cap: 60}\n")
    study = load_project(folder).study
    assert study.is_sequential
    assert not study.sweeps_until_decided


def test_a_pilot_below_the_replicates_is_found(folder, section, edit, place_of, problems):
    section("until_decided: {pilot: 4}\n")
    edit(STUDY, f"replicates: {load_project(folder).study.replicates}\n", "replicates: 6\n")
    (found,) = problems()
    assert found == (
        f"{place_of(STUDY, '4}')}: error: pilot must be at least the study's replicates, 6, got 4 "
        "(raise it, or lower the replicates) [study.until-decided]"
    )


def test_no_trial_depends_on_it(shipped, folder, section):
    section(SECTION)
    variants = [shipped.designs.variant(1)]
    before, after = (trial_specs(project, variants=variants, seeds=[1]) for project in (shipped, load_project(folder)))
    assert key_of(before[0]) == key_of(after[0])


@pytest.mark.parametrize(
    ("old", "new", "mark", "message"),
    [
        (
            "1 %",
            "0",
            "0\n  margin",
            "error rate must be between 0 and 0.5, got 0 (give a share between 0 and 0.5, such as 5 %)",
        ),
        (
            "1 %",
            "60 %",
            "60 %",
            "error rate must be between 0 and 0.5, got 0.6 (give a share between 0 and 0.5, such as 5 %)",
        ),
        ("1 %", "2 s", "2 s", "'2 s' has a unit where a pure number is expected (write 2)"),
        ("0.02", "1.5", "1.5", "margin must be from 0 to below 1, got 1.5 (a difference of value, such"),
        ("0.02", "-0.1", "-0.1", "margin must be from 0 to below 1, got -0.1"),
        ("4 %", "100 %", "100 %", "slack must be from 0 to below 1, got 1 (a share of a threshold, such as 10 %)"),
        ("pilot: 10", "pilot: 1", "1\n  batch", "pilot: input should be greater than or equal to 2"),
        ("batch: 6", "batch: 0", "0\n  cap", "batch: input should be greater than or equal to 1"),
        ("cap: 90", "cap: 20000", "20000", "cap: input should be less than or equal to 10000"),
        ("cap: 90", "cap: many", "many", "cap: "),
        (
            "verdict_cap: 30",
            "verdict_cap: 91",
            "91",
            "verdict_cap must be at most the cap of 90, got 91 (raise the cap, or lower the other)",
        ),
        (
            "pilot: 10",
            "pilot: 100",
            "100",
            "pilot must be at most the cap of 90, got 100 (raise the cap, or lower the other)",
        ),
        ("pilot: 10", "first_look: 10", "first_look", "unknown key 'first_look'"),
    ],
)
def test_mistakes_are_found_at_their_place(section, place_of, problems, old, new, mark, message):
    section(SECTION.replace(old, new, 1))
    (found,) = problems()
    assert found.startswith(f"{place_of(STUDY, mark)}: error: ")
    assert message in found


def test_finalists_without_a_budget_are_found(section, place_of, problems):
    section("until_decided: {finalists: 6}\n")
    (found,) = problems()
    assert found == (
        f"{place_of(STUDY, '6}')}: error: finalists needs a budget (give a budget too) [study.until-decided]"
    )


@pytest.mark.parametrize(
    ("text", "mark", "message"),
    [
        ("{reserve: 600}", "600", "reserve needs a budget (give a budget too)"),
        ("{budget: 900, reserve: 0}", "0}", "reserve: input should be greater than or equal to 1"),
        (
            "{budget: 900, reserve: 600, good_selection: 100 %}",
            "100 %",
            "good_selection must be between 0 and 1, got 1 (give a probability such as 90 %)",
        ),
        (
            "{budget: 900, good_selection: 80 %}",
            "80 %",
            "good_selection needs a reserve (it says when the reserve is left; give one)",
        ),
    ],
)
def test_mistakes_in_a_reserve_are_found(section, place_of, problems, text, mark, message):
    section(f"until_decided: {text}\n")
    (found,) = problems()
    assert found.startswith(f"{place_of(STUDY, mark)}: error: ")
    assert message in found


def test_a_reserve_is_read(folder, section):
    section("until_decided: {budget: 900, reserve: 600, good_selection: 80 %}\n")
    rule = load_project(folder).study.until_decided
    assert (rule.reserve, rule.good_selection) == (600, 0.8)


def test_a_cap_below_a_default_is_found_at_the_cap(section, place_of, problems):
    section("until_decided: {cap: 12}\n")
    (found,) = problems()
    assert found == (
        f"{place_of(STUDY, '12}')}: error: verdict_cap must be at most the cap of 12, got 16 "
        "(raise the cap, or lower the other) [study.until-decided]"
    )
