"""Verification and repair of the evidence store."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from rgss.cli.evidence.place import EvidencePlace
from rgss.counted import counted
from rgss.findings import printable

if TYPE_CHECKING:
    from rgss.evidence.store import Verification


def verify_evidence(options: argparse.Namespace, store: EvidencePlace) -> int:
    """Check every page, digest, seal and reference; 1 if there is damage."""
    from rgss.cli.evidence.numerics import computed_with, numerics_line
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.output import print_json
    from rgss.evidence.store import verify

    found = verify(store.path, label=store.label)
    mended = _mend(found, store) if options.mend and found.damages else ""
    computed = [] if found.damages else computed_with(store.path, store.label)
    if options.json:
        print_json(
            {
                "evidence": store.label,
                "sound": dict(found.sound),
                "orphaned_pieces": found.orphaned_pieces,
                "orphaned_inputs": found.orphaned_inputs,
                "damages": [{"what": one.what, "key": one.key, "problem": one.problem} for one in found.damages],
                "mended": mended,
                "numerics": computed,
            }
        )
        return FINDINGS if found.damages else CLEAN
    for damage in found.damages:
        print(printable(f"{store.label}: {damage}"))
    sound = ", ".join(counted(number, what.removesuffix("s")) for what, number in found.sound.items())
    if found.damages:
        print(f"{counted(len(found.damages), 'damage')}; sound: {sound or 'nothing'}.")
        print(mended or _how_to_mend(found))
        return FINDINGS
    print(f"Sound: {sound}.")
    for one in computed:
        if one["numerics"]:
            print(numerics_line(one))
    idle = {"pieces": found.orphaned_pieces, "inputs": found.orphaned_inputs}
    if any(idle.values()):
        which = " and ".join(f"{count} of the {name}" for name, count in idle.items() if count)
        print(
            f"No trial refers to {which}, which is no damage; the next sweep uses what it can, "
            "or 'rgss evidence gc' shows what is left."
        )
    return CLEAN


def _mend(found: Verification, store: EvidencePlace) -> str:
    """Repair the damage; returns a description of the repair."""
    from rgss.evidence.store import remove_damaged_rows, salvage

    if found.pages_are_damaged:
        path, to = store.path, store.path.with_name(f"{store.path.name}.mended")
        saved = salvage(path, found, to, label=store.label)
        return (
            f"{saved} sound rows are saved in {to.name} beside it. When no sweep is running, remove {path.name} and "
            f"the files {path.name}-wal and {path.name}-shm if they are there, and rename {to.name} to {path.name}."
        )
    removed = remove_damaged_rows(store.path, label=store.label)
    if not removed:
        return "The ledger is rewritten for the rows that exist; 'rgss sweep' makes the others again as needed."
    return f"{counted(removed, 'damaged row')} removed; 'rgss sweep' makes their contents again."


def _how_to_mend(found: Verification) -> str:
    if found.pages_are_damaged:
        return "To repair it: 'rgss evidence verify --mend' saves the sound rows in a new file."
    if all(damage.row is None for damage in found.damages):
        return "To repair it: 'rgss evidence verify --mend' keeps the rows that exist."
    return "To repair it: 'rgss evidence verify --mend' removes these rows, and 'rgss sweep' makes them again."
