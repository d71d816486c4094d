"""Recorded verdicts of a study, with digests of their inputs.

A verdict is computed from stored evidence whenever it is needed, by the present requirement and measure. To detect
a change of either after the evidence was made, a verdict is recorded together with digests of the requirement, of
its measure's complete definition, and of the design values behind it, and with the keys of the trials that there were:
by `rgss measure --record`, and by `record_after_sweep` for the variants with trials that their record does not know.
A verdict whose digests differ from the recorded ones is stale, unless it is drawn from a trial that was made after the
recorded one: a record says nothing about newer evidence, whether the sweep that made it was interrupted or not.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from rgss.documents import canonical_json, digest, replaced_file
from rgss.errors import EvidenceError, StorageError
from rgss.evidence.records import is_digest
from rgss.evidence.store import error_of, folder_lock
from rgss.measures import Verdict

VERDICT_FILE = ".rgss/verdicts.json"
"""The record, relative to the project; it is beside the evidence, to which it belongs."""

SCHEMA_VERSION = 2
_WITHOUT_EVIDENCE = 1
"""Schema of records that do not name their trials."""

LARGEST_FILE_BYTES = 256 * 1024 * 1024

_HINT = "remove it and run 'rgss measure --record'"


@dataclass(frozen=True, slots=True, kw_only=True)
class Basis:
    """Inputs of a verdict, by SHA-256.

    Attributes:
        requirement: The requirement: its sentence, its criterion, how it is verified.
        measure: The definition of its measure and of all below it.
        design: The values of the design that the measure is computed from.
    """

    requirement: str
    measure: str
    design: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedVerdict:
    """One recorded verdict.

    Attributes:
        verdict: The verdict.
        basis: Inputs of the verdict.
        evidence: Keys of the variant's trials that were stored when it was recorded; None if the record does not name
            them.
    """

    verdict: Verdict
    basis: Basis
    evidence: frozenset[str] | None = None

    def is_older_than(self, trials: Iterable[str]) -> bool:
        """True if a trial was made after the verdict was recorded.

        Args:
            trials: Keys of trials of its variant.
        """
        return self.evidence is not None and not self.evidence.issuperset(trials)

    def without_lost(self, stored: Collection[str]) -> RecordedVerdict:
        """The verdict without the trials that are stored no longer, so that they count as new once they are made again.

        Args:
            stored: Keys of the stored trials of its variant; a record that does not name its trials has all of them.
        """
        return replace(self, evidence=frozenset(stored if self.evidence is None else self.evidence & set(stored)))


Book = Mapping[str, Mapping[int, RecordedVerdict]]
"""The recorded verdicts on each requirement by its id, for each variant by its id."""


@dataclass(frozen=True, slots=True, kw_only=True)
class VerdictRecord:
    """Every recorded verdict of a project.

    Attributes:
        studies: The recorded verdicts of each study, by `study_key`.
    """

    studies: Mapping[str, Book] = field(default_factory=lambda: MappingProxyType({}))

    def of_study(self, key: str) -> Book:
        """The recorded verdicts of one study; none if none were recorded."""
        return self.studies.get(key, MappingProxyType({}))


def study_key(label: str, fidelity: str) -> str:
    """Name of a study in the record: its file and the fidelity of its trials."""
    return f"{label} at fidelity {fidelity}"


def read_record(folder: Path) -> VerdictRecord:
    """Read what was recorded; an empty record if nothing was.

    Args:
        folder: The project's folder.

    Raises:
        EvidenceError: The file is damaged or was written by another version.
    """
    path = folder / VERDICT_FILE
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE_BYTES + 1)
    except FileNotFoundError:
        return VerdictRecord()
    except OSError as error:
        raise EvidenceError(f"{VERDICT_FILE} cannot be read: {error.strerror}", hint="check its permissions") from error
    if len(content) > LARGEST_FILE_BYTES:
        raise EvidenceError(f"{VERDICT_FILE} is too large", hint=_HINT)
    try:
        data = json.loads(content)
        if data["schema"] not in (_WITHOUT_EVIDENCE, SCHEMA_VERSION):
            raise EvidenceError(
                f"{VERDICT_FILE} has schema {data['schema']!r}; this rgss reads {SCHEMA_VERSION}", hint=_HINT
            )
        evidence = _trials(data["evidence"]) if data["schema"] == SCHEMA_VERSION else {}
        studies = {str(key): _book(book, evidence) for key, book in data["studies"].items()}
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise EvidenceError(f"{VERDICT_FILE} is not a record of verdicts", hint=_HINT) from error
    return VerdictRecord(studies=MappingProxyType(studies))


def update_record(folder: Path, change: Callable[[VerdictRecord], VerdictRecord]) -> VerdictRecord:
    """Read the record, change it and write it, excluding other processes: each may record another study.

    Args:
        folder: The project's folder.
        change: Function that returns the changed record; if it is the same, nothing is written.

    Returns:
        The changed record.

    Raises:
        EvidenceError: The file is damaged, or cannot be written.
    """
    place = (folder / VERDICT_FILE).parent
    with _translated_errors():
        place.mkdir(parents=True, exist_ok=True)
        with folder_lock(place):
            recorded = read_record(folder)
            changed = change(recorded)
            if changed != recorded:
                write_record(folder, changed)
            return changed


def write_record(folder: Path, record: VerdictRecord) -> Path:
    """Write the record atomically; the same record gives the same bytes.

    Args:
        folder: The project's folder.
        record: Every recorded verdict.

    Returns:
        The file.

    Raises:
        EvidenceError: The file cannot be written.
    """
    path = folder / VERDICT_FILE
    evidence: dict[str, list[str]] = {}
    studies = {key: _plain(book, evidence) for key, book in record.studies.items()}
    data = {"schema": SCHEMA_VERSION, "studies": studies, "evidence": evidence}
    with _translated_errors():
        path.parent.mkdir(parents=True, exist_ok=True)
        with replaced_file(path, replace_source=True) as part:
            part.write_text(canonical_json(data) + "\n", encoding="ascii")
    return path


@contextmanager
def _translated_errors() -> Iterator[None]:
    try:
        yield
    except OSError as error:
        kind = error_of(error)
        hint = "free some space, or check the disk" if kind is StorageError else "check the folder"
        raise kind(f"{VERDICT_FILE} cannot be written: {error.strerror}", hint=hint) from error


def _plain(book: Book, evidence: dict[str, list[str]]) -> dict[str, Any]:
    """Document of a book; the trials of its verdicts, which most have in common, are added to `evidence`."""
    return {
        requirement: {str(variant): _plain_verdict(one, evidence) for variant, one in sorted(variants.items())}
        for requirement, variants in book.items()
    }


def _plain_verdict(one: RecordedVerdict, evidence: dict[str, list[str]]) -> dict[str, Any]:
    document = {"verdict": one.verdict, **asdict(one.basis)}
    if one.evidence is None:
        return document
    keys = sorted(one.evidence)
    name = digest(keys)
    evidence[name] = keys
    return {**document, "evidence": name}


def _trials(data: Mapping[str, Any]) -> dict[str, frozenset[str]]:
    found = {str(name): frozenset(keys) for name, keys in data.items()}
    if not all(name == digest(sorted(keys)) and all(map(is_digest, keys)) for name, keys in found.items()):
        raise ValueError("not the trials of a verdict")
    return found


def _book(data: Mapping[str, Any], evidence: Mapping[str, frozenset[str]]) -> Book:
    return MappingProxyType(
        {
            str(requirement): MappingProxyType(
                {int(variant): _verdict(one, evidence) for variant, one in variants.items()}
            )
            for requirement, variants in data.items()
        }
    )


def _verdict(data: Mapping[str, Any], evidence: Mapping[str, frozenset[str]]) -> RecordedVerdict:
    digests = {name: data[name] for name in ("requirement", "measure", "design")}
    if not all(map(is_digest, digests.values())):
        raise ValueError("not a digest")
    trials = evidence[data["evidence"]] if "evidence" in data else None
    return RecordedVerdict(verdict=Verdict(data["verdict"]), basis=Basis(**digests), evidence=trials)
