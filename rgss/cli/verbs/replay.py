"""``rgss replay``: a stored trial run again, compared bit for bit, or within a tolerance on other numerics."""

from __future__ import annotations

import argparse
from typing import Any

from rgss.cli.options import STUDY_HELP, add_fidelity, chosen_project

HELP = "run a stored trial again and compare it bit for bit"
EXAMPLE = "rgss replay 2/1"
MORE_EXAMPLES = (("rgss replay 2/1 --json", "the differences, if any, as JSON"),)
WITHIN_TOLERANCE = 4
"""The exit status where the trial was computed with other numerics, and deviates within the tolerance."""

_SHOWN = 12


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument("trial", metavar="TRIAL", help="variant and seed, such as 28/1, or the beginning of its key")
    parser.add_argument("--study", metavar="STUDY", help=STUDY_HELP)
    add_fidelity(parser)


def run(options: argparse.Namespace) -> int:
    """Run it again; 1 if a bit differs, 4 if that is within the tolerance of other numerics."""
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.measured import require_store
    from rgss.cli.output import print_json, shown_path
    from rgss.engines import require_engines
    from rgss.evidence import EvidenceStore, record_digest
    from rgss.sweep import Agreement, deviation, find_trial, replay

    require_engines("'rgss replay'")
    project = chosen_project(options)
    require_store(options, project)
    with EvidenceStore.open(project.evidence, create=False, label=shown_path(project.evidence)) as store:
        stored = find_trial(project, store, options.trial)
        known_by = stored.provenance.inputs_digest
        inputs = store.inputs(known_by) if known_by else None
    result = replay(project, stored, inputs=inputs)
    if options.json:
        print_json(
            {
                "key": stored.key,
                "variant": stored.record.variant,
                "seed": stored.record.seed,
                "same": result.same,
                "agreement": result.agreement.value,
                "numerics_then": dict(stored.provenance.numerics),
                "numerics_now": dict(result.numerics),
                "digest_then": stored.content_digest,
                "digest_now": record_digest(result.record),
                "versions": [_as_json(change) for change in result.versions],
                "changed_inputs": list(result.inputs),
                "inputs": [_as_json(change) for change in result.changes],
                "differences": [{**_as_json(change), "deviation": deviation(change)} for change in result.differences],
            }
        )
    else:
        _show(result)
    statuses = {Agreement.BIT_FOR_BIT: CLEAN, Agreement.WITHIN_TOLERANCE: WITHIN_TOLERANCE}
    return statuses.get(result.agreement, FINDINGS)


def _as_json(change: Any) -> dict[str, str]:
    return {"name": change.name, "then": change.then, "now": change.now}


def _show(result: Any) -> None:
    from rgss.cli.output import number, print_table
    from rgss.evidence.records import numerics_difference
    from rgss.sweep import Agreement, beyond_tolerance, deviation

    record = result.stored.record
    print(f"Trial {result.stored.key[:12]}: variant {record.variant}, seed {record.seed}, {record.fidelity.value}")
    for change in result.versions:
        print(f"  version of {change.name}: {change.then[:12]} then, {change.now[:12]} now")
    if result.inputs:
        print(f"  changed inputs: {', '.join(result.inputs)}")
    for change in result.changes:
        print(f"  {change.name}: {change.then} then, {change.now} now")
    if result.same:
        print(f"The same, bit for bit: {result.stored.content_digest}")
        return
    difference = numerics_difference(result.stored.provenance.numerics, result.numerics)
    if difference:
        print(f"Computed with other numerics: {difference.replace(' there', ' then').replace(' here', ' now')}")
    if result.agreement is Agreement.WITHIN_TOLERANCE:
        print(
            "The same within the tolerance of other numerics, not bit for bit: "
            f"{len(result.differences)} values differ:"
        )
    else:
        beyond = len(beyond_tolerance(result.differences))
        print(f"{len(result.differences)} values differ{f', {beyond} beyond the tolerance' if difference else ''}:")
    shown = result.differences[:_SHOWN]
    rows = [[change.name, change.then, change.now] for change in shown]
    if difference:
        rows = [[*row, number(deviation(change), 3)] for row, change in zip(rows, shown, strict=True)]
    print_table(["value", "then", "now", *(["deviation"] if difference else [])], rows, right=(3,))
    if len(result.differences) > _SHOWN:
        print(f"… and {len(result.differences) - _SHOWN} more (--json shows them)")
