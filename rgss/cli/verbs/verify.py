"""``rgss verify``: records what a person found who inspected, demonstrated, analysed or tested a requirement."""

from __future__ import annotations

import argparse
from datetime import date

from rgss.cli.options import STUDY_HELP
from rgss.counted import counted

HELP = "record what an inspection, a demonstration, an analysis or a test by a person found"
EXAMPLE = "rgss verify SYS-2 --result met --by 'A. Reader' --on 2026-05-12 --file protocols/closing.md"
MORE_EXAMPLES = (
    (
        "rgss verify SYS-2 SYS-3 --result not-met --by 'A. Reader' --on 2026-05-12 --note 'It closes in 2.4 s.'",
        "two requirements at once, with a note",
    ),
    ("rgss verify SYS-2 --withdraw", "take back what is recorded of it"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument("requirements", nargs="+", metavar="ID", help="system requirements that were verified")
    parser.add_argument("--result", choices=("met", "not-met", "inconclusive"), help="what was found")
    parser.add_argument("--by", metavar="NAME", help="who verified")
    parser.add_argument("--on", metavar="DATE", help="when, as year-month-day")
    parser.add_argument(
        "--file",
        action="append",
        default=[],
        metavar="FILE",
        help="a file of the project that it rests on, such as the protocol, or what was inspected; may be repeated",
    )
    parser.add_argument("--note", default="", metavar="TEXT", help="what was done or seen, in a line")
    parser.add_argument("--withdraw", action="store_true", help="remove the record of these requirements instead")
    parser.add_argument("--study", metavar="STUDY", help=f"{STUDY_HELP}; its set of requirements is meant")


def run(options: argparse.Namespace) -> int:
    """Write the record."""
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json, shown_path
    from rgss.errors import DocumentError
    from rgss.requirements import RecordedResult, load_requirements
    from rgss.studies import find_project, requirements_of_study, without_consequences
    from rgss.trace.evidence import new_record, with_record, write_records

    _refuse_contradictions(options)
    project = find_project(options.project)
    name = requirements_of_study(project, options.study)
    try:
        requirements = load_requirements(project / name, label_root=name)
    except DocumentError as error:
        raise DocumentError(without_consequences(error.findings)) from error
    record = None
    if not options.withdraw:
        record = new_record(
            project,
            result=RecordedResult(options.result.replace("-", "_")),
            by=options.by,
            on=options.on,
            today=date.today(),
            note=options.note,
            files=options.file,
        )
    ids = tuple(dict.fromkeys(options.requirements))
    records = with_record(requirements, ids, record)
    path = shown_path(write_records(project / name, records))
    if options.json:
        print_json({"verified": list(ids), "result": None if record is None else record.result.value, "file": path})
    else:
        done = "Withdrew the record" if record is None else f"Recorded {options.result.replace('-', ' ')}"
        print(f"{done} of {', '.join(ids)}; {path} has {counted(len(records), 'record')}.")
    return CLEAN


def _refuse_contradictions(options: argparse.Namespace) -> None:
    """Refuse a record that lacks what it must state, and a withdrawal that states something.

    Raises:
        DefinitionError: The options do so.
    """
    from rgss.errors import DefinitionError

    stated = {"--result": options.result, "--by": options.by, "--on": options.on}
    if options.withdraw:
        given = [name for name, value in {**stated, "--file": options.file, "--note": options.note}.items() if value]
        if given:
            raise DefinitionError(f"--withdraw and {given[0]} exclude each other", hint="give one of them")
        return
    missing = [name for name, value in stated.items() if not value]
    if missing:
        raise DefinitionError(f"{' and '.join(missing)} {'is' if len(missing) == 1 else 'are'} missing", hint=EXAMPLE)
