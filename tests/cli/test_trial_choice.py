"""Commands that are named on pages and in errors choose the trials that the page is about."""

from __future__ import annotations

import argparse

from rgss.api.argument_terms import in_arguments
from rgss.assessment import measure_variants
from rgss.cli.options import sweep_words
from rgss.decision import trace_evidence
from rgss.evidence import EvidenceStore
from rgss.trace.evidence import EvidenceState


def test_commands_name_the_chosen_trials(shipped):
    chosen = shipped.with_replicates(2).nominal().with_fidelity("kinematic")

    assert shipped.command("sweep") == "rgss sweep"
    assert chosen.command("trade") == "rgss trade --fidelity kinematic --replicates 2 --nominal"
    assert (
        shipped.with_fidelity("dynamic").with_fidelity("kinematic").command("sweep").endswith(" --fidelity kinematic")
    )


def test_options_and_project_name_the_same_trials(shipped):
    options = argparse.Namespace(study=None, project="here", fidelity="kinematic", replicates=2, nominal=True)
    words = sweep_words(options, "fidelity", "replicates")

    assert " ".join(words) == shipped.with_fidelity("kinematic").with_replicates(2).nominal().command("sweep")
    assert sweep_words(options, "project", "fidelity")[2:] == [
        *("--project", "here", "--fidelity", "kinematic", "--nominal")
    ]


def test_a_page_names_the_sweep_of_its_own_trials(shipped, tmp_path):
    project = shipped.with_fidelity("kinematic").nominal()
    with EvidenceStore.open(tmp_path / "empty.sqlite") as store:
        evidence = trace_evidence(project, measure_variants(project, store), EvidenceState())

    assert "(run 'rgss sweep" in evidence.choice
    assert evidence.choice.endswith(" --fidelity kinematic --nominal' first)")
    assert evidence.sweep.endswith(" --fidelity kinematic --nominal")
    assert in_arguments(evidence.choice).endswith("(call sweep() first)")
