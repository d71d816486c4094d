"""``rgss evidence``: what the store holds; checking it, exporting it, clearing it up."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from rgss.cli.options import add_fidelity, add_replicates, chosen_project

if TYPE_CHECKING:
    from rgss.decision import NamingStudy
    from rgss.evidence.records import StoredTrial
    from rgss.evidence.store import Contents, Garbage, TrialName, Verification


class _Store(NamedTuple):
    """Where the evidence is, and what to call it."""

    folder: Path
    path: Path
    label: str


HELP = "tell what the evidence store holds, check it, export it or clear it up"
EXAMPLE = "rgss evidence export trials.parquet"
MORE_EXAMPLES = (
    ("rgss evidence", "what is stored"),
    ("rgss evidence export trials.csv studies/pick_place.yaml", "the trials of one study, as it is now"),
    ("rgss evidence verify", "whether every byte is what was written"),
    ("rgss evidence gc", "what clearing up would remove"),
)
_SHOWN = 12


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's actions."""
    actions = parser.add_subparsers(dest="action", metavar="ACTION")
    verify = _action(actions, "verify", "", "check every page, digest, seal and reference (--mend takes damage away)")
    verify.add_argument(
        "--mend",
        action="store_true",
        help="take damaged rows away, so that the next sweep makes them anew; save the sound rows of a damaged file",
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
    gc = _action(actions, "gc", "--apply", "show what no study names (--apply removes it; --strict keeps less)")
    gc.add_argument(
        "--strict",
        action="store_true",
        help="keep only what the studies themselves ask for, not what --fidelity and --replicates made of them",
    )
    doing = gc.add_mutually_exclusive_group()
    doing.add_argument("--apply", action="store_true", help="remove it, and give its space back")
    doing.add_argument("--dry-run", action="store_true", help="only show it, which is the default")


def _action(actions: Any, name: str, words: str, text: str) -> argparse.ArgumentParser:
    example = f"Example: rgss evidence {name} {words}".rstrip()
    parser: argparse.ArgumentParser = actions.add_parser(
        name, help=text, description=text[:1].upper() + text[1:] + ".", epilog=example
    )
    # Without a default, which would take the place of what stands before the action.
    parser.add_argument("--project", type=Path, metavar="DIR", default=argparse.SUPPRESS, help="the project's folder")
    parser.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print one JSON document")
    return parser


def run(options: argparse.Namespace) -> int:
    """Do what was asked; a summary if nothing was."""
    from rgss.cli.output import shown_path
    from rgss.studies import EVIDENCE, find_project

    folder = find_project(options.project)
    store = _Store(folder=folder, path=folder / EVIDENCE, label=shown_path(folder / EVIDENCE))
    actions = {None: _summarise, "verify": _verify, "export": _export, "gc": _collect}
    return actions[options.action](options, store)


def _summarise(options: argparse.Namespace, store: _Store) -> int:
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json, print_table

    contents, studies = _contents(store)
    current, stale = _divided(contents.trials, _named_trials(studies, strict=False))
    there = {trial.key for trial in contents.trials}
    asked = _asked(store, studies)
    rows = []
    for study, own in zip(studies, asked, strict=True):
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
    if options.json:
        print_json(
            {
                "evidence": store.label,
                "bytes": contents.size_bytes,
                "trials": len(contents.trials),
                "current": _by_fidelity(current),
                "stale": _by_fidelity(stale),
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
        )
        return CLEAN
    print(f"Evidence: {store.label}, {_size(contents.size_bytes)}")
    print(f"Trials: {len(contents.trials)}; {_counted('current', current)}, {_counted('stale', stale)}")
    kinds = ", ".join(f"{number} of kind {kind}" for kind, number in contents.pieces.items())
    print(f"Pieces: {sum(contents.pieces.values())}{f' ({kinds})' if kinds else ''}")
    print()
    titles = ["study", "fidelity", "trials", "with evidence", "missing", "failures of the run"]
    print_table(titles, [[str(cell) for cell in row.values()] for row in rows], right=(2, 3, 4, 5))
    if contents.failures:
        print()
        print("Failures of the run, which the next sweep tries again:")
        for one in contents.failures[:_SHOWN]:
            print(f"  {_printable(one.what)} {one.key[:12]}: {one.kind.value}, {_printable(one.detail)}")
        if len(contents.failures) > _SHOWN:
            print(f"  … and {len(contents.failures) - _SHOWN} more (--json shows them)")
    if stale:
        print()
        print("Stale trials are of other inputs or other code than now; 'rgss evidence gc' shows them.")
    return CLEAN


def _verify(options: argparse.Namespace, store: _Store) -> int:
    from rgss.cli.evidence_numerics import computed_with, numerics_line
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
        print(_printable(f"{store.label}: {damage}"))
    sound = ", ".join(f"{number} {_plural(what, number)}" for what, number in found.sound.items())
    if found.damages:
        print(f"{len(found.damages)} {_plural('damage', len(found.damages))}; sound: {sound or 'nothing'}.")
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


def _mend(found: Verification, store: _Store) -> str:
    """Take the damage away; returns what was done."""
    from rgss.evidence.store import salvage, take_away

    if found.pages_are_damaged:
        path, to = store.path, store.path.with_name(f"{store.path.name}.mended")
        saved = salvage(path, found, to, label=store.label)
        return (
            f"{saved} sound rows are saved in {to.name} beside it. When no sweep is running, remove {path.name} and "
            f"the files {path.name}-wal and {path.name}-shm if they are there, and rename {to.name} to {path.name}."
        )
    removed = take_away(store.path, found, label=store.label)
    if not removed:
        return (
            "The ledger is written anew for the rows that are there; 'rgss sweep' makes anew what it needs of others."
        )
    return f"{removed} damaged {_plural('row', removed)} taken away; 'rgss sweep' makes anew what was in them."


def _how_to_mend(found: Verification) -> str:
    if found.pages_are_damaged:
        return "To mend it: 'rgss evidence verify --mend' saves the sound rows in a new file."
    if all(damage.row is None for damage in found.damages):
        return "To mend it: 'rgss evidence verify --mend' goes on with the rows that are there."
    return "To mend it: 'rgss evidence verify --mend' takes these rows away, and 'rgss sweep' makes them anew."


def _export(options: argparse.Namespace, store: _Store) -> int:
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
    announce(f"{count} {_plural('trial', count)} written to {options.file}", options.file)
    if missing:
        print(f"{missing} more {'has' if missing == 1 else 'have'} no evidence yet; 'rgss sweep' makes it.")
    return CLEAN


def _collect(options: argparse.Namespace, store: _Store) -> int:
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json
    from rgss.evidence import EvidenceStore
    from rgss.evidence.store import collect_garbage, find_garbage

    _, studies = _contents(store)
    trials = _named_trials(studies, strict=options.strict)
    pieces = {digest for study in studies for digest in (study.own if options.strict else study.all).pieces}
    freed, shrunk = None, True
    if options.apply:
        done = collect_garbage(store.path, trials=trials, pieces=pieces, label=store.label)
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
        print("The studies name everything that is in the evidence; there is nothing to remove.")
        return CLEAN
    print("No study of the project, as it and the code are now, names:")
    for line in _garbage_lines(garbage):
        print(f"  {line}")
    if not options.apply:
        print(f"In all {_size(garbage.size_bytes)}; 'rgss evidence gc --apply' removes it.")
    elif shrunk:
        print(f"Removed; the file is {_size(freed or 0)} smaller.")
    else:
        print("Removed; the file keeps its size, for there is no space to write it anew, and uses it for what comes.")
    return CLEAN


def _garbage_lines(garbage: Garbage) -> Iterable[str]:
    if garbage.trials:
        variants = len({trial.variant for trial in garbage.trials})
        yield f"{_counted('trials', garbage.trials)} of {variants} {_plural('variant', variants)}"
    for name, keys in (("piece", garbage.pieces), ("set", garbage.inputs), ("failure", garbage.failures)):
        of = {"set": " of inputs", "failure": " of the run"}.get(name, "")
        if keys:
            yield f"{len(keys)} {_plural(name, len(keys))}{of}"


def _asked(store: _Store, studies: Sequence[NamingStudy]) -> list[frozenset[str]]:
    """The trials that each study asks for, as far as its screening is known."""
    from rgss.decision import asked_trials
    from rgss.evidence import EvidenceStore

    if not store.path.exists():
        return [asked_trials(study, None) for study in studies]
    with EvidenceStore.open(store.path, create=False, label=store.label) as evidence:
        return [asked_trials(study, evidence) for study in studies]


def _contents(store: _Store) -> tuple[Contents, tuple[NamingStudy, ...]]:
    """What the store holds, and the studies with what they name of it."""
    from rgss.decision import naming_studies
    from rgss.evidence import EvidenceStore
    from rgss.evidence.store import contents_of
    from rgss.trials.code import assume_engines

    with EvidenceStore.open(store.path, create=False, label=store.label) as evidence:
        contents = contents_of(evidence.database)
        assume_engines(trial.provenance.versions for trial in evidence.iterate())
    seeds: dict[str, set[int]] = {}
    for trial in contents.trials:
        seeds.setdefault(trial.fidelity, set()).add(trial.seed)
    return contents, naming_studies(store.folder, seeds)


def _named_trials(studies: Iterable[NamingStudy], *, strict: bool) -> set[str]:
    return {key for study in studies for key in (study.own if strict else study.all).trials}


def _divided(trials: Iterable[TrialName], named: set[str]) -> tuple[list[TrialName], list[TrialName]]:
    current: list[TrialName] = []
    stale: list[TrialName] = []
    for trial in trials:
        (current if trial.key in named else stale).append(trial)
    return current, stale


def _by_fidelity(trials: Iterable[TrialName]) -> Mapping[str, int]:
    return dict(sorted(Counter(trial.fidelity for trial in trials).items()))


def _counted(what: str, trials: Iterable[TrialName]) -> str:
    by_fidelity = _by_fidelity(trials)
    each = ", ".join(f"{number} {_printable(fidelity)}" for fidelity, number in by_fidelity.items())
    return f"{sum(by_fidelity.values())} {what}{f' ({each})' if each else ''}"


def _plural(word: str, number: int) -> str:
    return word if number == 1 or word == "inputs" else f"{word}s"


def _size(size_bytes: int) -> str:
    if size_bytes < 1_000_000:
        return f"{size_bytes / 1000:.0f} kB"
    return f"{size_bytes / 1_000_000:.1f} MB"


def _printable(text: str) -> str:
    """Text that comes from a file must not steer the terminal."""
    return "".join(character if character.isprintable() else "�" for character in text)
