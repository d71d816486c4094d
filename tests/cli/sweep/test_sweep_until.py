"""``rgss sweep --until decided``: what it refuses, and how it tells what came of it."""

from __future__ import annotations

import pytest

import rgss.decision.until_decided as until
from rgss.evidence import EvidenceStore, RunFailure, RunFailureKind
from rgss.measures import Verdict
from rgss.reports.decision.until_decided import open_paragraph, until_decided_summary
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.sweep.results import LostTrials, SweepResult
from rgss.tradeoff.sequential import Forecast, Reason, SequentialRule
from tests.fixtures.stored_trials import put_trials


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["--cap", "40"], "--cap needs --until decided (--replicates is the fixed number of trials)"),
        (["--until", "decided", "--only", "1"], "--until decided and --only exclude each other (omit --only)"),
        (
            ["--until", "decided", "--replicates", "4"],
            "--until decided and --replicates exclude each other (omit --replicates)",
        ),
        (
            ["--until", "decided", "--dry-run"],
            "--until decided and --dry-run exclude each other (omit --dry-run)",
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
    assert "cap must be at least the pilot of 8 and the verdict cap of 4, got 4" in told.complaint


def test_what_came_of_it(rgss, folder, monkeypatch):
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
    monkeypatch.setattr("rgss.decision.replicate_until_decided", lambda *_, **__: found)

    told = rgss("sweep", "--until", "decided", "--project", folder)
    document = rgss("sweep", "--until", "decided", "--json", "--project", folder).document

    assert told.status == 0
    assert told.output.startswith("variant 2: decided at an error rate of 0.05")
    assert (document["variant"], document["trials"], document["probability"]) == (2, 20, 0.97)
    assert document["variants"][0] == {"variant": 1, "trials": 8, "verdicts": {"SYS-005": "not_met"}}
    assert {name: document[name] for name in ("error_rate", "margin", "slack", "pilot", "batch", "cap")} == {
        "error_rate": 0.05,
        "margin": 0.05,
        "slack": 0.1,
        "pilot": 8,
        "batch": 4,
        "cap": 200,
    }


def test_the_rule_is_the_studys_and_the_cap_may_be_named(rgss, folder, monkeypatch):
    study = folder / "studies" / "pick_place.yaml"
    text = study.read_text(encoding="utf-8")
    study.write_text(f"{text}\nuntil_decided: {{margin: 0.02, cap: 90}}\n", encoding="utf-8")
    asked = []

    def replicate(*_, rule, **__):
        asked.append(rule)
        return until.UntilDecided(
            reason=Reason.DECIDED,
            variant=2,
            contenders=(1, 2, 3),
            verdicts={},
            trials={1: 8, 2: 12, 3: 12},
            probability=0.97,
            looks=2,
            rule=rule,
        )

    monkeypatch.setattr("rgss.decision.replicate_until_decided", replicate)

    told = rgss("sweep", "--until", "decided", "--project", folder)
    rgss("sweep", "--until", "decided", "--cap", "60", "--project", folder)

    rgss("sweep", "--until", "decided", "--cap", "10", "--project", folder)
    assert asked == [
        SequentialRule(margin=0.02, cap=90),
        SequentialRule(margin=0.02, cap=60),
        # No option sets the cap of verdicts, which is at most that of all.
        SequentialRule(margin=0.02, cap=10, verdict_cap=10),
    ]
    assert "decided at an error rate of 0.05, 2 of the others may equal it within 0.02, prob" in told.output


UNPROVEN = "Not proven at an error rate of 0.05 over all looks, a stricter standard than the probability above:"


def ended(rule, **more):
    return until.UntilDecided(
        **{
            "reason": Reason.BUDGET,
            "variant": 2,
            "contenders": (1, 2, 3),
            "verdicts": {},
            "trials": {1: 4, 2: 12, 3: 12},
            "probability": 0.5,
            "looks": 3,
            "rule": rule,
            "unsettled": (1, 3),
            "forecast": Forecast(rivals={1: 24, 3: 48}, requirements={"SYS-024": 96}, accepted=48, trials=230),
            **more,
        }
    )


def test_a_study_with_a_budget_goes_on_until_decided_of_itself(rgss, folder, monkeypatch):
    study = folder / "studies" / "pick_place.yaml"
    study.write_text(
        f"{study.read_text(encoding='utf-8')}\nuntil_decided: {{budget: 600, reserve: 300}}\n", encoding="utf-8"
    )
    asked = []

    def replicate(*_, rule, **__):
        asked.append(rule)
        return ended(rule)

    monkeypatch.setattr("rgss.decision.replicate_until_decided", replicate)
    told = rgss("sweep", "--project", folder)
    rgss("sweep", "--budget", "900", "--project", folder)

    assert [rule.budget for rule in asked] == [600, 900]
    # A budget that is typed is all that is spent.
    assert [rule.reserve for rule in asked] == [300, None]
    assert told.output.splitlines()[0].startswith(
        "variant 2: budget of 600 trials spent, probability of good selection 50 %; 28 trials in 3 looks"
    )
    assert told.output.splitlines()[1:] == [
        (
            "Not proven at an error rate of 0.05 over all looks, a stricter standard than the probability above: that "
            "variants 1, 3 are worth at most 0.05 more than variant 2; that variant 2, which has 12 replicates, meets "
            "SYS-024 (about 96 replicates). If trials go on as so far, some 250 more trials settle the decision; to "
            f"go on where it stopped, type 'rgss sweep --project {folder} --budget 300', or raise until_decided.budget."
        )
    ]
    *_, budget, reserve = rgss("sweep", "--dry-run", "--project", folder).output.splitlines()
    assert budget.startswith("Then up to ")
    assert reserve == (
        "Then up to 300 more trials while the probability of good selection is below 0.9 (until_decided.reserve)."
    )
    assert len(asked) == 2


def test_a_dry_run_counts_the_replicates_that_were_added(folder, rgss, record_of):
    study = folder / "studies" / "pick_place.yaml"
    study.write_text(
        f"{study.read_text(encoding='utf-8')}\nuntil_decided: {{budget: 600, reserve: 20}}\n", encoding="utf-8"
    )
    project = load_project(folder)
    own = trial_specs(project)
    first = project.designs.variant(1)
    more = trial_specs(project, variants=[first], seeds=range(1 + project.study.replicates, 31))

    def told(*options):
        return rgss("sweep", "--dry-run", *options, "--project", folder).output.splitlines()[-2:]

    in_reserve = "more trials while the probability of good selection is below 0.9 (until_decided.reserve)."
    with EvidenceStore.open(folder / ".rgss" / "evidence.sqlite") as store:
        put_trials(store, (*own, *more), record_of)
    left = 600 - len(own) - len(more)
    assert told() == [
        f"Then up to {left} more trials where the decision is open (until_decided.budget).",
        f"Then up to 20 {in_reserve}",
    ]
    # A budget that is typed is all that is spent.
    spent = len(own) + len(more)
    assert told("--budget", str(spent + 7))[-1] == "Then up to 7 more trials where the decision is open (--budget)."
    assert told("--budget", str(spent))[-1] == (
        f"No more trials where the decision is open: the budget of {spent} is spent (--budget)."
    )
    study.write_text(study.read_text(encoding="utf-8").replace("budget: 600", f"budget: {spent - 5}"), encoding="utf-8")
    assert told() == [
        f"No more trials where the decision is open: the budget of {spent - 5} is spent (until_decided.budget).",
        f"Then up to 15 {in_reserve}",
    ]


def test_what_was_spent_of_the_reserve_is_said():
    rule = SequentialRule(budget=20, reserve=40)
    found = ended(rule, verdicts={2: {"SYS-024": Verdict.INCONCLUSIVE, "SYS-001": Verdict.MET}})
    assert found.reserve_spent == 8
    assert until_decided_summary(found) == (
        "variant 2: budget of 20 trials and 8 of a reserve of 40 spent, probability of good selection 50 %; "
        "inconclusive: SYS-024; 28 trials in 3 looks, 5 % of the cap of 200 for each variant"
    )
    assert ended(SequentialRule(budget=28)).reserve_spent == ended(SequentialRule()).reserve_spent == 0


@pytest.mark.parametrize(
    ("found", "words"),
    [
        ({"reason": Reason.DECIDED}, ""),
        ({"variant": None, "forecast": None, "unsettled": ()}, "No variant meets every requirement by its"),
        (
            {"variant": None, "forecast": None, "unsettled": (), "unobserved": ("SYS-04", "SYS-07")},
            (
                "No trial so far gives a value that SYS-04 or SYS-07 limits, so that no variant can be chosen. Where "
                "trials at this fidelity do not observe it, more of them do not help. To go on where it stopped, type"
            ),
        ),
        (
            {"forecast": Forecast(rivals={1: None}, requirements={}, accepted=12, trials=None), "unsettled": (1,)},
            (
                f"{UNPROVEN} that variant 1 is worth at most 0.05 more than variant 2. If trials go on as so far, "
                "12800 replicates do not settle all of it: accept the tie, widen until_decided.margin, or go on with "
                "'rgss sweep --budget 100'."
            ),
        ),
        (
            {
                "reason": Reason.BUDGET,
                "unsettled": (),
                "forecast": Forecast(rivals={}, requirements={}, accepted=236, trials=388),
            },
            (
                f"{UNPROVEN} that variant 2 keeps every requirement within the slack. If trials go on as so far, some "
                "400 more trials settle the decision (up to 236 of a variant, more than the cap of 200); to go on "
                "where it stopped, type 'rgss sweep --budget 450 --cap 236', or raise until_decided.budget and "
                "until_decided.cap, as no page reads more of a variant."
            ),
        ),
        (
            {
                "reason": Reason.CAP,
                "unsettled": (),
                "forecast": Forecast(rivals={}, requirements={}, accepted=400, trials=388),
            },
            (
                f"{UNPROVEN} that variant 2 keeps every requirement within the slack. If trials go on as so far, some "
                "400 more trials settle the decision (up to 400 of a variant, more than the cap of 200); to go on "
                "where it stopped, type 'rgss sweep --cap 400', or raise until_decided.cap."
            ),
        ),
    ],
)
def test_what_is_open_in_words(found, words):
    text = open_paragraph(ended(SequentialRule(budget=28), **found), command="rgss sweep")
    assert text.startswith(words)
    assert bool(text) == bool(words)


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["--budget", "40"], "--budget needs --until decided (--replicates is the fixed number of trials)"),
        (
            ["--until", "decided", "--budget", "0"],
            "--budget must be at least 1 trial, got 0 (omit it for the study's)",
        ),
    ],
)
def test_budgets_that_are_none(rgss, untouched, arguments, complaint):
    told = rgss("sweep", *arguments, "--project", untouched)

    assert (told.status, told.output, told.complaint) == (2, "", f"rgss: {complaint}")


def test_trials_that_cannot_be_run_are_a_failure_of_the_run(rgss, folder, monkeypatch):
    failure = RunFailure(key="a" * 64, what="plan", kind=RunFailureKind.CRASHED, detail="killed", attempts=2)
    result = SweepResult(made={}, reused={}, lost=(LostTrials(failure=failure, trials=((1, 1),)),))
    monkeypatch.setattr("rgss.sweep.sweep", lambda *_, **__: result)

    told = rgss("sweep", "--until", "decided", "--project", folder)

    assert (told.status, told.output) == (3, "")
    assert told.errors.splitlines() == [
        "rgss: the plan of variant 1, seed 1 crashed: killed (tried 2 times)",
        "rgss: the trial of variant 1 with seed 1 was not run (see what failed with 'rgss sweep', then run it again)",
    ]
