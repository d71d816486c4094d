"""Compiled task: a flat tuple of named steps."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.tasks.steps import HandAction, MoveKind, MoveStep, Step, Target


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskProgram:
    """Compiled task, with repetitions expanded.

    Attributes:
        id: Its name.
        start: Configuration at the start, at rest with the hand open; None for the robot's home.
        steps: The steps in order; their names are unique.
        time_limit_s: Longest time of the whole task, planning and motion; None for no limit.
    """

    id: str
    start: Target | None
    steps: tuple[Step, ...]
    time_limit_s: float | None = None

    @property
    def phases(self) -> tuple[str, ...]:
        """Names of the steps in order."""
        return tuple(step.name for step in self.steps)

    @property
    def moves(self) -> tuple[MoveStep, ...]:
        """Moves in order."""
        return tuple(step for step in self.steps if isinstance(step, MoveStep))

    @property
    def planned(self) -> tuple[str, ...]:
        """Names of the planned moves: the sub-tasks of the sums over n (eq. 4.3, 4.4)."""
        return tuple(step.name for step in self.moves if step.mode is MoveKind.PLANNED)

    @property
    def direct(self) -> tuple[str, ...]:
        """Names of the straight moves, which are not planned."""
        return tuple(step.name for step in self.moves if step.mode is not MoveKind.PLANNED)

    @property
    def grips(self) -> tuple[str, ...]:
        """Names of the steps that close the hand."""
        return tuple(step.name for step in self.steps if step.hand is HandAction.CLOSES)

    @property
    def releases(self) -> tuple[str, ...]:
        """Names of the steps that open the hand."""
        return tuple(step.name for step in self.steps if step.hand is HandAction.OPENS)

    @property
    def carried(self) -> tuple[str, ...]:
        """Names of the moves with an object in the hand."""
        found, is_held = [], False
        for step in self.steps:
            is_held = step.hand is HandAction.CLOSES or (is_held and step.hand is not HandAction.OPENS)
            if is_held and isinstance(step, MoveStep):
                found.append(step.name)
        return tuple(found)

    def move(self, name: str) -> MoveStep:
        """Move by name."""
        return next(step for step in self.moves if step.name == name)
