"""Steps of a task, one module a kind: its data, its effect on the hand, and the method of a machine that runs it."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tasks.steps.base import HandAction, Mention, Named
    from rgss.tasks.steps.check import CheckStep, Nearness
    from rgss.tasks.steps.grip import GripStep
    from rgss.tasks.steps.kinds import RestingMachine, Step, StepMachine
    from rgss.tasks.steps.move import MoveStep, Target
    from rgss.tasks.steps.move_kind import MoveKind
    from rgss.tasks.steps.neutral import NeutralStep
    from rgss.tasks.steps.release import ReleaseStep
    from rgss.tasks.steps.step_control import StepControl
    from rgss.tasks.steps.wait import WaitStep
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
