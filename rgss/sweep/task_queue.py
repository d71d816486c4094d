"""Task queue of a sweep: tasks, their dependencies, and the order in which they come."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from rgss.evidence import PieceKind
from rgss.sweep.durations import Durations, TaskClass
from rgss.trials.pieces import Task, TrialDigests, TrialSpec, TrialTask, tasks_of

_ORDER = {"trial": 0, PieceKind.BENCH.value: 0, PieceKind.EXECUTION.value: 1, PieceKind.TIMING.value: 2}
_LAST = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """A trial of a study."""

    key: str
    spec: TrialSpec
    digests: TrialDigests

    @property
    def pieces(self) -> dict[PieceKind, str]:
        """The digests of its pieces by their kind."""
        named = self.digests.as_mapping()
        return {kind: named[kind.value] for kind in PieceKind if kind.value in named}


class TaskQueue:
    """Priority queue of the tasks of a sweep with their dependencies.

    Tasks nearest to a finished trial come first, so that trials finish continuously and few pieces are held; among them
    the longest first, also for plans, so that no long task is left to the end while other workers are idle.
    """

    def __init__(self, trials: Sequence[Trial], *, stored: Collection[str] = (), share: bool = True) -> None:
        """Queue of the missing results.

        Args:
            trials: The trials without a record.
            stored: Digests of the stored pieces.
            share: Whether pieces are shared; otherwise every trial is one task.
        """
        self.durations = Durations()
        self._uses: Counter[str] = Counter()
        self._tasks: dict[str, Task] = {}
        self._waiting: dict[str, set[str]] = {}
        self._followers: dict[str, list[str]] = {}
        self._trials: dict[str, list[Trial]] = {}
        self._missing: dict[str, set[str]] = {}
        self._complete: deque[Trial] = deque()
        self._ready: dict[TaskClass, deque[str]] = {}
        self._left: Counter[TaskClass] = Counter()
        for trial in _by_plan(trials):
            if share:
                self._add_shared(trial, stored)
            else:
                self._add(TrialTask(digest=trial.key, spec=trial.spec), stored)
                self._trials[trial.key] = [trial]
                self._missing[trial.key] = {trial.key}

    @property
    def left(self) -> int:
        """Number of tasks that are not yet done."""
        return len(self._tasks)

    @property
    def ready(self) -> int:
        """Number of tasks that could be begun now."""
        return sum(map(len, self._ready.values()))

    def remaining_s(self) -> float:
        """The time that the tasks that are left are expected to take, one after another."""
        return sum(count * self.durations.expected_s(tasks) for tasks, count in self._left.items())

    def take(self) -> Task:
        """Take the next task; it is then no longer ready."""
        best = min(
            (tasks for tasks, queue in self._ready.items() if queue),
            key=lambda tasks: (_ORDER.get(tasks[0], _LAST), -self.durations.expected_s(tasks), tasks),
        )
        return self._tasks[self._ready[best].popleft()]

    def give_back(self, task: Task) -> None:
        """Return a task to the queue."""
        self._ready.setdefault(self.durations.class_of(task), deque()).append(task.digest)

    def done(self, digest: str, *, took_s: float) -> None:
        """Mark a task as done; tasks that depended only on it become ready.

        Args:
            digest: The task's digest.
            took_s: Its time by the wall clock.
        """
        tasks = self._remove(digest)
        self.durations.learn(tasks, took_s)
        for follower in self._followers.pop(digest, ()):
            self._waiting[follower].discard(digest)
            if not self._waiting[follower]:
                self.give_back(self._tasks[follower])
        for trial in self._trials.pop(digest, ()):
            missing = self._missing.get(trial.key)
            if missing is not None:
                missing.discard(digest)
                if not missing:
                    self._finish(trial)

    def give_up(self, digest: str) -> tuple[Trial, ...]:
        """Mark a task and its dependents as failed.

        Returns:
            The trials without a record as a consequence.
        """
        lost: dict[str, Trial] = {}
        waiting = [digest]
        while waiting:
            each = waiting.pop()
            if each not in self._tasks:
                continue
            for needed in self._tasks[each].needs:
                self.release(needed)
            self._remove(each)
            waiting += self._followers.pop(each, ())
            for trial in self._trials.pop(each, ()):
                if self._missing.pop(trial.key, None) is not None:
                    lost[trial.key] = trial
                    for piece in trial.pieces.values():
                        self.release(piece)
        return tuple(lost.values())

    def release(self, digest: str) -> None:
        """Record one use of a piece."""
        self._uses[digest] -= 1
        if self._uses[digest] <= 0:
            del self._uses[digest]

    def is_used(self, digest: str) -> bool:
        """True if something that is left needs a piece."""
        return digest in self._uses

    def complete(self) -> Iterable[Trial]:
        """The trials whose pieces have all been made since the last call."""
        while self._complete:
            yield self._complete.popleft()

    def _add_shared(self, trial: Trial, stored: Collection[str]) -> None:
        missing = set()
        for task in tasks_of(trial.spec, trial.digests):
            self._uses[task.digest] += 1
            if task.digest not in stored:
                missing.add(task.digest)
                self._trials.setdefault(task.digest, []).append(trial)
                if task.digest not in self._tasks:
                    self._add(task, stored)
        self._missing[trial.key] = missing
        if not missing:
            self._finish(trial)

    def _add(self, task: Task, stored: Collection[str]) -> None:
        self._tasks[task.digest] = task
        self._left[self.durations.class_of(task)] += 1
        self._waiting[task.digest] = {needed for needed in task.needs if needed not in stored}
        for needed in task.needs:
            self._uses[needed] += 1
        for needed in self._waiting[task.digest]:
            self._followers.setdefault(needed, []).append(task.digest)
        if not self._waiting[task.digest]:
            self.give_back(task)

    def _remove(self, digest: str) -> TaskClass:
        tasks = self.durations.class_of(self._tasks.pop(digest))
        self._left[tasks] -= 1
        self._waiting.pop(digest, None)
        return tasks

    def _finish(self, trial: Trial) -> None:
        del self._missing[trial.key]
        self._complete.append(trial)


def _by_plan(trials: Sequence[Trial]) -> list[Trial]:
    """Trials with one plan next to each other, so that its pieces are not held for long."""
    first: dict[str, int] = {}
    for number, trial in enumerate(trials):
        first.setdefault(trial.digests.plan, number)
    return sorted(trials, key=lambda trial: first[trial.digests.plan])
