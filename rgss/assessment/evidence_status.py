"""State of a project's evidence: verdicts from its trials, and results of its own tests."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

from rgss.assessment.measuring import VariantMeasures, requirements_with_criteria
from rgss.assessment.recorded_verdicts import VerdictRecord, study_key
from rgss.errors import DefinitionError, EvidenceError
from rgss.requirements import RequirementSet
from rgss.studies import REQUIREMENTS, Project, named_sets, qualifier_of
from rgss.trace.evidence import (
    JUNIT_FILE,
    EvidenceState,
    FailedVerifications,
    MarkedTest,
    SoftwareEvidence,
    TrialVerdicts,
    evidence_of_records,
    marked_tests,
    read_junit,
    software_digest,
    software_evidence,
    tested_files,
)

TESTS = "tests"
"""The folder of a project's own tests."""


def evidence_state(
    project: Project,
    measured: Sequence[VariantMeasures],
    *,
    recorded: VerdictRecord | None = None,
    junit: Path | None = None,
) -> EvidenceState:
    """Evidence on each requirement.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates; empty if there is no evidence from trials.
        recorded: The verdicts that were recorded.
        junit: The result of the project's tests; by default the file that ``make test`` writes,
            which need not exist.

    Raises:
        DefinitionError: There is a result of tests, but the project has no tests.
        EvidenceError: Files of tests or their result cannot be read.
    """
    folder = project.study.requirements
    marked = project_marks(project.folder, folder)
    if junit is not None and marked is None:
        raise DefinitionError("--junit is given, but the project has no tests", hint="omit it")
    return EvidenceState(
        trials=trial_verdicts(project, measured, recorded=recorded),
        software=None
        if marked is None
        else project_tests(project.folder, project.requirements, marked, requirement_folder=folder, junit=junit),
        records=evidence_of_records(project.requirements, project.folder),
    )


def trial_verdicts(
    project: Project, measured: Sequence[VariantMeasures], *, recorded: VerdictRecord | None = None
) -> MappingProxyType[str, TrialVerdicts]:
    """The verdicts on each requirement with a criterion, by its id.

    A recorded verdict that is older than a trial of its variant says nothing about the present evidence.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.
        recorded: The verdicts that were recorded.
    """
    key = study_key(project.study.label, project.study.fidelity.value)
    book = {} if recorded is None else recorded.of_study(key)
    trials = {one.variant.id: one.trials for one in measured}
    return MappingProxyType(
        {
            requirement.id: TrialVerdicts(
                requirement=requirement.id,
                verdicts=MappingProxyType({one.variant.id: one.verdicts[requirement.id] for one in measured}),
                recorded=MappingProxyType(
                    {
                        variant: one.verdict
                        for variant, one in book.get(requirement.id, {}).items()
                        if not one.is_older_than(trials.get(variant, ()))
                    }
                ),
                causes=MappingProxyType(
                    {one.variant.id: one.causes[requirement.id] for one in measured if requirement.id in one.causes}
                ),
            )
            for requirement in requirements_with_criteria(project)
        }
    )


def project_marks(folder: Path, requirement_folder: str = REQUIREMENTS) -> tuple[MarkedTest, ...] | None:
    """The marks on a project's own tests for one set of requirements; None if it has no tests of its own.

    A mark names a requirement of a set other than the default by the folder's name and its id: ``bench/SYS-001``.

    Args:
        folder: The project's folder.
        requirement_folder: The set, relative to the project.

    Raises:
        EvidenceError: A file of tests cannot be read.
    """
    if not (folder / TESTS).is_dir():
        return None
    own = qualifier_of(requirement_folder)
    others = tuple(qualifier_of(name) for name in named_sets(folder) if name != requirement_folder)
    kept = []
    for mark in marked_tests(folder, folder=TESTS):
        names = tuple(
            name.removeprefix(own) for name in mark.requirements if name.startswith(own) and not name.startswith(others)
        )
        if names:
            kept.append(replace(mark, requirements=names))
    return tuple(kept)


def failed_verifications(project: Project) -> FailedVerifications:
    """The requirements that are not met by the project's own tests, or by a verification record, that still holds.

    Args:
        project: The project with its study. A result of tests that is not there, or cannot be read, says nothing;
            `rgss trace` and `rgss report` tell the latter.
    """
    records = evidence_of_records(project.requirements, project.folder)
    folder, tests = project.study.requirements, None
    if (project.folder / JUNIT_FILE).exists():
        try:
            marked = project_marks(project.folder, folder) or ()
            tests = project_tests(project.folder, project.requirements, marked, requirement_folder=folder)
        except EvidenceError:
            tests = None
    return EvidenceState(software=tests, records=records).failed


def verification_files(folder: Path, requirements: RequirementSet | None) -> tuple[Path, ...]:
    """Files besides requirements, designs, scenes and studies on which `failed_verifications` rests.

    Args:
        folder: The project's folder.
        requirements: Its requirements with their records; None if they are not known.
    """
    records = () if requirements is None else requirements.records.values()
    named = sorted({folder / name for record in records for name in record.files})
    junit = folder / JUNIT_FILE
    return (*named, junit, *(tested_files(folder) if junit.exists() else ()))


def project_tests(
    folder: Path,
    requirements: RequirementSet,
    marked: Sequence[MarkedTest],
    *,
    requirement_folder: str = REQUIREMENTS,
    junit: Path | None = None,
) -> MappingProxyType[str, SoftwareEvidence]:
    """Results of a project's own tests for each requirement that is verified by test.

    Args:
        folder: The project's folder.
        requirements: Its requirements.
        marked: The marks on its tests.
        requirement_folder: The set of requirements, relative to the project.
        junit: The result of a run; by default the file that ``make test`` writes, which need not exist.

    Raises:
        EvidenceError: The result cannot be read, or a file of the project cannot.
    """
    path = folder / JUNIT_FILE if junit is None else junit
    report = read_junit(path, label=JUNIT_FILE) if junit is None and path.exists() else None
    if junit is not None:
        report = read_junit(path)
    return MappingProxyType(
        dict(
            software_evidence(
                requirements.system,
                marked,
                report,
                software=software_digest(folder),
                qualifier=qualifier_of(requirement_folder),
            )
        )
    )
