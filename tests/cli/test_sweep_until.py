"""``rgss sweep --until decided``: what it refuses, and how it tells what came of it."""

from __future__ import annotations

import pytest

import rgss.studies.until_decided as until
from rgss.measures import Verdict
from rgss.tradeoff.sequential import Reason, SequentialRule


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["--cap", "40"], "--cap needs --until decided (--replicates is the fixed number of trials)"),
        (["--until", "decided", "--only", "1"], "--until decided and --only exclude each other (leave --only away)"),
        (
            ["--until", "decided", "--replicates", "4"],
            "--until decided and --replicates exclude each other (leave --replicates away)",
        ),
        (
            ["--until", "decided", "--dry-run"],
            "--until decided and --dry-run exclude each other (leave --dry-run away)",
        ),
    ],
)
def test_what_contradicts_it(rgss, untouched, arguments, complaint):
    told = rgss("sweep", *arguments, "--project", untouched)

    assert (told.status, told.output) == (2, "")
    assert told.complaint == f"rgss: {complaint}"


def test_a_cap_below_the_pilot(rgss, untouched):
    told = rgss("sweep", "--until", "decided", "--cap", "4", "--project", untouched)

    assert (told.status, told.output) == (2, "")
    assert "a cap of 4, one for verdicts of 16 and a pilot of 8 do not agree" in told.complaint


def test_what_came_of_it(rgss, untouched, monkeypatch):
    found = until.UntilDecided(
        reason=Reason.DECIDED,
        variant=2,
        contenders=(2,),
        verdicts={1: {"SYS-005": Verdict.NOT_MET}, 2: {"SYS-005": Verdict.MET}},
        trials={1: 8, 2: 12},
        probability=0.97,
        looks=2,
        rule=SequentialRule(),
    )
    monkeypatch.setattr(until, "replicate_until_decided", lambda *_, **__: found)

    told = rgss("sweep", "--until", "decided", "--project", untouched)
    document = rgss("sweep", "--until", "decided", "--json", "--project", untouched).document

    assert told.status == 0
    assert told.output.startswith("variant 2: decided at an error rate of 0.05")
    assert (document["variant"], document["trials"], document["probability"]) == (2, 20, 0.97)
    assert document["variants"][0] == {"variant": 1, "trials": 8, "verdicts": {"SYS-005": "not_met"}}
