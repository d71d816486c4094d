"""Tasks: lists of typed steps of a robot, and the stages derived from them."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tasks.packaged_task import default_task
    from rgss.tasks.program import TaskProgram
    from rgss.tasks.reading import LoadedTask, TaskDocument, load_task, task_findings
    from rgss.tasks.stages import Stage, stages_of
    from rgss.tasks.steps import (
        CheckStep,
        GripStep,
        HandAction,
        MoveKind,
        MoveStep,
        Named,
        Nearness,
        NeutralStep,
        ReleaseStep,
        RestingMachine,
        Step,
        StepControl,
        StepMachine,
        Target,
        WaitStep,
    )
    from rgss.tasks.task_clock import TaskClock
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
