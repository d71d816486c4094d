"""Summary of the evidence store."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rgss.cli.evidence.place import EvidencePlace, contents_and_studies, named_trials, trials_by_study
from rgss.cli.evidence.words import by_fidelity, counted_trials, divided, size_text
from rgss.findings import printable

if TYPE_CHECKING:
    from rgss.decision import NamingStudy
    from rgss.evidence.store import Contents, TrialName

_SHOWN = 12
"""Number of failures that are printed."""


def summarise(options: argparse.Namespace, store: EvidencePlace) -> int:
    """Print the contents of the store, and the missing trials of each study."""
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json

    contents, studies = contents_and_studies(store)
    current, stale = divided(contents.trials, named_trials(studies, strict=False))
    rows = _rows(contents, studies, trials_by_study(store, studies))
    if options.json:
        print_json(_document(store, contents, rows, current, stale))
    else:
        _print_summary(store, contents, rows, current, stale)
    return CLEAN


def _rows(
    contents: Contents, studies: Sequence[NamingStudy], trials: Sequence[frozenset[str]]
) -> list[dict[str, str | int]]:
    there = {trial.key for trial in contents.trials}
    rows: list[dict[str, str | int]] = []
    for study, own in zip(studies, trials, strict=True):
        failed = [one for one in contents.failures if one.key in own | study.own.pieces]
        rows.append(
            {
                "study": study.file,
                "fidelity": study.project.study.fidelity.value,
                "trials": len(own),
                "with_evidence": len(own & there),
                "missing": len(own - there),
                "failures_of_the_run": len(failed),
            }
        )
    return rows


def _document(
    store: EvidencePlace,
    contents: Contents,
    rows: list[dict[str, str | int]],
    current: list[TrialName],
    stale: list[TrialName],
) -> dict[str, Any]:
    return {
        "evidence": store.label,
        "bytes": contents.size_bytes,
        "trials": len(contents.trials),
        "current": by_fidelity(current),
        "stale": by_fidelity(stale),
        "studies": rows,
        "pieces": dict(contents.pieces),
        "inputs": contents.inputs,
        "failures_of_the_run": [
            {
                "key": one.key,
                "what": one.what,
                "kind": one.kind.value,
                "detail": one.detail,
                "attempts": one.attempts,
            }
            for one in contents.failures
        ],
    }


def _print_summary(
    store: EvidencePlace,
    contents: Contents,
    rows: list[dict[str, str | int]],
    current: list[TrialName],
    stale: list[TrialName],
) -> None:
    from rgss.cli.output import print_table

    print(f"Evidence: {store.label}, {size_text(contents.size_bytes)}")
    print(f"Trials: {len(contents.trials)}; {counted_trials('current', current)}, {counted_trials('stale', stale)}")
    kinds = ", ".join(f"{number} of kind {kind}" for kind, number in contents.pieces.items())
    print(f"Pieces: {sum(contents.pieces.values())}{f' ({kinds})' if kinds else ''}")
    print()
    titles = ["study", "fidelity", "trials", "with evidence", "missing", "failures of the run"]
    print_table(titles, [[str(cell) for cell in row.values()] for row in rows], right=(2, 3, 4, 5))
    if contents.failures:
        print()
        print("Failures of the run, which the next sweep retries:")
        for one in contents.failures[:_SHOWN]:
            print(f"  {printable(one.what)} {one.key[:12]}: {one.kind.value}, {printable(one.detail)}")
        if len(contents.failures) > _SHOWN:
            print(f"  … and {len(contents.failures) - _SHOWN} more (--json shows them)")
    if stale:
        print()
        print("Stale trials were made with other inputs or code than the present ones; 'rgss evidence gc' shows them.")
