"""The state of a project's evidence: the verdicts of its trials, and what its own tests say."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import MappingProxyType

from rgss.assessment.measuring import VariantMeasures, requirements_with_criteria
from rgss.assessment.recorded_verdicts import VerdictRecord, study_key
from rgss.requirements import RequirementSet
from rgss.studies import Project
from rgss.trace.evidence import (
    JUNIT_FILE,
    EvidenceState,
    MarkedTest,
    SoftwareEvidence,
    TrialVerdicts,
    marked_tests,
    read_junit,
    software_digest,
    software_evidence,
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
    """What is known of each requirement.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates; empty if there is no evidence from trials.
        recorded: The verdicts that were recorded.
        junit: The result of the project's tests; the file that ``make test`` writes by default,
            which need not be there.

    Raises:
        EvidenceError: Files of tests or their result cannot be read.
    """
    marked = project_marks(project.folder)
    return EvidenceState(
        trials=trial_verdicts(project, measured, recorded=recorded),
        software=None if marked is None else project_tests(project.folder, project.requirements, marked, junit=junit),
    )


def trial_verdicts(
    project: Project, measured: Sequence[VariantMeasures], *, recorded: VerdictRecord | None = None
) -> MappingProxyType[str, TrialVerdicts]:
    """The verdicts on each requirement with a criterion, by its id.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.
        recorded: The verdicts that were recorded.
    """
    key = study_key(project.study.label, project.study.fidelity.value)
    book = {} if recorded is None else recorded.of_study(key)
    return MappingProxyType(
        {
            requirement.id: TrialVerdicts(
                requirement=requirement.id,
                verdicts=MappingProxyType({one.variant.id: one.verdicts[requirement.id] for one in measured}),
                recorded=MappingProxyType(
                    {variant: one.verdict for variant, one in book.get(requirement.id, {}).items()}
                ),
                causes=MappingProxyType(
                    {one.variant.id: one.causes[requirement.id] for one in measured if requirement.id in one.causes}
                ),
            )
            for requirement in requirements_with_criteria(project)
        }
    )


def project_marks(folder: Path) -> tuple[MarkedTest, ...] | None:
    """The marks on a project's own tests; None if it has none of its own.

    Args:
        folder: The project's folder.

    Raises:
        EvidenceError: A file of tests cannot be read.
    """
    return marked_tests(folder, folder=TESTS) if (folder / TESTS).is_dir() else None


def project_tests(
    folder: Path, requirements: RequirementSet, marked: Sequence[MarkedTest], *, junit: Path | None = None
) -> MappingProxyType[str, SoftwareEvidence]:
    """What a project's own tests say of each requirement that is verified by test.

    Args:
        folder: The project's folder.
        requirements: Its requirements.
        marked: The marks on its tests.
        junit: The result of a run; the file that ``make test`` writes by default, which need not be there.

    Raises:
        EvidenceError: The result cannot be read, or a file of the project cannot.
    """
    path = folder / JUNIT_FILE if junit is None else junit
    report = read_junit(path, label=JUNIT_FILE) if junit is None and path.exists() else None
    if junit is not None:
        report = read_junit(path)
    return MappingProxyType(
        dict(software_evidence(requirements.system, marked, report, software=software_digest(folder)))
    )
