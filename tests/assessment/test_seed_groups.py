"""Seeds that were read of each variant, and what the pages say of them."""

from __future__ import annotations

from types import SimpleNamespace

from rgss.assessment import sequential_seeds
from rgss.reports.decision.conclusion import seeds_sentences


def sentences(*seeds, replicates=4, is_sequential=True):
    """The sentences on variants 1, 2, … with these seeds."""
    project = SimpleNamespace(study=SimpleNamespace(is_sequential=is_sequential, replicates=replicates))
    measured = [
        SimpleNamespace(variant=SimpleNamespace(id=number), records=tuple(SimpleNamespace(seed=seed) for seed in each))
        for number, each in enumerate(seeds, start=1)
    ]
    return list(seeds_sentences(sequential_seeds(project, measured)))


def test_variants_of_equal_seeds_are_told_together():
    told = sentences(range(1, 5), range(1, 9), range(1, 5))
    assert told[0] == "Seeds read: 1 to 4 of variants 1, 3; 1 to 8 of variant 2."
    assert told[1].startswith("Effects of levels are of the 4 seeds that all variants have; '--replicates 4'")
    assert told[2].startswith("Replicates were added where the decision was open")


def test_a_seed_without_a_trial_is_named():
    """Neither are the seeds all that lie between, nor does every variant have them."""
    assert sentences(range(1, 5), (1, 3, 4)) == ["Seeds read: 1 to 4 of variant 1; 1 to 4 without 2 of variant 2."]
    assert sentences((2,)) == ["Seeds read: 2 of variant 1."]


def test_where_no_replicate_was_added_none_is_said_to_be():
    assert sentences(range(1, 5), range(1, 5)) == ["Seeds read: 1 to 4 of variants 1, 2."]


def test_fixed_replicates_have_no_such_sentence():
    assert sentences(range(1, 9), is_sequential=False) == []
