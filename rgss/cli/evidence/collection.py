"""Garbage collection of the evidence store: trials and pieces that no study names."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import TYPE_CHECKING

from rgss.cli.evidence.place import EvidencePlace, contents_and_studies, named_trials
from rgss.cli.evidence.words import counted_trials, size_text
from rgss.counted import counted

if TYPE_CHECKING:
    from rgss.evidence.store import Garbage


def collect(options: argparse.Namespace, store: EvidencePlace) -> int:
    """Show the trials and pieces that no study names; remove them if `--apply` is given."""
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json
    from rgss.confirmation import confirmation_trials
    from rgss.evidence import EvidenceStore
    from rgss.evidence.store import collect_garbage, find_garbage

    contents, studies = contents_and_studies(store)
    trials = named_trials(studies, strict=options.strict)
    pieces = {digest for study in studies for digest in (study.own if options.strict else study.all).pieces}
    if not options.strict:
        with EvidenceStore.open(store.path, create=False, label=store.label) as evidence:
            trials |= confirmation_trials((study.project for study in studies), evidence)
    freed, shrunk = None, True
    if options.apply:
        done = collect_garbage(store.path, trials=trials, pieces=pieces, label=store.label, then=contents.ledger)
        garbage, freed, shrunk = done.garbage, done.before_bytes - done.after_bytes, done.shrunk
    else:
        with EvidenceStore.open(store.path, create=False, label=store.label) as evidence:
            garbage = find_garbage(evidence.database, trials=trials, pieces=pieces)
    if options.json:
        print_json(
            {
                "evidence": store.label,
                "removed": bool(options.apply),
                "trials": [
                    {"key": one.key, "variant": one.variant, "seed": one.seed, "fidelity": one.fidelity}
                    for one in garbage.trials
                ],
                "pieces": len(garbage.pieces),
                "inputs": len(garbage.inputs),
                "failures": len(garbage.failures),
                "bytes": garbage.size_bytes,
                "freed_bytes": freed,
            }
        )
        return CLEAN
    if not garbage:
        print("The studies name everything that is stored; there is nothing to remove.")
        return CLEAN
    print("With the present inputs and code, no study of the project names:")
    for line in _garbage_lines(garbage):
        print(f"  {line}")
    if not options.apply:
        print(f"In all {size_text(garbage.size_bytes)}; 'rgss evidence gc --apply' removes it.")
    elif shrunk:
        print(f"Removed; the file is {size_text(freed or 0)} smaller.")
    else:
        print("Removed; the file keeps its size, since there is no space to rewrite it; later trials reuse the space.")
    return CLEAN


def _garbage_lines(garbage: Garbage) -> Iterable[str]:
    if garbage.trials:
        variants = len({trial.variant for trial in garbage.trials})
        yield f"{counted_trials('trials', garbage.trials)} of {counted(variants, 'variant')}"
    for name, keys in (("piece", garbage.pieces), ("set", garbage.inputs), ("failure", garbage.failures)):
        of = {"set": " of inputs", "failure": " of the run"}.get(name, "")
        if keys:
            yield f"{counted(len(keys), name)}{of}"
