"""``rgss check``: the project's files, their wording, their traceability and, where requested, their evidence."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rgss.cli.options import STUDY_HELP, add_junit
from rgss.counted import counted

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rgss.findings import Finding
    from rgss.studies import Project

HELP = "check the project's files, wording, traceability and scene, without a simulation"
PAGED = True
EXAMPLE = "rgss check --explain wording.R7"
MORE_EXAMPLES = (
    ("rgss check", "files, wording and traceability of the project"),
    ("rgss check --evidence", "the stored evidence and the result of the tests too"),
    ("rgss check --review all", "stamp every requirement as reviewed; or name some, such as SYS-005 SYS-009"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument("study", nargs="?", metavar="STUDY", help=STUDY_HELP)
    parser.add_argument("--all", action="store_true", help="show notes too, not only errors and warnings")
    parser.add_argument(
        "--evidence", action="store_true", help="check the stored evidence and the result of the tests too"
    )
    add_junit(parser)
    parser.add_argument("--explain", nargs="?", const="", metavar="RULE", help="explain a rule, or list all of them")
    parser.add_argument("--markdown", action="store_true", help="with --explain: write the page of all rules")
    parser.add_argument(
        "--review",
        nargs="+",
        metavar="ID",
        help="stamp these elements as reviewed ('all': every requirement), and check nothing",
    )
    parser.add_argument(
        "--reviewer", metavar="NAME", help="with --review: the name of the reviewer (default: the login name)"
    )


def run(options: argparse.Namespace) -> int:
    """Check and report; 1 if there are errors or warnings, 2 if a file cannot be used."""
    _refuse_idle(options)
    if options.explain is not None:
        return _explain(options)
    if options.review is not None:
        return _review(options)
    return _check(options)


def _check(options: argparse.Namespace) -> int:
    from rgss.cli.command_parser import BAD_INPUT
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.output import print_json
    from rgss.findings import Severity
    from rgss.studies import find_project, invisible_findings, unread_findings

    folder = find_project(options.project)
    checked = [_checked(folder, study, options) for study in _studies(folder, options)]
    found = [finding for one in checked for finding in one.findings]
    # A file with errors may name files that are otherwise reported as unread.
    broken = {finding.file for one in checked if one.project is None for finding in one.findings}
    of_files = [*unread_findings(folder), *invisible_findings(folder)]
    kept = [finding for finding in of_files if finding.file not in broken]
    # Studies may share a scene or a robot, whose findings are reported once.
    findings = list(dict.fromkeys([*found, *kept] if broken else [*kept, *found]))
    problems = [finding for finding in findings if finding.severity is not Severity.INFO]
    skipped = list(dict.fromkeys(one.skipped for one in checked if one.skipped))
    if options.json:
        print_json({"findings": [_as_json(finding) for finding in findings], "skipped": skipped})
    else:
        for finding in findings if options.all else problems:
            print(finding)
        for reason in skipped:
            print(f"Skipped: {reason}.")
        if not broken:
            notes = 0 if options.all else len(findings) - len(problems)
            print(_summary([one.project for one in checked if one.project is not None], len(problems), notes))
    if broken:
        return BAD_INPUT
    return FINDINGS if problems else CLEAN


@dataclass(frozen=True, slots=True, kw_only=True)
class _Checked:
    """Findings of one study, with its project, which is None if files of it cannot be used."""

    project: Project | None
    findings: tuple[Finding, ...]
    skipped: str = ""


def _studies(folder: Path, options: argparse.Namespace) -> tuple[str | None, ...]:
    """The studies to check: the named one, else the default and one for each further set of requirements."""
    from rgss.studies import DEFAULT_STUDY, REQUIREMENTS, studies_by_set

    if options.study is not None:
        return (options.study,)
    by_set = studies_by_set(folder)
    # The default study is loaded in any case, so that its errors are reported.
    loaded = {DEFAULT_STUDY} if DEFAULT_STUDY in by_set.values() else {by_set.get(REQUIREMENTS)}
    return (None, *(study for study in by_set.values() if study not in loaded))


def _checked(folder: Path, study: str | None, options: argparse.Namespace) -> _Checked:
    from rgss.decision import replication_findings
    from rgss.decision.assumptions import assumption_findings
    from rgss.errors import DocumentError
    from rgss.guard import guard_findings
    from rgss.studies import (
        bench_findings,
        check_scene,
        double_counting_findings,
        draw_findings,
        impact_findings,
        light_body_findings,
        load_project,
        object_limit_findings,
        strict_findings,
        task_time_findings,
        threshold_findings,
        uncounted_mass_findings,
        undefined_findings,
        unused_findings,
    )
    from rgss.studies.robot_project import robot_findings

    try:
        project = load_project(folder, study)
        scene = check_scene(project)
        findings = (
            *guard_findings(project),
            *unused_findings(project),
            *uncounted_mass_findings(project),
            *bench_findings(project),
            *impact_findings(project),
            *light_body_findings(project),
            *object_limit_findings(project),
            *draw_findings(project),
            *task_time_findings(project),
            *strict_findings(project),
            *replication_findings(project),
            *threshold_findings(project),
            *undefined_findings(project),
            *double_counting_findings(project),
            *assumption_findings(project),
            *scene.findings,
            *robot_findings(project),
            *_findings(project, options),
        )
    except DocumentError as error:
        return _Checked(project=None, findings=tuple(error.findings))
    return _Checked(project=project, findings=findings, skipped=scene.skipped)


def _findings(project: Project, options: argparse.Namespace) -> tuple[Finding, ...]:
    from rgss.assessment import project_marks
    from rgss.cli.measured import measured_state
    from rgss.trace import check_trace

    marked = project_marks(project.folder, project.study.requirements)
    if not options.evidence:
        return check_trace(project.requirements, project.measure_traces, marked=marked)
    # Without a store, each requirement has a finding that its evidence is missing.
    _, state = measured_state(project, options.junit)
    return check_trace(project.requirements, project.measure_traces, marked=marked, evidence=state)


def _explain(options: argparse.Namespace) -> int:
    from rgss.cli.explained_sources import SOURCE_RULE, source_lines, sources_as_json
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json
    from rgss.trace.rules import RULES, rule_as_json, rule_lines, rule_of, rules_markdown

    if options.markdown:
        print(rules_markdown(), end="")
        return CLEAN
    if options.explain.lower() in (SOURCE_RULE, SOURCE_RULE.partition(".")[2]):
        if options.json:
            print_json({"rules": [sources_as_json()]})
        else:
            print(*source_lines(), sep="\n")
        return CLEAN
    rules = [rule_of(options.explain)] if options.explain else list(RULES)
    if options.json:
        print_json({"rules": [rule_as_json(rule) for rule in rules]})
        return CLEAN
    for index, rule in enumerate(rules):
        if index:
            print()
        if options.explain:
            print(*rule_lines(rule), sep="\n")
        else:
            print(f"{rule.id} ({rule.severity.value})\n  {rule.explanation}")
    return CLEAN


def _review(options: argparse.Namespace) -> int:
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json, shown_path
    from rgss.errors import DocumentError
    from rgss.requirements import load_requirements
    from rgss.studies import find_project, requirements_of_study, without_consequences
    from rgss.trace.rules import expanded, stamped, write_reviews

    project = find_project(options.project)
    name = requirements_of_study(project, options.study)
    folder = project / name
    try:
        requirements = load_requirements(folder, label_root=name)
    except DocumentError as error:
        raise DocumentError(without_consequences(error.findings)) from error
    ids = expanded(requirements, options.review)
    reviews = stamped(requirements, ids, options.reviewer or _login_name())
    path = shown_path(write_reviews(folder, reviews))
    if options.json:
        print_json({"reviewed": list(ids), "reviewer": reviews[ids[0]].reviewer if ids else "", "file": path})
    else:
        elements = "1 element" if len(ids) == 1 else f"{len(ids)} elements"
        print(f"Reviewed {elements}; {path} has {counted(len(reviews), 'review')}.")
    return CLEAN


def _refuse_idle(options: argparse.Namespace) -> None:
    """Refuse options that have no effect beside the others.

    Raises:
        DefinitionError: There is one.
    """
    from rgss.errors import DefinitionError

    if options.explain is not None and options.review is not None:
        raise DefinitionError("--explain and --review exclude each other", hint="give one of them")
    if options.markdown and options.explain != "":
        raise DefinitionError("--markdown writes the page of all rules", hint="rgss check --explain --markdown")
    if options.reviewer is not None and options.review is None:
        raise DefinitionError("--reviewer goes with --review", hint="rgss check --review ID --reviewer NAME")
    if options.junit is not None and not options.evidence:
        raise DefinitionError("--junit goes with --evidence", hint="rgss check --evidence --junit FILE")


def _login_name() -> str:
    import getpass

    from rgss.errors import DefinitionError

    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError) as error:
        raise DefinitionError("the login name is not known", hint="give --reviewer NAME") from error


def _summary(projects: Sequence[Project], problems: int, notes: int) -> str:
    held = [
        f"{len(project.requirements.stakeholder)} stakeholder and {len(project.requirements.system)} system "
        f"requirements, {counted(len(project.measures.measures), 'measure')}, "
        f"{counted(len(project.designs.expand()), 'variant')}"
        for project in projects
    ]
    if len(projects) > 1:
        held = [f"{project.study.label}: {one}" for project, one in zip(projects, held, strict=True)]
    return (
        "\n".join(held)
        + f": {counted(problems, 'finding')}"
        + (f", {counted(notes, 'note')} (--all shows {'it' if notes == 1 else 'them'})" if notes else "")
    )


def _as_json(finding: Finding) -> dict[str, Any]:
    return {
        "rule": finding.rule,
        "severity": finding.severity.value,
        "message": finding.message,
        "file": finding.file,
        "line": finding.line,
        "column": finding.column,
        "hint": finding.hint,
    }
