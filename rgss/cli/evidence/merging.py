"""Merge of another store into the project's."""

from __future__ import annotations

import argparse

from rgss.cli.evidence.place import EvidencePlace
from rgss.counted import counted


def merge_evidence(options: argparse.Namespace, store: EvidencePlace) -> int:
    """Add what another store has; 1 if some of its rows are damaged."""
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.output import print_json, shown_path
    from rgss.errors import DefinitionError
    from rgss.evidence import EvidenceStore
    from rgss.evidence.store import merge
    from rgss.studies import EVIDENCE

    other = shown_path(options.file)
    if not options.file.exists():
        raise DefinitionError(f"there is no store {other}", hint="name the file of another store")
    if options.file.is_dir():
        inside = options.file / EVIDENCE
        hint = f"its store is {shown_path(inside)}" if inside.is_file() else "name the file of another store"
        raise DefinitionError(f"{options.file} is a folder, not a store", hint=hint)
    if store.path.exists() and store.path.samefile(options.file):
        raise DefinitionError(f"{other} is the store of this project", hint="name another store")
    with (
        EvidenceStore.open(options.file, create=False, label=other) as source,
        EvidenceStore.open(store.path, label=store.label) as target,
    ):
        found = merge(target, source)
        target.confirm()
    if options.json:
        print_json(
            {
                "evidence": store.label,
                "from": other,
                "trials": found.trials,
                "pieces": found.pieces,
                "present": found.present,
                "left_out": found.left_out,
                "unproven": found.unproven,
            }
        )
    else:
        added = f"{counted(found.trials, 'trial')} and {counted(found.pieces, 'piece')}"
        print(f"{added} added to {store.label}; {found.present} of {other} were there already.")
        if found.left_out:
            print(f"{counted(found.left_out, 'damaged row')} of {other} left out.")
        if found.unproven:
            print(
                f"{counted(found.unproven, 'piece')} of {other} left out: it has no trial, which would state the "
                "numerics with which they were computed."
            )
    return FINDINGS if found.left_out else CLEAN
