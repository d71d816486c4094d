"""Tasks: lists of typed steps of a robot, and the stages derived from them."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tasks.check_step import CheckStep, Nearness
    from rgss.tasks.document import TaskDocument
    from rgss.tasks.grip_step import GripStep
    from rgss.tasks.move_kinds import MoveKind
    from rgss.tasks.move_step import MoveStep, Target
    from rgss.tasks.packaged_task import default_task
    from rgss.tasks.program import Step, TaskProgram, no_branch_for
    from rgss.tasks.release_step import ReleaseStep
    from rgss.tasks.scene_findings import task_findings
    from rgss.tasks.stages import Stage, stages_of
    from rgss.tasks.step_settings import StepControl
    from rgss.tasks.task_clock import TaskClock
    from rgss.tasks.task_file import LoadedTask, load_task
    from rgss.tasks.wait_step import WaitStep
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
