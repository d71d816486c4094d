"""``rgss evidence``: contents, verification, export, merge and garbage collection of the store."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rgss.cli.options import add_fidelity, add_replicates, chosen_project, with_sweep_options
from rgss.counted import counted

if TYPE_CHECKING:
    from rgss.cli.evidence import EvidencePlace
    from rgss.evidence.records import StoredTrial


HELP = "show the contents of the evidence store, verify it, export it, merge another one or clean it up"
EXAMPLE = "rgss evidence export trials.parquet"
MORE_EXAMPLES = (
    ("rgss evidence", "what is stored"),
    ("rgss evidence export trials.csv studies/pick_place.yaml", "the trials of one study, as it is now"),
    ("rgss evidence verify", "check the store for damage"),
    ("rgss evidence gc", "what cleaning up would remove"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's actions."""
    actions = parser.add_subparsers(dest="action", metavar="ACTION")
    verify = _action(actions, "verify", "", "check every page, digest, seal and reference (--mend repairs damage)")
    verify.add_argument(
        "--mend",
        action="store_true",
        help="remove damaged rows, which the next sweep makes again; save the sound rows of a damaged file",
    )
    export = _action(
        actions, "export", "trials.csv studies/pick_place.yaml", "write one row a trial to FILE.parquet or FILE.csv"
    )
    export.add_argument("file", type=Path, metavar="FILE", help="a file whose name ends in .parquet or .csv")
    export.add_argument(
        "study", nargs="?", metavar="STUDY", help="only the trials of this study (default: all that are stored)"
    )
    add_replicates(export)
    add_fidelity(export)
    merged = _action(
        actions, "merge", "../copy/.rgss/evidence.sqlite", "add the trials and pieces of another store to this one"
    )
    merged.add_argument("file", type=Path, metavar="FILE", help="the other store, which is not changed")
    gc = _action(
        actions,
        "gc",
        "--apply",
        "show the trials and pieces that no study names (--apply removes them; --strict keeps fewer)",
    )
    gc.add_argument(
        "--strict",
        action="store_true",
        help="keep only the trials that the studies state, not those run with --fidelity or --replicates",
    )
    doing = gc.add_mutually_exclusive_group()
    doing.add_argument("--apply", action="store_true", help="remove them, and free their space")
    doing.add_argument("--dry-run", action="store_true", help="only show them, which is the default")


def _action(actions: Any, name: str, words: str, text: str) -> argparse.ArgumentParser:
    example = f"Example: rgss evidence {name} {words}".rstrip()
    parser: argparse.ArgumentParser = actions.add_parser(
        name, help=text, description=text[:1].upper() + text[1:] + ".", epilog=example
    )
    # No default, which would replace the option given before the action.
    parser.add_argument("--project", type=Path, metavar="DIR", default=argparse.SUPPRESS, help="the project's folder")
    parser.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print one JSON document")
    return parser


def run(options: argparse.Namespace) -> int:
    """Carry out the action; a summary without one."""
    from rgss.cli.evidence import EvidencePlace, collect, merge_evidence, summarise, verify_evidence
    from rgss.cli.output import shown_path
    from rgss.studies import EVIDENCE, find_project

    folder = find_project(options.project)
    store = EvidencePlace(folder=folder, path=folder / EVIDENCE, label=shown_path(folder / EVIDENCE))
    actions = {
        None: summarise,
        "verify": verify_evidence,
        "export": _export,
        "merge": merge_evidence,
        "gc": collect,
    }
    return actions[options.action](options, store)


def _export(options: argparse.Namespace, store: EvidencePlace) -> int:
    from rgss.cli.main import CLEAN
    from rgss.cli.output import announce, print_json
    from rgss.decision import asked_of
    from rgss.documents import require_no_source
    from rgss.evidence import EvidenceStore
    from rgss.evidence.store import export_trials, require_exportable

    require_exportable(options.file)
    require_no_source(options.file)
    limited = any(choice is not None for choice in (options.study, options.replicates, options.fidelity))
    project = chosen_project(options) if limited else None
    missing = 0
    with EvidenceStore.open(store.path, create=False, label=store.label) as evidence:
        trials: Iterable[StoredTrial] = evidence.iterate()
        if project is not None:
            asked = asked_of(project, evidence)
            missing = len(asked) - len(evidence.has(asked))
            trials = (trial for trial in trials if trial.key in asked)
        count = export_trials(trials, options.file)
    if options.json:
        print_json({"evidence": store.label, "file": str(options.file), "trials": count, "missing": missing})
        return CLEAN
    announce(f"{counted(count, 'trial')} written to {options.file}", options.file)
    if missing:
        sweep = with_sweep_options("'rgss sweep'", options)
        print(f"{missing} more {'has' if missing == 1 else 'have'} no evidence yet; {sweep} makes it.")
    return CLEAN
