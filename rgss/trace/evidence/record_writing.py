"""Writing of verification records."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

from rgss.documents import write_small_source
from rgss.errors import DefinitionError, EvidenceError
from rgss.findings import shown
from rgss.requirements import RecordedResult, RequirementSet, VerificationRecord
from rgss.trace.evidence.digest import verification_digest
from rgss.trace.evidence.record_evidence import content_of_file

VERIFICATIONS = "verifications.yaml"
"""The file in the requirements folder."""

LONGEST_NAME = 80
LONGEST_NOTE = 1_000

_HEAD = (
    "# Written by 'rgss verify'; the requirement and the files are told by SHA-256 of their content,\n"
    "# so that a record is stale once one of them differs.\n"
)


def new_record(
    project: Path, *, result: RecordedResult, by: str, on: str, today: date, note: str = "", files: Sequence[str] = ()
) -> VerificationRecord:
    """A record of what a person found, for `with_record`.

    Args:
        project: The project's folder.
        result: What was found.
        by: Who verified.
        on: When, as ``2026-05-12``.
        today: The present day; a verification of later days has not taken place.
        note: What was done or seen.
        files: What it rests on, such as the protocol, and what was inspected; relative to the current folder or the
            project's.

    Raises:
        DefinitionError: The name or the note is no line of text, the date is none or still to come, or a file is not in
            the project.
        EvidenceError: A file cannot be read.
    """
    try:
        day = date.fromisoformat(on)
    except ValueError:
        raise DefinitionError(f"{shown(on)} is no date", hint="write year, month and day: --on 2026-05-12") from None
    # East of here it may be tomorrow.
    if day > today + timedelta(days=1):
        raise DefinitionError(f"{day} has not come yet", hint="give the day of the verification, or record it then")
    comment = _line(note, "a note", LONGEST_NOTE, "--note TEXT") if note.strip() else None
    return VerificationRecord(
        result=result,
        by=_line(by, "who verified", LONGEST_NAME, "--by NAME"),
        date=day.isoformat(),
        note=comment,
        files=dict(sorted(_stamped(project, name) for name in files)),
        requirement="0" * 64,
    )


def with_record(
    requirements: RequirementSet, ids: Sequence[str], record: VerificationRecord | None
) -> Mapping[str, VerificationRecord]:
    """Records of a project after some of its requirements were verified.

    Args:
        requirements: The requirements, with the records so far.
        ids: Ids of the requirements that were verified.
        record: What was found, from `new_record`; None to withdraw what is recorded.

    Returns:
        Every record by id, sorted. Records of requirements that are gone are left out.

    Raises:
        DefinitionError: An id is not that of a system requirement, or has no record to withdraw.
    """
    there = {requirement.id for requirement in requirements.system}
    kept = {one: stated for one, stated in requirements.records.items() if one in there}
    for each in ids:
        requirement = requirements.requirement(each)
        if record is not None:
            kept[each] = replace(record, requirement=verification_digest(requirement))
        elif kept.pop(each, None) is None:
            raise DefinitionError(f"{each!r} has no verification record", hint="'rgss trace' shows those that have")
    return dict(sorted(kept.items()))


def write_records(folder: Path, records: Mapping[str, VerificationRecord]) -> Path:
    """Write the records atomically.

    Args:
        folder: The requirements folder.
        records: Every record by id.

    Returns:
        The file.

    Raises:
        DefinitionError: The file would exceed the size limit of the reader, or the folder cannot be written.
        StorageError: The disk is full.
    """
    text, holds = records_yaml(records), f"{len(records)} records"
    return write_small_source(folder / VERIFICATIONS, text, holds=holds, hint="give shorter notes")


def records_yaml(records: Mapping[str, VerificationRecord]) -> str:
    """Canonical text of some records, independent of their order."""
    if not records:
        return f"{_HEAD}verifications: {{}}\n"
    lines = [_HEAD, "verifications:\n"]
    for name, record in sorted(records.items()):
        lines.append(
            f'  {name}:\n    result: {record.result.value}\n    by: {_quoted(record.by)}\n    date: "{record.date}"\n'
        )
        lines += [f"    note: {_quoted(record.note)}\n"] if record.note else []
        lines.append("    files:\n" if record.files else "    files: {}\n")
        lines += [f'      {_quoted(file)}: "{digest}"\n' for file, digest in sorted(record.files.items())]
        lines.append(f'    requirement: "{record.requirement}"\n')
    return "".join(lines)


def _stamped(project: Path, name: str) -> tuple[str, str]:
    # As a path of the shell, otherwise relative to the project.
    path = Path(name) if Path(name).exists() else project / name
    try:
        inside = path.resolve().relative_to(project.resolve()).as_posix()
    except (ValueError, OSError, RuntimeError):
        raise DefinitionError(
            f"{shown(name)} is not a file of the project", hint="copy it into the project, such as to protocols/"
        ) from None
    if not inside.isprintable():
        raise DefinitionError(f"{shown(name)} has a character that cannot be printed", hint="rename the file")
    try:
        return inside, content_of_file(path)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise EvidenceError(f"{shown(name)} cannot be read: {reason}", hint="check the name") from error


def _line(text: str, what: str, longest: int, hint: str) -> str:
    line = " ".join(text.split())
    if not line or len(line) > longest or not line.isprintable():
        raise DefinitionError(f"{what} is stated by 1 to {longest} printable characters", hint=f"give {hint}")
    return line


def _quoted(text: str) -> str:
    """A printable text as a double-quoted scalar of YAML."""
    return json.dumps(text, ensure_ascii=False)
