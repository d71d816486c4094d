"""Replays of single trials for the page of a study: each is run again when it is asked for, and kept in memory."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import Future

from rgss.engines import missing_engines
from rgss.errors import DefinitionError
from rgss.evidence import Fidelity
from rgss.serving.ending_thread import EndingThread
from rgss.studies import Project, trial_specs

MOST_KEPT = 6
"""Pages that are kept, some 1 MB each."""

_HIGHEST_SEED = 2**31 - 1


def can_replay(project: Project) -> bool:
    """True if trials of a study can be replayed here: contact is simulated, and the engines are installed."""
    return project.study.fidelity is Fidelity.CONTACT and not missing_engines(pictures=True)


class TrialReplays:
    """Replays of trials, one made at a time.

    Args:
        project: The project as its files are now.
    """

    def __init__(self, project: Callable[[], Project]) -> None:
        self._project = project
        self._lock, self._making = threading.Lock(), threading.Lock()
        self._of: Project | None = None
        self._threads: list[EndingThread] = []
        self._pages: OrderedDict[tuple[int, int], Future[str]] = OrderedDict()

    def page(self, variant: int, seed: int) -> Future[str]:
        """The HTML page of a replay, which is made in a thread that ends with the process.

        Args:
            variant: The variant's id.
            seed: The trial's seed.

        Returns:
            The page, or the `RgssError` for which there is none.

        Raises:
            DefinitionError: The project's files have a mistake.
        """
        project, key = self._project(), (variant, seed)
        with self._lock:
            if project is not self._of:
                self._of = project
                self._pages.clear()
            found = self._pages.get(key)
            if found is None or (found.done() and found.exception() is not None):
                found = self._pages[key] = Future()
                # Whoever waits may leave; the page is made all the same.
                found.set_running_or_notify_cancel()
                thread = EndingThread(self._make, (found, project, variant, seed), name="trial-replay")
                self._threads = [*(each for each in self._threads if each.is_alive()), thread]
                thread.start()
            self._pages.move_to_end(key)
            while len(self._pages) > MOST_KEPT:
                self._pages.popitem(last=False)
        return found

    def end(self) -> None:
        """End the threads that make pages."""
        with self._lock:
            threads = self._threads
        for each in threads:
            each.end()

    def _make(self, made: Future[str], project: Project, variant: int, seed: int) -> None:
        with self._making:
            try:
                made.set_result(replay_page(project, variant, seed))
            except Exception as error:  # every failure is the answer to whoever waits for the page
                made.set_exception(error)


def replay_page(project: Project, variant: int, seed: int) -> str:
    """Run a trial again, and make the page that replays it.

    Args:
        project: The project with its study.
        variant: The variant's id.
        seed: The trial's seed.

    Raises:
        DefinitionError: There is no such trial, or nothing of it to be seen.
        SimulationError: The physics engine cannot build the world.
    """
    from rgss.reports.replay import packed_replay, replay_to_html
    from rgss.sweep import compute
    from rgss.trials.replay import run_replayed_trial

    if not can_replay(project):
        raise DefinitionError(
            "trials of this study cannot be replayed here", hint="contact fidelity, and pip install 'rgss[sim]'"
        )
    if not 0 <= seed <= _HIGHEST_SEED:
        raise DefinitionError(f"seed must be from 0 to {_HIGHEST_SEED}, got {seed}")
    (spec,) = trial_specs(project, variants=[project.designs.variant(variant)], seeds=[seed])
    replayed = compute(run_replayed_trial, spec)
    if replayed.trace is None or replayed.scene is None:
        raise DefinitionError(
            f"trial {variant}/{seed} ended before anything moved: {replayed.record.failure_detail}",
            hint="there is nothing to replay",
        )
    return replay_to_html(
        [packed_replay(replayed.record, replayed.trace, replayed.scene, joints=spec.scene.robot.joints)]
    )
