"""Keeping results as they come: together in one transaction, none of them long in memory alone."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, Piece, Provenance, TrialRecord
from rgss.evidence.records import Numerics, code_revision, file_digests, machine, require_alike
from rgss.evidence.store import numerics_census
from rgss.studies import FOLDERS, named_inputs
from rgss.sweep.task_queue import Trial
from rgss.trials.code import versions

NON_DETERMINISM = "non-determinism: "
"""Beginning of the store's message if the same inputs gave another result."""

LONGEST_S = 1.0
"""Longest time for which a finished result may wait until it is on disk."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Origin:
    """Origin of a sweep's trials, beyond the digests.

    Attributes:
        files: SHA-256 of each input file by its name in the project.
        revision: Revision of the code; empty if it is not known.
        machine: Its machine; empty if it is not known.
        study: File of the study by its name in the project; empty if it is not known.
    """

    files: Mapping[str, str] = field(default_factory=dict)
    revision: str = ""
    machine: str = ""
    study: str = ""


def origin_of(folder: Path, study: str) -> Origin:
    """Origin of trials that are run here and now.

    Args:
        folder: The project's folder.
        study: File of the study by its name in the project.

    Raises:
        EvidenceError: An input file cannot be read.
    """
    return Origin(files=file_digests(folder, FOLDERS), revision=code_revision(), machine=machine(), study=study)


class TrialWriter:
    """Collects pieces and trials and puts them into the store about once a second."""

    def __init__(
        self,
        store: EvidenceStore,
        origin: Callable[[], Origin],
        *,
        on_kept: Callable[[str, TrialRecord], None],
        numerics: Callable[[], Numerics] = dict,
    ) -> None:
        """Begin with nothing.

        Args:
            store: The evidence store.
            origin: Callback for the provenance of the trials; called once there is one.
            on_kept: Callback with the key and the record of each trial once it is on disk.
            numerics: Callback for the numerics of the processes that make the pieces; called once there is a trial.
        """
        self._store = store
        self._origin = lru_cache(maxsize=1)(origin)
        self._on_kept = on_kept
        self._numerics = lru_cache(maxsize=1)(numerics)
        self._versions = versions()
        self._pieces: list[Piece] = []
        self._trials: list[tuple[str, TrialRecord, Provenance]] = []
        self._inputs: dict[str, Mapping[str, object]] = {}
        self._inputs_there: set[str] = set()
        self._since: float | None = None

    def keep_piece(self, piece: Piece) -> None:
        """Keep a piece."""
        self._pieces.append(piece)
        self._begin()

    def keep_trial(self, trial: Trial, record: TrialRecord) -> None:
        """Keep the record of a trial."""
        inputs = named_inputs(trial.spec)
        if inputs.digest not in self._inputs_there:
            self._inputs[inputs.digest] = inputs.values
        origin = self._origin()
        provenance = Provenance(
            inputs=trial.digests.as_mapping(),
            versions=self._versions,
            inputs_digest=inputs.digest,
            files=origin.files,
            revision=origin.revision,
            machine=origin.machine,
            numerics=self._numerics(),
            study=origin.study,
        )
        self._trials.append((trial.key, record, provenance))
        self._begin()

    def due_s(self) -> float:
        """Time in s until the next flush; the longest time if the batch is empty."""
        return LONGEST_S if self._since is None else max(0.0, self._since + LONGEST_S - time.monotonic())

    def flush_if_due(self) -> None:
        """Flush the batch if it is due.

        Raises:
            EvidenceError: The store cannot be written, or had another result.
        """
        if self._since is not None and self.due_s() == 0.0:
            self.flush()

    def flush(self) -> None:
        """Put everything that is collected.

        Raises:
            EvidenceError: The store cannot be written, or had another result.
        """
        if self._since is None:
            return
        try:
            self._store.put_many(trials=self._trials, pieces=self._pieces, inputs=self._inputs.values())
        except EvidenceError as error:
            self._explain_by_numerics(error)
            raise
        self._inputs_there.update(self._inputs)
        kept, self._trials, self._pieces, self._inputs, self._since = self._trials, [], [], {}, None
        for key, record, _ in kept:
            self._on_kept(key, record)

    def _explain_by_numerics(self, error: EvidenceError) -> None:
        """Attribute a different result for the same inputs to other numerics, if the store has such.

        Another sweep may have written it while this one ran; a piece has no record of its numerics, but the trials of
        that sweep do.
        """
        if not error.message.startswith(NON_DETERMINISM):
            return
        for there, _ in numerics_census(self._store.database):
            require_alike(f"{error.message.removeprefix(NON_DETERMINISM)}: what is stored", there, self._numerics())

    def _begin(self) -> None:
        if self._since is None:
            self._since = time.monotonic()
