"""Observer of a study in its own thread, which reads again only after a change and only while a page polls."""

from __future__ import annotations

import itertools
import secrets
import threading
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from rgss.assessment import VERDICT_FILE, VariantMeasures, failed_verifications, read_record, verification_files
from rgss.decision import ScreeningResult, measure_survivors
from rgss.decision.study_decision import StudyDecision, decide_study
from rgss.errors import DocumentError, RgssError
from rgss.evidence import EvidenceStore
from rgss.evidence.store import observed, state_of
from rgss.reports.live import live_study_document
from rgss.serving.ending_thread import EndingThread
from rgss.serving.pace import Pace
from rgss.serving.replays import can_replay
from rgss.studies import FOLDERS, Project

_PAUSE_PER_WORK = 3.0
"""Seconds of rest for each second of work, so that a concurrent sweep keeps its cores."""


class StudyObserver:
    """State of a study as its files and its evidence are.

    Args:
        folder: The project's folder.
        load: Function that reads the project; called again after a change of its files.
        evidence: The file of its evidence.
        label: Name of the evidence in messages.
    """

    def __init__(self, folder: Path, load: Callable[[], Project], *, evidence: Path, label: str) -> None:
        self._folder, self._load, self._evidence, self._label = folder, load, evidence, label
        self._lock, self._wanted = threading.Lock(), threading.Event()
        self._thread: EndingThread | None = None
        self._project: Project | None = None
        self._files: object = None
        self._seen: object = None
        self._pace = Pace()
        # A page may outlive its server; a state of the next one must not pass for one that the page has.
        self._versions = (f"{secrets.token_hex(4)}-{count}" for count in itertools.count())
        self._state: dict[str, Any] = {
            "version": next(self._versions),
            "sentence": "The evidence is being read for the first time.",
            "problem": "",
            "study": None,
        }

    def start(self) -> None:
        """Start the thread, which ends with the process."""
        self._thread = EndingThread(self._observe, name="study-observer")
        self._thread.start()

    def end(self) -> None:
        """End the thread, if it was started."""
        if self._thread is not None:
            self._wanted.set()
            self._thread.end()

    def project(self) -> Project:
        """The project as its files were at the last look.

        Raises:
            DefinitionError: They have a mistake.
        """
        found = self._project
        return self._load() if found is None else found

    def state(self, *, seen: str = "") -> dict[str, Any]:
        """The last state that was read; requests an update without waiting for it.

        Args:
            seen: The version that the caller has, of this server or of an earlier one; for the present version the
                study is omitted.
        """
        self._wanted.set()
        with self._lock:
            state = dict(self._state)
        if state["version"] == seen:
            del state["study"]
        return state

    def look(self) -> None:
        """Read files and evidence if they changed since the last look."""
        files = _files_state(self._folder)
        evidence, results = state_of(self._evidence), _results_state(self._folder, self._project)
        if (files, evidence, results) == self._seen:
            return
        study, problem = None, ""
        try:
            if self._project is None or files != self._files:
                self._project = None
                self._project, self._files = self._load(), files
                # The records of this project name files.
                results = _results_state(self._folder, self._project)
            if not evidence.exists:
                problem = f"There is no evidence in {self._label} yet; 'rgss sweep' makes it."
            else:
                study = self._read(self._project)
        except DocumentError as error:
            problem = "\n".join(str(finding) for finding in error.findings)
        except RgssError as error:
            problem = str(error)
        except (OSError, ValueError) as error:
            # A file was replaced while it was read; the next look reads it again.
            problem = f"The project cannot be read: {error}"
        except Exception as error:  # the thread must go on, and the page say why it has no study
            problem = f"The study cannot be shown: {type(error).__name__}: {error}"
        clock = time.strftime("%H:%M:%S")
        with self._lock:
            self._state = {
                "version": next(self._versions),
                "sentence": f"As of {clock}: {study['progress']['sentence']}" if study else f"As of {clock}.",
                "problem": problem,
                "study": study,
            }
        self._seen = (files, evidence, results)

    def _observe(self) -> None:
        while self._wanted.wait():
            self._wanted.clear()
            begun = time.monotonic()
            self.look()
            time.sleep((time.monotonic() - begun) * _PAUSE_PER_WORK)

    def _read(self, project: Project) -> dict[str, Any]:
        recorded = read_record(project.folder)

        def measure(store: EvidenceStore) -> tuple[tuple[VariantMeasures, ...], ScreeningResult | None]:
            return measure_survivors(project, store, recorded=recorded)

        measured, screened = observed(self._evidence, measure, label=self._label)
        made: StudyDecision | None = None
        problem = ""
        whole = [entry for entry in measured if not entry.missing]
        if whole:
            try:
                made = decide_study(
                    project,
                    whole,
                    evidence=self._label,
                    analysed=False,
                    screened=screened,
                    failed=failed_verifications(project),
                )
            except RgssError as error:
                problem = str(error)
        found = live_study_document(
            project, measured, made, problem=problem, screened=screened, replayable=can_replay(project)
        )
        progress = found["progress"]
        left = self._pace.left(time.monotonic(), progress["done"], progress["planned"])
        progress["notes"] = [*([left] if left else []), *progress["notes"]]
        return found


def _files_state(folder: Path) -> tuple[tuple[str, int, int], ...]:
    """Name, size and time of change of the project's files."""
    return _states(path for name in FOLDERS for path in (folder / name).rglob("*"))


def _results_state(folder: Path, project: Project | None) -> tuple[tuple[str, int, int], ...]:
    """The same of the verdicts, which a sweep records after its last trial, and of what verification rests on."""
    requirements = None if project is None else project.requirements
    return _states((folder / VERDICT_FILE, *verification_files(folder, requirements)))


def _states(paths: Iterable[Path]) -> tuple[tuple[str, int, int], ...]:
    found = []
    for path in paths:
        try:
            state = path.stat()
        except OSError:
            continue
        found.append((str(path), state.st_size, state.st_mtime_ns))
    return tuple(sorted(found))
